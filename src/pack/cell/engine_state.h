#ifndef GB_PACK_CELL_ENGINE_STATE_H
#define GB_PACK_CELL_ENGINE_STATE_H

#include <stdbool.h>
#include <stdint.h>

#include "pack/cell/contacts.h"

/* The state machine of the periodic engine; docs/engine.md has it as a drawing.  All
 * changes are transitions of engine_state.c; an illegal one is an error of the program
 * and stops at an assertion. */

/* Positions exist twice: `position` (double, count x 3), which everything outside the
 * engine reads and writes, and fixed-point positions, which sweeps in single precision and
 * integrate_f32.c work on.  The state says which of them is current, whether a velocity
 * update waits for its evaluation, and whether the bounds of the particle groups hold. */
enum gb_engine_motion {
    /* `position` is current, fixed-point positions are stale, bounds unknown */
    GB_ENGINE_EDITED,
    /* evaluated; both agree; bounds unknown */
    GB_ENGINE_EVALUATED,
    /* a velocity update without its evaluation; `position` is stale; bounds known */
    GB_ENGINE_MOVED,
    /* the same, `position` synchronised */
    GB_ENGINE_MOVED_SYNCHRONISED,
    /* a velocity update with its evaluation; `position` is stale; bounds known */
    GB_ENGINE_RELAXING,
    /* the same, `position` synchronised */
    GB_ENGINE_RELAXING_SYNCHRONISED,
    GB_ENGINE_MOTIONS,
};

enum gb_engine_lists {
    GB_ENGINE_NO_LISTS, /* not built yet, or spoilt by a failure */
    GB_ENGINE_LISTS,
    GB_ENGINE_LISTS_PATCHED, /* just checked and completed: valid for the next sweep
                              * without another check */
};

/* Where forces and torques of the last evaluation are. */
enum gb_engine_forces {
    GB_ENGINE_FORCES_F64, /* in the arrays of gb_particles (and in f32, where that exists) */
    GB_ENGINE_FORCES_F32, /* in gb_f32_state only */
};

struct gb_engine_state {
    enum gb_real real; /* constant */
    enum gb_engine_motion motion;
    enum gb_engine_lists lists;
    enum gb_engine_forces forces;
    int64_t evaluation; /* number of the last one: what was computed from it tells by this
                         * whether it still holds */
};

/* `position` lags behind the fixed-point positions. */
static inline bool gb_engine_state_position_stale(const struct gb_engine_state *state)
{
    return state->motion == GB_ENGINE_MOVED || state->motion == GB_ENGINE_RELAXING;
}

/* Fixed-point positions lag behind `position`. */
static inline bool gb_engine_state_fixed_stale(const struct gb_engine_state *state)
{
    return state->motion == GB_ENGINE_EDITED;
}

/* A velocity update has set the fixed-point positions for the next evaluation. */
static inline bool gb_engine_state_moved(const struct gb_engine_state *state)
{
    return state->motion == GB_ENGINE_MOVED ||
           state->motion == GB_ENGINE_MOVED_SYNCHRONISED;
}

/* Forces belong to the present positions. */
static inline bool gb_engine_state_evaluated(const struct gb_engine_state *state)
{
    return state->motion == GB_ENGINE_EVALUATED || state->motion == GB_ENGINE_RELAXING ||
           state->motion == GB_ENGINE_RELAXING_SYNCHRONISED;
}

/* Only velocity updates have moved particles since the bounds were last computed. */
static inline bool gb_engine_state_bounds_known(const struct gb_engine_state *state)
{
    return state->motion >= GB_ENGINE_MOVED;
}

/* Motion: one function per transition. */

/* `position` was set from the fixed-point positions. */
void gb_engine_state_synchronise(struct gb_engine_state *state);
/* A caller receives `position` for writing; it must be synchronised.  While a velocity
 * update waits for its evaluation the caller may read only. */
void gb_engine_state_lend(struct gb_engine_state *state);
/* All positions were replaced: strain, restored copy, loaded checkpoint. */
void gb_engine_state_replace(struct gb_engine_state *state);
/* A velocity update has moved the fixed-point positions; once per evaluation. */
void gb_engine_state_move(struct gb_engine_state *state);
/* Forces were computed; `position` must be synchronised unless particles were moved. */
void gb_engine_state_evaluate(struct gb_engine_state *state);

/* Lists. */
void gb_engine_state_build_lists(struct gb_engine_state *state);
void gb_engine_state_drop_lists(struct gb_engine_state *state);
void gb_engine_state_patch_lists(struct gb_engine_state *state);
/* The sweep after a patch is done. */
void gb_engine_state_use_lists(struct gb_engine_state *state);

/* Forces. */
void gb_engine_state_convert_forces(struct gb_engine_state *state);

#endif
