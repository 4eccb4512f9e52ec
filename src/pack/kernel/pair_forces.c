#include "pack/kernel/pair_forces.h"

#include <string.h>

#include "pack/cell/world_private.h"
#include "pack/kernel/sweep_f32.h"

void gb_pair_forces_init(struct gb_pair_forces *forces, const struct gb_world *world,
                         enum gb_pair_forces_list list)
{
    const struct gb_neighbour_list *lists = &world->engine.list;
    forces->world = world;
    forces->list = list == GB_PAIR_FORCES_NEAR ? &lists->near : &lists->far;
    forces->slot = 0;
    forces->count = 0;
}

/* Row of a sweep in double precision. */
static void read_row(const struct gb_pair_forces *forces, int64_t k, double force[3])
{
    const struct gb_engine *engine = &forces->world->engine;
    if (forces->list == &engine->list.near) {
        gb_engine_pair_force(&engine->pair, k, force);
    } else {
        memcpy(force, engine->pair.pull + 3 * k, 3 * sizeof *force);
    }
}

/* The batch that begins with pair k. */
static void recompute(struct gb_pair_forces *forces, int64_t k)
{
    const struct gb_engine *engine = &forces->world->engine;
    const int64_t left = gb_neighbour_list_slots(&engine->list, forces->list) - k;
    struct gb_batch_f32 batch;
    batch.n = left < GB_BATCH ? (int)left : GB_BATCH;
    gb_sweep_f32_recompute(engine, forces->list, k, &batch);
    for (int c = 0; c < 3; c++) {
        for (int l = 0; l < batch.n; l++) {
            forces->force[c][l] = (double)batch.force[c][l];
        }
    }
    forces->slot = k;
    forces->count = batch.n;
}

void gb_pair_forces_at(struct gb_pair_forces *forces, int64_t k, double force[3])
{
    if (!gb_engine_is_f32(&forces->world->engine)) {
        read_row(forces, k, force);
        return;
    }
    if (k < forces->slot || k >= forces->slot + forces->count) {
        recompute(forces, k);
    }
    for (int c = 0; c < 3; c++) {
        force[c] = forces->force[c][k - forces->slot];
    }
}
