#include "pack/cell/world.h"

#include <math.h>
#ifdef _OPENMP
#include <omp.h>
#endif
#include <string.h>

#include "base/alloc.h"
#include "pack/cell/list_patch.h"
#include "pack/cell/world_private.h"
#include "pack/kernel/simd.h"
#include "pack/kernel/sweep.h"
#include "pack/kernel/sweep_f32.h"
#include "pack/kernel/sweep_sized.h"
#include "pack/structure/assign_sizes.h"
#include "scene/loading_kind.h"
#include "scene/tolerances.h"

/* Particles per thread below which a second thread costs more than it brings. */
enum { PARTICLES_PER_THREAD = 2000 };
_Static_assert((int)PARTICLES_PER_THREAD * 17 / 16 >= (int)GB_SWEEP_BLOCK,
               "hardly a thread is left without a block");

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

static bool take_sizes(struct gb_world *world, struct gb_error *err)
{
    if (!world->model->polydisperse) {
        return true;
    }
    world->diameter = gb_alloc_array((size_t)world->count, sizeof *world->diameter, err);
    world->pairs.diameter = world->diameter;
    world->pairs.largest = world->model->diameter_max;
    return world->diameter && gb_assign_sizes_model(world->model, world->diameter, err);
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
    world->row = model->polydisperse ? GB_SIZED_ROW : model->dimension == 3 ? 6 : 3;
    world->in_single = model->numerics.single;
    gb_cell_init(&world->cell, model->dimension, model->edges);
    world->position = gb_alloc_array(3 * n, sizeof(double), err);
    world->turn = gb_alloc_array(3 * n, sizeof(double), err);
    world->force = gb_alloc_array(3 * n, sizeof(double), err);
    world->torque = gb_alloc_array(3 * n, sizeof(double), err);
    world->block =
        gb_alloc_array((size_t)gb_sweep_blocks(world->count), sizeof *world->block, err);
    world->degree = gb_alloc_array(n, sizeof *world->degree, err);
    if (!world->degree || !world->position || !world->turn || !world->force ||
        !world->torque || !world->block ||
        !gb_neighbour_list_init(&world->pairs, world->count, world->in_single, err) ||
        (world->in_single && !gb_f32_state_init(&world->single, model, err)) ||
        !take_sizes(world, err)) {
        gb_world_destroy(world);
        return false;
    }
    memcpy(world->position, position, 3 * n * sizeof *position);
    *out = world;
    return true;
}

void gb_world_destroy(struct gb_world *world)
{
    if (!world) {
        return;
    }
    gb_alloc_free(world->diameter);
    gb_alloc_free(world->position);
    gb_alloc_free(world->turn);
    gb_alloc_free(world->force);
    gb_alloc_free(world->torque);
    gb_alloc_free(world->block);
    gb_alloc_free(world->degree);
    gb_contacts_finish(&world->contacts);
    gb_alloc_free(world->wrench);
    gb_alloc_free(world->pull);
    gb_f32_state_finish(&world->single);
    gb_alloc_free(world->far_distance);
    gb_alloc_free(world->far_pull);
    gb_contact_history_finish(&world->ledger);
    gb_contact_history_finish(&world->spare);
    gb_neighbour_list_finish(&world->pairs);
    gb_alloc_free(world);
}

/* Where the forces of near and far pairs go. */
static bool reserve_wrench(struct gb_world *world, int64_t room, struct gb_error *err)
{
    if (world->in_single) {
        return true;
    }
    gb_alloc_free(world->wrench);
    world->wrench =
        gb_alloc_array((size_t)room * (size_t)world->row, sizeof *world->wrench, err);
    return world->wrench != NULL;
}

static bool reserve_pull(struct gb_world *world, int64_t room, struct gb_error *err)
{
    if (world->in_single) {
        return true;
    }
    gb_alloc_free(world->pull);
    world->pull = gb_alloc_array(3 * (size_t)room, sizeof *world->pull, err);
    return world->pull != NULL;
}

bool gb_world_reserve(struct gb_world *world, struct gb_error *err)
{
    const int64_t near = world->pairs.near.capacity, far = world->pairs.far.capacity;
    const bool viscous = gb_loading_kind_at(world->model->kind)->viscous_contacts;
    if (near > world->contacts.room) {
        gb_contacts_finish(&world->contacts);
        if (!reserve_wrench(world, near, err) ||
            !gb_contacts_init(&world->contacts, world->model->dimension, viscous,
                              world->in_single, near, err)) {
            return false;
        }
    }
    if (far > world->far_room) {
        gb_alloc_free(world->far_distance);
        gb_alloc_free(world->far_pull);
        world->far_room = 0;
        world->far_distance = world->far_pull = NULL;
        if (!reserve_pull(world, far, err)) {
            return false;
        }
        if (viscous) {
            world->far_distance = gb_alloc_array((size_t)far, sizeof(double), err);
            world->far_pull = gb_alloc_array((size_t)far, sizeof(double), err);
        }
        if (viscous && (!world->far_distance || !world->far_pull)) {
            return false;
        }
        world->far_room = far;
    }
    return !world->in_single ||
           gb_f32_state_take_lists(&world->single, &world->pairs, err);
}

static bool rebuild(struct gb_world *world, const struct gb_contact_history *ledger,
                    struct gb_error *err)
{
    const int threads = world->threads;
    gb_sweep_f32_settle(world);
#pragma omp parallel for num_threads(threads) schedule(static) if (threads > 1)
    for (int64_t i = 0; i < world->count; i++) {
        gb_cell_wrap(&world->cell, world->position + 3 * i);
    }
    world->listed = false;
    const struct gb_numerics *numerics = &world->model->numerics;
    if (!gb_neighbour_list_build(&world->pairs, &world->cell, world->position,
                                 numerics->cutoff, numerics->skin, threads, err) ||
        !gb_world_reserve(world, err)) {
        gb_neighbour_list_clear(&world->pairs);
        return false;
    }
    gb_neighbour_list_shifts(&world->cell, world->shift);
    gb_contact_history_read(ledger, world);
    for (int64_t b = 0; b < gb_sweep_blocks(world->count); b++) {
        world->block[b].travel = 0.0; /* the ways of a drive under way end here */
    }
    if (world->far_distance) {
        memset(world->far_distance, 0,
               (size_t)world->pairs.far.pair_count * sizeof *world->far_distance);
    }
    world->listed = true;
    world->rebuilds++;
    return true;
}

static int64_t first_bad_particle(struct gb_world *world)
{
    gb_sweep_f32_widen(world);
    for (int64_t i = 0; i < world->count; i++) {
        for (int k = 0; k < 3; k++) {
            if (!isfinite(world->force[3 * i + k]) ||
                !isfinite(world->torque[3 * i + k])) {
                return i;
            }
        }
    }
    return -1;
}

static bool check_sweep(struct gb_world *world, struct gb_error *err)
{
    if (!isfinite(world->force_rms) || !isfinite(world->torque_rms)) {
        return gb_error_set(err, GB_ERR_GUARD,
                            "force on particle %lld is not a finite number",
                            (long long)first_bad_particle(world));
    }
    if (world->tally.deepest > GB_OVERLAP_MAX) {
        return gb_error_set(
            err, GB_ERR_GUARD,
            "two particles overlap by %.3g d: the strain step is too large "
            "or the pressure beyond the contact laws",
            world->tally.deepest);
    }
    return true;
}

static bool sweep(struct gb_world *world, double *travel)
{
    return (world->diameter ? gb_sweep_sized_run : gb_sweep_run)(world, travel);
}

static bool evaluate(struct gb_world *world, struct gb_error *err)
{
    double travel = 0.0;
    world->state++;
    if (!world->listed) {
        gb_sweep_f32_settle(world);
        travel =
            gb_neighbour_list_travel(&world->pairs, world->position, 0, world->count);
    }
    bool swept = world->listed && sweep(world, &travel);
    if (!swept && !isfinite(travel)) {
        return gb_error_set(err, GB_ERR_GUARD,
                            "a particle's place is not a finite number");
    }
    bool amended = !swept && world->listed;
    if (amended && !gb_list_patch_lists(world, travel, &amended, err)) {
        world->listed = false;
        return false;
    }
    world->amended = amended;
    swept = swept || (amended && sweep(world, &travel));
    world->amended = false;
    if (!swept) {
        if (!gb_contact_history_write(&world->ledger, world, true, err) ||
            !rebuild(world, &world->ledger, err)) {
            return false;
        }
        (void)sweep(world, &travel); /* nothing has come any way */
    }
    world->evaluations++;
    return check_sweep(world, err);
}

bool gb_world_evaluate(struct gb_world *world, struct gb_error *err)
{
    const bool done = evaluate(world, err);
    gb_sweep_f32_settle(world);
    gb_sweep_f32_widen(world);
    return done;
}

bool gb_world_evaluate_along(struct gb_world *world, const double *velocity,
                             const double *spin, struct gb_error *err)
{
    world->velocity = velocity;
    world->spin = spin;
    const bool done = evaluate(world, err);
    world->velocity = world->spin = NULL;
    return done;
}

const struct gb_force_sums *gb_world_sums(const struct gb_world *world)
{
    return &world->sums;
}

void gb_world_set_step(struct gb_world *world, double time_step)
{
    world->damp = world->model->dynamics.viscous / time_step;
}

GB_SIMD_LOOP void scale_loop(double *restrict position, const double factor[3],
                             int64_t count)
{
    const double x = factor[0], y = factor[1], z = factor[2];
#pragma omp simd
    for (int64_t i = 0; i < count; i++) {
        position[3 * i] *= x;
        position[3 * i + 1] *= y;
        position[3 * i + 2] *= z;
    }
}
GB_SIMD_WIDTHS(scale, (double *position, const double factor[3], int64_t count),
               (position, factor, count))

/* For somebody who may move the particles. */
static void hand_out(struct gb_world *world)
{
    gb_sweep_f32_settle(world);
    world->single.ahead = GB_F32_STATE_POSITIONS;
}

void gb_world_strain(struct gb_world *world, const double factor[3])
{
    hand_out(world);
    for (int k = 0; k < 3; k++) {
        world->cell.edge[k] *= factor[k];
    }
    scale(world->position, factor, world->count);
    world->single.driven = false;
    gb_neighbour_list_strain(&world->pairs, factor);
}

void gb_world_synchronise(struct gb_world *world)
{
    gb_sweep_f32_settle(world);
}

struct gb_bodies gb_world_bodies(struct gb_world *world)
{
    hand_out(world);
    gb_sweep_f32_widen(world);
    return (struct gb_bodies){world->count, world->position, world->turn, world->force,
                              world->torque};
}

struct gb_bodies gb_world_movable(struct gb_world *world)
{
    hand_out(world);
    return (struct gb_bodies){
        .count = world->count, .position = world->position, .rotation = world->turn};
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

int gb_world_threads(const struct gb_world *world)
{
    return world->threads;
}

const double *gb_world_position(const struct gb_world *world)
{
    return world->position;
}

double gb_world_diameter(const struct gb_world *world, int64_t i)
{
    return world->diameter ? world->diameter[i] : 1.0;
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

const struct gb_neighbour_list *gb_world_pairs(const struct gb_world *world)
{
    return &world->pairs;
}

const struct gb_contacts *gb_world_contacts(const struct gb_world *world)
{
    return &world->contacts;
}

const int32_t *gb_world_coordination(const struct gb_world *world)
{
    const struct gb_pair_list *near = &world->pairs.near;
    memset(world->degree, 0, (size_t)world->count * sizeof *world->degree);
    for (int64_t k = 0; k < gb_neighbour_list_slots(&world->pairs, near); k++) {
        const int touches = gb_contacts_touch(&world->contacts, k);
        world->degree[near->first[k]] += touches;
        world->degree[near->other[k]] += touches;
    }
    return world->degree;
}

void gb_world_branch_vector(const struct gb_world *world, const struct gb_pair_list *list,
                            int64_t i, int64_t k, double r[3])
{
    gb_world_arm_of(world, list, i, k, r);
}

int64_t gb_world_evaluations(const struct gb_world *world)
{
    return world->evaluations;
}

int64_t gb_world_rebuilds(const struct gb_world *world)
{
    return world->rebuilds;
}

bool gb_world_copy_ensure(const struct gb_world *world, struct gb_world_copy **copy,
                          struct gb_error *err)
{
    if (*copy) {
        return true;
    }
    struct gb_world_copy *fresh = gb_alloc_array(1, sizeof *fresh, err);
    if (!fresh) {
        return false;
    }
    fresh->position =
        gb_alloc_array(3 * (size_t)world->count, sizeof *fresh->position, err);
    if (!fresh->position) {
        gb_alloc_free(fresh);
        return false;
    }
    *copy = fresh;
    return true;
}

bool gb_world_copy_save(const struct gb_world *world, struct gb_world_copy **copy,
                        struct gb_error *err)
{
    const size_t n = 3 * (size_t)world->count;
    if (!gb_world_copy_ensure(world, copy, err)) {
        return false;
    }
    (*copy)->cell = world->cell;
    (*copy)->count = world->count;
    memcpy((*copy)->position, world->position, n * sizeof *world->position);
    /* a checkpoint of this state has the same lines */
    return world->state > 0 && world->spare.state == world->state
               ? gb_contact_history_copy(&(*copy)->ledger, &world->spare, err)
               : gb_contact_history_write(&(*copy)->ledger, world, false, err);
}

bool gb_world_copy_restore(struct gb_world *world, const struct gb_world_copy *copy,
                           struct gb_error *err)
{
    const size_t n = 3 * (size_t)world->count;
    world->cell = copy->cell;
    memcpy(world->position, copy->position, n * sizeof *world->position);
    memset(world->turn, 0, n * sizeof *world->turn);
    world->single.driven = false;
    world->single.ahead = GB_F32_STATE_POSITIONS;
    return rebuild(world, &copy->ledger, err);
}

void gb_world_copy_destroy(struct gb_world_copy *copy)
{
    if (copy) {
        gb_alloc_free(copy->position);
        gb_contact_history_finish(&copy->ledger);
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
    const struct gb_contacts *contacts = &world->contacts;
    const int64_t slots =
        world->listed ? gb_neighbour_list_slots(&world->pairs, &world->pairs.near) : 0;
    uint64_t hash = 14695981039346656037u;
    hash = hash_bytes(hash, world->cell.edge, sizeof world->cell.edge);
    hash = hash_bytes(hash, world->position,
                      3 * (size_t)world->count * sizeof *world->position);
    for (int64_t k = 0; k < slots; k++) {
        for (int p = 0; p < contacts->planes && gb_contacts_touch(contacts, k); p++) {
            const double value = gb_contacts_value(contacts, p, k);
            hash = hash_bytes(hash, &value, sizeof value);
        }
    }
    return hash;
}
