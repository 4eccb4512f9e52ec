#ifndef GB_RUN_RECORD_KEPT_STATES_H
#define GB_RUN_RECORD_KEPT_STATES_H

#include "base/record.h"
#include "greenbody/curve.h"
#include "io/state.h"
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

/* Whether a recorded point is one of loading, where states are kept: in any leg of a path. */
bool gb_kept_states_loads(const struct gb_point *point);

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

#endif
