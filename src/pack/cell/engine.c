/* The state of the periodic engine, and the results of its pairs.
 *
 * The state is a machine; docs/engine.md has it as a drawing.  All changes are transitions of this
 * file.  An illegal one is an error of the program and stops at an assertion. */
#include "pack/cell/engine.h"

#include <assert.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "base/alloc.h"
#include "greenbody/status.h"
#include "pack/cell/contacts.h"
#include "scene/model.h"

/* Motion: one function per transition. */

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

void gb_engine_pair_init(struct gb_pair_results *results, const struct gb_model *model)
{
    results->width = model->record_dimension == 3 ? 6 : 3;
}

void gb_engine_pair_finish(struct gb_pair_results *results)
{
    gb_alloc_free(results->wrench);
    gb_alloc_free(results->pull);
    gb_alloc_free(results->far_distance);
    gb_alloc_free(results->far_pull);
    *results = (struct gb_pair_results){0};
}

bool gb_engine_pair_resize_near(struct gb_pair_results *results, int64_t capacity,
                                struct gb_error *err)
{
    gb_alloc_free(results->wrench);
    results->wrench = gb_alloc_array((size_t)capacity * (size_t)results->width,
                                     sizeof *results->wrench, err);
    return results->wrench != NULL;
}

bool gb_engine_pair_resize_far(struct gb_pair_results *results, int64_t capacity,
                               enum gb_real real, enum gb_pair_results_far content,
                               struct gb_error *err)
{
    gb_alloc_free(results->far_distance);
    gb_alloc_free(results->far_pull);
    results->far_capacity = 0;
    results->far_distance = results->far_pull = NULL;
    if (real == GB_REAL_F64) {
        gb_alloc_free(results->pull);
        results->pull = gb_alloc_array(3 * (size_t)capacity, sizeof *results->pull, err);
        if (!results->pull) {
            return false;
        }
    }
    if (content == GB_PAIR_RESULTS_FAR_WORK) {
        results->far_distance = gb_alloc_array((size_t)capacity, sizeof(double), err);
        results->far_pull = gb_alloc_array((size_t)capacity, sizeof(double), err);
        if (!results->far_distance || !results->far_pull) {
            return false;
        }
    }
    results->far_capacity = capacity;
    return true;
}

void gb_engine_pair_reset_far(struct gb_pair_results *results, int64_t pairs)
{
    if (results->far_distance) {
        memset(results->far_distance, 0, (size_t)pairs * sizeof *results->far_distance);
    }
}

void gb_engine_pair_set_force(struct gb_pair_results *results, int64_t k,
                              const double force[3])
{
    double *row = results->wrench + (int64_t)results->width * k;
    if (gb_engine_pair_planar(results)) {
        row[0] = force[0];
        row[1] = force[2];
    } else {
        memcpy(row, force, 3 * sizeof *row);
    }
}
