/* A periodic packing: life, evaluation, motion, measures and copies of a world.
 *
 * An evaluation computes the forces at the present positions.  It first asks the list check
 * whether the neighbour lists still hold every pair.  If not, missing pairs are inserted
 * (pack/list/list_patch.h), or the lists are rebuilt and the contacts keep their histories.
 * docs/engine.md describes how the parts of the engine work together. */

#include "pack/cell/world.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "base/alloc.h"
#include "base/record.h"
#include "base/team.h"
#include "base/vec.h"
#include "pack/cell/engine.h"
#include "pack/cell/record_checks.h"
#include "pack/cell/world_private.h"
#include "pack/cell/world_record.h"
#include "pack/f32/f32_state.h"
#include "pack/kernel/fabric_sums.h"
#include "pack/kernel/pair_forces.h"
#include "pack/kernel/share.h"
#include "pack/kernel/simd.h"
#include "pack/kernel/sweep_f32.h"
#include "pack/kernel/sweep_f64.h"
#include "pack/kernel/tally.h"
#include "pack/list/blocks.h"
#include "pack/list/engine_lists.h"
#include "pack/list/list_check.h"
#include "pack/list/list_patch.h"
#include "scene/thread_count.h"
#include "scene/tolerances.h"

/* ---- Pressure and fabric as sums over pairs ---- */

/* Partial sums over at most PARTS parts of the particles, added in their order: the same
 * bits for any number of threads.  Groups of parts have about GROUP_LEAST particles and more,
 * enough to fill some batches; in single precision a part is a group. */
enum { PARTS = 64, GROUP_LEAST = 256 };

static int groups_of(const struct gb_engine *engine)
{
    const int64_t groups = 1 + engine->particles.count / GROUP_LEAST;
    return groups < PARTS ? (int)groups : PARTS;
}

static int parts_of(const struct gb_engine *engine)
{
    return gb_engine_is_f32(engine) ? groups_of(engine) : PARTS;
}

static void add(double sum[3][3], const double force[3], const double r[3])
{
    for (int a = 0; a < 3; a++) {
        gb_vec_add(sum[a], force[a], r);
    }
}

/* Adds the pairs of a batch, lane by lane. */
GB_SIMD_LOOP void add_batch_loop(const struct gb_batch_f32 *batch,
                                 double lane[3][3][GB_LANES])
{
    for (int a = 0; a < 3; a++) {
        const float *restrict force = batch->force[a];
        for (int b = 0; b < 3; b++) {
            const float *restrict r = batch->r[b];
            double *restrict sum = lane[a][b];
            int k = 0;
            for (; k + GB_LANES <= batch->n; k += GB_LANES) {
                for (int l = 0; l < GB_LANES; l++) {
                    sum[l] += (double)force[k + l] * (double)r[k + l];
                }
            }
            for (; k < batch->n; k++) {
                sum[0] += (double)force[k] * (double)r[k];
            }
        }
    }
}
GB_SIMD_WIDTHS(add_batch, (const struct gb_batch_f32 *batch, double lane[3][3][GB_LANES]),
               (batch, lane))

/* Contacts of a batch in single precision that begins at a slot of the near list. */
static void add_fabric_f32(const struct gb_engine *engine,
                           const struct gb_batch_f32 *batch, int64_t slot,
                           struct gb_fabric_sums *fabric)
{
    const struct gb_contacts *contacts = &engine->contacts;
    const float *deepest = (const float *)contacts->plane[contacts->deepest] + slot;
    struct gb_fabric_sums_batch pairs;
    pairs.n = batch->n;
    for (int k = 0; k < batch->n; k++) {
        for (int c = 0; c < 3; c++) {
            pairs.r[c][k] = (double)batch->r[c][k];
            pairs.force[c][k] = (double)batch->force[c][k];
        }
        pairs.deepest[k] = (double)deepest[k];
    }
    gb_fabric_sums_add(fabric, &pairs);
}

/* Pairs [begin, end) of a list in single precision; fabric: of the near list, or NULL. */
static void sum_f32(const struct gb_engine *engine, const struct gb_pair_list *list,
                    int64_t begin, int64_t end, double sum[3][3],
                    struct gb_fabric_sums *fabric)
{
    double lane[3][3][GB_LANES] = {0};
    struct gb_batch_f32 batch;
    for (int64_t slot = begin; slot < end; slot += batch.n) {
        batch.n = end - slot < GB_BATCH ? (int)(end - slot) : GB_BATCH;
        gb_sweep_f32_recompute(engine, list, slot, &batch);
        add_batch(&batch, lane);
        if (fabric) {
            add_fabric_f32(engine, &batch, slot, fabric);
        }
    }
    for (int a = 0; a < 3; a++) {
        for (int b = 0; b < 3; b++) {
            for (int l = 0; l < GB_LANES; l++) {
                sum[a][b] += lane[a][b][l];
            }
        }
    }
}

/* Adds pair k to those of the fabric, if it touches; a full batch is added to the sums. */
static void add_fabric_f64(const struct gb_engine *engine, int64_t k,
                           const double force[3], const double r[3],
                           struct gb_fabric_sums_batch *pairs,
                           struct gb_fabric_sums *fabric)
{
    const double deepest = gb_contacts_deepest(&engine->contacts, k);
    if (deepest < 0.0) {
        return;
    }
    for (int c = 0; c < 3; c++) {
        pairs->r[c][pairs->n] = r[c];
        pairs->force[c][pairs->n] = force[c];
    }
    pairs->deepest[pairs->n++] = deepest;
    if (pairs->n == GB_BATCH) {
        gb_fabric_sums_add(fabric, pairs);
        pairs->n = 0;
    }
}

/* Pairs of particle i in double precision; fabric: of the near list, or NULL. */
static void sum_f64(struct gb_pair_forces *forces, int64_t i, double sum[3][3],
                    struct gb_fabric_sums_batch *pairs, struct gb_fabric_sums *fabric)
{
    const struct gb_pair_list *list = forces->list;
    const struct gb_engine *engine = &forces->world->engine;
    for (int64_t k = list->start[i]; k < list->start[i + 1]; k++) {
        double force[3], r[3];
        gb_engine_branch_vector(engine, list, i, k, r);
        gb_pair_forces_at(forces, k, force);
        add(sum, force, r);
        if (fabric) {
            add_fabric_f64(engine, k, force, r, pairs, fabric);
        }
    }
}

/* pairs: contacts in double precision that are not in the fabric yet. */
static void sum_part(const struct gb_world *world, int64_t begin, int64_t end,
                     double sum[3][3], struct gb_fabric_sums_batch *pairs,
                     struct gb_fabric_sums *fabric)
{
    const struct gb_engine *engine = &world->engine;
    const struct gb_pair_list *near = &engine->list.near, *far = &engine->list.far;
    struct gb_pair_forces near_forces, far_forces;
    if (gb_engine_is_f32(engine)) {
        sum_f32(engine, near, near->start[begin], near->start[end], sum, fabric);
        sum_f32(engine, far, far->start[begin], far->start[end], sum, NULL);
        return;
    }
    gb_pair_forces_init(&near_forces, world, GB_PAIR_FORCES_NEAR);
    gb_pair_forces_init(&far_forces, world, GB_PAIR_FORCES_FAR);
    for (int64_t i = begin; i < end; i++) {
        sum_f64(&near_forces, i, sum, pairs, fabric);
        sum_f64(&far_forces, i, sum, NULL, NULL);
    }
}

/* Parts begin .. end - 1; the fabric of all of them, or NULL. */
static void sum_group(const struct gb_world *world, int begin, int end,
                      double (*part)[3][3], struct gb_fabric_sums *fabric)
{
    const int64_t count = world->engine.particles.count;
    const int parts = parts_of(&world->engine);
    struct gb_fabric_sums_batch pairs;
    pairs.n = 0;
    for (int p = begin; p < end; p++) {
        sum_part(world, gb_share(count, p, parts), gb_share(count, p + 1, parts), part[p],
                 &pairs, fabric);
    }
    if (fabric && pairs.n > 0) {
        gb_fabric_sums_add(fabric, &pairs);
    }
}

void gb_world_virial(const struct gb_world *world, double sum[3][3])
{
    gb_world_virial_fabric(world, sum, NULL);
}

/* Adds the sums of a group. */
static void add_group(struct gb_fabric_sums *sums, const struct gb_fabric_sums *group)
{
    for (int kind = 0; kind < GB_FABRIC_KINDS; kind++) {
        sums->weight[kind] += group->weight[kind];
        for (int s = 0; s < 6; s++) {
            sums->tensor[kind][s] += group->tensor[kind][s];
        }
    }
}

struct summing {
    const struct gb_world *world;
    double (*part)[3][3];
    struct gb_fabric_sums *group; /* NULL: no fabric */
};

static void sum_item(void *data, int64_t g)
{
    const struct summing *summing = data;
    const struct gb_engine *engine = &summing->world->engine;
    const int parts = parts_of(engine), groups = groups_of(engine);
    struct gb_fabric_sums *fabric = summing->group ? &summing->group[g] : NULL;
    if (fabric) {
        *fabric = (struct gb_fabric_sums){.weight = {0}};
    }
    sum_group(summing->world, (int)gb_share(parts, (int)g, groups),
              (int)gb_share(parts, (int)g + 1, groups), summing->part, fabric);
}

static void sum_all(const struct gb_world *world, double sum[3][3],
                    struct gb_fabric_sums *fabric)
{
    double part[PARTS][3][3] = {0};
    struct gb_fabric_sums group[PARTS];
    const int parts = parts_of(&world->engine), groups = groups_of(&world->engine);
    struct summing summing = {world, part, fabric ? group : NULL};
    gb_team_run(world->engine.team, groups, sum_item, &summing);
    for (int g = 0; fabric && g < groups; g++) {
        add_group(fabric, &group[g]);
    }
    memset(sum, 0, sizeof part[0]);
    for (int p = 0; p < parts; p++) {
        for (int a = 0; a < 3; a++) {
            gb_vec_add(sum[a], 1.0, part[p][a]);
        }
    }
}

void gb_world_virial_fabric(const struct gb_world *world, double sum[3][3],
                            struct gb_fabric_sums *fabric)
{
    const struct gb_engine_state *state = &world->engine.state;
    struct gb_virial *last = world->virial;
    if (fabric || last->evaluation != state->evaluation ||
        !gb_engine_state_evaluated(state)) {
        sum_all(world, last->sum, fabric);
        last->evaluation = gb_engine_state_evaluated(state) ? state->evaluation : 0;
    }
    memcpy(sum, last->sum, sizeof last->sum);
}

enum sweep_outcome {
    GB_SWEEP_DONE,
    GB_SWEEP_LIST_INVALID, /* nothing was computed: a pair is missing from the lists */
    GB_SWEEP_NOT_FINITE,   /* nothing was computed: a coordinate is not finite */
};

/* ---- Sweeps over the blocks of particles ---- */

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

/* Forces and torques from lists that are still valid; contact histories advance,
 * rotation increments are set to 0.  Pairs are computed in blocks of particles, then
 * every particle adds the forces of pairs of other blocks, in the order of the list: the
 * same bits for any number of threads. */
static enum sweep_outcome sweep_run(struct gb_engine *engine, struct gb_sweep_along along)
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

/* ---- Life ---- */

_Static_assert((int)GB_PARTICLES_PER_THREAD * 17 / 16 >= (int)GB_BLOCKS_SIZE,
               "hardly a thread is left without a block");

static bool init_engine(struct gb_engine *engine, const struct gb_model *model,
                        const double *position, struct gb_error *err)
{
    const bool f32 = model->numerics.single;
    const size_t blocks = (size_t)gb_blocks_count(model->count);
    engine->model = model;
    engine->state.real = f32 ? GB_REAL_F32 : GB_REAL_F64;
    engine->kernel = gb_batch_pick(model, 0);
    gb_engine_pair_init(&engine->pair, model);
    engine->check = gb_alloc_array(blocks, sizeof *engine->check, err);
    engine->tally = gb_alloc_array(blocks, sizeof *engine->tally, err);
    engine->block_cost = gb_alloc_array(blocks + 1, sizeof *engine->block_cost, err);
    if (!engine->check || !engine->tally || !engine->block_cost ||
        !gb_team_create(&engine->team, gb_thread_count(model), err) ||
        !gb_particles_init(&engine->particles, model, position, err) ||
        !gb_neighbour_list_init(
            &engine->list, model->count,
            f32 ? GB_NEIGHBOUR_LIST_PATCHABLE : GB_NEIGHBOUR_LIST_TRANSPOSED, err) ||
        (f32 && !gb_f32_state_init(&engine->f32, model, err))) {
        return false;
    }
    if (engine->particles.diameter) {
        engine->list.diameter = engine->particles.diameter;
        engine->list.largest = model->diameter_max;
    }
    return true;
}

static void finish_engine(struct gb_engine *engine)
{
    gb_team_destroy(engine->team);
    gb_alloc_free(engine->check);
    gb_alloc_free(engine->tally);
    gb_alloc_free(engine->block_cost);
    gb_contacts_finish(&engine->contacts);
    gb_engine_pair_finish(&engine->pair);
    gb_f32_state_finish(&engine->f32);
    gb_neighbour_list_finish(&engine->list);
    gb_particles_finish(&engine->particles);
}

bool gb_world_create(struct gb_world **out, const struct gb_model *model,
                     const double *position, struct gb_error *err)
{
    struct gb_world *world = gb_alloc_array(1, sizeof *world, err);
    if (!world) {
        return false;
    }
    world->coordination =
        gb_alloc_array((size_t)model->count, sizeof *world->coordination, err);
    world->virial = gb_alloc_array(1, sizeof *world->virial, err);
    if (!world->coordination || !world->virial ||
        !init_engine(&world->engine, model, position, err)) {
        gb_world_destroy(world);
        return false;
    }
    *out = world;
    return true;
}

void gb_world_destroy(struct gb_world *world)
{
    if (!world) {
        return;
    }
    finish_engine(&world->engine);
    gb_engine_lists_carry_finish(&world->carry);
    gb_alloc_free(world->coordination);
    gb_alloc_free(world->virial);
    gb_alloc_free(world);
}

/* ---- Evaluation ---- */

bool gb_world_evaluate_rebuild(struct gb_world *world,
                               const struct gb_contact_history *history,
                               struct gb_error *err)
{
    struct gb_engine *engine = &world->engine;
    if (!history && !gb_engine_lists_carry_note(&world->carry, engine, err)) {
        return false;
    }
    gb_f32_state_synchronise(engine);
    (void)gb_cell_fold(&engine->particles.cell); /* new lists have new images */
    gb_particles_wrap(&engine->particles, engine->team);
    if (!gb_engine_lists_build(engine, &engine->particles.cell, err)) {
        return false;
    }
    if (history) {
        gb_contact_history_read(history, engine);
    } else {
        gb_engine_lists_carry_move(&world->carry, engine);
    }
    for (int64_t b = 0; b < gb_blocks_count(engine->particles.count); b++) {
        engine->check[b].displacement = 0.0; /* also of a velocity update before this */
    }
    gb_engine_pair_reset_far(&engine->pair, engine->list.far.pair_count);
    world->rebuilds++;
    return true;
}

static int64_t first_not_finite(struct gb_engine *engine)
{
    const struct gb_particles *particles = &engine->particles;
    gb_f32_state_forces_to_f64(engine);
    for (int64_t i = 0; i < particles->count; i++) {
        for (int k = 0; k < 3; k++) {
            if (!isfinite(particles->force[3 * i + k]) ||
                !isfinite(particles->torque[3 * i + k])) {
                return i;
            }
        }
    }
    return -1;
}

static bool check_result(struct gb_engine *engine, struct gb_error *err)
{
    const double overlap = engine->total.tally.deepest;
    if (!isfinite(engine->force_rms) || !isfinite(engine->torque_rms)) {
        return gb_error_set(err, GB_ERR_GUARD,
                            "force on particle %lld is not a finite number",
                            (long long)first_not_finite(engine));
    }
    if (overlap > GB_OVERLAP_MAX) {
        return gb_error_set(
            err, GB_ERR_GUARD,
            "two particles overlap by %.3g of the smaller one's diameter: the strain step "
            "is too large or the pressure beyond the contact laws",
            overlap);
    }
    return true;
}

/* A sweep with the lists as they are, if there are any. */
static enum sweep_outcome try_sweep(struct gb_engine *engine, struct gb_sweep_along along)
{
    if (engine->state.lists != GB_ENGINE_NO_LISTS) {
        return sweep_run(engine, along);
    }
    gb_f32_state_synchronise(engine);
    const double displacement = gb_neighbour_list_displacement(
        &engine->list, engine->particles.position, 0, engine->particles.count);
    return isfinite(displacement) ? GB_SWEEP_LIST_INVALID : GB_SWEEP_NOT_FINITE;
}

/* Inserts the missing pairs, and sweeps where that was possible. */
static enum gb_list_patch_outcome patch_and_sweep(struct gb_engine *engine,
                                                  struct gb_sweep_along along,
                                                  struct gb_error *err)
{
    if (engine->state.lists == GB_ENGINE_NO_LISTS) {
        return GB_LIST_PATCH_REBUILD;
    }
    const enum gb_list_patch_outcome outcome = gb_list_patch_insert(engine, err);
    if (outcome == GB_LIST_PATCH_FAILED) {
        gb_engine_state_drop_lists(&engine->state);
    }
    if (outcome == GB_LIST_PATCH_DONE) {
        gb_engine_state_patch_lists(&engine->state);
        (void)sweep_run(engine, along); /* patched lists are valid */
        gb_engine_state_use_lists(&engine->state);
    }
    return outcome;
}

static bool rebuild_and_sweep(struct gb_world *world, struct gb_sweep_along along,
                              struct gb_error *err)
{
    if (!gb_world_evaluate_rebuild(world, NULL, err)) {
        return false;
    }
    (void)sweep_run(&world->engine, along); /* new lists are valid */
    return true;
}

static bool evaluate(struct gb_world *world, struct gb_sweep_along along,
                     struct gb_error *err)
{
    struct gb_engine *engine = &world->engine;
    const enum sweep_outcome swept = try_sweep(engine, along);
    if (swept == GB_SWEEP_NOT_FINITE) {
        return gb_error_set(err, GB_ERR_GUARD,
                            "a coordinate of a particle is not a finite number");
    }
    if (swept == GB_SWEEP_LIST_INVALID) {
        const enum gb_list_patch_outcome patched = patch_and_sweep(engine, along, err);
        if (patched == GB_LIST_PATCH_FAILED ||
            (patched == GB_LIST_PATCH_REBUILD && !rebuild_and_sweep(world, along, err))) {
            return false;
        }
    }
    world->evaluations++;
    return check_result(engine, err);
}

bool gb_world_evaluate(struct gb_world *world, struct gb_error *err)
{
    const bool done = evaluate(world, (struct gb_sweep_along){NULL, NULL}, err);
    gb_f32_state_synchronise(&world->engine);
    gb_f32_state_forces_to_f64(&world->engine);
    return done;
}

bool gb_world_evaluate_along(struct gb_world *world, const double *velocity,
                             const double *spin, struct gb_error *err)
{
    return evaluate(world, (struct gb_sweep_along){velocity, spin}, err);
}

/* ---- Motion ---- */

const struct gb_force_sums *gb_world_sums(const struct gb_world *world)
{
    return &world->engine.total.sums;
}

void gb_world_set_step(struct gb_world *world, double time_step)
{
    world->engine.damp = world->engine.model->dynamics.viscous / time_step;
}

void gb_world_deform(struct gb_world *world, const struct gb_deformation *deformation)
{
    struct gb_engine *engine = &world->engine;
    gb_f32_state_synchronise(engine);
    gb_particles_deform(&engine->particles, deformation);
    gb_neighbour_list_deform(&engine->list, deformation);
    gb_engine_state_replace(&engine->state);
}

void gb_world_strain(struct gb_world *world, const double factor[3])
{
    const struct gb_deformation scaling = gb_deformation_scaling(factor);
    gb_world_deform(world, &scaling);
}

void gb_world_synchronise(struct gb_world *world)
{
    gb_f32_state_synchronise(&world->engine);
}

struct gb_bodies gb_world_movable(struct gb_world *world)
{
    const struct gb_particles *particles = &world->engine.particles;
    gb_f32_state_synchronise(&world->engine);
    gb_engine_state_lend(&world->engine.state);
    return (struct gb_bodies){.count = particles->count,
                              .position = particles->position,
                              .rotation = particles->rotation};
}

struct gb_bodies gb_world_readable(struct gb_world *world)
{
    const struct gb_particles *particles = &world->engine.particles;
    gb_f32_state_synchronise(&world->engine);
    gb_f32_state_forces_to_f64(&world->engine);
    return (struct gb_bodies){.count = particles->count,
                              .position = particles->position,
                              .rotation = particles->rotation,
                              .force = particles->force,
                              .torque = particles->torque};
}

struct gb_bodies gb_world_bodies(struct gb_world *world)
{
    (void)gb_world_movable(world);
    return gb_world_readable(world);
}

/* ---- What the world holds ---- */

const struct gb_cell *gb_world_cell(const struct gb_world *world)
{
    return &world->engine.particles.cell;
}

const struct gb_model *gb_world_model(const struct gb_world *world)
{
    return world->engine.model;
}

const struct gb_tally *gb_world_tally(const struct gb_world *world)
{
    return &world->engine.total.tally;
}

struct gb_team *gb_world_team(const struct gb_world *world)
{
    return world->engine.team;
}

const double *gb_world_position(const struct gb_world *world)
{
    return world->engine.particles.position;
}

const double *gb_world_diameters(const struct gb_world *world)
{
    return world->engine.particles.diameter;
}

double gb_world_diameter(const struct gb_world *world, int64_t i)
{
    const double *diameter = world->engine.particles.diameter;
    return diameter ? diameter[i] : 1.0;
}

double gb_world_imbalance(const struct gb_world *world)
{
    return fmax(world->engine.force_rms, world->engine.torque_rms);
}

double gb_world_residual(const struct gb_world *world)
{
    const struct gb_engine *engine = &world->engine;
    const struct gb_tally *tally = &engine->total.tally;
    const double mean =
        tally->contacts > 0 ? tally->normal_sum / (double)tally->contacts : 0.0;
    const double scale = fmax(mean, engine->model->force_floor);
    return gb_world_imbalance(world) / scale;
}

/* Force and torque on particle i, from where the last evaluation left them. */
static void wrench_of(const struct gb_engine *engine, int64_t i, double wrench[6])
{
    for (int c = 0; c < 3; c++) {
        if (engine->state.forces == GB_ENGINE_FORCES_F32) {
            wrench[c] = (double)engine->f32.rows.row[i][c];
            wrench[3 + c] = (double)engine->f32.rows.row[i][GB_WRENCH_ROWS_TORQUE + c];
        } else {
            wrench[c] = engine->particles.force[3 * i + c];
            wrench[3 + c] = engine->particles.torque[3 * i + c];
        }
    }
}

void gb_world_largest(const struct gb_world *world, double *force, double *torque)
{
    double force2 = 0.0, torque2 = 0.0;
    for (int64_t i = 0; i < world->engine.particles.count; i++) {
        double wrench[6];
        wrench_of(&world->engine, i, wrench);
        force2 = fmax(force2, gb_vec_dot(wrench, wrench));
        torque2 = fmax(torque2, gb_vec_dot(wrench + 3, wrench + 3));
    }
    *force = sqrt(force2);
    *torque = sqrt(torque2);
}

const struct gb_neighbour_list *gb_world_pairs(const struct gb_world *world)
{
    return &world->engine.list;
}

const struct gb_contacts *gb_world_contacts(const struct gb_world *world)
{
    return &world->engine.contacts;
}

const int32_t *gb_world_coordination(const struct gb_world *world)
{
    const struct gb_engine *engine = &world->engine;
    const struct gb_pair_list near = engine->list.near;
    const struct gb_contacts contacts =
        engine->contacts; /* no store below changes these */
    const int64_t slots = gb_neighbour_list_slots(&engine->list, &engine->list.near);
    int32_t *coordination = world->coordination;
    memset(coordination, 0, (size_t)engine->particles.count * sizeof *coordination);
    for (int64_t k = 0; k < slots; k++) {
        const int touches = gb_contacts_touch(&contacts, k);
        coordination[near.first[k]] += touches;
        coordination[near.other[k]] += touches;
    }
    return coordination;
}

void gb_world_branch_vector(const struct gb_world *world, const struct gb_pair_list *list,
                            int64_t i, int64_t k, double r[3])
{
    gb_engine_branch_vector(&world->engine, list, i, k, r);
}

int64_t gb_world_evaluations(const struct gb_world *world)
{
    return world->evaluations;
}

void gb_world_set_evaluations(struct gb_world *world, int64_t evaluations)
{
    world->evaluations = evaluations;
}

int64_t gb_world_rebuilds(const struct gb_world *world)
{
    return world->rebuilds;
}

uint64_t gb_world_hash(const struct gb_world *world)
{
    const struct gb_engine *engine = &world->engine;
    const struct gb_particles *particles = &engine->particles;
    const struct gb_contacts *contacts = &engine->contacts;
    const int64_t slots = engine->state.lists != GB_ENGINE_NO_LISTS
                              ? gb_neighbour_list_slots(&engine->list, &engine->list.near)
                              : 0;
    uint64_t hash = GB_RECORD_FNV;
    hash = gb_record_fnv(hash, particles->cell.edge, sizeof particles->cell.edge);
    if (gb_cell_tilted(&particles->cell)) {
        hash = gb_record_fnv(hash, particles->cell.tilt, sizeof particles->cell.tilt);
    }
    hash = gb_record_fnv(hash, particles->position,
                         3 * (size_t)particles->count * sizeof *particles->position);
    for (int64_t k = 0; k < slots; k++) {
        for (int p = 0; p < contacts->planes && gb_contacts_touch(contacts, k); p++) {
            const double value = gb_contacts_value(contacts, p, k);
            hash = gb_record_fnv(hash, &value, sizeof value);
        }
    }
    return hash;
}

/* ---- Measures ---- */

/* A cell that is filled to the last pore has density 1, whatever the product of its strains
 * is rounded to. */
static double without_rounding(double density)
{
    return density > 1.0 && density < 1.0 + GB_DENSITY_END_TOLERANCE ? 1.0 : density;
}

double gb_world_density(const struct gb_world *world)
{
    const struct gb_model *model = gb_world_model(world);
    const double shape = model->dimension == 3 ? M_PI / 6.0 : M_PI / 4.0;
    return without_rounding(shape * model->mean_power * (double)model->count /
                            gb_cell_volume(gb_world_cell(world)));
}

void gb_world_pressure(const struct gb_world *world, double pressure[3][3])
{
    gb_world_tensors(world, pressure, NULL);
}

void gb_world_tensors(const struct gb_world *world, double pressure[3][3],
                      struct gb_fabric_sums *fabric)
{
    const double volume = gb_cell_volume(gb_world_cell(world));
    gb_world_virial_fabric(world, pressure, fabric);
    for (int a = 0; a < 3; a++) {
        gb_vec_scale(pressure[a], 1.0 / volume);
    }
}

void gb_world_normal_pressures(const struct gb_world *world, double pressure[3])
{
    double tensor[3][3];
    gb_world_pressure(world, tensor);
    for (int k = 0; k < 3; k++) {
        pressure[k] = tensor[k][k];
    }
}

/* ---- Copies ---- */

/* A copy to be filled; made when *copy is NULL. */
static bool ensure_copy(const struct gb_world *world, struct gb_world_copy **copy,
                        struct gb_error *err)
{
    if (*copy) {
        return true;
    }
    struct gb_world_copy *made = gb_alloc_array(1, sizeof *made, err);
    if (!made) {
        return false;
    }
    made->position = gb_alloc_array(3 * (size_t)world->engine.particles.count,
                                    sizeof *made->position, err);
    if (!made->position) {
        gb_alloc_free(made);
        return false;
    }
    *copy = made;
    return true;
}

bool gb_world_copy_save(const struct gb_world *world, struct gb_world_copy **copy,
                        struct gb_error *err)
{
    const struct gb_engine *engine = &world->engine;
    const struct gb_particles *particles = &engine->particles;
    if (!ensure_copy(world, copy, err)) {
        return false;
    }
    (*copy)->cell = particles->cell;
    (*copy)->count = particles->count;
    memcpy((*copy)->position, particles->position,
           3 * (size_t)particles->count * sizeof *particles->position);
    return gb_contact_history_write(&(*copy)->history, engine, err);
}

bool gb_world_copy_restore(struct gb_world *world, const struct gb_world_copy *copy,
                           struct gb_error *err)
{
    gb_particles_replace(&world->engine.particles, &copy->cell, copy->position);
    gb_engine_state_replace(&world->engine.state);
    return gb_world_evaluate_rebuild(world, &copy->history, err);
}

void gb_world_copy_destroy(struct gb_world_copy *copy)
{
    if (copy) {
        gb_alloc_free(copy->position);
        gb_contact_history_finish(&copy->history);
        gb_alloc_free(copy);
    }
}
