#ifndef GB_RUN_RECORD_KEPT_STATES_H
#define GB_RUN_RECORD_KEPT_STATES_H

#include <stdbool.h>

#include "base/record.h"
#include "greenbody/curve.h"
#include "io/state.h"
#include "run/experiment.h"
#include "scene/field/keep_points.h"

/* States kept along a run, DIR/snapshots/<name>.h5: of the first recorded point of
 * loading, whatever its leg, that reaches a pressure or a density ("p-100MPa", "density-0.5"), and of every
 * n-th point ("point-000021").  They are made of the record that is taken at each point
 * in any case. */
struct gb_kept_states {
    const struct gb_params *params;
    struct gb_keep_points marks;
    double p_pa, density; /* highest so far while loading; 0: no point yet */
};

/* Name of the state that is kept for a mark, without its ending. */
char *gb_kept_states_name(const struct gb_keep_point *mark, char *name, size_t size);

/* The marks of checked params, which must outlive it. */
void gb_kept_states_init(struct gb_kept_states *states, const struct gb_params *params);

/* A point before the start or resume: its state is not kept. */
void gb_kept_states_pass(struct gb_kept_states *states, const struct gb_point *point);

/* Names of the states that are due at a point, without their endings. */
struct gb_kept_names {
    int count;
    char name[GB_KEEP_POINTS_MAX + 1][64];
};

/* number   of the point, from 1 */
void gb_kept_states_due(const struct gb_kept_states *states, const struct gb_point *point,
                        int64_t number, struct gb_kept_names *names);

/* Keeps the state of a point under its names.
 *
 * record   taken at it
 * An existing state stays: a run that is continued from a checkpoint repeats points. */
bool gb_kept_states_write(const char *directory, const struct gb_kept_names *names,
                          const struct gb_state *state, const struct gb_record *record,
                          struct gb_error *err);

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
bool gb_kept_states_run(const struct gb_params *params, const struct gb_keep_walk *walk,
                        int *missed, struct gb_error *err);

#endif
