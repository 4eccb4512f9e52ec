#include "pack/sweep.h"

#include <math.h>
#include <string.h>

#include "pack/world_private.h"

int64_t gb_sweep_blocks(int64_t count)
{
    return (count + GB_SWEEP_BLOCK - 1) / GB_SWEEP_BLOCK;
}

/* Attraction across a gap: force on the first particle. */
static void gap_force(const struct gb_model *model, const double r[3], double squared,
                      double force[3])
{
    const double distance = sqrt(squared);
    const double pull = gb_law_dispersion_force(&model->dispersion, distance) / distance;
    for (int k = 0; k < 3; k++) {
        force[k] = -pull * r[k];
    }
}

/* The work that a pull takes up since the last evaluation. */
static double far_work(double last[2], double distance, double pull)
{
    const double work =
        last[0] > 0.0 ? 0.5 * (last[1] + pull) * (distance - last[0]) : 0.0;
    last[0] = distance;
    last[1] = pull;
    return work;
}

/* The far pairs of particle i. */
static void sweep_far(struct gb_world *world, int64_t i, double cutoff2,
                      struct gb_tally *tally)
{
    const struct gb_pair_list *far = &world->pairs.far;
    double *force = world->force + 3 * i;
    for (int64_t k = far->start[i]; k < far->start[i + 1]; k++) {
        double r[3];
        double *pull = world->pull + 3 * k;
        const double squared = gb_world_arm_of(world, far, i, k, r);
        pull[0] = pull[1] = pull[2] = 0.0;
        if (squared < cutoff2) {
            gap_force(world->model, r, squared, pull);
            gb_vec_add(force, 1.0, pull);
            for (int c = 0; c < 3; c++) {
                tally->virial[c] += pull[c] * r[c];
            }
        }
        if (world->far_last) {
            tally->absorbed +=
                far_work(world->far_last[k], sqrt(squared), gb_vec_length(pull));
        }
    }
}

/* Pairs of particle i within a batch that begins at slot: index behind the last one. */
static int stop_of(const struct gb_pair_list *near, const struct gb_batch *batch,
                   int64_t slot, int64_t i)
{
    const int64_t stop = near->start[i + 1] - slot;
    return stop < batch->n ? (int)stop : batch->n;
}

/* Loads a batch: arms and turns of pairs [slot, slot + n); i is the first particle. */
static void fill_batch(const struct gb_world *world, struct gb_batch *restrict batch,
                       int64_t slot, int64_t i)
{
    const struct gb_pair_list *near = &world->pairs.near;
    const int32_t *other = near->other + slot;
    const uint8_t *image = near->image + slot;
    const double *position = world->position, *turn = world->turn;
    for (int k = 0; k < batch->n; i++) {
        const int stop = stop_of(near, batch, slot, i);
        const double *x = position + 3 * i, *w = turn + 3 * i;
        const double xi[3] = {x[0], x[1], x[2]}, ti[3] = {w[0], w[1], w[2]};
        for (; k < stop; k++) {
            const double *xj = position + 3 * (int64_t)other[k];
            const double *tj = turn + 3 * (int64_t)other[k];
            const double *shift = world->shift[image[k]];
            for (int c = 0; c < 3; c++) {
                batch->r[c][k] = xi[c] - xj[c] + shift[c];
                batch->turn_sum[c][k] = ti[c] + tj[c];
                batch->turn_difference[c][k] = ti[c] - tj[c];
            }
        }
    }
}

static void fill_batch_2d(const struct gb_world *world, struct gb_batch *restrict batch,
                          int64_t slot, int64_t i)
{
    const struct gb_pair_list *near = &world->pairs.near;
    for (int k = 0; k < batch->n; i++) {
        const int stop = stop_of(near, batch, slot, i);
        const double *xi = world->position + 3 * i;
        const double ti = world->turn[3 * i + 1];
        for (; k < stop; k++) {
            const int64_t j = near->other[slot + k];
            const double *xj = world->position + 3 * j;
            const double *shift = world->shift[near->image[slot + k]];
            const double tj = world->turn[3 * j + 1];
            batch->r[0][k] = xi[0] - xj[0] + shift[0];
            batch->r[1][k] = xi[2] - xj[2] + shift[2];
            batch->turn_sum[0][k] = ti + tj;
            batch->turn_difference[0][k] = ti - tj;
        }
    }
}

/* Unloads a batch: adds to the first particles, leaves rows for the second ones. */
static void spill_batch(struct gb_world *world, const struct gb_batch *restrict batch,
                        int64_t slot, int64_t i)
{
    double *restrict row = world->wrench + 6 * slot;
    for (int k = 0; k < batch->n; i++) {
        const int stop = stop_of(&world->pairs.near, batch, slot, i);
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
        const int stop = stop_of(&world->pairs.near, batch, slot, i);
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
        (planar ? fill_batch_2d : fill_batch)(world, &batch, slot, i);
        gb_batch_advance(&world->kernel, world->model, &batch, &world->contacts, slot);
        (planar ? spill_batch_2d : spill_batch)(world, &batch, slot, i);
        world->kernel.tally(&batch, world->contacts.deepest + slot, tally);
    }
}

static void sweep_block(struct gb_world *world, int64_t b)
{
    const double cutoff =
        world->model->terms.attraction ? world->model->numerics.cutoff : 0.0;
    const int64_t begin = b * GB_SWEEP_BLOCK;
    const int64_t end =
        begin + GB_SWEEP_BLOCK < world->count ? begin + GB_SWEEP_BLOCK : world->count;
    struct gb_tally tally = {0};
    const size_t bytes = 3 * (size_t)(end - begin) * sizeof(double);
    memset(world->force + 3 * begin, 0, bytes);
    memset(world->torque + 3 * begin, 0, bytes);
    sweep_near(world, begin, end, cutoff * cutoff, &tally);
    for (int64_t i = begin; i < end; i++) {
        sweep_far(world, i, cutoff * cutoff, &tally);
    }
    world->block[b].tally = tally;
}

/* Adds what the near pairs of others do to particle j, in slot order. */
static void collect_near(const struct gb_world *world, int64_t j, double *restrict force,
                         double *restrict torque)
{
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

static void collect_near_2d(const struct gb_world *world, int64_t j,
                            double *restrict force, double *restrict torque)
{
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

static void collect_block(struct gb_world *world, int64_t b)
{
    double force2 = 0.0, torque2 = 0.0;
    const int64_t end =
        (b + 1) * GB_SWEEP_BLOCK < world->count ? (b + 1) * GB_SWEEP_BLOCK : world->count;
    for (int64_t j = b * GB_SWEEP_BLOCK; j < end; j++) {
        double f[3], t[3];
        memcpy(f, world->force + 3 * j, sizeof f);
        memcpy(t, world->torque + 3 * j, sizeof t);
        (world->row == 6 ? collect_near : collect_near_2d)(world, j, f, t);
        collect_far(world, j, f);
        memcpy(world->force + 3 * j, f, sizeof f);
        memcpy(world->torque + 3 * j, t, sizeof t);
        force2 += gb_vec_dot(f, f);
        torque2 += gb_vec_dot(t, t);
    }
    world->block[b].force2 = force2;
    world->block[b].torque2 = torque2;
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

void gb_sweep_run(struct gb_world *world)
{
    gb_pairs_shifts(&world->cell, world->shift);
    const int64_t blocks = gb_sweep_blocks(world->count);
#pragma omp parallel num_threads(world->threads) if (world->threads > 1)
    {
#pragma omp for schedule(static)
        for (int64_t b = 0; b < blocks; b++) {
            sweep_block(world, b);
        }
#pragma omp for schedule(static)
        for (int64_t b = 0; b < blocks; b++) {
            collect_block(world, b);
        }
    }
    struct gb_sweep_block sum = {0};
    for (int64_t b = 0; b < blocks; b++) {
        sum.force2 += world->block[b].force2;
        sum.torque2 += world->block[b].torque2;
        add_tally(&sum.tally, &world->block[b].tally);
    }
    world->tally = sum.tally;
    world->force_rms = sqrt(sum.force2 / (double)world->count);
    world->torque_rms = sqrt(sum.torque2 / (double)world->count);
}
