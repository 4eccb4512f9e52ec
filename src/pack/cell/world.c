#include "pack/cell/world.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/team/team.h"
#include "base/vec.h"
#include "pack/cell/world_private.h"
#include "pack/f32/f32_state.h"
#include "pack/list/blocks.h"
#include "scene/thread_count.h"

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
    const struct gb_engine *engine = &world->engine;
    const struct gb_particles *particles = &engine->particles;
    const struct gb_contacts *contacts = &engine->contacts;
    const int64_t slots = engine->state.lists != GB_ENGINE_NO_LISTS
                              ? gb_neighbour_list_slots(&engine->list, &engine->list.near)
                              : 0;
    uint64_t hash = 14695981039346656037u;
    hash = hash_bytes(hash, particles->cell.edge, sizeof particles->cell.edge);
    if (gb_cell_tilted(&particles->cell)) {
        hash = hash_bytes(hash, particles->cell.tilt, sizeof particles->cell.tilt);
    }
    hash = hash_bytes(hash, particles->position,
                      3 * (size_t)particles->count * sizeof *particles->position);
    for (int64_t k = 0; k < slots; k++) {
        for (int p = 0; p < contacts->planes && gb_contacts_touch(contacts, k); p++) {
            const double value = gb_contacts_value(contacts, p, k);
            hash = hash_bytes(hash, &value, sizeof value);
        }
    }
    return hash;
}
