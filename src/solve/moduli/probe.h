#ifndef GB_SOLVE_MODULI_PROBE_H
#define GB_SOLVE_MODULI_PROBE_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"
#include "pack/cell/world.h"
#include "pack/kernel/pair_tangent.h"
#include "solve/relax/relax.h"

/* Stiffness matrix of a packing from the tangents of its pairs, and the linear equations
 * of all displacements and rotations with it.  It is not symmetric where contacts slide.
 *
 * Vectors have 6 x count numbers: displacements (count x 3, d), then rotations; forces
 * (E d^2), then torques. */
struct gb_tangent {
    int64_t count, pairs;
    struct gb_pair_tangent *pair; /* stiffness transposed */
    double *inverse;              /* count x 36: inverse blocks of the diagonal */
    double *scratch[5];           /* of gb_probe_solve */
};

/* Forces and torques after an affine strain with the particles held.  Returns what their
 * norm would be if the forces of pairs did not cancel: in a lattice they do. */
double gb_probe_affine(const struct gb_tangent *tangent, const double strain[3][3],
                       double *force);

/* Motion that these forces cause: stabilised biconjugate gradients to a residual of
 * `tolerance` of the forces, or until the iterations end.  Directions without stiffness do
 * not move.  Returns the iterations. */
int gb_probe_solve(struct gb_tangent *tangent, const double *force, double tolerance,
                   int iterations_max, double *motion);

/* Change of sum f_i r_j over the pairs (E d^3) by a strain and a motion. */
void gb_probe_virial(const struct gb_tangent *tangent, const double strain[3][3],
                     const double *motion, double change[3][3]);

/* A copy of a packing in double precision, for small strains: each is applied to the same
 * saved state as one increment, with the motion that keeps the forces in balance.  The
 * contact histories then advance once, from the same start, whatever the solver tried on
 * the way.  The packing that was copied does not change.
 *
 * Equilibrium is found by Newton's method with the stiffness matrix of the saved state,
 * and by FIRE where that does not converge. */
struct gb_probe {
    struct gb_model model; /* of the copy */
    struct gb_world *world;
    struct gb_world_copy *base; /* where every strain begins */
    struct gb_relax *relax;
    struct gb_tangent *tangent;    /* of the saved state ... */
    struct gb_tangent *local;      /* ... and after the motion so far */
    double *motion;                /* 6 x count, as in probe.h: of the last strain ... */
    double *force, *step;          /* ... and scratch */
    double pressure[3][3];         /* of the saved state, E */
    double residual;               /* of it, as gb_world_residual */
    double moved_rms, moved_most;  /* from the packing that was copied, d */
    bool (*cancelled)(void *data); /* polled; NULL is fine */
    void *data;
    int64_t iterations; /* of the conjugate gradients so far */
    int64_t fallbacks;  /* strains that were relaxed by FIRE */
};

/* Copies a world right after an evaluation and relaxes the copy to GB_PROBE_RESIDUAL.
 * cancelled as above, from the start.  Errors: GB_ERR_INPUT where no equilibrium is near,
 * GB_ERR_GUARD, GB_ERR_MEMORY, GB_ERR_CANCELLED. */
bool gb_probe_create(struct gb_probe **out, const struct gb_world *world,
                     bool (*cancelled)(void *data), void *data, struct gb_error *err);
void gb_probe_destroy(struct gb_probe *probe); /* NULL is fine */

/* Pressure tensor (E) after a symmetric strain of the saved state.
 *
 * first    the first motion tried is probe->motion times this
 * share    residual allowed, as a share of that of the affine strain */
bool gb_probe_strain(struct gb_probe *probe, const double strain[3][3], double first,
                     double share, double pressure[3][3], struct gb_error *err);

/* The state after the last strain becomes the saved one. */
bool gb_probe_advance(struct gb_probe *probe, struct gb_error *err);

/* A copy of the saved state, and back to it: for several advances from one state. */
bool gb_probe_save(const struct gb_probe *probe, struct gb_world_copy **copy,
                   struct gb_error *err);
bool gb_probe_return(struct gb_probe *probe, const struct gb_world_copy *copy,
                     struct gb_error *err);

#endif
