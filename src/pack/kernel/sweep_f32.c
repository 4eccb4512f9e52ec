/* The sweep in single precision: particles as rows of numbers, the laws over columns of
 * many contacts. */
#include "pack/kernel/sweep_f32.h"

#include <stdbool.h>
#include <string.h>

#include "base/team.h"
#include "pack/cell/engine.h"
#include "pack/kernel/register_rows.h"
#include "pack/kernel/simd.h"
#include "pack/list/blocks.h"

/* Where the torque begins in a row of force and torque. */
enum { TORQUE = GB_WRENCH_ROWS_TORQUE };

/* What a batch gathers: far pairs have no springs. */
enum { BRANCH_ONLY = 0, WITH_ROTATIONS = 1 };

/* Branch vectors of `count` pairs (at most eight) into the columns of a batch from index k
 * on; with rotations also their sums and differences. */
GB_ROW_INLINE void gather_eight(const struct gb_f32_state *f32,
                                const struct gb_pair_list *list,
                                struct gb_batch_f32 *restrict batch, int64_t slot, int k,
                                int count, bool rotations)
{
    const struct gb_f32_particle *particle = f32->particle;
    const int32_t *first = list->first + slot + k, *other = list->other + slot + k;
    gb_row_pair apart[4], ti[4], tj[4], x[3], y[3];
    for (int l = 0; l < 4; l++) {
        const int low = l < count ? l : 0; /* behind the last pair: any */
        const int high = l + 4 < count ? l + 4 : 0;
        const struct gb_f32_particle *i = &particle[first[low]];
        const struct gb_f32_particle *j = &particle[other[low]];
        const struct gb_f32_particle *i4 = &particle[first[high]];
        const struct gb_f32_particle *j4 = &particle[other[high]];
        gb_row_word_pair pi, pj;
        gb_row_words_beside(i->position, i4->position, &pi);
        gb_row_words_beside(j->position, j4->position, &pj);
        apart[l] = (gb_row_pair)(pi - pj);
        if (rotations) {
            gb_row_beside(i->rotation, i4->rotation, &ti[l]);
            gb_row_beside(j->rotation, j4->rotation, &tj[l]);
        }
    }
    gb_row_pair_columns(apart, x);
    for (int c = 0; c < 3; c++) {
        const gb_row_pair r =
            __builtin_convertvector((gb_row_int_pair)x[c], gb_row_pair) * f32->scale[c];
        memcpy(batch->r[c] + k, &r, sizeof r);
    }
    if (rotations) {
        gb_row_pair_columns(ti, x);
        gb_row_pair_columns(tj, y);
        for (int c = 0; c < 3; c++) {
            const gb_row_pair sum = x[c] + y[c], difference = x[c] - y[c];
            memcpy(batch->rotation_sum[c] + k, &sum, sizeof sum);
            memcpy(batch->rotation_difference[c] + k, &difference, sizeof difference);
        }
    }
}

GB_ROW_INLINE void gather(const struct gb_f32_state *f32, const struct gb_pair_list *list,
                          struct gb_batch_f32 *restrict batch, int64_t slot,
                          bool rotations)
{
    int k = 0;
    for (; k + 8 <= batch->n; k += 8) {
        gather_eight(f32, list, batch, slot, k, 8, rotations);
    }
    if (k < batch->n) {
        gather_eight(f32, list, batch, slot, k, batch->n - k, rotations);
    }
}

/* Diameters of the pairs of a batch, where they are unequal. */
GB_ROW_INLINE void gather_diameters(const struct gb_engine *engine,
                                    const struct gb_pair_list *list,
                                    struct gb_batch_f32 *restrict batch, int64_t slot)
{
    const double *diameter = engine->particles.diameter;
    for (int k = 0; diameter && k < batch->n; k++) {
        batch->diameter[0][k] = (float)diameter[list->first[slot + k]];
        batch->diameter[1][k] = (float)diameter[list->other[slot + k]];
    }
}

/* Adds the results of `count` pairs (at most eight) from index k of a batch on to their
 * particles, pair by pair: sums have the order of the list. */
GB_ROW_INLINE void scatter_wrenches(const struct gb_batch_f32 *batch,
                                    const struct gb_pair_list *list, int64_t slot, int k,
                                    int count, float (*row)[GB_WRENCH_ROWS_WIDTH])
{
    const int32_t *first = list->first + slot + k, *other = list->row + slot + k;
    gb_row_pair force[4], ti[4], tj[4];
    gb_row_pair_rows(batch->force[0] + k, batch->force[1] + k, batch->force[2] + k,
                     force);
    gb_row_pair_rows(batch->torque_i[0] + k, batch->torque_i[1] + k,
                     batch->torque_i[2] + k, ti);
    gb_row_pair_rows(batch->torque_j[0] + k, batch->torque_j[1] + k,
                     batch->torque_j[2] + k, tj);
    for (int l = 0; l < 4 && l < count; l++) {
        const gb_row_pair on_first = GB_ROW_PAIR_LOW(force[l], ti[l]);
        const gb_row_pair on_other = GB_ROW_PAIR_LOW(-force[l], tj[l]);
        gb_row_pair_add(row[first[l]], &on_first);
        gb_row_pair_add(row[other[l]], &on_other);
    }
    for (int l = 4; l < count; l++) {
        const gb_row_pair on_first = GB_ROW_PAIR_HIGH(force[l - 4], ti[l - 4]);
        const gb_row_pair on_other = GB_ROW_PAIR_HIGH(-force[l - 4], tj[l - 4]);
        gb_row_pair_add(row[first[l]], &on_first);
        gb_row_pair_add(row[other[l]], &on_other);
    }
}

/* The same for attractions. */
GB_ROW_INLINE void scatter_pulls(const struct gb_batch_f32 *batch,
                                 const struct gb_pair_list *list, int64_t slot, int k,
                                 int count, float (*row)[GB_WRENCH_ROWS_WIDTH])
{
    const int32_t *first = list->first + slot + k, *other = list->row + slot + k;
    gb_row pull[4];
    gb_row_of_columns(batch->force[0] + k, batch->force[1] + k, batch->force[2] + k,
                      pull);
    for (int l = 0; l < count; l++) {
        gb_row_add(row[first[l]], pull[l]);
        gb_row_add(row[other[l]], -pull[l]);
    }
}

/* Adds the results of so many pairs from index k of a batch on. */
typedef void scatter_some(const struct gb_batch_f32 *batch,
                          const struct gb_pair_list *list, int64_t slot, int k, int count,
                          float (*row)[GB_WRENCH_ROWS_WIDTH]);

/* A whole batch. */
GB_ROW_INLINE void scatter(const struct gb_batch_f32 *batch,
                           const struct gb_pair_list *list, int64_t slot,
                           float (*row)[GB_WRENCH_ROWS_WIDTH], int at_once,
                           scatter_some *some)
{
    int k = 0;
    for (; k + at_once <= batch->n; k += at_once) {
        some(batch, list, slot, k, at_once, row);
    }
    if (k < batch->n) {
        some(batch, list, slot, k, batch->n - k, row);
    }
}

/* Data of other threads are in the caches of other cores. */
static bool prefetches(const struct gb_engine *engine)
{
    return engine->particles.count >= GB_F32_STATE_PREFETCH ||
           gb_team_active(engine->team) > 1;
}

/* Prefetches the second particles of the `count` pairs of a list from slot on, a batch
 * before they are read: their order is random. */
GB_ROW_INLINE void prefetch_particles(const struct gb_engine *engine,
                                      const struct gb_pair_list *list, int64_t slot,
                                      int64_t count)
{
    if (!prefetches(engine)) {
        return;
    }
    const int32_t *other = list->other + slot, *row = list->row + slot;
    for (int k = 0; k < GB_BATCH && k < count; k++) {
        gb_simd_fetch(&engine->f32.particle[other[k]]);
        gb_simd_fetch(engine->f32.rows.row[row[k]]);
    }
}

GB_ROW_INLINE void sweep_near(struct gb_engine *engine, int64_t b, float cutoff2,
                              struct gb_tally *tally)
{
    const struct gb_pair_list *near = &engine->list.near;
    const struct gb_batch_f32_kernel *kernel = &engine->f32.kernel;
    const int64_t stop = near->stop[b];
    struct gb_batch_f32 batch;
    batch.cutoff2 = cutoff2;
    batch.damp = 0.0F;
    for (int64_t slot = near->start[gb_blocks_begin(engine->particles.count, b)];
         slot < stop; slot += batch.n) {
        batch.n = stop - slot < GB_BATCH ? (int)(stop - slot) : GB_BATCH;
        prefetch_particles(engine, near, slot + batch.n, stop - slot - batch.n);
        gather(&engine->f32, near, &batch, slot, WITH_ROTATIONS);
        gather_diameters(engine, near, &batch, slot);
        kernel->advance(engine->model, &batch, &engine->contacts, slot);
        scatter(&batch, near, slot, engine->f32.rows.row, 8, scatter_wrenches);
        kernel->tally(&batch, &engine->contacts, slot, tally);
    }
}

GB_ROW_INLINE void sweep_far(struct gb_engine *engine, int64_t b, float cutoff2)
{
    const struct gb_pair_list *far = &engine->list.far;
    const int64_t stop = far->stop[b];
    struct gb_batch_f32 batch;
    batch.cutoff2 = cutoff2;
    for (int64_t slot = far->start[gb_blocks_begin(engine->particles.count, b)];
         slot < stop; slot += batch.n) {
        batch.n = stop - slot < GB_BATCH ? (int)(stop - slot) : GB_BATCH;
        prefetch_particles(engine, far, slot + batch.n, stop - slot - batch.n);
        gather(&engine->f32, far, &batch, slot, BRANCH_ONLY);
        gather_diameters(engine, far, &batch, slot);
        engine->f32.kernel.attract(engine->model, &batch);
        scatter(&batch, far, slot, engine->f32.rows.row, 4, scatter_pulls);
    }
}

GB_SIMD_LOOP void sweep_block_loop(struct gb_engine *engine, int64_t b, float cutoff2,
                                   struct gb_tally *tally)
{
    const int64_t count = engine->particles.count, begin = gb_blocks_begin(count, b);
    memset(engine->f32.rows.row[begin], 0,
           (size_t)(gb_blocks_end(count, b) - begin) * sizeof *engine->f32.rows.row);
    sweep_near(engine, b, cutoff2, tally);
    sweep_far(engine, b, cutoff2);
}
GB_SIMD_WIDTHS(sweep_block,
               (struct gb_engine * engine, int64_t b, float cutoff2,
                struct gb_tally *tally),
               (engine, b, cutoff2, tally))

void gb_sweep_f32_block(struct gb_engine *engine, int64_t b, double cutoff2,
                        struct gb_tally *tally)
{
    sweep_block(engine, b, (float)cutoff2, tally);
}

/* Adds the rows of near pairs that cross to particle j, all without a branch that the
 * processor would mispredict: few particles have more than the first four. */
GB_ROW_INLINE void collect_near(const struct gb_wrench_rows *rows, int64_t j,
                                gb_row_pair *sum)
{
    const int32_t stop = rows->start[2 * j + 1];
    for (int32_t in = rows->start[2 * j]; in < stop; in += GB_WRENCH_ROWS_AT_ONCE) {
        for (int l = 0; l < GB_WRENCH_ROWS_AT_ONCE; l++) {
            gb_row_sum_if(sum, rows->row[in + l], l, stop - in);
        }
    }
}

/* Sum of the rows of far pairs. */
GB_ROW_INLINE gb_row collect_far(const struct gb_wrench_rows *rows, int64_t j)
{
    gb_row sum = {0.0F};
    for (int32_t in = rows->start[2 * j + 1]; in < rows->start[2 * j + 2]; in++) {
        sum += gb_row_load(rows->row[in]);
    }
    return sum;
}

GB_SIMD_LOOP void collect_loop(struct gb_engine *engine, int64_t begin, int64_t end,
                               struct gb_force_sums *sums)
{
    const struct gb_f32_state *f32 = &engine->f32;
    const gb_row none = {0.0F};
    gb_row_pair squares = {0.0F}, power = {0.0F};
    for (int64_t j = begin; j < end; j++) {
        gb_row_pair sum;
        memcpy(&sum, f32->rows.row[j], sizeof sum);
        collect_near(&f32->rows, j, &sum);
        const gb_row pull = collect_far(&f32->rows, j);
        sum += __builtin_shufflevector(pull, none, 0, 1, 2, 3, 4, 5, 6, 7);
        memcpy(f32->rows.row[j], &sum, sizeof sum);
        squares += sum * sum;
        gb_row_pair velocity;
        memcpy(&velocity, f32->velocity[j], sizeof velocity);
        power += sum * velocity;
    }
    gb_f32_state_clear_rows(&f32->rows, begin, end);
    *sums = (struct gb_force_sums){0};
    for (int c = 0; c < 3; c++) {
        sums->force2 += (double)squares[c];
        sums->torque2 += (double)squares[TORQUE + c];
        sums->power += (double)power[c] + (double)power[TORQUE + c];
    }
}
GB_SIMD_WIDTHS(collect,
               (struct gb_engine * engine, int64_t begin, int64_t end,
                struct gb_force_sums *sums),
               (engine, begin, end, sums))

void gb_sweep_f32_collect(struct gb_engine *engine, int64_t begin, int64_t end,
                          struct gb_force_sums *sums)
{
    collect(engine, begin, end, sums);
}

void gb_sweep_f32_recompute(const struct gb_engine *engine,
                            const struct gb_pair_list *list, int64_t slot,
                            struct gb_batch_f32 *batch)
{
    const double cutoff = gb_engine_cutoff(engine);
    batch->cutoff2 = (float)(cutoff * cutoff);
    gather_diameters(engine, list, batch, slot);
    if (list == &engine->list.near) {
        engine->f32.kernel.recompute(engine->model, batch, &engine->contacts, slot);
        return;
    }
    for (int k = 0; k < batch->n; k++) {
        double r[3];
        gb_engine_branch_vector(engine, list, list->first[slot + k], slot + k, r);
        for (int c = 0; c < 3; c++) {
            batch->r[c][k] = (float)r[c];
        }
    }
    engine->f32.kernel.attract(engine->model, batch);
}
