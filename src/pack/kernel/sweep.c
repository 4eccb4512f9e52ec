#include "pack/kernel/sweep.h"

#include <math.h>
#ifdef _OPENMP
#include <omp.h>
#endif
#include <string.h>

#include "pack/cell/engine.h"
#include "pack/f32/f32_convert.h"
#include "pack/kernel/sweep_f32.h"
#include "pack/kernel/sweep_f64.h"
#include "pack/kernel/sweep_sized.h"
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

static void prepare_block(struct gb_engine *engine, int64_t b)
{
    const int64_t count = engine->particles.count;
    gb_list_check_measure(engine, b);
    if (gb_engine_is_f32(engine)) {
        gb_f32_convert_particles(engine, gb_blocks_begin(count, b),
                                 gb_blocks_end(count, b));
    }
}

/* Blocks of one thread of a team, or all of them: those that a loop with a static
 * schedule gives it, so that they stay in its caches. */
struct part {
    int64_t begin, end;
};

static struct part own_part(int64_t blocks)
{
#ifdef _OPENMP
    const int64_t thread = omp_get_thread_num(), threads = omp_get_num_threads();
    const int64_t each = blocks / threads, more = blocks % threads;
    const int64_t begin = each * thread + (thread < more ? thread : more);
    return (struct part){begin, begin + each + (thread < more ? 1 : 0)};
#else
    return (struct part){0, blocks};
#endif
}

/* True if all rows for block b come from blocks of the same part, which its thread has
 * swept already. */
static bool collects_at_once(const struct gb_engine *engine, const struct part *part,
                             int64_t b)
{
    return gb_engine_is_f32(engine) && engine->f32.near.source[b] >= part->begin &&
           engine->f32.far.source[b] >= part->begin;
}

/* All blocks, by the threads of the calling OpenMP team; without a team, by the caller.
 * Sets *valid where the lists are: the same for every thread. */
static void run_blocks(struct gb_engine *engine, int64_t blocks,
                       struct gb_sweep_along along, bool *valid)
{
    if (!gb_engine_state_moved(&engine->state)) { /* else the velocity update did it */
#pragma omp for schedule(static)
        for (int64_t b = 0; b < blocks; b++) {
            prepare_block(engine, b);
        }
    }
    if (!gb_list_check_run(engine)) {
        return;
    }
#pragma omp single nowait
    *valid = true;
    const struct part part = own_part(blocks);
    for (int64_t b = part.begin; b < part.end; b++) {
        sweep_block(engine, b);
        if (collects_at_once(engine, &part, b)) {
            collect_block(engine, b, along);
        }
    }
#pragma omp barrier
    for (int64_t b = part.begin; b < part.end; b++) {
        if (!collects_at_once(engine, &part, b)) {
            collect_block(engine, b, along);
        }
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

/* Particles of one size. */
static bool sweep_equal(struct gb_engine *engine, struct gb_sweep_along along)
{
    const int64_t blocks = gb_blocks_count(engine->particles.count);
    bool valid = false;
    for (int c = 0; c < 3; c++) {
        engine->f32.scale[c] = (float)gb_fixed_position_unit(&engine->particles.cell, c);
    }
    if (!gb_engine_state_moved(&engine->state)) {
        gb_f32_convert_synchronise(engine);
    }
    if (engine->threads > 1) {
#pragma omp parallel num_threads(engine->threads)
        run_blocks(engine, blocks, along, &valid);
    } else { /* a team of one thread costs a barrier */
        run_blocks(engine, blocks, along, &valid);
    }
    if (valid) {
        sum_blocks(engine, blocks);
    }
    return valid;
}

/* Particles of unequal sizes; all sums by one thread. */
static bool sweep_sized(struct gb_engine *engine, struct gb_sweep_along along)
{
    const int64_t count = engine->particles.count;
    for (int64_t b = 0; b < gb_blocks_count(count); b++) {
        gb_list_check_measure(engine, b);
    }
    if (!gb_list_check_run(engine)) {
        return false;
    }
    gb_sweep_sized_run(engine);
    gb_sweep_f64_sum(&engine->particles, 0, count, along, &engine->total.sums);
    return true;
}

enum gb_sweep_outcome gb_sweep_run(struct gb_engine *engine, struct gb_sweep_along along)
{
    const double count = (double)engine->particles.count;
    gb_neighbour_list_update_shifts(&engine->list, &engine->particles.cell);
    if (!(engine->particles.diameter ? sweep_sized : sweep_equal)(engine, along)) {
        return isfinite(gb_list_check_largest(engine)) ? GB_SWEEP_LIST_INVALID
                                                       : GB_SWEEP_NOT_FINITE;
    }
    engine->force_rms = sqrt(engine->total.sums.force2 / count);
    engine->torque_rms = sqrt(engine->total.sums.torque2 / count);
    gb_engine_state_evaluate(&engine->state);
    return GB_SWEEP_DONE;
}
