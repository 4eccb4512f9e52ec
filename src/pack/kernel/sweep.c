#include "pack/kernel/sweep.h"

#include <math.h>
#ifdef _OPENMP
#include <omp.h>
#endif
#include <string.h>

#include "pack/cell/list_check.h"
#include "pack/cell/world_private.h"
#include "pack/kernel/simd.h"
#include "pack/kernel/sweep_f32.h"

/* Loads a batch: arms and turns of pairs [slot, slot + n). */
static void fill_batch(const struct gb_world *world, struct gb_batch *restrict batch,
                       int64_t slot)
{
    const struct gb_pair_list *near = &world->pairs.near;
    const int32_t *first = near->first + slot, *other = near->other + slot;
    const uint8_t *image = near->image + slot;
    const double *position = world->position, *turn = world->turn;
    const int n = batch->n;
    for (int k = 0; k < n; k++) {
        const int64_t i = 3 * (int64_t)first[k], j = 3 * (int64_t)other[k];
        const double *shift = world->shift[image[k]];
        for (int c = 0; c < 3; c++) {
            const double ti = turn[i + c], tj = turn[j + c];
            batch->r[c][k] = position[i + c] - position[j + c] + shift[c];
            batch->turn_sum[c][k] = ti + tj;
            batch->turn_difference[c][k] = ti - tj;
        }
    }
}

static void fill_batch_2d(const struct gb_world *world, struct gb_batch *restrict batch,
                          int64_t slot)
{
    const struct gb_pair_list *near = &world->pairs.near;
    const int32_t *first = near->first + slot, *other = near->other + slot;
    const uint8_t *image = near->image + slot;
    const double *position = world->position, *turn = world->turn;
    const int n = batch->n;
    for (int k = 0; k < n; k++) {
        const int64_t i = 3 * (int64_t)first[k], j = 3 * (int64_t)other[k];
        const double *shift = world->shift[image[k]];
        const double ti = turn[i + 1], tj = turn[j + 1];
        batch->r[0][k] = position[i] - position[j] + shift[0];
        batch->r[1][k] = position[i + 2] - position[j + 2] + shift[2];
        batch->turn_sum[0][k] = ti + tj;
        batch->turn_difference[0][k] = ti - tj;
    }
}

/* Unloads a batch: adds to the first particles, leaves rows for the second ones. */
static void spill_batch(struct gb_world *world, const struct gb_batch *restrict batch,
                        int64_t slot, int64_t i)
{
    double *restrict row = world->wrench + 6 * slot;
    for (int k = 0; k < batch->n; i++) {
        const int stop = gb_world_stop(&world->pairs.near, batch->n, slot, i);
        double *force = world->force + 3 * i, *torque = world->torque + 3 * i;
        double f[3] = {force[0], force[1], force[2]};
        double t[3] = {torque[0], torque[1], torque[2]};
        for (; k < stop; k++, row += 6) {
            for (int c = 0; c < 3; c++) {
                f[c] += row[c] = batch->force[c][k];
                t[c] += batch->torque_i[c][k];
                row[3 + c] = batch->torque_j[c][k];
            }
        }
        for (int c = 0; c < 3; c++) {
            force[c] = f[c];
            torque[c] = t[c];
        }
    }
}

static void spill_batch_2d(struct gb_world *world, const struct gb_batch *restrict batch,
                           int64_t slot, int64_t i)
{
    double *restrict row = world->wrench + 3 * slot;
    for (int k = 0; k < batch->n; i++) {
        const int stop = gb_world_stop(&world->pairs.near, batch->n, slot, i);
        double *force = world->force + 3 * i, *torque = world->torque + 3 * i;
        double fx = force[0], fz = force[2], t = torque[1];
        for (; k < stop; k++, row += 3) {
            fx += row[0] = batch->force[0][k];
            fz += row[1] = batch->force[1][k];
            row[2] = batch->torque_j[0][k];
            t += batch->torque_i[0][k];
        }
        force[0] = fx;
        force[2] = fz;
        torque[1] = t;
    }
}

/* The near pairs of particles [begin, end), batch by batch. */
static void sweep_near(struct gb_world *world, int64_t begin, int64_t end, double cutoff2,
                       struct gb_tally *tally)
{
    const int64_t *start = world->pairs.near.start;
    const bool planar = world->model->dimension == 2;
    struct gb_batch batch;
    batch.cutoff2 = cutoff2;
    batch.damp = world->damp;
    int64_t i = begin;
    for (int64_t slot = start[begin]; slot < start[end]; slot += batch.n) {
        const int64_t left = start[end] - slot;
        batch.n = left < GB_BATCH ? (int)left : GB_BATCH;
        while (slot >= start[i + 1]) {
            i++;
        }
        (planar ? fill_batch_2d : fill_batch)(world, &batch, slot);
        world->kernel.advance(world->model, &batch, &world->contacts, slot);
        (planar ? spill_batch_2d : spill_batch)(world, &batch, slot, i);
        world->kernel.tally(&batch, &world->contacts, slot, tally);
    }
}

/* Arms of far pairs [slot, slot + n). */
static void fill_far(const struct gb_world *world, struct gb_batch *restrict batch,
                     int64_t slot)
{
    const struct gb_pair_list *far = &world->pairs.far;
    const int32_t *first = far->first + slot, *other = far->other + slot;
    const uint8_t *image = far->image + slot;
    const int up = world->model->dimension == 2 ? 1 : 2, n = batch->n;
    for (int k = 0; k < n; k++) {
        const double *xi = world->position + 3 * (int64_t)first[k];
        const double *xj = world->position + 3 * (int64_t)other[k];
        const double *shift = world->shift[image[k]];
        batch->r[0][k] = xi[0] - xj[0] + shift[0];
        batch->r[1][k] = xi[1] - xj[1] + shift[1];
        batch->r[up][k] = xi[2] - xj[2] + shift[2];
    }
}

static void spill_far(struct gb_world *world, const struct gb_batch *restrict batch,
                      int64_t slot)
{
    const int32_t *first = world->pairs.far.first + slot;
    const bool planar = world->model->dimension == 2;
    const int n = batch->n;
    double *restrict pull = world->pull + 3 * slot;
    for (int k = 0; k < n; k++, pull += 3) {
        double *restrict force = world->force + 3 * (int64_t)first[k];
        force[0] += pull[0] = batch->force[0][k];
        force[1] += pull[1] = planar ? 0.0 : batch->force[1][k];
        force[2] += pull[2] = batch->force[planar ? 1 : 2][k];
    }
}

/* The far pairs of particles [begin, end). */
static void sweep_far(struct gb_world *world, int64_t begin, int64_t end, double cutoff2,
                      struct gb_tally *tally)
{
    const int64_t *start = world->pairs.far.start;
    struct gb_batch batch;
    batch.cutoff2 = cutoff2;
    for (int64_t slot = start[begin]; slot < start[end]; slot += batch.n) {
        const int64_t left = start[end] - slot;
        batch.n = left < GB_BATCH ? (int)left : GB_BATCH;
        fill_far(world, &batch, slot);
        world->kernel.attract(world->model, &batch,
                              world->far_distance ? world->far_distance + slot : NULL,
                              world->far_distance ? world->far_pull + slot : NULL, tally);
        spill_far(world, &batch, slot);
    }
}

static void sweep_block(struct gb_world *world, int64_t b)
{
    const double cutoff = gb_world_cutoff(world);
    const int64_t begin = gb_sweep_block_begin(world->count, b),
                  end = gb_sweep_block_end(world->count, b);
    struct gb_tally tally = {0};
    if (world->in_single) {
        gb_sweep_f32_block(world, b, cutoff * cutoff, &tally);
    } else {
        const size_t bytes = 3 * (size_t)(end - begin) * sizeof(double);
        memset(world->force + 3 * begin, 0, bytes);
        memset(world->torque + 3 * begin, 0, bytes);
        sweep_near(world, begin, end, cutoff * cutoff, &tally);
        sweep_far(world, begin, end, cutoff * cutoff, &tally);
    }
    world->block[b].tally = tally;
}

/* Adds what the near pairs of others do to particle j, in slot order. */
static void collect_near(struct gb_world *world, int64_t j)
{
    double *restrict force = world->force + 3 * j, *restrict torque =
                                                       world->torque + 3 * j;
    const struct gb_pair_list *near = &world->pairs.near;
    const int32_t *slot = near->in_slot;
    for (int64_t in = near->in_start[j]; in < near->in_start[j + 1]; in++) {
        const double *restrict row = world->wrench + 6 * (int64_t)slot[in];
        for (int c = 0; c < 3; c++) {
            force[c] -= row[c];
            torque[c] += row[3 + c];
        }
    }
}

static void collect_near_2d(struct gb_world *world, int64_t j)
{
    double *restrict force = world->force + 3 * j, *restrict torque =
                                                       world->torque + 3 * j;
    const struct gb_pair_list *near = &world->pairs.near;
    for (int64_t in = near->in_start[j]; in < near->in_start[j + 1]; in++) {
        const double *restrict row = world->wrench + 3 * (int64_t)near->in_slot[in];
        force[0] -= row[0];
        force[2] -= row[1];
        torque[1] += row[2];
    }
}

static void collect_far(const struct gb_world *world, int64_t j, double *restrict force)
{
    const struct gb_pair_list *far = &world->pairs.far;
    for (int64_t in = far->in_start[j]; in < far->in_start[j + 1]; in++) {
        const double *restrict pull = world->pull + 3 * (int64_t)far->in_slot[in];
        for (int c = 0; c < 3; c++) {
            force[c] -= pull[c];
        }
    }
}

/* Sum of n products, lane by lane: the same bits from every vector width. */
GB_SIMD_LOOP void product_sum_loop(const double *restrict a, const double *restrict b,
                                   int64_t n, double *restrict total)
{
    double lane[GB_LANES] = {0}, sum = 0.0;
    int64_t k = 0;
    for (; k + GB_LANES <= n; k += GB_LANES) {
        for (int l = 0; l < GB_LANES; l++) {
            lane[l] += a[k + l] * b[k + l];
        }
    }
    for (; k < n; k++) {
        sum += a[k] * b[k];
    }
    for (int l = 0; l < GB_LANES; l++) {
        sum += lane[l];
    }
    *total = sum;
}
GB_SIMD_WIDTHS(product_sum, (const double *a, const double *b, int64_t n, double *total),
               (a, b, n, total))

void gb_sweep_sum(const struct gb_world *world, int64_t begin, int64_t end,
                  struct gb_force_sums *sums)
{
    const double *force = world->force + 3 * begin, *torque = world->torque + 3 * begin;
    const int64_t n = 3 * (end - begin);
    double moving = 0.0, turning = 0.0;
    product_sum(force, force, n, &sums->force2);
    product_sum(torque, torque, n, &sums->torque2);
    if (world->velocity) {
        product_sum(force, world->velocity + 3 * begin, n, &moving);
        product_sum(torque, world->spin + 3 * begin, n, &turning);
    }
    sums->power = moving + turning;
}

void gb_sweep_conclude(struct gb_world *world, const struct gb_force_sums *sums)
{
    world->sums = *sums;
    world->force_rms = sqrt(sums->force2 / (double)world->count);
    world->torque_rms = sqrt(sums->torque2 / (double)world->count);
}

static void collect_block(struct gb_world *world, int64_t b)
{
    const bool planar = world->model->dimension == 2;
    const int64_t begin = gb_sweep_block_begin(world->count, b),
                  end = gb_sweep_block_end(world->count, b);
    if (!world->single.driven) {
        memset(world->turn + 3 * begin, 0,
               3 * (size_t)(end - begin) * sizeof *world->turn);
    }
    if (world->in_single) {
        gb_sweep_f32_collect(world, begin, end, &world->block[b].sums);
        return;
    }
    for (int64_t j = begin; j < end; j++) {
        (planar ? collect_near_2d : collect_near)(world, j);
        collect_far(world, j, world->force + 3 * j);
    }
    gb_sweep_sum(world, begin, end, &world->block[b].sums);
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

static double longest_travel(const struct gb_world *world, int64_t blocks)
{
    double longest = 0.0;
    for (int64_t b = 0; b < blocks; b++) {
        const double travel = world->block[b].travel;
        if (!(travel <= longest)) {
            longest = travel;
        }
        if (isnan(travel)) {
            break;
        }
    }
    return longest;
}

static void prepare_block(struct gb_world *world, int64_t b)
{
    const int64_t begin = gb_sweep_block_begin(world->count, b),
                  end = gb_sweep_block_end(world->count, b);
    world->block[b].travel =
        gb_neighbour_list_travel(&world->pairs, world->position, begin, end);
    if (world->in_single) {
        gb_sweep_f32_prepare(world, begin, end);
    }
}

/* Where somebody of the block has strayed: are they still in the list? */
static void doubt_block(struct gb_world *world, int64_t b)
{
    struct gb_sweep_block *block = &world->block[b];
    block->missing = (struct gb_list_check_missing){0};
    if (gb_list_check_judge(world, block->travel) != GB_LIST_CHECK_FRESH) {
        gb_list_check_look(world, gb_sweep_block_begin(world->count, b),
                           gb_sweep_block_end(world->count, b), &block->missing);
    }
}

/* Does the list miss a pair, or is it too old to be looked after? */
static bool any_missing(const struct gb_world *world, int64_t blocks)
{
    int64_t strays = 0;
    for (int64_t b = 0; b < blocks; b++) {
        const struct gb_list_check_missing *missing = &world->block[b].missing;
        if (missing->many || missing->count > 0) {
            return true;
        }
        strays += missing->strays;
    }
    return gb_list_check_too_many(strays, world->count);
}

/* By all threads of a team or by one; every one of them gets the same answer. */
static bool list_holds(struct gb_world *world, int64_t blocks)
{
    if (world->amended) {
        return true;
    }
    const enum gb_list_check_list list =
        gb_list_check_judge(world, longest_travel(world, blocks));
    if (list != GB_LIST_CHECK_DOUBTED) {
        return list == GB_LIST_CHECK_FRESH;
    }
#pragma omp for schedule(static)
    for (int64_t b = 0; b < blocks; b++) {
        doubt_block(world, b);
    }
    return !any_missing(world, blocks);
}

bool gb_sweep_list_holds(struct gb_world *world, double *travel)
{
    const int64_t blocks = gb_sweep_blocks(world->count);
    for (int64_t b = 0; b < blocks; b++) {
        world->block[b].travel = gb_neighbour_list_travel(
            &world->pairs, world->position, gb_sweep_block_begin(world->count, b),
            gb_sweep_block_end(world->count, b));
    }
    *travel = longest_travel(world, blocks);
    return list_holds(world, blocks);
}

/* The blocks of one thread of a team; all of them without one.  The same that a loop with
 * a static schedule gives it, so that they stay in its caches. */
struct share {
    int64_t begin, end;
};

static struct share share_of(int64_t blocks)
{
#ifdef _OPENMP
    const int64_t thread = omp_get_thread_num(), threads = omp_get_num_threads();
    const int64_t each = blocks / threads, more = blocks % threads;
    const int64_t begin = each * thread + (thread < more ? thread : more);
    return (struct share){begin, begin + each + (thread < more ? 1 : 0)};
#else
    return (struct share){0, blocks};
#endif
}

/* Is all that a block of a share collects left there by its thread, and already? */
static bool collects_at_once(const struct gb_world *world, const struct share *share,
                             int64_t b)
{
    return world->in_single && world->single.near.source[b] >= share->begin &&
           world->single.far.source[b] >= share->begin;
}

/* All blocks, by the threads of the team that calls it; without one, by the caller.  All
 * of them see alike whether the list still holds. */
static void run_blocks(struct gb_world *world, int64_t blocks, bool *holds)
{
    if (!world->single.driven) { /* a drive has prepared them already */
#pragma omp for schedule(static)
        for (int64_t b = 0; b < blocks; b++) {
            prepare_block(world, b);
        }
    }
    if (!list_holds(world, blocks)) {
        return;
    }
#pragma omp single nowait
    *holds = true;
    const struct share share = share_of(blocks);
    for (int64_t b = share.begin; b < share.end; b++) {
        sweep_block(world, b);
        if (collects_at_once(world, &share, b)) {
            collect_block(world, b);
        }
    }
#pragma omp barrier
    for (int64_t b = share.begin; b < share.end; b++) {
        if (!collects_at_once(world, &share, b)) {
            collect_block(world, b);
        }
    }
}

bool gb_sweep_run(struct gb_world *world, double *travel)
{
    gb_neighbour_list_shifts(&world->cell, world->shift);
    const int64_t blocks = gb_sweep_blocks(world->count);
    for (int c = 0; c < 3; c++) {
        world->single.scale[c] = (float)gb_f32_state_d(&world->cell, c);
    }
    if (!world->single.driven) {
        gb_sweep_f32_settle(world);
    }
    bool holds = false;
    world->single.bounded = world->single.bounded && world->single.driven;
    if (world->threads > 1) {
#pragma omp parallel num_threads(world->threads)
        run_blocks(world, blocks, &holds);
    } else { /* a team of one would wait for itself */
        run_blocks(world, blocks, &holds);
    }
    if (!world->single.driven) {
        world->single.ahead = GB_F32_STATE_EVEN; /* prepared */
    }
    *travel = longest_travel(world, blocks);
    if (!holds) {
        return false;
    }
    struct gb_sweep_block sum = {0};
    for (int64_t b = 0; b < blocks; b++) {
        sum.sums.force2 += world->block[b].sums.force2;
        sum.sums.torque2 += world->block[b].sums.torque2;
        sum.sums.power += world->block[b].sums.power;
        add_tally(&sum.tally, &world->block[b].tally);
    }
    world->tally = sum.tally;
    world->single.driven = false;
    world->single.narrow = world->in_single;
    gb_sweep_conclude(world, &sum.sums);
    return true;
}
