/* A periodic packing: life, evaluation, motion, measures and copies of a world.
 *
 * An evaluation computes the forces at the present positions.  It first asks the list check
 * whether the neighbour lists still hold every pair.  If not, missing pairs are inserted
 * (pack/list/list_patch.h), or the lists are rebuilt and the contacts keep their histories.
 * docs/engine.md describes how the parts of the engine work together. */

#include "pack/cell/world.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/record.h"
#include "base/team.h"
#include "base/vec.h"
#include "pack/cell/record_checks.h"
#include "pack/cell/world_private.h"
#include "pack/cell/world_record.h"
#include "pack/f32/f32_state.h"
#include "pack/kernel/fabric_sums.h"
#include "pack/kernel/sweep.h"
#include "pack/kernel/virial.h"
#include "pack/list/blocks.h"
#include "pack/list/engine_lists.h"
#include "pack/list/list_patch.h"
#include "scene/thread_count.h"
#include "scene/tolerances.h"

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
    gb_pair_results_init(&engine->pair, model);
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
    gb_pair_results_finish(&engine->pair);
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
    gb_pair_results_reset_far(&engine->pair, engine->list.far.pair_count);
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
static enum gb_sweep_outcome try_sweep(struct gb_engine *engine,
                                       struct gb_sweep_along along)
{
    if (engine->state.lists != GB_ENGINE_NO_LISTS) {
        return gb_sweep_run(engine, along);
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
        (void)gb_sweep_run(engine, along); /* patched lists are valid */
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
    (void)gb_sweep_run(&world->engine, along); /* new lists are valid */
    return true;
}

static bool evaluate(struct gb_world *world, struct gb_sweep_along along,
                     struct gb_error *err)
{
    struct gb_engine *engine = &world->engine;
    const enum gb_sweep_outcome swept = try_sweep(engine, along);
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
    gb_virial_sum_fabric(world, pressure, fabric);
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
