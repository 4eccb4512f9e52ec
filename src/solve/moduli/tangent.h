#ifndef GB_SOLVE_MODULI_TANGENT_H
#define GB_SOLVE_MODULI_TANGENT_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"
#include "pack/cell/world.h"
#include "pack/kernel/pair_tangent.h"

/* Stiffness matrix of a packing from the tangents of its pairs, and the linear equations
 * of all displacements and rotations with it.  It is not symmetric where contacts slide.
 *
 * Vectors have 6 x count numbers: displacements (count x 3, d), then rotations; forces
 * (E d^2), then torques. */
struct gb_tangent {
    int64_t count, pairs;
    struct gb_pair_tangent *pair; /* stiffness transposed */
    double *inverse;              /* count x 36: inverse blocks of the diagonal */
    double *scratch[5];           /* of gb_tangent_solve */
};

/* Of a world in double precision right after an evaluation; the world does not change.
 * motion: as of gb_pair_tangent_list; NULL is fine. */
bool gb_tangent_create(struct gb_tangent **out, const struct gb_world *world,
                       struct gb_error *err);
/* Another motion of the same world. */
bool gb_tangent_renew(struct gb_tangent *tangent, const struct gb_world *world,
                      const struct gb_pair_tangent_motion *motion, struct gb_error *err);
void gb_tangent_destroy(struct gb_tangent *tangent); /* NULL is fine */

/* Forces and torques after an affine strain with the particles held.  Returns what their
 * norm would be if the forces of pairs did not cancel: in a lattice they do. */
double gb_tangent_affine(const struct gb_tangent *tangent, const double strain[3][3],
                         double *force);

/* Motion that these forces cause: stabilised biconjugate gradients to a residual of
 * `tolerance` of the forces, or until the iterations end.  Directions without stiffness do
 * not move.  Returns the iterations. */
int gb_tangent_solve(struct gb_tangent *tangent, const double *force, double tolerance,
                     int iterations_max, double *motion);

/* Change of sum f_i r_j over the pairs (E d^3) by a strain and a motion. */
void gb_tangent_virial(const struct gb_tangent *tangent, const double strain[3][3],
                       const double *motion, double change[3][3]);

#endif
