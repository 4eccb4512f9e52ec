#ifndef GB_RUN_EXPERIMENT_PRIVATE_H
#define GB_RUN_EXPERIMENT_PRIVATE_H

#include "pack/cell/world.h"
#include "run/die_run.h"
#include "run/experiment.h"
#include "solve/dynamic.h"
#include "solve/guard.h"
#include "solve/quasistatic.h"
#include "solve/relax.h"

/* The inside of gb_experiment, for the files that work on it: experiment.c (owner),
 * checkpoint.c (records). */

enum { GB_EXPERIMENT_EVENTS = 32 };

struct gb_experiment {
    struct gb_params params;
    struct gb_model model;
    struct gb_world *world;
    struct gb_world_copy *good;   /* before the strain step under way */
    struct gb_world_copy *branch; /* where the unloading branch began */
    struct gb_relax *relax;
    struct gb_dynamic *motion;  /* dynamic scenes only, instead of relax and load */
    struct gb_experiment *husk; /* holds the model after a change: run/change.c */
    struct gb_die_run *die;     /* dies only, instead of all these */
    double elastic_start;       /* elastic energy when the motion began */
    struct gb_quasistatic load;
    struct gb_guard guard;
    double factor[3]; /* strain step under way, or to be taken next */
    int part;         /* of the strain step, from 1; the parts are equal */
    bool strain_due;  /* it waits for the next slice, so that between slices after
                       * a point forces, places and histories belong together */
    int64_t step;     /* strain steps recorded */
    int64_t spent_iterations, spent_evaluations; /* by attempts that were taken back */
    bool have_good;
    bool over, stopped;
    struct gb_point point; /* the last recorded one ... */
    struct gb_point shown; /* ... and that of the world: after an unloading branch, where
                            * it began */
    char event[GB_EXPERIMENT_EVENTS][GB_EVENT_TEXT];
    int events_first, events_count;
};

#endif
