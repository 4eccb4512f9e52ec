#ifndef GB_SOLVE_LOADING_DYNAMIC_STATE_H
#define GB_SOLVE_LOADING_DYNAMIC_STATE_H

#include <stdbool.h>
#include <stdint.h>

#include "pack/cell/world.h"
#include "solve/loading/dynamic.h"
#include "solve/verlet.h"

/* Internal to dynamic.c, dynamic_step.c and dynamic_guard.c.  Reduced units. */
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

#endif
