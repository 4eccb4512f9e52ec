#ifndef GB_MANY_PARAM_SWEEP_H
#define GB_MANY_PARAM_SWEEP_H

#include <glib.h>
#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"
#include "many/ensemble.h"
#include "many/reading.h"

/* The points of a sweep: keys and the values each of them takes, all combinations of them
 * (a grid) or one of each at a point (a design). */
enum { GB_AXES_MOST = 6, GB_AXES_VALUES_MOST = 10000 };

struct gb_axis {
    const struct gb_field *field;
    GPtrArray *values; /* char *, as a preset would write them */
    double *share;     /* of a design: place in the range at each point, 0 to 1 */
    bool material;     /* values are names of materials, the field is material.name */
};

struct gb_axes {
    struct gb_axis axis[GB_AXES_MOST];
    size_t count;
    size_t design; /* points of a Sobol sequence over the ranges; 0: a grid */
};

/* Reads "sobol:64" into axes without an axis.  Errors: GB_ERR_INPUT. */
bool gb_param_sweep_design(struct gb_axes *axes, const char *text, struct gb_error *err);

/* Adds "contact.mu=0.05:0.4:8" (from, to, how many; ":log" behind it spaces them evenly
 * in the logarithm), or a list "particles.diameter=9.7;16;21;38 nm",
 * "loading.geometry=uniaxial;isotropic".  A number without a unit takes that at the end.
 * In a design a range has no count, "contact.mu=0.05:0.4" or "...:log": coordinate k of the
 * Sobol sequence (GSL; Antonov and Saleev, USSR Comput. Maths Math. Phys. 19, 252 (1980))
 * is the share of axis k, evenly in the value or its logarithm, so that a longer design
 * contains the shorter.  "material=alumina;yttria" varies all keys of [material] by name, in
 * front of the other axes; its column is that of material.name.
 *
 * Errors: GB_ERR_INPUT with what was given and what is expected, for values that the key
 * refuses, values given twice, and keys that make no other experiment (seed, title,
 * threads, [output]) or are lists themselves. */
bool gb_param_sweep_add_axis(struct gb_axes *axes, const char *text,
                             struct gb_error *err);

void gb_param_sweep_axes_finish(struct gb_axes *axes); /* zeroed is fine */

/* Points; 1 without axes. */
size_t gb_param_sweep_points(const struct gb_axes *axes);

/* Value of one axis at a point; the last axis of a grid runs fastest. */
const char *gb_param_sweep_value(const struct gb_axes *axes, size_t point, size_t axis);

/* Gives params the values of a point and checks them. */
bool gb_param_sweep_apply(const struct gb_axes *axes, size_t point,
                          struct gb_params *params, struct gb_error *err);

/* "mu-0.2_diameter-9.7nm": a name that depends on the values only, so that a grid can
 * grow in the same directory, and tells any two points apart; "scene" without axes.  Of words
 * that may have any character (a material, a path of loading) those that are neither
 * letters, digits, '.', '+' nor '-' become "~" and two hexadecimal digits per byte, and
 * what is longer than a file name may be ends with "~~" and a checksum.  Caller
 * g_frees. */
char *gb_param_sweep_point_name(const struct gb_axes *axes, size_t point);

/* The same for a table: the name of a column, "contact.mu" or "particles.diameter_nm",
 * and the cell of a point under it, a number in that unit, or a word.  Name: caller
 * g_frees; cell: returns buffer. */
char *gb_param_sweep_column(const struct gb_axes *axes, size_t axis);

char *gb_param_sweep_cell(const struct gb_axes *axes, size_t point, size_t axis,
                          char *buffer, size_t size);

enum { GB_SWEEP_TABLE_PRESSURES = 256 };

/* Pressures at which a sweep is tabulated, ascending. */
struct gb_sweep_table_pressures {
    double pa[GB_SWEEP_TABLE_PRESSURES];
    size_t count;
};

/* "50 MPa;100 MPa;1 GPa" or "50;100 MPa".  Errors: GB_ERR_INPUT. */
bool gb_param_sweep_pressures(struct gb_sweep_table_pressures *at, const char *text,
                              struct gb_error *err);

/* The default: 1, 2, 5, 10, ... MPa up to the end of loading, and the pressures of
 * unloading. */
void gb_param_sweep_default_pressures(struct gb_sweep_table_pressures *at,
                                      const struct gb_params *params);

/* Branches of a curve on which a sweep reads its figures: loading, and unloading from a
 * pressure. */
enum { GB_SWEEP_BRANCHES = 2 };

const char *gb_param_sweep_branch(size_t branch); /* "load", "unload" */

/* The figures of the runs of one point that count, at all pressures. */
struct gb_sweep_readings {
    double *value; /* [branch][pressure][quantity][run]; NaN: not reached, or failed */
    size_t pressures, runs;
};

/* Reads the curves.  A run that cannot be read counts as failed; its error goes to the run.
 * gb_param_sweep_readings_finish is due. */
void gb_param_sweep_readings_init(struct gb_sweep_readings *readings,
                                  struct gb_ensemble *ensemble, size_t point,
                                  const struct gb_sweep_table_pressures *at);

void gb_param_sweep_readings_finish(
    struct gb_sweep_readings *readings); /* zeroed is fine */

/* The values of one figure over the runs. */
const double *gb_param_sweep_readings_at(const struct gb_sweep_readings *readings,
                                         size_t branch, size_t pressure, size_t quantity);

/* Ends the replicas of a point when the standard error of their mean density at a pressure
 * is small enough. */
struct gb_sweep_target {
    double standard_error; /* of the density; 0: all replicas are done */
    double pressure_pa;
    double *density; /* of each run at the pressure, NaN where it failed ... */
    bool *is_read;   /* ... once its curve.csv was read */
};

/* Reads "0.002@100MPa".  Errors: GB_ERR_INPUT. */
bool gb_param_sweep_target(struct gb_sweep_target *target, const char *text,
                           struct gb_error *err);

void gb_param_sweep_target_finish(struct gb_sweep_target *target); /* zeroed is fine */

/* Points whose replicas were all done before the standard error was small enough. */
size_t gb_param_sweep_missed(const struct gb_sweep_target *target,
                             const struct gb_ensemble *ensemble);

/* Number of the runs that count and have not reached what they should: goals of their
 * loading, equilibrium of points. */
size_t gb_param_sweep_shortfalls(const struct gb_ensemble *ensemble);

/* sweep.csv: a row per point of the grid, branch and pressure: the varied values, the
 * number of runs that reached it, mean and standard error of each figure over them.  Branch load is
 * read at the pressure; unload is the end of unloading from it.  A run that cannot be
 * read counts as failed; its error goes to the run.  Caller frees. */
GString *gb_param_sweep_means(struct gb_ensemble *ensemble, const struct gb_axes *axes,
                              const struct gb_sweep_table_pressures *at);

/* runs.csv: a row per run: directory, point, seed, done, failed or missing, why. */
GString *gb_param_sweep_runs(const struct gb_ensemble *ensemble);

/* A grid of parameters with replicas, a directory for each run, and its tables. */
struct gb_param_sweep {
    struct gb_axes axes;
    struct gb_sweep_table_pressures at;
    struct gb_sweep_target target;
    struct gb_ensemble ensemble;
};

/* Makes the list of runs in directory, from axes, target and the scene of params; marks
 * those that are done.  Errors: GB_ERR_INPUT, GB_ERR_MEMORY.  gb_param_sweep_finish is due in
 * any case. */
bool gb_param_sweep_fill(struct gb_param_sweep *sweep, const struct gb_params *params,
                         size_t replicas, const char *directory, struct gb_error *err);
void gb_param_sweep_finish(struct gb_param_sweep *sweep); /* zeroed is fine */

/* Writes sweep.csv and runs.csv, whatever state the runs are in. */
bool gb_param_sweep_write(struct gb_param_sweep *sweep, const char *directory,
                          struct gb_error *err);

/* Writes a further table of the sweep, and frees its text. */
bool gb_param_sweep_put(const char *directory, const char *name, GString *text,
                        struct gb_error *err);

#endif
