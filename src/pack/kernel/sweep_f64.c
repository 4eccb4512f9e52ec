#include "pack/kernel/sweep_f64.h"

#include <string.h>

#include "pack/cell/engine.h"
#include "pack/kernel/simd.h"
#include "pack/list/blocks.h"

/* Pairs of particle i among n that begin at slot: index behind the last one. */
static int pairs_end(const struct gb_pair_list *list, int n, int64_t slot, int64_t i)
{
    const int64_t stop = list->start[i + 1] - slot;
    return stop < n ? (int)stop : n;
}

/* Gathers a batch: branch vectors and rotations of pairs [slot, slot + n). */
static void gather(const struct gb_engine *engine, struct gb_batch *restrict batch,
                   int64_t slot)
{
    const struct gb_pair_list *near = &engine->list.near;
    const int32_t *first = near->first + slot, *other = near->other + slot;
    const uint8_t *image = near->image + slot;
    const double *position = engine->particles.position;
    const double *rotation = engine->particles.rotation;
    const int n = batch->n;
    for (int k = 0; k < n; k++) {
        const int64_t i = 3 * (int64_t)first[k], j = 3 * (int64_t)other[k];
        const double *shift = engine->list.shift[image[k]];
        for (int c = 0; c < 3; c++) {
            const double ti = rotation[i + c], tj = rotation[j + c];
            batch->r[c][k] = position[i + c] - position[j + c] + shift[c];
            batch->rotation_sum[c][k] = ti + tj;
            batch->rotation_difference[c][k] = ti - tj;
        }
    }
}

void gb_sweep_f64_gather_diameters(const struct gb_engine *engine,
                                   const struct gb_pair_list *list,
                                   struct gb_batch *restrict batch, int64_t slot)
{
    const double *diameter = engine->particles.diameter;
    for (int k = 0; diameter && k < batch->n; k++) {
        batch->diameter[0][k] = diameter[list->first[slot + k]];
        batch->diameter[1][k] = diameter[list->other[slot + k]];
    }
}

static void gather_2d(const struct gb_engine *engine, struct gb_batch *restrict batch,
                      int64_t slot)
{
    const struct gb_pair_list *near = &engine->list.near;
    const int32_t *first = near->first + slot, *other = near->other + slot;
    const uint8_t *image = near->image + slot;
    const double *position = engine->particles.position;
    const double *rotation = engine->particles.rotation;
    const int n = batch->n;
    for (int k = 0; k < n; k++) {
        const int64_t i = 3 * (int64_t)first[k], j = 3 * (int64_t)other[k];
        const double *shift = engine->list.shift[image[k]];
        const double ti = rotation[i + 1], tj = rotation[j + 1];
        batch->r[0][k] = position[i] - position[j] + shift[0];
        batch->r[1][k] = position[i + 2] - position[j + 2] + shift[2];
        batch->rotation_sum[0][k] = ti + tj;
        batch->rotation_difference[0][k] = ti - tj;
    }
}

/* Scatters a batch: adds to the first particles, leaves rows for the second ones. */
static void scatter(struct gb_engine *engine, const struct gb_batch *restrict batch,
                    int64_t slot, int64_t i)
{
    double *restrict row = engine->pair.wrench + 6 * slot;
    for (int k = 0; k < batch->n; i++) {
        const int stop = pairs_end(&engine->list.near, batch->n, slot, i);
        double *force = engine->particles.force + 3 * i;
        double *torque = engine->particles.torque + 3 * i;
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

static void scatter_2d(struct gb_engine *engine, const struct gb_batch *restrict batch,
                       int64_t slot, int64_t i)
{
    double *restrict row = engine->pair.wrench + 3 * slot;
    for (int k = 0; k < batch->n; i++) {
        const int stop = pairs_end(&engine->list.near, batch->n, slot, i);
        double *force = engine->particles.force + 3 * i;
        double *torque = engine->particles.torque + 3 * i;
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
static void sweep_near(struct gb_engine *engine, int64_t begin, int64_t end,
                       double cutoff2, struct gb_tally *tally)
{
    const int64_t *start = engine->list.near.start;
    const bool planar = gb_engine_pair_planar(&engine->pair);
    struct gb_batch batch;
    batch.cutoff2 = cutoff2;
    batch.damp = engine->damp;
    int64_t i = begin;
    for (int64_t slot = start[begin]; slot < start[end]; slot += batch.n) {
        const int64_t left = start[end] - slot;
        batch.n = left < GB_BATCH ? (int)left : GB_BATCH;
        while (slot >= start[i + 1]) {
            i++;
        }
        (planar ? gather_2d : gather)(engine, &batch, slot);
        gb_sweep_f64_gather_diameters(engine, &engine->list.near, &batch, slot);
        engine->kernel.advance(engine->model, &batch, &engine->contacts, slot);
        (planar ? scatter_2d : scatter)(engine, &batch, slot, i);
        engine->kernel.tally(&batch, &engine->contacts, slot, tally);
    }
}

/* Branch vectors of far pairs [slot, slot + n). */
static void gather_far(const struct gb_engine *engine, struct gb_batch *restrict batch,
                       int64_t slot)
{
    const struct gb_pair_list *far = &engine->list.far;
    const int32_t *first = far->first + slot, *other = far->other + slot;
    const uint8_t *image = far->image + slot;
    const double *position = engine->particles.position;
    const int up = gb_engine_pair_planar(&engine->pair) ? 1 : 2, n = batch->n;
    for (int k = 0; k < n; k++) {
        const double *xi = position + 3 * (int64_t)first[k];
        const double *xj = position + 3 * (int64_t)other[k];
        const double *shift = engine->list.shift[image[k]];
        batch->r[0][k] = xi[0] - xj[0] + shift[0];
        batch->r[1][k] = xi[1] - xj[1] + shift[1];
        batch->r[up][k] = xi[2] - xj[2] + shift[2];
    }
}

static void scatter_far(struct gb_engine *engine, const struct gb_batch *restrict batch,
                        int64_t slot)
{
    const int32_t *first = engine->list.far.first + slot;
    const bool planar = gb_engine_pair_planar(&engine->pair);
    const int n = batch->n;
    double *restrict pull = engine->pair.pull + 3 * slot;
    for (int k = 0; k < n; k++, pull += 3) {
        double *restrict force = engine->particles.force + 3 * (int64_t)first[k];
        force[0] += pull[0] = batch->force[0][k];
        force[1] += pull[1] = planar ? 0.0 : batch->force[1][k];
        force[2] += pull[2] = batch->force[planar ? 1 : 2][k];
    }
}

/* The far pairs of particles [begin, end). */
static void sweep_far(struct gb_engine *engine, int64_t begin, int64_t end,
                      double cutoff2, struct gb_tally *tally)
{
    const int64_t *start = engine->list.far.start;
    double *distance = engine->pair.far_distance, *pull = engine->pair.far_pull;
    struct gb_batch batch;
    batch.cutoff2 = cutoff2;
    for (int64_t slot = start[begin]; slot < start[end]; slot += batch.n) {
        const int64_t left = start[end] - slot;
        batch.n = left < GB_BATCH ? (int)left : GB_BATCH;
        gather_far(engine, &batch, slot);
        gb_sweep_f64_gather_diameters(engine, &engine->list.far, &batch, slot);
        engine->kernel.attract(engine->model, &batch, distance ? distance + slot : NULL,
                               distance ? pull + slot : NULL, tally);
        scatter_far(engine, &batch, slot);
    }
}

void gb_sweep_f64_block(struct gb_engine *engine, int64_t b, double cutoff2,
                        struct gb_tally *tally)
{
    struct gb_particles *particles = &engine->particles;
    const int64_t begin = gb_blocks_begin(particles->count, b);
    const int64_t end = gb_blocks_end(particles->count, b);
    const size_t bytes = 3 * (size_t)(end - begin) * sizeof(double);
    memset(particles->force + 3 * begin, 0, bytes);
    memset(particles->torque + 3 * begin, 0, bytes);
    sweep_near(engine, begin, end, cutoff2, tally);
    sweep_far(engine, begin, end, cutoff2, tally);
}

/* Adds the rows of near pairs with j as second particle, in slot order. */
static void collect_near(struct gb_engine *engine, int64_t j)
{
    double *restrict force = engine->particles.force + 3 * j;
    double *restrict torque = engine->particles.torque + 3 * j;
    const struct gb_pair_list *near = &engine->list.near;
    const int32_t *slot = near->in_slot;
    for (int64_t in = near->in_start[j]; in < near->in_start[j + 1]; in++) {
        const double *restrict row = engine->pair.wrench + 6 * (int64_t)slot[in];
        for (int c = 0; c < 3; c++) {
            force[c] -= row[c];
            torque[c] += row[3 + c];
        }
    }
}

static void collect_near_2d(struct gb_engine *engine, int64_t j)
{
    double *restrict force = engine->particles.force + 3 * j;
    double *restrict torque = engine->particles.torque + 3 * j;
    const struct gb_pair_list *near = &engine->list.near;
    for (int64_t in = near->in_start[j]; in < near->in_start[j + 1]; in++) {
        const double *restrict row = engine->pair.wrench + 3 * (int64_t)near->in_slot[in];
        force[0] -= row[0];
        force[2] -= row[1];
        torque[1] += row[2];
    }
}

static void collect_far(const struct gb_engine *engine, int64_t j, double *restrict force)
{
    const struct gb_pair_list *far = &engine->list.far;
    for (int64_t in = far->in_start[j]; in < far->in_start[j + 1]; in++) {
        const double *restrict pull = engine->pair.pull + 3 * (int64_t)far->in_slot[in];
        for (int c = 0; c < 3; c++) {
            force[c] -= pull[c];
        }
    }
}

void gb_sweep_f64_collect(struct gb_engine *engine, int64_t begin, int64_t end)
{
    const bool planar = gb_engine_pair_planar(&engine->pair);
    for (int64_t j = begin; j < end; j++) {
        (planar ? collect_near_2d : collect_near)(engine, j);
        collect_far(engine, j, engine->particles.force + 3 * j);
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

void gb_sweep_f64_sum(const struct gb_particles *particles, int64_t begin, int64_t end,
                      struct gb_sweep_along along, struct gb_force_sums *sums)
{
    const double *force = particles->force + 3 * begin;
    const double *torque = particles->torque + 3 * begin;
    const int64_t n = 3 * (end - begin);
    double translation = 0.0, rotation = 0.0;
    product_sum(force, force, n, &sums->force2);
    product_sum(torque, torque, n, &sums->torque2);
    if (along.velocity) {
        product_sum(force, along.velocity + 3 * begin, n, &translation);
        product_sum(torque, along.spin + 3 * begin, n, &rotation);
    }
    sums->power = translation + rotation;
}
