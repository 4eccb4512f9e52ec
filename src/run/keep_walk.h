#ifndef GB_RUN_KEEP_WALK_H
#define GB_RUN_KEEP_WALK_H

#include <stdbool.h>

#include "run/experiment.h"
#include "scene/field/keep_points.h"

/* What a visited state is: bit k, the first state beyond point k of the list, and these. */
enum {
    GB_KEEP_WALK_END = 1 << GB_KEEP_POINTS_MAX,     /* the end that the preset asks for */
    GB_KEEP_WALK_STOPPED = 2 << GB_KEEP_POINTS_MAX, /* where the run stopped early */
    GB_KEEP_WALK_VISITED = 4 << GB_KEEP_POINTS_MAX  /* it was visited before this call */
};

/* A run of a preset that is looked at where it first reaches points while loading, and at its
 * end; a lattice without points as it was placed, without loading. */
struct gb_keep_walk {
    const struct gb_keep_points *points;
    /* Called at each of them; false ends the run with its error. */
    bool (*visit)(void *data, const struct gb_experiment *experiment, unsigned what,
                  struct gb_error *err);
    void *data;
    bool (*cancelled)(void *data); /* polled; NULL is fine */
    void *cancel_data;
};

/* *missed counts points that were not reached.  Errors: GB_ERR_GUARD when the run stops
 * early (its last state has been visited), and those of a visit. */
bool gb_keep_walk_run(const struct gb_params *params, const struct gb_keep_walk *walk,
                      int *missed, struct gb_error *err);

#endif
