#ifndef GB_PACK_KERNEL_PAIR_TANGENT_H
#define GB_PACK_KERNEL_PAIR_TANGENT_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"

struct gb_world;

/* Contacts that a world in double precision has from one in single precision.  A spring
 * that slides stays just below its cap there, and rounding hides that: a small strain would
 * find it sticking both ways.  The same holds for a bridge at its deepest overlap, and for
 * one that peels.
 *
 * Springs within the rounding of single precision of their caps are lengthened to them, and
 * such bridges put where they are.  The laws of the world's own sweep decide, so this holds
 * for every law and size.  3D; right after an evaluation, and another must follow.
 *
 * most     largest change of a spring or a bridge, d
 * Errors: GB_ERR_MEMORY. */
bool gb_pair_tangent_undo(struct gb_world *world, double *most, struct gb_error *err);

struct gb_world;

/* Nine numbers describe the motion of a pair: the branch vector r_ij, the rotation of i,
 * the rotation of j; their conjugates are the force on i (its opposite acts on j) and the
 * torques on i and j. */
enum { GB_PAIR_TANGENT_WIDTH = 9 };

/* A pair that transmits forces, at the state of the last evaluation.  Reduced units. */
struct gb_pair_tangent {
    int32_t first, other;
    double r[3];     /* x_first - x_other, nearest image, d */
    double force[3]; /* on the first, E d^2 */
    /* Minus the derivatives of the conjugates by the nine numbers.  Not symmetric where
     * springs are loaded; a spring at its cap counts half. */
    double stiffness[GB_PAIR_TANGENT_WIDTH][GB_PAIR_TANGENT_WIDTH];
};

/* A strain with displacements (count x 3, d), then rotations, of all particles. */
struct gb_pair_tangent_motion {
    double strain[3][3];
    const double *motion; /* 6 x count */
    double step; /* of the differences, d: far below the motion of a contact, so that both
                  * sides slide or neither */
};

/* Tangents of all pairs of a world in double precision, right after an evaluation: central
 * differences of the laws of its own sweep, so for every law, size and dimension.  In the
 * order of the lists.  The world does not change.
 *
 * motion       where the differences are taken, from the contact histories as they are: a
 *              spring that slides by this motion slides on both sides; NULL: no motion
 * out, count   made here; freed with gb_alloc_free
 * Errors: GB_ERR_MEMORY. */
bool gb_pair_tangent_list(const struct gb_world *world,
                          const struct gb_pair_tangent_motion *motion,
                          struct gb_pair_tangent **out, int64_t *count,
                          struct gb_error *err);

#endif
