#include "pack/kernel/pair_forces.h"

#include "pack/cell/world_private.h"
#include "pack/kernel/sweep_f32.h"

void gb_pair_forces_init(struct gb_pair_forces *forces, const struct gb_world *world,
                         bool near)
{
    forces->world = world;
    forces->near = near;
    forces->slot = 0;
    forces->count = 0;
}

/* As the sweep in double precision left them. */
static void kept(const struct gb_world *world, bool near, int64_t k, double force[3])
{
    const double *row =
        near ? world->wrench + (int64_t)world->row * k : world->pull + 3 * k;
    const bool planar = near && world->row < 6;
    force[0] = row[0];
    force[1] = planar ? 0.0 : row[1];
    force[2] = planar ? row[1] : row[2];
}

/* The batch that begins with pair k. */
static void recall(struct gb_pair_forces *forces, int64_t k)
{
    const struct gb_neighbour_list *pairs = &forces->world->pairs;
    const int64_t left =
        gb_neighbour_list_slots(pairs, forces->near ? &pairs->near : &pairs->far) - k;
    struct gb_batch_f32 batch;
    batch.n = left < GB_BATCH ? (int)left : GB_BATCH;
    gb_sweep_f32_recall(forces->world, forces->near, k, &batch);
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
    if (!forces->world->in_single) {
        kept(forces->world, forces->near, k, force);
        return;
    }
    if (k < forces->slot || k >= forces->slot + forces->count) {
        recall(forces, k);
    }
    for (int c = 0; c < 3; c++) {
        force[c] = forces->force[c][k - forces->slot];
    }
}
