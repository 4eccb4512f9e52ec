#include "pack/cell/engine_state.h"

#include <assert.h>

enum { ILLEGAL = -1 };

/* Moves the motion along a row of a table that has an entry for every motion. */
static void change(struct gb_engine_state *state, const int next[GB_ENGINE_MOTIONS])
{
    const int motion = next[state->motion];
    assert(motion != ILLEGAL);
    state->motion = (enum gb_engine_motion)motion;
}

void gb_engine_state_synchronise(struct gb_engine_state *state)
{
    static const int next[GB_ENGINE_MOTIONS] = {
        [GB_ENGINE_EDITED] = GB_ENGINE_EDITED,
        [GB_ENGINE_EVALUATED] = GB_ENGINE_EVALUATED,
        [GB_ENGINE_MOVED] = GB_ENGINE_MOVED_SYNCHRONISED,
        [GB_ENGINE_MOVED_SYNCHRONISED] = GB_ENGINE_MOVED_SYNCHRONISED,
        [GB_ENGINE_RELAXING] = GB_ENGINE_RELAXING_SYNCHRONISED,
        [GB_ENGINE_RELAXING_SYNCHRONISED] = GB_ENGINE_RELAXING_SYNCHRONISED,
    };
    change(state, next);
}

void gb_engine_state_lend(struct gb_engine_state *state)
{
    static const int next[GB_ENGINE_MOTIONS] = {
        [GB_ENGINE_EDITED] = GB_ENGINE_EDITED,
        [GB_ENGINE_EVALUATED] = GB_ENGINE_EDITED,
        [GB_ENGINE_MOVED] = ILLEGAL,
        [GB_ENGINE_MOVED_SYNCHRONISED] = GB_ENGINE_MOVED_SYNCHRONISED,
        [GB_ENGINE_RELAXING] = ILLEGAL,
        [GB_ENGINE_RELAXING_SYNCHRONISED] = GB_ENGINE_EDITED,
    };
    change(state, next);
}

void gb_engine_state_replace(struct gb_engine_state *state)
{
    state->motion = GB_ENGINE_EDITED; /* from any */
}

void gb_engine_state_move(struct gb_engine_state *state)
{
    static const int next[GB_ENGINE_MOTIONS] = {
        [GB_ENGINE_EDITED] = GB_ENGINE_MOVED,
        [GB_ENGINE_EVALUATED] = GB_ENGINE_MOVED,
        [GB_ENGINE_MOVED] = ILLEGAL,
        [GB_ENGINE_MOVED_SYNCHRONISED] = ILLEGAL,
        [GB_ENGINE_RELAXING] = GB_ENGINE_MOVED,
        [GB_ENGINE_RELAXING_SYNCHRONISED] = GB_ENGINE_MOVED,
    };
    assert(state->real == GB_REAL_F32);
    assert(state->lists != GB_ENGINE_NO_LISTS);
    change(state, next);
}

void gb_engine_state_evaluate(struct gb_engine_state *state)
{
    static const int next[GB_ENGINE_MOTIONS] = {
        [GB_ENGINE_EDITED] = GB_ENGINE_EVALUATED,
        [GB_ENGINE_EVALUATED] = GB_ENGINE_EVALUATED,
        [GB_ENGINE_MOVED] = GB_ENGINE_RELAXING,
        [GB_ENGINE_MOVED_SYNCHRONISED] = GB_ENGINE_RELAXING_SYNCHRONISED,
        [GB_ENGINE_RELAXING] = ILLEGAL,
        [GB_ENGINE_RELAXING_SYNCHRONISED] = GB_ENGINE_EVALUATED,
    };
    assert(state->lists != GB_ENGINE_NO_LISTS);
    change(state, next);
    state->evaluation++;
    state->forces =
        state->real == GB_REAL_F32 ? GB_ENGINE_FORCES_F32 : GB_ENGINE_FORCES_F64;
}

void gb_engine_state_build_lists(struct gb_engine_state *state)
{
    state->lists = GB_ENGINE_LISTS; /* from any */
}

void gb_engine_state_drop_lists(struct gb_engine_state *state)
{
    state->lists = GB_ENGINE_NO_LISTS; /* from any */
}

void gb_engine_state_patch_lists(struct gb_engine_state *state)
{
    assert(state->real == GB_REAL_F32);
    assert(state->lists == GB_ENGINE_LISTS);
    state->lists = GB_ENGINE_LISTS_PATCHED;
}

void gb_engine_state_use_lists(struct gb_engine_state *state)
{
    assert(state->lists != GB_ENGINE_NO_LISTS);
    state->lists = GB_ENGINE_LISTS;
}

void gb_engine_state_convert_forces(struct gb_engine_state *state)
{
    state->forces = GB_ENGINE_FORCES_F64;
}
