/* The sweep in single precision: particles as rows of numbers, the laws over columns of
 * many contacts. */
#include "pack/kernel/sweep_f32.h"

#include <string.h>

#include "pack/cell/world_private.h"
#include "pack/kernel/register_rows.h"
#include "pack/kernel/simd.h"

/* Where the torque begins in a row of both. */
enum { WRENCH = GB_F32_STATE_WRENCH, PULL = GB_F32_STATE_PULL, TORQUE = 4 };

/* Rows of one particle that are looked at together: few have more, none pays much for
 * those it has not. */
enum { AT_ONCE = 4 };
_Static_assert((int)AT_ONCE <= (int)GB_F32_STATE_SLACK, "lists are long enough");

void gb_sweep_f32_prepare(struct gb_world *world, int64_t begin, int64_t end)
{
    const double units[3] = {gb_f32_state_units(&world->cell, 0),
                             gb_f32_state_units(&world->cell, 1),
                             gb_f32_state_units(&world->cell, 2)};
    for (int64_t i = begin; i < end; i++) {
        struct gb_spot *spot = &world->single.spot[i];
        const double *position = world->position + 3 * i, *turn = world->turn + 3 * i;
        for (int c = 0; c < 3; c++) {
            spot->place[c] = gb_f32_state_place(position[c], units[c]);
            spot->turn[c] = (float)turn[c];
        }
    }
}

GB_SIMD_LOOP void follow_loop(double *restrict position, const struct gb_spot *spot,
                              int64_t count, const double units[3], const double d[3])
{
    for (int64_t i = 0; i < count; i++) {
        for (int c = 0; c < 3; c++) {
            position[3 * i + c] = gb_f32_state_follow(position[3 * i + c],
                                                      spot[i].place[c], units[c], d[c]);
        }
    }
}
GB_SIMD_WIDTHS(follow,
               (double *position, const struct gb_spot *spot, int64_t count,
                const double units[3], const double d[3]),
               (position, spot, count, units, d))

void gb_sweep_f32_settle(struct gb_world *world)
{
    if (world->single.ahead != GB_F32_STATE_PLACES) {
        return;
    }
    const int64_t blocks = gb_sweep_blocks(world->count);
    double units[3], d[3];
    for (int c = 0; c < 3; c++) {
        units[c] = gb_f32_state_units(&world->cell, c);
        d[c] = gb_f32_state_d(&world->cell, c);
    }
#pragma omp parallel for num_threads(world->threads)                                     \
    schedule(static) if (world->threads > 1)
    for (int64_t b = 0; b < blocks; b++) {
        const int64_t begin = gb_sweep_block_begin(world->count, b);
        follow(world->position + 3 * begin, world->single.spot + begin,
               gb_sweep_block_end(world->count, b) - begin, units, d);
    }
    world->single.ahead = GB_F32_STATE_EVEN;
}

/* Columns of arms, and with turns of their sums and differences, of `count` pairs (at
 * most four) from place k of a batch on. */
GB_ROW_INLINE void fill_four(const struct gb_f32_state *single,
                             const struct gb_pair_list *list,
                             struct gb_batch_f32 *restrict batch, int64_t slot, int k,
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

GB_ROW_INLINE void fill_batch(const struct gb_f32_state *single,
                              const struct gb_pair_list *list,
                              struct gb_batch_f32 *restrict batch, int64_t slot,
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

/* Where what acts on a particle goes: on the second one of a pair, too, while that lies
 * before `end`, else into the next row. */
struct way_out {
    float (*total)[WRENCH];
    float *row;
    int32_t end;
};

static struct way_out way_out(const struct gb_world *world,
                              const struct gb_f32_state_outward *out, int width,
                              int64_t b)
{
    return (struct way_out){world->single.total, out->row + width * out->start[b],
                            (int32_t)gb_sweep_block_end(world->count, b)};
}

/* Rows of force and torque for both particles of four pairs. */
GB_ROW_INLINE void wrench_rows(const struct gb_batch_f32 *batch, int k,
                               gb_row_pair on_first[4], gb_row_pair on_other[4])
{
    gb_row force[3], against[3], first[3], other[3];
    for (int c = 0; c < 3; c++) {
        force[c] = gb_row_load(batch->force[c] + k);
        against[c] = -force[c];
        first[c] = gb_row_load(batch->torque_i[c] + k);
        other[c] = gb_row_load(batch->torque_j[c] + k);
    }
    gb_row_rows(force, first, on_first);
    gb_row_rows(against, other, on_other);
}

/* Gives `count` pairs (at most four) of a list to their particles, from place k of a
 * batch on, pair by pair: sums have the order of the list. */
GB_ROW_INLINE struct way_out give_four(const struct gb_batch_f32 *batch,
                                       const int32_t *first, const int32_t *other, int k,
                                       int count, struct way_out out)
{
    gb_row_pair on_first[4], on_other[4];
    wrench_rows(batch, k, on_first, on_other);
    for (int l = 0; l < count; l++) {
        const int32_t i = first[k + l], j = other[k + l];
        const bool here = j < out.end;
        gb_row_pair_add(out.total[i], &on_first[l]);
        gb_row_pair_add_if(here ? out.total[j] : out.row, here, &on_other[l]);
        out.row += here ? 0 : WRENCH;
    }
    return out;
}

/* As give_four, for pulls. */
GB_ROW_INLINE struct way_out pull_four(const struct gb_batch_f32 *batch,
                                       const int32_t *first, const int32_t *other, int k,
                                       int count, struct way_out out)
{
    gb_row pull[4];
    gb_row_of_columns(batch->force[0] + k, batch->force[1] + k, batch->force[2] + k,
                      pull);
    for (int l = 0; l < count; l++) {
        const int32_t i = first[k + l], j = other[k + l];
        const bool here = j < out.end;
        gb_row_add(out.total[i], pull[l]);
        gb_row_add_if(here ? out.total[j] : out.row, here, -pull[l]);
        out.row += here ? 0 : PULL;
    }
    return out;
}

typedef struct way_out give(const struct gb_batch_f32 *batch, const int32_t *first,
                            const int32_t *other, int k, int count, struct way_out out);

/* Unloads a batch, four pairs at a time. */
GB_ROW_INLINE struct way_out spill(const struct gb_batch_f32 *batch, const int32_t *first,
                                   const int32_t *other, struct way_out out, give *four)
{
    int k = 0;
    for (; k + 4 <= batch->n; k += 4) {
        out = four(batch, first, other, k, 4, out);
    }
    return k < batch->n ? four(batch, first, other, k, batch->n - k, out) : out;
}

/* Asks for the spots of the `count` pairs of a list from slot on, a batch before they are
 * needed: they lie in no order that a processor could foresee. */
GB_ROW_INLINE void fetch_ahead(const struct gb_world *world,
                               const struct gb_pair_list *list, int64_t slot,
                               int64_t count)
{
    if (world->count < GB_F32_STATE_FETCHED) {
        return;
    }
    const int32_t *other = list->other + slot;
    for (int k = 0; k < GB_BATCH && k < count; k++) {
        gb_simd_fetch(&world->single.spot[other[k]]);
    }
}

GB_ROW_INLINE void sweep_near(struct gb_world *world, int64_t b, float cutoff2,
                              struct gb_tally *tally)
{
    const struct gb_pair_list *near = &world->pairs.near;
    const struct gb_batch_f32_kernel *kernel = &world->single.kernel;
    const int64_t stop = near->stop[b];
    struct way_out out = way_out(world, &world->single.near, WRENCH, b);
    struct gb_batch_f32 batch;
    batch.cutoff2 = cutoff2;
    batch.damp = 0.0F;
    for (int64_t slot = near->start[gb_sweep_block_begin(world->count, b)]; slot < stop;
         slot += batch.n) {
        batch.n = stop - slot < GB_BATCH ? (int)(stop - slot) : GB_BATCH;
        fetch_ahead(world, near, slot + batch.n, stop - slot - batch.n);
        fill_batch(&world->single, near, &batch, slot, true);
        kernel->advance(world->model, &batch, &world->contacts, slot);
        out = spill(&batch, near->first + slot, near->other + slot, out, give_four);
        kernel->tally(&batch, &world->contacts, slot, tally);
    }
}

GB_ROW_INLINE void sweep_far(struct gb_world *world, int64_t b, float cutoff2)
{
    const struct gb_pair_list *far = &world->pairs.far;
    const int64_t stop = far->stop[b];
    struct way_out out = way_out(world, &world->single.far, PULL, b);
    struct gb_batch_f32 batch;
    batch.cutoff2 = cutoff2;
    for (int64_t slot = far->start[gb_sweep_block_begin(world->count, b)]; slot < stop;
         slot += batch.n) {
        batch.n = stop - slot < GB_BATCH ? (int)(stop - slot) : GB_BATCH;
        fetch_ahead(world, far, slot + batch.n, stop - slot - batch.n);
        fill_batch(&world->single, far, &batch, slot, false);
        world->single.kernel.attract(world->model, &batch);
        out = spill(&batch, far->first + slot, far->other + slot, out, pull_four);
    }
}

GB_SIMD_LOOP void sweep_block_loop(struct gb_world *world, int64_t b, float cutoff2,
                                   struct gb_tally *tally)
{
    const int64_t begin = gb_sweep_block_begin(world->count, b);
    memset(world->single.total[begin], 0,
           (size_t)(gb_sweep_block_end(world->count, b) - begin) *
               sizeof *world->single.total);
    sweep_near(world, b, cutoff2, tally);
    sweep_far(world, b, cutoff2);
}
GB_SIMD_WIDTHS(sweep_block,
               (struct gb_world * world, int64_t b, float cutoff2,
                struct gb_tally *tally),
               (world, b, cutoff2, tally))

void gb_sweep_f32_block(struct gb_world *world, int64_t b, double cutoff2,
                        struct gb_tally *tally)
{
    sweep_block(world, b, (float)cutoff2, tally);
}

/* What near pairs of earlier blocks do to particle j, added to sum. */
GB_ROW_INLINE void collect_near(const struct gb_f32_state_outward *near, int64_t j,
                                gb_row_pair *sum)
{
    const int32_t stop = near->in_start[j + 1];
    for (int32_t in = near->in_start[j]; in < stop; in += AT_ONCE) {
        const int32_t *row = near->in_row + in;
        for (int l = 0; l < AT_ONCE; l++) {
            gb_row_sum_if(sum, near->row + WRENCH * (int64_t)row[l], l, stop - in);
        }
    }
}

/* The pulls. */
GB_ROW_INLINE gb_row collect_far(const struct gb_f32_state_outward *far, int64_t j)
{
    gb_row sum = {0.0F};
    for (int32_t in = far->in_start[j]; in < far->in_start[j + 1]; in++) {
        sum += gb_row_load(far->row + PULL * (int64_t)far->in_row[in]);
    }
    return sum;
}

/* Particles whose rows are asked for together, before those in front of them collect. */
enum { COLLECTED_NEXT = 32 };

GB_ROW_INLINE void ask_for_rows(const struct gb_f32_state_outward *out, int width,
                                int64_t begin, int64_t end)
{
    for (int32_t in = out->in_start[begin]; in < out->in_start[end]; in++) {
        gb_simd_fetch(out->row + width * (int64_t)out->in_row[in]);
    }
}

GB_ROW_INLINE void ask_for_next(const struct gb_world *world, int64_t begin, int64_t end)
{
    const int64_t stop = begin + COLLECTED_NEXT < end ? begin + COLLECTED_NEXT : end;
    if (world->count >= GB_F32_STATE_FETCHED && begin < end) {
        ask_for_rows(&world->single.near, WRENCH, begin, stop);
        ask_for_rows(&world->single.far, PULL, begin, stop);
    }
}

GB_SIMD_LOOP void collect_loop(struct gb_world *world, int64_t begin, int64_t end,
                               struct gb_force_sums *sums)
{
    const struct gb_f32_state *single = &world->single;
    const gb_row none = {0.0F};
    gb_row_pair squares = {0.0F};
    gb_row power = {0.0F};
    ask_for_next(world, begin, end);
    for (int64_t j = begin; j < end; j++) {
        if ((j - begin) % COLLECTED_NEXT == 0) {
            ask_for_next(world, j + COLLECTED_NEXT, end);
        }
        gb_row_pair sum;
        memcpy(&sum, single->total[j], sizeof sum);
        collect_near(&single->near, j, &sum);
        const gb_row pull = collect_far(&single->far, j);
        sum += __builtin_shufflevector(pull, none, 0, 1, 2, 3, 4, 5, 6, 7);
        memcpy(single->total[j], &sum, sizeof sum);
        squares += sum * sum;
        /* the fourth number of a velocity is another's, that of a force is 0 */
        const gb_row force = __builtin_shufflevector(sum, sum, 0, 1, 2, 3);
        const gb_row torque = __builtin_shufflevector(sum, sum, 4, 5, 6, 7);
        power += force * gb_row_load(single->velocity + 3 * j) +
                 torque * gb_row_load(single->spin + 3 * j);
    }
    *sums = (struct gb_force_sums){0};
    for (int c = 0; c < 3; c++) {
        sums->force2 += (double)squares[c];
        sums->torque2 += (double)squares[TORQUE + c];
        sums->power += (double)power[c];
    }
}
GB_SIMD_WIDTHS(collect,
               (struct gb_world * world, int64_t begin, int64_t end,
                struct gb_force_sums *sums),
               (world, begin, end, sums))

void gb_sweep_f32_collect(struct gb_world *world, int64_t begin, int64_t end,
                          struct gb_force_sums *sums)
{
    collect(world, begin, end, sums);
}

void gb_sweep_f32_recall(const struct gb_world *world, bool near, int64_t slot,
                         struct gb_batch_f32 *batch)
{
    const double cutoff = gb_world_cutoff(world);
    batch->cutoff2 = (float)(cutoff * cutoff);
    if (near) {
        world->single.kernel.recall(world->model, batch, &world->contacts, slot);
        return;
    }
    const struct gb_pair_list *far = &world->pairs.far;
    for (int k = 0; k < batch->n; k++) {
        double r[3];
        gb_world_arm_of(world, far, far->first[slot + k], slot + k, r);
        for (int c = 0; c < 3; c++) {
            batch->r[c][k] = (float)r[c];
        }
    }
    world->single.kernel.attract(world->model, batch);
}

void gb_sweep_f32_widen(struct gb_world *world)
{
    if (!world->in_single || !world->single.narrow) {
        return;
    }
#pragma omp parallel for num_threads(world->threads)                                     \
    schedule(static) if (world->threads > 1)
    for (int64_t i = 0; i < world->count; i++) {
        for (int c = 0; c < 3; c++) {
            world->force[3 * i + c] = (double)world->single.total[i][c];
            world->torque[3 * i + c] = (double)world->single.total[i][TORQUE + c];
        }
    }
    world->single.narrow = false;
}

void gb_sweep_f32_narrow(struct gb_world *world)
{
    for (int64_t i = 0; world->in_single && i < world->count; i++) {
        for (int c = 0; c < 3; c++) {
            world->single.total[i][c] = (float)world->force[3 * i + c];
            world->single.total[i][TORQUE + c] = (float)world->torque[3 * i + c];
        }
    }
}
