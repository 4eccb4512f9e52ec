#ifndef GB_MANY_SWEEP_AXES_H
#define GB_MANY_SWEEP_AXES_H

#include <stdbool.h>
#include <stddef.h>

#include <glib.h>

#include "greenbody/params.h"

/* The points of a sweep: keys and the values each of them takes, all combinations of them
 * (a grid) or one of each at a point (a design). */
enum { GB_AXES_MOST = 6, GB_AXES_VALUES_MOST = 10000 };

struct gb_axis {
    const struct gb_field *field;
    GPtrArray *values; /* char *, as a preset would write them */
    double *share;     /* of a design: place in the range at each point, 0 to 1 */
    bool material; /* the values are names of materials, the field is that of the name */
};

struct gb_axes {
    struct gb_axis axis[GB_AXES_MOST];
    size_t count;
    size_t design; /* points of a Sobol sequence over the ranges; 0: a grid */
};

/* Reads "sobol:64" into axes without an axis.  Errors: GB_ERR_INPUT. */
bool gb_axes_design(struct gb_axes *axes, const char *text, struct gb_error *err);

/* Adds "contact.mu=0.05:0.4:8" (from, to, how many; ":log" behind it spaces them evenly
 * in the logarithm), or a list "particles.diameter=9.7;16;21;38 nm",
 * "loading.geometry=uniaxial;isotropic".  A number without a unit takes that at the end.
 * In a design a range has no count, "contact.mu=0.05:0.4" or "...:log": coordinate k of the
 * Sobol sequence (GSL; Antonov and Saleev, USSR Comput. Maths Math. Phys. 19, 252 (1980))
 * is the share of axis k, evenly in the value or its logarithm, so that a longer design
 * contains the shorter.  "material=alumina;yttria" varies all keys of [material] by name, in
 * front of the other axes; its column is that of material.name.
 *
 * Errors: GB_ERR_INPUT with what was given and what is accepted, for values that the key
 * refuses, values given twice, and keys that make no other experiment (seed, title,
 * threads, [output]) or are lists themselves. */
bool gb_axes_add(struct gb_axes *axes, const char *text, struct gb_error *err);
void gb_axes_finish(struct gb_axes *axes); /* zeroed is fine */

/* Points; 1 without axes. */
size_t gb_axes_points(const struct gb_axes *axes);

/* Value of one axis at a point; the last axis of a grid runs fastest. */
const char *gb_axes_value(const struct gb_axes *axes, size_t point, size_t axis);

/* Gives params the values of a point and checks them. */
bool gb_axes_apply(const struct gb_axes *axes, size_t point, struct gb_params *params,
                   struct gb_error *err);

/* Has the key words of its own, in which every character counts? */
bool gb_axes_is_free_text(const struct gb_axis *axis);

/* "mu-0.2_diameter-9.7nm": a name that depends on the values only, so that a grid can
 * grow in the same directory, and tells any two points apart; "scene" without axes.  Of words
 * that may have any character (a material, a path of loading) those that are neither
 * letters, digits, '.', '+' nor '-' become "~" and two hexadecimal digits per byte, and
 * what is longer than a file name may be ends with "~~" and a checksum.  Caller
 * g_frees. */
char *gb_axes_name(const struct gb_axes *axes, size_t point);

/* The same for a table: the name of a column, "contact.mu" or "particles.diameter_nm",
 * and the cell of a point under it, a number in that unit, or a word.  Name: caller
 * g_frees; cell: returns buffer. */
char *gb_axes_column(const struct gb_axes *axes, size_t axis);
char *gb_axes_cell(const struct gb_axes *axes, size_t point, size_t axis, char *buffer,
                   size_t size);

#endif
