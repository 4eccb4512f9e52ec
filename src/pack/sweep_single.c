/* The sweep in single precision: particles as rows of numbers, the laws over columns of
 * many contacts. */
#include "pack/sweep_single.h"

#include <string.h>

#include "pack/rows.h"
#include "pack/simd.h"
#include "pack/world_private.h"

/* Rows of eight: force and torque on a particle. */
enum { WRENCH = 8, TORQUE = 4 };

/* Pairs of one particle that are looked at together: few have more, none pays much for
 * those it has not. */
enum { AT_ONCE = GB_PAIR_LIST_SLACK };

void gb_sweep_single_prepare(struct gb_world *world, int64_t begin, int64_t end)
{
    const double units[3] = {gb_single_units(&world->cell, 0),
                             gb_single_units(&world->cell, 1),
                             gb_single_units(&world->cell, 2)};
    for (int64_t i = begin; i < end; i++) {
        struct gb_spot *spot = &world->single.spot[i];
        const double *position = world->position + 3 * i, *turn = world->turn + 3 * i;
        for (int c = 0; c < 3; c++) {
            spot->place[c] = gb_single_place(position[c], units[c]);
            spot->turn[c] = (float)turn[c];
        }
    }
}

/* Columns of arms, and with turns of their sums and differences, of `count` pairs (at
 * most four) from place k of a batch on. */
GB_ROW_INLINE void fill_four(const struct gb_single *single,
                             const struct gb_pair_list *list,
                             struct gb_batch_single *restrict batch, int64_t slot, int k,
                             int count, bool turns)
{
    const gb_row scale = {single->scale[0], single->scale[1], single->scale[2], 0.0F};
    const int32_t *first = list->first + slot + k, *other = list->other + slot + k;
    gb_row arm[4], sum[4], difference[4];
    for (int l = 0; l < 4; l++) {
        const int at = l < count ? l : 0; /* behind the last pair: any */
        const struct gb_spot *i = &single->spot[first[at]];
        const struct gb_spot *j = &single->spot[other[at]];
        arm[l] = gb_row_difference(i->place, j->place) * scale;
        if (turns) {
            const gb_row ti = gb_row_load(i->turn), tj = gb_row_load(j->turn);
            sum[l] = ti + tj;
            difference[l] = ti - tj;
        }
    }
    gb_row_columns(arm, batch->r[0] + k, batch->r[1] + k, batch->r[2] + k);
    if (turns) {
        gb_row_columns(sum, batch->turn_sum[0] + k, batch->turn_sum[1] + k,
                       batch->turn_sum[2] + k);
        gb_row_columns(difference, batch->turn_difference[0] + k,
                       batch->turn_difference[1] + k, batch->turn_difference[2] + k);
    }
}

GB_ROW_INLINE void fill_batch(const struct gb_single *single,
                              const struct gb_pair_list *list,
                              struct gb_batch_single *restrict batch, int64_t slot,
                              bool turns)
{
    int k = 0;
    for (; k + 4 <= batch->n; k += 4) {
        fill_four(single, list, batch, slot, k, 4, turns);
    }
    if (k < batch->n) {
        fill_four(single, list, batch, slot, k, batch->n - k, turns);
    }
}

/* Columns of forces, times a sign, and torques as rows. */
GB_ROW_INLINE void spill_wrench(float (*force)[GB_BATCH], float (*torque)[GB_BATCH],
                                int n, float sign, float (*restrict to)[WRENCH])
{
    gb_row low[3], high[3];
    gb_row_pair row[4];
    int k = 0;
    for (; k + 4 <= n; k += 4) {
        for (int c = 0; c < 3; c++) {
            low[c] = sign * gb_row_load(force[c] + k);
            high[c] = gb_row_load(torque[c] + k);
        }
        gb_row_rows(low, high, row);
        for (int l = 0; l < 4; l++) {
            memcpy(to[k + l], &row[l], sizeof row[l]);
        }
    }
    for (; k < n; k++) {
        for (int c = 0; c < 3; c++) {
            to[k][c] = sign * force[c][k];
            to[k][TORQUE + c] = torque[c][k];
        }
        to[k][3] = to[k][TORQUE + 3] = 0.0F;
    }
}

/* Unloads a batch: leaves rows for the second particles, adds to the first ones. */
GB_ROW_INLINE void spill_batch(struct gb_world *world,
                               struct gb_batch_single *restrict batch, int64_t slot,
                               int64_t i)
{
    float own[GB_BATCH + AT_ONCE][WRENCH];
    spill_wrench(batch->force, batch->torque_j, batch->n, -1.0F,
                 world->single.row + slot);
    spill_wrench(batch->force, batch->torque_i, batch->n, 1.0F, own);
    for (int k = 0; k < batch->n; i++) {
        const int stop = gb_world_stop(&world->pairs.near, batch->n, slot, i);
        gb_row_pair sum, other = {0.0F};
        memcpy(&sum, world->single.total[i], sizeof sum);
        for (; k < stop; k += AT_ONCE) {
            for (int l = 0; l < AT_ONCE; l += 2) { /* in two chains: adding takes time */
                gb_row_add_if(&sum, own[k + l], l, stop - k);
                gb_row_add_if(&other, own[k + l + 1], l + 1, stop - k);
            }
        }
        k = stop;
        sum += other;
        memcpy(world->single.total[i], &sum, sizeof sum);
    }
}

GB_ROW_INLINE void sweep_near(struct gb_world *world, int64_t begin, int64_t end,
                              float cutoff2, struct gb_tally *tally)
{
    const struct gb_pair_list *near = &world->pairs.near;
    const struct gb_batch_single_kernel *kernel = &world->single.kernel;
    struct gb_batch_single batch;
    batch.cutoff2 = cutoff2;
    batch.damp = 0.0F;
    int64_t i = begin;
    for (int64_t slot = near->start[begin]; slot < near->start[end]; slot += batch.n) {
        const int64_t left = near->start[end] - slot;
        batch.n = left < GB_BATCH ? (int)left : GB_BATCH;
        while (slot >= near->start[i + 1]) {
            i++;
        }
        fill_batch(&world->single, near, &batch, slot, true);
        kernel->advance(world->model, &batch, &world->contacts, slot);
        spill_batch(world, &batch, slot, i);
        kernel->tally(&batch, &world->contacts, slot, tally);
    }
}

GB_ROW_INLINE void sweep_far(struct gb_world *world, int64_t begin, int64_t end,
                             float cutoff2)
{
    const struct gb_pair_list *far = &world->pairs.far;
    struct gb_batch_single batch;
    batch.cutoff2 = cutoff2;
    for (int64_t slot = far->start[begin]; slot < far->start[end]; slot += batch.n) {
        const int64_t left = far->start[end] - slot;
        batch.n = left < GB_BATCH ? (int)left : GB_BATCH;
        fill_batch(&world->single, far, &batch, slot, false);
        world->single.kernel.attract(world->model, &batch);
        float(*restrict pull)[4] = world->single.pull + slot;
        for (int k = 0; k < batch.n; k++) {
            const gb_row one = {batch.force[0][k], batch.force[1][k], batch.force[2][k],
                                0.0F};
            float *total = world->single.total[far->first[slot + k]];
            gb_row_store(pull[k], one);
            gb_row_store(total, gb_row_load(total) + one);
        }
    }
}

GB_SIMD_LOOP void sweep_block_loop(struct gb_world *world, int64_t begin, int64_t end,
                                   float cutoff2, struct gb_tally *tally)
{
    memset(world->single.total[begin], 0,
           (size_t)(end - begin) * sizeof *world->single.total);
    sweep_near(world, begin, end, cutoff2, tally);
    sweep_far(world, begin, end, cutoff2);
}
GB_SIMD_WIDTHS(sweep_block,
               (struct gb_world * world, int64_t begin, int64_t end, float cutoff2,
                struct gb_tally *tally),
               (world, begin, end, cutoff2, tally))

void gb_sweep_single_block(struct gb_world *world, int64_t begin, int64_t end,
                           double cutoff2, struct gb_tally *tally)
{
    sweep_block(world, begin, end, (float)cutoff2, tally);
}

/* What near pairs of others do to particle j, added to sum. */
GB_ROW_INLINE void collect_near(const struct gb_single *single,
                                const struct gb_pair_list *near, int64_t j,
                                gb_row_pair *sum)
{
    const int64_t stop = near->in_start[j + 1];
    gb_row_pair other = {0.0F};
    for (int64_t in = near->in_start[j]; in < stop; in += AT_ONCE) {
        const int32_t *slot = near->in_slot + in;
        const int n = (int)(stop - in);
        for (int l = 0; l < AT_ONCE; l += 2) {
            gb_row_add_if(sum, single->row[slot[l]], l, n);
            gb_row_add_if(&other, single->row[slot[l + 1]], l + 1, n);
        }
    }
    *sum += other;
}

/* The pulls of others on it. */
GB_ROW_INLINE gb_row collect_far(const struct gb_single *single,
                                 const struct gb_pair_list *far, int64_t j)
{
    const int64_t stop = far->in_start[j + 1];
    gb_row sum = {0.0F};
    for (int64_t in = far->in_start[j]; in < stop; in++) {
        sum += gb_row_load(single->pull[far->in_slot[in]]);
    }
    return sum;
}

GB_SIMD_LOOP void collect_loop(struct gb_world *world, int64_t begin, int64_t end)
{
    const struct gb_single *single = &world->single;
    for (int64_t j = begin; j < end; j++) {
        gb_row_pair sum;
        memcpy(&sum, single->total[j], sizeof sum);
        collect_near(single, &world->pairs.near, j, &sum);
        const gb_row pull = collect_far(single, &world->pairs.far, j);
        for (int c = 0; c < 3; c++) {
            world->force[3 * j + c] = (double)(sum[c] - pull[c]);
            world->torque[3 * j + c] = (double)sum[TORQUE + c];
        }
    }
}
GB_SIMD_WIDTHS(collect, (struct gb_world * world, int64_t begin, int64_t end),
               (world, begin, end))

void gb_sweep_single_collect(struct gb_world *world, int64_t begin, int64_t end)
{
    collect(world, begin, end);
}
