#include "pack/kernel/sweep.h"

#include <math.h>
#include <string.h>

#include "base/team.h"
#include "pack/cell/engine.h"
#include "pack/f32/f32_state.h"
#include "pack/kernel/sweep_f32.h"
#include "pack/kernel/sweep_f64.h"
#include "pack/list/blocks.h"
#include "pack/list/list_check.h"

static void sweep_block(struct gb_engine *engine, int64_t b)
{
    const double cutoff = gb_engine_cutoff(engine);
    struct gb_tally tally = {0};
    if (gb_engine_is_f32(engine)) {
        gb_sweep_f32_block(engine, b, cutoff * cutoff, &tally);
    } else {
        gb_sweep_f64_block(engine, b, cutoff * cutoff, &tally);
    }
    engine->tally[b].tally = tally;
}

static void collect_block(struct gb_engine *engine, int64_t b,
                          struct gb_sweep_along along)
{
    struct gb_particles *particles = &engine->particles;
    const int64_t begin = gb_blocks_begin(particles->count, b);
    const int64_t end = gb_blocks_end(particles->count, b);
    if (!gb_engine_state_moved(&engine->state)) {
        memset(particles->rotation + 3 * begin, 0,
               3 * (size_t)(end - begin) * sizeof *particles->rotation);
    }
    if (gb_engine_is_f32(engine)) {
        gb_sweep_f32_collect(engine, begin, end, &engine->tally[b].sums);
    } else {
        gb_sweep_f64_collect(engine, begin, end);
        gb_sweep_f64_sum(particles, begin, end, along, &engine->tally[b].sums);
    }
}

static void prepare_block(void *data, int64_t b)
{
    struct gb_engine *engine = data;
    const int64_t count = engine->particles.count;
    gb_list_check_measure(engine, b);
    if (gb_engine_is_f32(engine)) {
        gb_f32_state_particles(engine, gb_blocks_begin(count, b),
                               gb_blocks_end(count, b));
    }
}

struct sweep {
    struct gb_engine *engine;
    struct gb_sweep_along along;
};

static void sweep_item(void *data, int64_t b)
{
    const struct sweep *sweep = data;
    sweep_block(sweep->engine, b);
}

static void collect_item(void *data, int64_t b)
{
    const struct sweep *sweep = data;
    collect_block(sweep->engine, b, sweep->along);
}

/* In single precision all rows for a block come from blocks before it: a single thread
 * collects each block while it is in the caches. */
static bool collects_at_once(const struct gb_engine *engine)
{
    return gb_engine_is_f32(engine) && gb_team_active(engine->team) < 2;
}

static void run_blocks(struct gb_engine *engine, int64_t blocks,
                       struct gb_sweep_along along)
{
    struct sweep sweep = {engine, along};
    if (collects_at_once(engine)) {
        for (int64_t b = 0; b < blocks; b++) {
            sweep_block(engine, b);
            collect_block(engine, b, along);
        }
    } else {
        gb_blocks_run(engine, sweep_item, &sweep);
        gb_blocks_run(engine, collect_item, &sweep);
    }
}

static void add_tally(struct gb_tally *sum, const struct gb_tally *part)
{
    sum->contacts += part->contacts;
    sum->sliding += part->sliding;
    sum->normal_sum += part->normal_sum;
    sum->absorbed += part->absorbed;
    for (int c = 0; c < 3; c++) {
        sum->virial[c] += part->virial[c];
    }
    sum->deepest = fmax(sum->deepest, part->deepest);
}

/* Sums of the blocks, in their order. */
static void sum_blocks(struct gb_engine *engine, int64_t blocks)
{
    struct gb_tally_block total = {0};
    for (int64_t b = 0; b < blocks; b++) {
        const struct gb_tally_block *block = &engine->tally[b];
        total.sums.force2 += block->sums.force2;
        total.sums.torque2 += block->sums.torque2;
        total.sums.power += block->sums.power;
        add_tally(&total.tally, &block->tally);
    }
    engine->total = total;
}

static bool sweep(struct gb_engine *engine, struct gb_sweep_along along)
{
    const int64_t blocks = gb_blocks_count(engine->particles.count);
    for (int c = 0; c < 3; c++) {
        engine->f32.scale[c] = (float)gb_fixed_position_unit(&engine->particles.cell, c);
    }
    if (!gb_engine_state_moved(&engine->state)) {
        gb_f32_state_synchronise(engine);
        gb_blocks_run(engine, prepare_block, engine);
    } /* else the velocity update did it */
    if (!gb_list_check_run(engine)) {
        return false;
    }
    gb_team_measured_begin(engine->team);
    run_blocks(engine, blocks, along);
    gb_team_measured_end(engine->team);
    sum_blocks(engine, blocks);
    return true;
}

enum gb_sweep_outcome gb_sweep_run(struct gb_engine *engine, struct gb_sweep_along along)
{
    const double count = (double)engine->particles.count;
    gb_neighbour_list_update_shifts(&engine->list, &engine->particles.cell);
    if (!sweep(engine, along)) {
        return isfinite(gb_list_check_largest(engine)) ? GB_SWEEP_LIST_INVALID
                                                       : GB_SWEEP_NOT_FINITE;
    }
    engine->force_rms = sqrt(engine->total.sums.force2 / count);
    engine->torque_rms = sqrt(engine->total.sums.torque2 / count);
    gb_engine_state_evaluate(&engine->state);
    return GB_SWEEP_DONE;
}
