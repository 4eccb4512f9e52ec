/* What a checkpoint holds, and what is computed again from it.  Lists are rebuilt from the
 * positions at their last build.  An evaluation without motion gives the rest: branch vectors,
 * records of pairs that are not in contact, gaps of far pairs. */
#include "pack/cell/world_record.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "pack/cell/record_checks.h"
#include "pack/cell/world_private.h"
#include "pack/f32/f32_state.h"
#include "pack/kernel/pair_forces.h"
#include "pack/list/engine_lists.h"
#include "pack/list/list_patch.h"

#define AT(member)     offsetof(struct gb_world, member)
#define ENGINE(member) offsetof(struct gb_world, engine.member)

/* Needed for the build of the lists. */
static const struct gb_record_member build_members[] = {
    {"world/built_edge", GB_RECORD_DOUBLE, 3, ENGINE(list.built.edge), "d"},
};

/* Needed for the evaluation. */
static const struct gb_record_member cell_members[] = {
    {"world/edge", GB_RECORD_DOUBLE, 3, ENGINE(particles.cell.edge), "d"},
    {"world/stretch", GB_RECORD_DOUBLE, 3, ENGINE(list.unit.edge), "1"},
    {"world/strain", GB_RECORD_DOUBLE, 1, ENGINE(list.strain), "1"},
};

/* The same in scenes that shear. */
static const struct gb_record_member sheared_build_members[] = {
    {"world/built_tilt", GB_RECORD_DOUBLE, 3, ENGINE(list.built.tilt), "d"},
};
static const struct gb_record_member sheared_cell_members[] = {
    {"world/tilt", GB_RECORD_DOUBLE, 3, ENGINE(particles.cell.tilt), "d"},
    {"world/shear", GB_RECORD_DOUBLE, 3, ENGINE(particles.cell.shear), "1"},
    {"world/stretch_tilt", GB_RECORD_DOUBLE, 3, ENGINE(list.unit.tilt), "1"},
};

/* After the evaluation, which changes them. */
static const struct gb_record_member result_members[] = {
    {"world/evaluations", GB_RECORD_INT64, 1, AT(evaluations), "1"},
    {"world/rebuilds", GB_RECORD_INT64, 1, AT(rebuilds), "1"},
    {"world/force_rms", GB_RECORD_DOUBLE, 1, ENGINE(force_rms), "E d^2"},
    {"world/torque_rms", GB_RECORD_DOUBLE, 1, ENGINE(torque_rms), "E d^3"},
    {"world/contacts", GB_RECORD_INT64, 1, ENGINE(total.tally.contacts), "1"},
    {"world/sliding", GB_RECORD_INT64, 1, ENGINE(total.tally.sliding), "1"},
    {"world/normal_sum", GB_RECORD_DOUBLE, 1, ENGINE(total.tally.normal_sum), "E d^2"},
    {"world/deepest", GB_RECORD_DOUBLE, 1, ENGINE(total.tally.deepest), "d"},
    {"world/absorbed", GB_RECORD_DOUBLE, 1, ENGINE(total.tally.absorbed), "E d^3"},
    {"world/virial", GB_RECORD_DOUBLE, 3, ENGINE(total.tally.virial), "E d^3"},
};

#define LENGTH(table) (sizeof(table) / sizeof((table)[0]))

/* A scene that shears has its tilts in the record.  One that shears only from here on
 * (loading.changes) begins without: they are 0. */
static bool has_tilts(const struct gb_world *world, const struct gb_record *record,
                      const char *name)
{
    return world->engine.model->sheared &&
           (!record->loading || gb_record_find(record, name) != NULL);
}

/* Edges, and tilts in scenes that shear, of the lists' build. */
static bool record_build(struct gb_world *world, struct gb_record *record,
                         struct gb_error *err)
{
    return gb_record_members(record, build_members, LENGTH(build_members), world, err) &&
           (!has_tilts(world, record, "world/built_tilt") ||
            gb_record_members(record, sheared_build_members,
                              LENGTH(sheared_build_members), world, err));
}

static bool record_cell(struct gb_world *world, struct gb_record *record,
                        struct gb_error *err)
{
    return gb_record_members(record, cell_members, LENGTH(cell_members), world, err) &&
           (!has_tilts(world, record, "world/tilt") ||
            gb_record_members(record, sheared_cell_members, LENGTH(sheared_cell_members),
                              world, err));
}

/* A vector of every particle. */
static bool record_vectors(struct gb_world *world, struct gb_record *record,
                           const char *name, const char *unit, double *data,
                           struct gb_error *err)
{
    return gb_record_array(record, name, GB_RECORD_DOUBLE, world->engine.particles.count,
                           3, unit, data, err);
}

/* Pairs inserted into the lists since their build. */
static const char inserted_name[] = "world/amended";

/* The lists as they were, without histories.  *as_saved: false where that cannot be: lists of a
 * run in single precision with inserted pairs, for a copy in double precision, which inserts
 * none.  The first evaluation builds them from the positions then. */
static bool load_lists(struct gb_world *world, struct gb_record *record, bool *as_saved,
                       struct gb_error *err)
{
    struct gb_engine *engine = &world->engine;
    struct gb_particles *particles = &engine->particles;
    int64_t inserted = 0;
    if (!gb_record_rows(record, inserted_name, GB_RECORD_INT32, 4, &inserted, err)) {
        return false;
    }
    *as_saved = inserted == 0 || gb_engine_is_f32(engine);
    engine->list.built = particles->cell;
    if (!record_build(world, record, err) ||
        !record_vectors(world, record, "world/built_at", "d", particles->position, err)) {
        return false;
    }
    const struct gb_cell built = engine->list.built;
    const bool fine =
        gb_record_checks_edges(&built, "world/built_edge", err) &&
        gb_record_checks_inside(&built, particles->position, particles->count, 0.0,
                                "world/built_at", err);
    if (!fine || !*as_saved || !gb_engine_lists_build(engine, &built, err)) {
        gb_neighbour_list_clear(&engine->list);
        gb_engine_state_drop_lists(&engine->state);
        return fine && !*as_saved;
    }
    const struct gb_contact_history none = {0};
    gb_contact_history_read(&none, engine);
    return gb_list_patch_load(engine, gb_record_find(record, inserted_name)->data,
                              inserted, err);
}

/* True if the history and the lists have the same pairs in contact. */
static bool fits(const struct gb_contact_history *history, const struct gb_engine *engine)
{
    const struct gb_pair_list *near = &engine->list.near;
    int64_t index = 0;
    for (int64_t i = 0; i < engine->particles.count; i++) {
        for (int64_t k = near->start[i]; k < near->start[i + 1]; k++) {
            if (!gb_contacts_touch(&engine->contacts, k)) {
                continue;
            }
            if (index == history->count || history->pair[index][0] != i ||
                history->pair[index][1] != near->other[k]) {
                return false;
            }
            index++;
        }
    }
    return index == history->count;
}

/* The history of every contact; everything else stays as the evaluation left it. */
static void apply_history(const struct gb_contact_history *history,
                          struct gb_engine *engine)
{
    const int64_t slots = gb_neighbour_list_slots(&engine->list, &engine->list.near);
    int64_t index = 0;
    for (int64_t k = 0; k < slots; k++) {
        if (gb_contacts_touch(&engine->contacts, k)) {
            gb_contact_history_apply(history, index++, &engine->contacts, k);
        }
    }
}

/* history: scratch. */
static bool load_history(struct gb_engine *engine, struct gb_contact_history *history,
                         struct gb_record *record, struct gb_error *err)
{
    if (!gb_contact_history_record(history, engine, record, err) ||
        !gb_record_checks_history(history, engine->particles.count,
                                  GB_CONTACT_HISTORY_PAIR, err)) {
        return false;
    }
    if (!fits(history, engine)) {
        return gb_error_set(err, GB_ERR_INPUT, "world/pair: does not fit the positions");
    }
    apply_history(history, engine);
    return true;
}

static bool load_contacts(struct gb_world *world, struct gb_record *record,
                          struct gb_error *err)
{
    struct gb_contact_history history = {0};
    const bool done = load_history(&world->engine, &history, record, err);
    gb_contact_history_finish(&history);
    return done;
}

/* Contacts of a record that has their pairs. */
static int64_t count_contacts(const struct gb_record *record)
{
    return gb_record_find(record, GB_CONTACT_HISTORY_PAIR)->rows;
}

/* Force on the first particle of every contact.  In single precision for pictures only;
 * in double precision also the near rows of the loaded world, whose evaluation was one
 * without histories. */
static const char forces_name[] = "world/pair_force";

static bool load_forces(struct gb_world *world, const struct gb_record *record,
                        struct gb_error *err)
{
    struct gb_engine *engine = &world->engine;
    const int64_t slots = gb_neighbour_list_slots(&engine->list, &engine->list.near);
    int64_t rows = 0;
    if (gb_engine_is_f32(engine)) {
        return true;
    }
    if (!gb_record_rows(record, forces_name, GB_RECORD_DOUBLE, 3, &rows, err)) {
        return false;
    }
    if (rows != count_contacts(record)) {
        return gb_error_set(err, GB_ERR_INPUT, "%s: does not fit the contacts",
                            forces_name);
    }
    const struct gb_record_item *item = gb_record_find(record, forces_name);
    int64_t row = 0;
    for (int64_t k = 0; k < slots; k++) {
        if (gb_contacts_touch(&engine->contacts, k)) {
            double force[3];
            gb_record_numbers(item, 3 * row++, 3, force);
            gb_engine_pair_set_force(&engine->pair, k, force);
        }
    }
    return true;
}

/* Cell and positions; then an evaluation without motion, from the lists as they were. */
static bool load_positions(struct gb_world *world, struct gb_record *record,
                           bool has_lists, struct gb_error *err)
{
    struct gb_particles *particles = &world->engine.particles;
    const size_t bytes = 3 * (size_t)particles->count * sizeof *particles->rotation;
    const int64_t rebuilds = world->rebuilds;
    if (!record_cell(world, record, err) ||
        !gb_record_checks_edges(&particles->cell, "world/edge", err) ||
        !record_vectors(world, record, "world/position", "d", particles->position, err) ||
        !gb_record_checks_inside(&particles->cell, particles->position, particles->count,
                                 1.0, "world/position", err)) {
        return false;
    }
    memset(particles->rotation, 0, bytes);
    if (!gb_world_evaluate(world, err)) {
        return false;
    }
    return !has_lists ||
           world->rebuilds == rebuilds || /* the saved state had been evaluated */
           gb_error_set(err, GB_ERR_INPUT, "world/built_at: does not fit the positions");
}

static bool load(struct gb_world *world, struct gb_record *record, struct gb_error *err)
{
    struct gb_engine *engine = &world->engine;
    struct gb_particles *particles = &engine->particles;
    bool has_lists = false;
    gb_engine_state_replace(&engine->state);
    if (!load_lists(world, record, &has_lists, err) ||
        !load_positions(world, record, has_lists, err) ||
        !load_contacts(world, record, err) || !load_forces(world, record, err) ||
        !record_vectors(world, record, "world/force", "E d^2", particles->force, err) ||
        !record_vectors(world, record, "world/torque", "E d^3", particles->torque, err)) {
        return false;
    }
    gb_f32_state_forces_from_f64(engine);
    return gb_record_members(record, result_members, LENGTH(result_members), world, err);
}

/* An item of vectors that are floats in an engine in single precision. */
static struct gb_record_item *add_vectors(const struct gb_engine *engine,
                                          struct gb_record *record, const char *name,
                                          int64_t rows, const char *unit,
                                          struct gb_error *err)
{
    return gb_engine_is_f32(engine)
               ? gb_record_add_f32(record, name, rows, 3, unit, err)
               : gb_record_add(record, name, GB_RECORD_DOUBLE, rows, 3, unit, err);
}

static void put_vector(struct gb_record_item *item, int64_t row, const double vector[3])
{
    for (int c = 0; c < 3; c++) {
        if (item->f32) {
            ((float *)item->data)[3 * row + c] = (float)vector[c];
        } else {
            ((double *)item->data)[3 * row + c] = vector[c];
        }
    }
}

static bool save_forces(const struct gb_world *world, struct gb_record *record,
                        struct gb_error *err)
{
    const struct gb_engine *engine = &world->engine;
    const int64_t slots = gb_neighbour_list_slots(&engine->list, &engine->list.near);
    struct gb_record_item *item =
        add_vectors(engine, record, forces_name, count_contacts(record), "E d^2", err);
    struct gb_pair_forces forces;
    int64_t row = 0;
    gb_pair_forces_init(&forces, world, GB_PAIR_FORCES_NEAR);
    for (int64_t k = 0; item && k < slots; k++) {
        if (gb_contacts_touch(&engine->contacts, k)) {
            double force[3];
            gb_pair_forces_at(&forces, k, force);
            put_vector(item, row++, force);
        }
    }
    return item != NULL;
}

/* Forces or torques on the particles. */
static bool save_vectors(const struct gb_world *world, struct gb_record *record,
                         const char *name, const char *unit, const double *vector,
                         struct gb_error *err)
{
    const int64_t count = world->engine.particles.count;
    struct gb_record_item *item =
        add_vectors(&world->engine, record, name, count, unit, err);
    for (int64_t i = 0; item && i < count; i++) {
        put_vector(item, i, vector + 3 * i);
    }
    return item != NULL;
}

static bool save(struct gb_world *world, struct gb_record *record, struct gb_error *err)
{
    struct gb_engine *engine = &world->engine;
    struct gb_particles *particles = &engine->particles;
    struct gb_neighbour_list *list = &engine->list;
    gb_f32_state_synchronise(engine);
    gb_f32_state_forces_to_f64(engine);
    return record_build(world, record, err) &&
           record_vectors(world, record, "world/built_at", "d", list->built_position,
                          err) &&
           gb_record_array(record, inserted_name, GB_RECORD_INT32, list->inserted_count,
                           4, "1", list->inserted, err) &&
           record_cell(world, record, err) &&
           record_vectors(world, record, "world/position", "d", particles->position,
                          err) &&
           gb_contact_history_save(engine, record, err) &&
           save_forces(world, record, err) &&
           save_vectors(world, record, "world/force", "E d^2", particles->force, err) &&
           save_vectors(world, record, "world/torque", "E d^3", particles->torque, err) &&
           gb_record_members(record, result_members, LENGTH(result_members), world, err);
}

bool gb_world_record(struct gb_world *world, struct gb_record *record,
                     struct gb_error *err)
{
    return record->loading ? load(world, record, err) : save(world, record, err);
}

#undef AT
#undef ENGINE
#undef LENGTH
