/* One evaluation: sweep; where the lists are no longer valid, missing pairs are inserted
 * or the lists rebuilt, and the sweep repeated. */
#include <math.h>

#include "pack/list/engine_lists.h"
#include "pack/cell/world_private.h"
#include "pack/f32/f32_state.h"
#include "pack/kernel/sweep.h"
#include "pack/list/blocks.h"
#include "pack/list/list_patch.h"
#include "scene/tolerances.h"

bool gb_world_evaluate_rebuild(struct gb_world *world,
                               const struct gb_contact_history *history,
                               struct gb_error *err)
{
    struct gb_engine *engine = &world->engine;
    if (!history && !gb_engine_lists_carry_note(&world->carry, engine, err)) {
        return false;
    }
    gb_f32_state_synchronise(engine);
    (void)gb_cell_fold(&engine->particles.cell); /* new lists have new images */
    gb_particles_wrap(&engine->particles, engine->team);
    if (!gb_engine_lists_build(engine, &engine->particles.cell, err)) {
        return false;
    }
    if (history) {
        gb_contact_history_read(history, engine);
    } else {
        gb_engine_lists_carry_move(&world->carry, engine);
    }
    for (int64_t b = 0; b < gb_blocks_count(engine->particles.count); b++) {
        engine->check[b].displacement = 0.0; /* also of a velocity update before this */
    }
    gb_pair_results_reset_far(&engine->pair, engine->list.far.pair_count);
    world->rebuilds++;
    return true;
}

static int64_t first_not_finite(struct gb_engine *engine)
{
    const struct gb_particles *particles = &engine->particles;
    gb_f32_state_forces_to_f64(engine);
    for (int64_t i = 0; i < particles->count; i++) {
        for (int k = 0; k < 3; k++) {
            if (!isfinite(particles->force[3 * i + k]) ||
                !isfinite(particles->torque[3 * i + k])) {
                return i;
            }
        }
    }
    return -1;
}

static bool check_result(struct gb_engine *engine, struct gb_error *err)
{
    const double overlap = engine->total.tally.deepest;
    if (!isfinite(engine->force_rms) || !isfinite(engine->torque_rms)) {
        return gb_error_set(err, GB_ERR_GUARD,
                            "force on particle %lld is not a finite number",
                            (long long)first_not_finite(engine));
    }
    if (overlap > GB_OVERLAP_MAX) {
        return gb_error_set(
            err, GB_ERR_GUARD,
            "two particles overlap by %.3g of the smaller one's diameter: the strain step "
            "is too large or the pressure beyond the contact laws",
            overlap);
    }
    return true;
}

/* A sweep with the lists as they are, if there are any. */
static enum gb_sweep_outcome try_sweep(struct gb_engine *engine,
                                       struct gb_sweep_along along)
{
    if (engine->state.lists != GB_ENGINE_NO_LISTS) {
        return gb_sweep_run(engine, along);
    }
    gb_f32_state_synchronise(engine);
    const double displacement = gb_neighbour_list_displacement(
        &engine->list, engine->particles.position, 0, engine->particles.count);
    return isfinite(displacement) ? GB_SWEEP_LIST_INVALID : GB_SWEEP_NOT_FINITE;
}

/* Inserts the missing pairs, and sweeps where that was possible. */
static enum gb_list_patch_outcome patch_and_sweep(struct gb_engine *engine,
                                                  struct gb_sweep_along along,
                                                  struct gb_error *err)
{
    if (engine->state.lists == GB_ENGINE_NO_LISTS) {
        return GB_LIST_PATCH_REBUILD;
    }
    const enum gb_list_patch_outcome outcome = gb_list_patch_insert(engine, err);
    if (outcome == GB_LIST_PATCH_FAILED) {
        gb_engine_state_drop_lists(&engine->state);
    }
    if (outcome == GB_LIST_PATCH_DONE) {
        gb_engine_state_patch_lists(&engine->state);
        (void)gb_sweep_run(engine, along); /* patched lists are valid */
        gb_engine_state_use_lists(&engine->state);
    }
    return outcome;
}

static bool rebuild_and_sweep(struct gb_world *world, struct gb_sweep_along along,
                              struct gb_error *err)
{
    if (!gb_world_evaluate_rebuild(world, NULL, err)) {
        return false;
    }
    (void)gb_sweep_run(&world->engine, along); /* new lists are valid */
    return true;
}

static bool evaluate(struct gb_world *world, struct gb_sweep_along along,
                     struct gb_error *err)
{
    struct gb_engine *engine = &world->engine;
    const enum gb_sweep_outcome swept = try_sweep(engine, along);
    if (swept == GB_SWEEP_NOT_FINITE) {
        return gb_error_set(err, GB_ERR_GUARD,
                            "a coordinate of a particle is not a finite number");
    }
    if (swept == GB_SWEEP_LIST_INVALID) {
        const enum gb_list_patch_outcome patched = patch_and_sweep(engine, along, err);
        if (patched == GB_LIST_PATCH_FAILED ||
            (patched == GB_LIST_PATCH_REBUILD && !rebuild_and_sweep(world, along, err))) {
            return false;
        }
    }
    world->evaluations++;
    return check_result(engine, err);
}

bool gb_world_evaluate(struct gb_world *world, struct gb_error *err)
{
    const bool done = evaluate(world, (struct gb_sweep_along){NULL, NULL}, err);
    gb_f32_state_synchronise(&world->engine);
    gb_f32_state_forces_to_f64(&world->engine);
    return done;
}

bool gb_world_evaluate_along(struct gb_world *world, const double *velocity,
                             const double *spin, struct gb_error *err)
{
    return evaluate(world, (struct gb_sweep_along){velocity, spin}, err);
}
