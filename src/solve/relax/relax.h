#ifndef GB_SOLVE_RELAX_RELAX_H
#define GB_SOLVE_RELAX_RELAX_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "greenbody/status.h"
#include "pack/cell/world.h"

/* Relaxation of a world to equilibrium: one table of methods, one stopping rule.
 *
 * The rule: a relaxation ends when the residual is at or below the tolerance, both in
 * the unit that numerics.tolerance_scale names.  All that a method does is to move the
 * particles after each evaluation. */
struct gb_relax;
struct gb_record;

/* Rotational inertia of relaxers in m d^2.  A sphere has 0.1; 0.4 brings the rotational
 * frequencies down to the translational ones. */
#define GB_RELAX_INERTIA 0.4

struct gb_relaxer {
    const char *name; /* as in numerics.relaxer */
    const char *doc;
    size_t state_size; /* bytes of its state ... */
    int vectors;       /* ... and how many arrays of count x 3 doubles it needs */
    bool moving;       /* the first two are velocities and angular velocities */
    int rotation_sum;  /* vector that adds up the rotation increments; 0: none */
    /* Least share of the tolerance under light loads, where it falls with the mean
     * contact force over f_a(d); 1: the tolerance holds everywhere. */
    double light;
    bool slow; /* hundreds of evaluations a strain step: a chart has two settings of it */
    void (*start)(struct gb_relax *relax, struct gb_world *world);
    void (*move)(struct gb_relax *relax, struct gb_world *world);
    /* Particles at rest where they are, the memory of the strain step kept; NULL: as
     * start. */
    void (*rest)(struct gb_relax *relax, struct gb_world *world);
    /* State kept from one relaxation to the next, into a checkpoint or out of it; NULL:
     * start sets all of it. */
    bool (*record)(struct gb_relax *relax, int64_t count, struct gb_record *record,
                   struct gb_error *err);
};

/* The table, NULL-terminated, and look-up by name (NULL when unknown). */
const struct gb_relaxer *const *gb_relax_table(void);
const struct gb_relaxer *gb_relax_find(const char *name);

struct gb_relax {
    const struct gb_relaxer *method;
    void *state;
    double *vector[4]; /* count x 3 each; less in worlds with an f32 state, which has the
                          * velocities */
    float *rotation_sum; /* with an f32 state, instead of vector[method->rotation_sum] */
    bool sheared;        /* the cell may be tilted */
    double tolerance;
    double
        allowed; /* residual at which this relaxation is done: less under light loads */
    int scale;   /* enum gb_tolerance_scale: unit of tolerance and residual */
    double stiffness; /* of the most strongly held particle, E d; 0: not yet known */
    double *sum;      /* count: scratch; NULL unless scale = displacement */
    int64_t max_evaluations;         /* per relaxation */
    int64_t iterations, evaluations; /* of the relaxation under way */
    double residual;
    double best; /* least residual since the last restart, lowered by GB_STALL_FRACTION
                      * or more at a time ... */
    int64_t best_at; /* ... and its evaluation */
    int restarts;
    bool stalled; /* given up: the residual stopped falling after a restart, too */
};

enum gb_relax_outcome {
    GB_RELAX_MORE,      /* the slice is used up */
    GB_RELAX_DONE,      /* residual at or below the tolerance */
    GB_RELAX_EXHAUSTED, /* max_evaluations reached, or stalled: not converged */
    GB_RELAX_FAILED     /* err says why */
};

bool gb_relax_create(struct gb_relax **out, const struct gb_model *model,
                     struct gb_error *err);
void gb_relax_destroy(struct gb_relax *relax); /* NULL is fine */

/* Begins a relaxation, after the cell was strained: the particles are at rest, but may be
 * moved to where they are expected. */
void gb_relax_start(struct gb_relax *relax, struct gb_world *world);

/* Goes on with the same strain step after a small correction of the cell. */
void gb_relax_proceed(struct gb_relax *relax, struct gb_world *world);

/* One evaluation: gb_world_sums then tells the power along the velocities, where the
 * method has any. */
bool gb_relax_evaluate(struct gb_relax *relax, struct gb_world *world,
                       struct gb_error *err);

/* At most max_evaluations force evaluations of it.  It always ends right after an
 * evaluation, so forces, histories and positions belong together. */
enum gb_relax_outcome gb_relax_advance(struct gb_relax *relax, struct gb_world *world,
                                       int64_t max_evaluations, struct gb_error *err);

/* The memory of the method into a record, or out of it. */
bool gb_relax_record(struct gb_relax *relax, int64_t count, struct gb_record *record,
                     struct gb_error *err);

/* One displacement of (15), k in 1/(E d), and the stiffness (E d) around the most
 * strongly held particle; sum: scratch, one double a particle. */
void gb_relax_steepest_step(struct gb_world *world, double k);
double gb_relax_steepest_stiffest(const struct gb_world *world, double *sum);

extern const struct gb_relaxer gb_relax_fire;
extern const struct gb_relaxer gb_relax_predict;
extern const struct gb_relaxer gb_relax_steepest;

#endif
