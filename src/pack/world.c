#include "pack/world.h"

#include <math.h>
#ifdef _OPENMP
#include <omp.h>
#endif
#include <string.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "phys/tolerances.h"

/* Particles whose tallies are summed as one: a fixed block, so that the order of the sums, and
 * with it every bit, does not depend on the number of threads. */
enum { BLOCK = 128 };

/* Touching pairs in list order with their histories: whole for rebuilds, without the arms for
 * copies. */
struct ledger {
    int64_t count, capacity;
    int planes;     /* values a line holds: all planes of the contacts, or those kept */
    int32_t (*pair)[2];
    double *value;  /* capacity x planes */
};

/* Sums over one block of particles. */
struct block {
    struct gb_tally tally;
    double force2, torque2;
};

struct gb_world {
    const struct gb_model *model;
    struct gb_cell cell;
    int64_t count;
    double *position, *turn, *force, *torque; /* count x 3 */
    struct gb_pairs pairs;
    double shift[27][3];          /* of the periodic images, as of the last evaluation */
    struct gb_batch_kernel kernel;
    struct gb_contacts contacts;  /* one per near pair */
    double *wrench;               /* rows per near pair: force on i, torque on j */
    double damp;                  /* viscous time over time step */
    int row;                      /* doubles in a row: 6, in 2D 3 (x, z, about y) */
    int64_t far_room;
    double *pull;                 /* three per far pair: force on the first particle */
    double (*far_last)[2];        /* dynamic scenes: distance and pull at the last evaluation */
    struct ledger ledger;
    struct block *block;
    int threads;
    struct gb_tally tally;
    double force_rms, torque_rms;
    bool listed;                  /* the pair list exists */
    int64_t evaluations, rebuilds;
};

struct gb_world_copy {
    struct gb_cell cell;
    int64_t count;
    double *position;
    struct ledger ledger;
};

/* Particles per thread below which a second thread costs more than it brings. */
enum { PARTICLES_PER_THREAD = 2000 };

static int thread_count(const struct gb_model *model)
{
#ifdef _OPENMP
    const int64_t useful = model->count / PARTICLES_PER_THREAD;
    const int cores = omp_get_num_procs();
    const int automatic = (int)(useful < 1 ? 1 : useful < cores ? useful : cores);
    return model->numerics.threads > 0 ? model->numerics.threads : automatic;
#else
    (void)model;
    return 1;
#endif
}

static int64_t block_count(const struct gb_world *world)
{
    return (world->count + BLOCK - 1) / BLOCK;
}

bool gb_world_create(struct gb_world **out, const struct gb_model *model,
                     const double *position, struct gb_error *err)
{
    struct gb_world *world = gb_alloc_array(1, sizeof *world, err);
    if (!world) {
        return false;
    }
    const size_t n = (size_t)model->count;
    world->model = model;
    world->count = model->count;
    world->threads = thread_count(model);
    world->kernel = gb_batch_pick(model, 0);
    world->row = model->dimension == 3 ? 6 : 3;
    gb_cell_init(&world->cell, model->dimension, model->edges);
    world->position = gb_alloc_array(3 * n, sizeof(double), err);
    world->turn = gb_alloc_array(3 * n, sizeof(double), err);
    world->force = gb_alloc_array(3 * n, sizeof(double), err);
    world->torque = gb_alloc_array(3 * n, sizeof(double), err);
    world->block = gb_alloc_array((size_t)block_count(world), sizeof *world->block, err);
    if (!world->position || !world->turn || !world->force || !world->torque ||
        !world->block || !gb_pairs_init(&world->pairs, world->count, err)) {
        gb_world_destroy(world);
        return false;
    }
    memcpy(world->position, position, 3 * n * sizeof *position);
    *out = world;
    return true;
}

static void ledger_finish(struct ledger *ledger)
{
    gb_alloc_free(ledger->pair);
    gb_alloc_free(ledger->value);
    *ledger = (struct ledger){0};
}

void gb_world_destroy(struct gb_world *world)
{
    if (!world) {
        return;
    }
    gb_alloc_free(world->position);
    gb_alloc_free(world->turn);
    gb_alloc_free(world->force);
    gb_alloc_free(world->torque);
    gb_alloc_free(world->block);
    gb_contacts_finish(&world->contacts);
    gb_alloc_free(world->wrench);
    gb_alloc_free(world->pull);
    gb_alloc_free(world->far_last);
    ledger_finish(&world->ledger);
    gb_pairs_finish(&world->pairs);
    gb_alloc_free(world);
}

static bool ledger_reserve(struct ledger *ledger, int64_t need, int planes,
                           struct gb_error *err)
{
    if (need <= ledger->capacity && planes == ledger->planes) {
        return true;
    }
    ledger_finish(ledger);
    const size_t room = (size_t)(need + need / 16 + 16);
    ledger->pair = gb_alloc_array(room, sizeof *ledger->pair, err);
    ledger->value = gb_alloc_array(room * (size_t)planes, sizeof *ledger->value, err);
    if (!ledger->pair || !ledger->value) {
        ledger_finish(ledger);
        return false;
    }
    ledger->planes = planes;
    ledger->capacity = (int64_t)room;
    return true;
}

static int64_t count_touching(const struct gb_world *world)
{
    int64_t touching = 0;
    for (int64_t k = 0; world->listed && k < world->pairs.near.pair_count; k++) {
        touching += world->contacts.deepest[k] >= 0.0;
    }
    return touching;
}

/* Writes down every touching pair, in the order of the list. */
static bool ledger_write(struct ledger *ledger, const struct gb_world *world, bool whole,
                         struct gb_error *err)
{
    const struct gb_pair_list *near = &world->pairs.near;
    const struct gb_contacts *contacts = &world->contacts;
    const int planes = world->listed ? whole ? contacts->planes : contacts->kept : 1;
    if (!ledger_reserve(ledger, count_touching(world), planes, err)) {
        return false;
    }
    int64_t line = 0;
    for (int64_t i = 0; world->listed && i < world->count; i++) {
        for (int64_t k = near->start[i]; k < near->start[i + 1]; k++) {
            if (contacts->deepest[k] < 0.0) {
                continue;
            }
            ledger->pair[line][0] = (int32_t)i;
            ledger->pair[line][1] = near->other[k];
            for (int p = 0; p < planes; p++) {
                ledger->value[line * planes + p] = contacts->plane[p][k];
            }
            line++;
        }
    }
    ledger->count = line;
    return true;
}

static double arm_of(const struct gb_world *world, const struct gb_pair_list *list, int64_t i,
                     int64_t k, double r[3])
{
    const double *xi = world->position + 3 * i;
    const double *xj = world->position + 3 * (int64_t)list->other[k];
    const double *shift = world->shift[list->image[k]];
    for (int c = 0; c < 3; c++) {
        r[c] = xi[c] - xj[c] + shift[c];
    }
    return gb_vec_dot(r, r);
}

/* Puts line `line` of the ledger into near pair k of particle i. */
static void ledger_put(const struct ledger *ledger, int64_t line, struct gb_world *world,
                       int64_t i, int64_t k)
{
    struct gb_contacts *contacts = &world->contacts;
    for (int p = 0; p < ledger->planes; p++) {
        contacts->plane[p][k] = ledger->value[line * ledger->planes + p];
    }
    if (ledger->planes < contacts->planes) {
        double arm[3];
        arm_of(world, &world->pairs.near, i, k, arm);
        contacts->arm[0][k] = arm[0];
        contacts->arm[1][k] = arm[contacts->arm[2] ? 1 : 2];
        if (contacts->arm[2]) {
            contacts->arm[2][k] = arm[2];
        }
    }
}

/* Gives every pair of the new list its old history: both are sorted alike. */
static void ledger_read(const struct ledger *ledger, struct gb_world *world)
{
    const struct gb_pair_list *near = &world->pairs.near;
    int64_t line = 0;
    for (int64_t i = 0; i < world->count; i++) {
        for (int64_t k = near->start[i]; k < near->start[i + 1]; k++) {
            const int32_t j = near->other[k];
            while (line < ledger->count &&
                   (ledger->pair[line][0] < i ||
                    (ledger->pair[line][0] == i && ledger->pair[line][1] < j))) {
                line++; /* a pair that has left the reach: its history is over */
            }
            if (line < ledger->count && ledger->pair[line][0] == i &&
                ledger->pair[line][1] == j) {
                ledger_put(ledger, line++, world, i, k);
            } else {
                gb_contacts_clear(&world->contacts, k);
            }
        }
    }
}

static bool reserve_slots(struct gb_world *world, struct gb_error *err)
{
    const int64_t near = world->pairs.near.capacity, far = world->pairs.far.capacity;
    if (near > world->contacts.room) {
        gb_contacts_finish(&world->contacts);
        gb_alloc_free(world->wrench);
        world->wrench = gb_alloc_array((size_t)near * (size_t)world->row,
                                       sizeof *world->wrench, err);
        if (!world->wrench ||
            !gb_contacts_init(&world->contacts, world->model->dimension,
                              world->model->kind == GB_KIND_DYNAMIC, near, err)) {
            return false;
        }
    }
    if (far > world->far_room) {
        const bool moving = world->model->kind == GB_KIND_DYNAMIC;
        gb_alloc_free(world->pull);
        gb_alloc_free(world->far_last);
        world->far_room = 0;
        world->far_last = NULL;
        world->pull = gb_alloc_array(3 * (size_t)far, sizeof *world->pull, err);
        if (moving) {
            world->far_last = gb_alloc_array((size_t)far, sizeof *world->far_last, err);
        }
        if (!world->pull || (moving && !world->far_last)) {
            return false;
        }
        world->far_room = far;
    }
    return true;
}

static bool rebuild(struct gb_world *world, const struct ledger *ledger,
                    struct gb_error *err)
{
    for (int64_t i = 0; i < world->count; i++) {
        gb_cell_wrap(&world->cell, world->position + 3 * i);
    }
    world->listed = false;
    const struct gb_numerics *numerics = &world->model->numerics;
    if (!gb_pairs_build(&world->pairs, &world->cell, world->position, numerics->cutoff,
                        numerics->skin, err) ||
        !reserve_slots(world, err)) {
        return false;
    }
    gb_pairs_shifts(&world->cell, world->shift);
    ledger_read(ledger, world);
    if (world->far_last) {
        memset(world->far_last, 0,
               (size_t)world->pairs.far.pair_count * sizeof *world->far_last);
    }
    world->listed = true;
    world->rebuilds++;
    return true;
}

static bool ensure_list(struct gb_world *world, struct gb_error *err)
{
    const struct gb_numerics *numerics = &world->model->numerics;
    const double travel = gb_pairs_travel(&world->pairs, world->position);
    if (!isfinite(travel)) {
        return gb_error_set(err, GB_ERR_GUARD, "a particle's place is not a finite number");
    }
    if (world->listed &&
        gb_pairs_fresh(&world->pairs, travel, numerics->cutoff, numerics->skin)) {
        return true;
    }
    return ledger_write(&world->ledger, world, true, err) &&
           rebuild(world, &world->ledger, err);
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

static void sweep_far(struct gb_world *world, int64_t i, int64_t k, double cutoff2,
                      double force[3], struct gb_tally *tally)
{
    double r[3];
    double *pull = world->pull + 3 * k;
    const double squared = arm_of(world, &world->pairs.far, i, k, r);
    pull[0] = pull[1] = pull[2] = 0.0;
    if (squared < cutoff2) {
        gap_force(world->model, r, squared, pull);
        gb_vec_add(force, 1.0, pull);
        for (int c = 0; c < 3; c++) {
            tally->virial[c] += pull[c] * r[c];
        }
    }
    if (world->far_last) {
        double *last = world->far_last[k];
        const double now[2] = {sqrt(squared), gb_vec_length(pull)};
        tally->absorbed += last[0] > 0.0 ? 0.5 * (last[1] + now[1]) * (now[0] - last[0]) : 0.0;
        memcpy(last, now, sizeof now);
    }
}

/* Loads a batch: arms and turns of pairs [slot, slot + n); *i is the first particle. */
static void fill_batch(const struct gb_world *world, struct gb_batch *batch, int64_t slot,
                       int64_t i)
{
    const struct gb_pair_list *near = &world->pairs.near;
    for (int k = 0; k < batch->n; k++) {
        while (slot + k >= near->start[i + 1]) {
            i++;
        }
        const int64_t j = near->other[slot + k];
        const double *ti = world->turn + 3 * i, *tj = world->turn + 3 * j;
        double r[3];
        arm_of(world, near, i, slot + k, r);
        for (int c = 0; c < 3; c++) {
            batch->r[c][k] = r[c];
            batch->turn_sum[c][k] = ti[c] + tj[c];
            batch->turn_difference[c][k] = ti[c] - tj[c];
        }
    }
}

static void fill_batch_2d(const struct gb_world *world, struct gb_batch *batch,
                          int64_t slot, int64_t i)
{
    const struct gb_pair_list *near = &world->pairs.near;
    for (int k = 0; k < batch->n; k++) {
        while (slot + k >= near->start[i + 1]) {
            i++;
        }
        const int64_t j = near->other[slot + k];
        const double *xi = world->position + 3 * i, *xj = world->position + 3 * j;
        const double *shift = world->shift[near->image[slot + k]];
        const double ti = world->turn[3 * i + 1], tj = world->turn[3 * j + 1];
        batch->r[0][k] = xi[0] - xj[0] + shift[0];
        batch->r[1][k] = xi[2] - xj[2] + shift[2];
        batch->turn_sum[0][k] = ti + tj;
        batch->turn_difference[0][k] = ti - tj;
    }
}

/* Unloads a batch: adds to the first particles, leaves rows for the second ones. */
static void spill_batch(struct gb_world *world, const struct gb_batch *batch, int64_t slot,
                        int64_t i)
{
    const int64_t *start = world->pairs.near.start;
    for (int k = 0; k < batch->n; k++) {
        while (slot + k >= start[i + 1]) {
            i++;
        }
        double *row = world->wrench + 6 * (slot + k);
        for (int c = 0; c < 3; c++) {
            row[c] = batch->force[c][k];
            row[3 + c] = batch->torque_j[c][k];
            world->force[3 * i + c] += batch->force[c][k];
            world->torque[3 * i + c] += batch->torque_i[c][k];
        }
    }
}

static void spill_batch_2d(struct gb_world *world, const struct gb_batch *batch,
                           int64_t slot, int64_t i)
{
    const int64_t *start = world->pairs.near.start;
    for (int k = 0; k < batch->n; k++) {
        while (slot + k >= start[i + 1]) {
            i++;
        }
        double *row = world->wrench + 3 * (slot + k);
        row[0] = batch->force[0][k];
        row[1] = batch->force[1][k];
        row[2] = batch->torque_j[0][k];
        world->force[3 * i] += row[0];
        world->force[3 * i + 2] += row[1];
        world->torque[3 * i + 1] += batch->torque_i[0][k];
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
    const double cutoff = world->model->terms.attraction ? world->model->numerics.cutoff : 0.0;
    const struct gb_pair_list *far = &world->pairs.far;
    const int64_t begin = b * BLOCK;
    const int64_t end = begin + BLOCK < world->count ? begin + BLOCK : world->count;
    struct gb_tally tally = {0};
    const size_t bytes = 3 * (size_t)(end - begin) * sizeof(double);
    memset(world->force + 3 * begin, 0, bytes);
    memset(world->torque + 3 * begin, 0, bytes);
    sweep_near(world, begin, end, cutoff * cutoff, &tally);
    for (int64_t i = begin; i < end; i++) {
        for (int64_t k = far->start[i]; k < far->start[i + 1]; k++) {
            sweep_far(world, i, k, cutoff * cutoff, world->force + 3 * i, &tally);
        }
    }
    world->block[b].tally = tally;
}

/* Adds what the pairs of others do to particle j, in slot order. */
static void collect_particle(struct gb_world *world, int64_t j)
{
    const struct gb_pair_list *near = &world->pairs.near, *far = &world->pairs.far;
    double *force = world->force + 3 * j, *torque = world->torque + 3 * j;
    for (int64_t in = near->in_start[j]; in < near->in_start[j + 1]; in++) {
        const double *row = world->wrench + (int64_t)world->row * near->in_slot[in];
        if (world->row == 6) {
            gb_vec_add(force, -1.0, row);
            gb_vec_add(torque, 1.0, row + 3);
        } else {
            force[0] -= row[0];
            force[2] -= row[1];
            torque[1] += row[2];
        }
    }
    for (int64_t in = far->in_start[j]; in < far->in_start[j + 1]; in++) {
        gb_vec_add(force, -1.0, world->pull + 3 * (int64_t)far->in_slot[in]);
    }
}

static void collect_block(struct gb_world *world, int64_t b)
{
    double force2 = 0.0, torque2 = 0.0;
    const int64_t end = (b + 1) * BLOCK < world->count ? (b + 1) * BLOCK : world->count;
    for (int64_t j = b * BLOCK; j < end; j++) {
        collect_particle(world, j);
        force2 += gb_vec_dot(world->force + 3 * j, world->force + 3 * j);
        torque2 += gb_vec_dot(world->torque + 3 * j, world->torque + 3 * j);
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

static int64_t first_bad_particle(const struct gb_world *world)
{
    for (int64_t i = 0; i < world->count; i++) {
        for (int k = 0; k < 3; k++) {
            if (!isfinite(world->force[3 * i + k]) || !isfinite(world->torque[3 * i + k])) {
                return i;
            }
        }
    }
    return -1;
}

static bool check_sweep(const struct gb_world *world, struct gb_error *err)
{
    if (!isfinite(world->force_rms) || !isfinite(world->torque_rms)) {
        return gb_error_set(err, GB_ERR_GUARD,
                            "force on particle %lld is not a finite number",
                            (long long)first_bad_particle(world));
    }
    if (world->tally.deepest > GB_OVERLAP_MOST) {
        return gb_error_set(err, GB_ERR_GUARD,
                            "two particles overlap by %.3g d: the strain step is too large "
                            "or the pressure beyond the contact laws",
                            world->tally.deepest);
    }
    return true;
}

bool gb_world_evaluate(struct gb_world *world, struct gb_error *err)
{
    if (!ensure_list(world, err)) {
        return false;
    }
    gb_pairs_shifts(&world->cell, world->shift);
    const int64_t blocks = block_count(world);
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
    struct block sum = {0};
    for (int64_t b = 0; b < blocks; b++) {
        sum.force2 += world->block[b].force2;
        sum.torque2 += world->block[b].torque2;
        add_tally(&sum.tally, &world->block[b].tally);
    }
    world->tally = sum.tally;
    memset(world->turn, 0, 3 * (size_t)world->count * sizeof *world->turn);
    world->force_rms = sqrt(sum.force2 / (double)world->count);
    world->torque_rms = sqrt(sum.torque2 / (double)world->count);
    world->evaluations++;
    return check_sweep(world, err);
}

void gb_world_set_step(struct gb_world *world, double time_step)
{
    world->damp = world->model->dynamics.viscous / time_step;
}

void gb_world_strain(struct gb_world *world, const double factor[3])
{
    for (int k = 0; k < 3; k++) {
        world->cell.edge[k] *= factor[k];
    }
    for (int64_t i = 0; i < world->count; i++) {
        for (int k = 0; k < 3; k++) {
            world->position[3 * i + k] *= factor[k];
        }
    }
    gb_pairs_strain(&world->pairs, factor);
}

struct gb_bodies gb_world_bodies(struct gb_world *world)
{
    return (struct gb_bodies){world->count, world->position, world->turn, world->force,
                              world->torque};
}

const struct gb_cell *gb_world_cell(const struct gb_world *world)
{
    return &world->cell;
}

const struct gb_model *gb_world_model(const struct gb_world *world)
{
    return world->model;
}

const struct gb_tally *gb_world_tally(const struct gb_world *world)
{
    return &world->tally;
}

const double *gb_world_position(const struct gb_world *world)
{
    return world->position;
}

double gb_world_residual(const struct gb_world *world)
{
    const double mean = world->tally.contacts > 0
                            ? world->tally.normal_sum / (double)world->tally.contacts
                            : 0.0;
    const double scale = fmax(mean, world->model->force_floor);
    const double rms = fmax(world->force_rms, world->torque_rms);
    return rms / scale;
}

const struct gb_pairs *gb_world_pairs(const struct gb_world *world)
{
    return &world->pairs;
}

const struct gb_contacts *gb_world_contacts(const struct gb_world *world)
{
    return &world->contacts;
}

void gb_world_force(const struct gb_world *world, int64_t k, double force[3])
{
    const double *row = world->wrench + (int64_t)world->row * k;
    force[0] = row[0];
    force[1] = world->row == 6 ? row[1] : 0.0;
    force[2] = world->row == 6 ? row[2] : row[1];
}

const double *gb_world_pulls(const struct gb_world *world)
{
    return world->pull;
}

void gb_world_arm(const struct gb_world *world, const struct gb_pair_list *list, int64_t i,
                  int64_t k, double r[3])
{
    arm_of(world, list, i, k, r);
}

int64_t gb_world_evaluations(const struct gb_world *world)
{
    return world->evaluations;
}

int64_t gb_world_rebuilds(const struct gb_world *world)
{
    return world->rebuilds;
}

bool gb_world_save(const struct gb_world *world, struct gb_world_copy **copy,
                   struct gb_error *err)
{
    const size_t n = 3 * (size_t)world->count;
    if (!*copy) {
        struct gb_world_copy *fresh = gb_alloc_array(1, sizeof *fresh, err);
        if (!fresh) {
            return false;
        }
        fresh->position = gb_alloc_array(n, sizeof *fresh->position, err);
        if (!fresh->position) {
            gb_alloc_free(fresh);
            return false;
        }
        *copy = fresh;
    }
    (*copy)->cell = world->cell;
    (*copy)->count = world->count;
    memcpy((*copy)->position, world->position, n * sizeof *world->position);
    return ledger_write(&(*copy)->ledger, world, false, err);
}

bool gb_world_restore(struct gb_world *world, const struct gb_world_copy *copy,
                      struct gb_error *err)
{
    const size_t n = 3 * (size_t)world->count;
    world->cell = copy->cell;
    memcpy(world->position, copy->position, n * sizeof *world->position);
    memset(world->turn, 0, n * sizeof *world->turn);
    return rebuild(world, &copy->ledger, err);
}

void gb_world_copy_destroy(struct gb_world_copy *copy)
{
    if (copy) {
        gb_alloc_free(copy->position);
        ledger_finish(&copy->ledger);
        gb_alloc_free(copy);
    }
}

static uint64_t hash_bytes(uint64_t hash, const void *data, size_t size)
{
    const unsigned char *byte = data;
    for (size_t i = 0; i < size; i++) {
        hash = (hash ^ byte[i]) * 1099511628211u; /* FNV-1a */
    }
    return hash;
}

uint64_t gb_world_hash(const struct gb_world *world)
{
    uint64_t hash = 14695981039346656037u;
    hash = hash_bytes(hash, world->cell.edge, sizeof world->cell.edge);
    hash = hash_bytes(hash, world->position,
                      3 * (size_t)world->count * sizeof *world->position);
    for (int64_t k = 0; world->listed && k < world->pairs.near.pair_count; k++) {
        for (int p = 0; p < world->contacts.planes && world->contacts.deepest[k] >= 0.0; p++) {
            hash = hash_bytes(hash, &world->contacts.plane[p][k], sizeof(double));
        }
    }
    return hash;
}
