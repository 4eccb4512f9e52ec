#ifndef GB_SOLVE_RELAX_H
#define GB_SOLVE_RELAX_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "greenbody/status.h"
#include "pack/world.h"

/* Relaxation of a world to equilibrium: one table of methods, one stopping rule.
 *
 * The rule: gb_world_residual (rms force and torque over the mean contact force or
 * f_a(d)) at or below the tolerance.  A method only moves the particles after each
 * evaluation. */
struct gb_relax;

struct gb_relaxer {
    const char *name; /* as in numerics.relaxer */
    const char *doc;
    size_t state_size; /* bytes of its state ... */
    int vectors;       /* ... and how many arrays of count x 3 doubles it needs */
    void (*start)(struct gb_relax *relax, struct gb_world *world);
    void (*move)(struct gb_relax *relax, struct gb_world *world);
};

/* The table, NULL-terminated, and look-up by name (NULL when unknown). */
const struct gb_relaxer *const *gb_relax_table(void);
const struct gb_relaxer *gb_relax_find(const char *name);

struct gb_relax {
    const struct gb_relaxer *method;
    void *state;
    double *vector[4]; /* count x 3 each */
    double tolerance;
    int64_t max_evaluations;         /* per relaxation */
    int64_t iterations, evaluations; /* of the relaxation under way */
    double residual;
};

enum gb_relax_outcome {
    GB_RELAX_MORE,      /* the slice is used up */
    GB_RELAX_DONE,      /* residual at or below the tolerance */
    GB_RELAX_EXHAUSTED, /* max_evaluations reached: not converged */
    GB_RELAX_FAILED     /* err says why */
};

bool gb_relax_create(struct gb_relax **out, const struct gb_model *model,
                     struct gb_error *err);
void gb_relax_destroy(struct gb_relax *relax); /* NULL is fine */

/* Begins a relaxation: the particles are at rest, nothing is remembered but step sizes.
 */
void gb_relax_start(struct gb_relax *relax, struct gb_world *world);

/* At most max_evaluations force evaluations of it.  It always ends right after an
 * evaluation, so forces, histories and positions belong together. */
enum gb_relax_outcome gb_relax_advance(struct gb_relax *relax, struct gb_world *world,
                                       int64_t max_evaluations, struct gb_error *err);

extern const struct gb_relaxer gb_relax_fire;
extern const struct gb_relaxer gb_relax_steepest;

#endif
