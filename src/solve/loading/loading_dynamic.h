#ifndef GB_SOLVE_LOADING_LOADING_DYNAMIC_H
#define GB_SOLVE_LOADING_LOADING_DYNAMIC_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/record.h"
#include "greenbody/status.h"
#include "pack/cell/world.h"
#include "solve/step_outcome.h"
#include "solve/verlet.h"

struct gb_model;

/* High-speed pressing of P2: relax in a fixed cell, compress at a rate to a density,
 * hold.  Steps of gb_verlet between recorded points; a guard on the share of
 * sliding contacts and on the critical step.  The world belongs to the caller. */
enum gb_dynamic_stage {
    GB_DYNAMIC_RELAX,
    GB_DYNAMIC_LOAD,
    GB_DYNAMIC_HOLD,
    GB_DYNAMIC_OVER
};

/* Its state, in reduced units. */
struct gb_dynamic {
    const struct gb_model *model;
    struct gb_verlet verlet;
    enum gb_dynamic_stage stage, recorded;
    double time, stage_end;
    double limit; /* longest step the guard allows, halved when it trips */
    int halvings;
    bool limit_reported; /* the event that damping bounds the step was written */
    /* steps to the next point */
    int64_t left, planned;
    double step;
    double factor[3];
    int64_t sliding, contacts; /* summed over the steps since the last point */
    double sliding_most;       /* share of them above which the step is doubted */
    double slid;               /* share that made the guard halve the step; 0: none */
    double limit_before;       /* limit before that halving */
    /* the last recorded point, restored by a guard */
    struct gb_world_copy *good;
    double *good_velocity, *good_spin;
    double good_time, good_work, good_absorbed;
    enum gb_dynamic_stage good_stage;
    double *scratch;
    double density; /* of the world, by the schedule */
    double good_density;
};

/* The world must have been evaluated. */
bool gb_loading_dynamic_create(struct gb_dynamic **out, struct gb_world *world,
                               struct gb_error *err);

void gb_loading_dynamic_destroy(struct gb_dynamic *motion); /* NULL is fine */

/* At most max_steps time steps.  text (size bytes) receives one line when a guard acted.
 */
enum gb_step_outcome gb_loading_dynamic_advance(struct gb_dynamic *motion,
                                                struct gb_world *world, int64_t max_steps,
                                                char *text, size_t size,
                                                struct gb_error *err);

/* Longest time step (T) allowed in the present state of the world: that of the preset, or
 * the automatic one, both bounded by the critical step and by the guard.  text (size
 * bytes) receives one line when the critical step bounds it for the first time. */
double gb_loading_dynamic_step_allowed(struct gb_dynamic *motion,
                                       const struct gb_world *world, char *text,
                                       size_t size);

/* Quantities of a recorded point, reduced units. */
struct gb_loading_dynamic_report {
    enum gb_dynamic_stage stage; /* the one that has just been recorded */
    double time;                 /* since the start */
    int64_t steps;               /* since the last point */
    double kinetic, work, absorbed;
    double time_step; /* last used */
    double progress;  /* 0..1, by time */
};

struct gb_loading_dynamic_report
gb_loading_dynamic_report(const struct gb_dynamic *motion);

#endif
