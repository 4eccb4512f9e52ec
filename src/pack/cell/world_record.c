/* What a checkpoint keeps of a world, and what it does not need to: the lists follow from
 * the positions at their last build; the arms of contacts, what touches nothing and the
 * gaps of far pairs follow from the present positions by an evaluation without motion. */
#include "pack/cell/world_record.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "pack/cell/list_patch.h"
#include "pack/cell/world_private.h"
#include "pack/kernel/pair_forces.h"
#include "pack/kernel/sweep_f32.h"

#define AT(member) offsetof(struct gb_world, member)

/* Before the lists can be built. */
static const struct gb_record_member before[] = {
    {"world/built_edge", GB_RECORD_DOUBLE, 3, AT(pairs.built_edge), "d"},
};

static const struct gb_record_member members[] = {
    {"world/edge", GB_RECORD_DOUBLE, 3, AT(cell.edge), "d"},
    {"world/stretch", GB_RECORD_DOUBLE, 3, AT(pairs.stretch), "1"},
    {"world/strain", GB_RECORD_DOUBLE, 1, AT(pairs.strain), "1"},
};

/* After the evaluation, which changes them. */
static const struct gb_record_member after[] = {
    {"world/evaluations", GB_RECORD_INT64, 1, AT(evaluations), "1"},
    {"world/rebuilds", GB_RECORD_INT64, 1, AT(rebuilds), "1"},
    {"world/force_rms", GB_RECORD_DOUBLE, 1, AT(force_rms), "E d^2"},
    {"world/torque_rms", GB_RECORD_DOUBLE, 1, AT(torque_rms), "E d^3"},
    {"world/contacts", GB_RECORD_INT64, 1, AT(tally.contacts), "1"},
    {"world/sliding", GB_RECORD_INT64, 1, AT(tally.sliding), "1"},
    {"world/normal_sum", GB_RECORD_DOUBLE, 1, AT(tally.normal_sum), "E d^2"},
    {"world/deepest", GB_RECORD_DOUBLE, 1, AT(tally.deepest), "d"},
    {"world/absorbed", GB_RECORD_DOUBLE, 1, AT(tally.absorbed), "E d^3"},
    {"world/virial", GB_RECORD_DOUBLE, 3, AT(tally.virial), "E d^3"},
};

#define LENGTH(table) (sizeof(table) / sizeof((table)[0]))

static bool wrong(const char *name, struct gb_error *err)
{
    return gb_error_set(err, GB_ERR_INPUT, "%s: is out of range", name);
}

static bool vectors(struct gb_world *world, struct gb_record *record, const char *name,
                    const char *unit, double *data, struct gb_error *err)
{
    return gb_record_array(record, name, GB_RECORD_DOUBLE, world->count, 3, unit, data,
                           err);
}

/* Touching pairs and their histories under two names. */
static bool exchange_ledger(struct gb_contact_history *ledger, int planes, bool single,
                            struct gb_record *record, const char *pairs,
                            const char *values, struct gb_error *err)
{
    int64_t rows = ledger->count;
    if (record->loading &&
        (!gb_record_rows(record, pairs, GB_RECORD_INT32, 2, &rows, err) ||
         !gb_contact_history_reserve(ledger, rows, planes, single, err))) {
        return false;
    }
    ledger->count = rows;
    return gb_record_array(record, pairs, GB_RECORD_INT32, rows, 2, "1", ledger->pair,
                           err) &&
           (single
                ? gb_record_f32(record, values, rows, planes, "d", ledger->value, err)
                : gb_record_array(record, values, GB_RECORD_DOUBLE, rows, planes, "d",
                                  ledger->value, err));
}

/* Sorted pairs of particles that there are. */
static bool check_ledger(const struct gb_contact_history *ledger, int64_t count,
                         const char *name, struct gb_error *err)
{
    for (int64_t k = 0; k < ledger->count; k++) {
        const int32_t i = ledger->pair[k][0], j = ledger->pair[k][1];
        const bool follows = k == 0 || ledger->pair[k - 1][0] < i ||
                             (ledger->pair[k - 1][0] == i && ledger->pair[k - 1][1] < j);
        if (i < 0 || j <= i || j >= count || !follows) {
            return wrong(name, err);
        }
    }
    return true;
}

static bool check_edges(const struct gb_cell *cell, const char *name,
                        struct gb_error *err)
{
    for (int k = 0; k < 3; k++) {
        if (!(cell->edge[k] > 0.0 && cell->edge[k] < 1e9)) {
            return wrong(name, err);
        }
    }
    return true;
}

static bool check_inside(const struct gb_cell *cell, const double *position,
                         int64_t count, double margin, const char *name,
                         struct gb_error *err)
{
    for (int64_t i = 0; i < 3 * count; i++) {
        const double x = position[i] / cell->edge[i % 3];
        const double more = cell->periodic[i % 3] ? margin : 1e6;
        if (!(x >= -more && x <= 1.0 + more)) {
            return wrong(name, err);
        }
    }
    return true;
}

/* Pairs that the lists were amended by. */
static const char amended[] = "world/amended";

static bool load_amended(struct gb_world *world, struct gb_record *record,
                         struct gb_error *err)
{
    int64_t rows = 0;
    return gb_record_rows(record, amended, GB_RECORD_INT32, 4, &rows, err) &&
           gb_list_patch_again(world, gb_record_find(record, amended)->data, rows, err);
}

/* The lists as they were, with no history. */
static bool load_lists(struct gb_world *world, struct gb_record *record,
                       struct gb_error *err)
{
    const struct gb_numerics *numerics = &world->model->numerics;
    struct gb_cell built = world->cell;
    if (!gb_record_members(record, before, LENGTH(before), world, err) ||
        !vectors(world, record, "world/built_at", "d", world->position, err)) {
        return false;
    }
    memcpy(built.edge, world->pairs.built_edge, sizeof built.edge);
    if (!check_edges(&built, "world/built_edge", err) ||
        !check_inside(&built, world->position, world->count, 0.0, "world/built_at",
                      err) ||
        !gb_neighbour_list_build(&world->pairs, &built, world->position, numerics->cutoff,
                                 numerics->skin, world->threads, err) ||
        !gb_world_reserve(world, err)) {
        gb_neighbour_list_clear(&world->pairs);
        return false;
    }
    const struct gb_contact_history none = {0};
    gb_neighbour_list_shifts(&built, world->shift);
    gb_contact_history_read(&none, world);
    world->listed = true;
    return load_amended(world, record, err);
}

/* Every pair of the ledger must touch, and no other. */
static bool fits(const struct gb_contact_history *ledger, const struct gb_world *world)
{
    const struct gb_pair_list *near = &world->pairs.near;
    int64_t line = 0;
    for (int64_t i = 0; i < world->count; i++) {
        for (int64_t k = near->start[i]; k < near->start[i + 1]; k++) {
            if (!gb_contacts_touch(&world->contacts, k)) {
                continue;
            }
            if (line == ledger->count || ledger->pair[line][0] != i ||
                ledger->pair[line][1] != near->other[k]) {
                return false;
            }
            line++;
        }
    }
    return line == ledger->count;
}

/* The history of what touches; everything else stays as the evaluation left it. */
static void put_history(const struct gb_contact_history *ledger, struct gb_world *world)
{
    int64_t line = 0;
    world->state++;
    for (int64_t k = 0; k < gb_neighbour_list_slots(&world->pairs, &world->pairs.near);
         k++) {
        if (!gb_contacts_touch(&world->contacts, k)) {
            continue;
        }
        gb_contact_history_give(ledger, line++, &world->contacts, k);
    }
}

static bool load_contacts(struct gb_world *world, struct gb_record *record,
                          struct gb_error *err)
{
    struct gb_contact_history *ledger = &world->spare;
    if (!exchange_ledger(ledger, world->contacts.kept, world->in_single, record,
                         "world/pair", "world/history", err) ||
        !check_ledger(ledger, world->count, "world/pair", err)) {
        return false;
    }
    if (!fits(ledger, world)) {
        return gb_error_set(err, GB_ERR_INPUT, "world/pair: does not fit the positions");
    }
    put_history(ledger, world);
    return true;
}

static bool load(struct gb_world *world, struct gb_record *record, struct gb_error *err)
{
    world->single.driven = false;
    world->single.ahead = GB_F32_STATE_POSITIONS;
    if (!load_lists(world, record, err) ||
        !gb_record_members(record, members, LENGTH(members), world, err) ||
        !check_edges(&world->cell, "world/edge", err) ||
        !vectors(world, record, "world/position", "d", world->position, err) ||
        !check_inside(&world->cell, world->position, world->count, 1.0, "world/position",
                      err)) {
        return false;
    }
    const int64_t rebuilds = world->rebuilds;
    memset(world->turn, 0, 3 * (size_t)world->count * sizeof *world->turn);
    if (!gb_world_evaluate(world, err)) {
        return false;
    }
    if (world->rebuilds != rebuilds) { /* an evaluation has been there already */
        return gb_error_set(err, GB_ERR_INPUT,
                            "world/built_at: does not fit the positions");
    }
    if (!load_contacts(world, record, err) ||
        !vectors(world, record, "world/force", "E d^2", world->force, err) ||
        !vectors(world, record, "world/torque", "E d^3", world->torque, err)) {
        return false;
    }
    gb_sweep_f32_narrow(world);
    return gb_record_members(record, after, LENGTH(after), world, err);
}

/* Whole force on the first particle of every touching pair: for pictures, no load needs
 * it. */
static bool save_forces(const struct gb_world *world, struct gb_record *record,
                        struct gb_error *err)
{
    struct gb_record_item *item =
        gb_record_add(record, "world/pair_force", GB_RECORD_DOUBLE, world->spare.count, 3,
                      "E d^2", err);
    double *force = item ? item->data : NULL;
    struct gb_pair_forces forces;
    gb_pair_forces_init(&forces, world, true);
    for (int64_t k = 0;
         item && k < gb_neighbour_list_slots(&world->pairs, &world->pairs.near); k++) {
        if (gb_contacts_touch(&world->contacts, k)) {
            gb_pair_forces_at(&forces, k, force);
            force += 3;
        }
    }
    return item != NULL;
}

static bool save(struct gb_world *world, struct gb_record *record, struct gb_error *err)
{
    struct gb_contact_history *ledger = &world->spare;
    gb_sweep_f32_settle(world);
    gb_sweep_f32_widen(world);
    return gb_contact_history_write(ledger, world, false, err) &&
           gb_record_members(record, before, LENGTH(before), world, err) &&
           vectors(world, record, "world/built_at", "d", world->pairs.built_at, err) &&
           gb_record_array(record, amended, GB_RECORD_INT32, world->pairs.amended_count,
                           4, "1", world->pairs.amended, err) &&
           gb_record_members(record, members, LENGTH(members), world, err) &&
           vectors(world, record, "world/position", "d", world->position, err) &&
           exchange_ledger(ledger, world->contacts.kept, world->in_single, record,
                           "world/pair", "world/history", err) &&
           save_forces(world, record, err) &&
           vectors(world, record, "world/force", "E d^2", world->force, err) &&
           vectors(world, record, "world/torque", "E d^3", world->torque, err) &&
           gb_record_members(record, after, LENGTH(after), world, err);
}

bool gb_world_record(struct gb_world *world, struct gb_record *record,
                     struct gb_error *err)
{
    return record->loading ? load(world, record, err) : save(world, record, err);
}

bool gb_world_record_copy(const struct gb_world *world, struct gb_world_copy **copy,
                          struct gb_record *record, struct gb_error *err)
{
    if (!gb_world_copy_ensure(world, copy, err)) {
        return false;
    }
    struct gb_world_copy *at = *copy;
    if (record->loading) {
        at->cell = world->cell;
        at->count = world->count;
    }
    return gb_record_array(record, "branch/edge", GB_RECORD_DOUBLE, 1, 3, "d",
                           at->cell.edge, err) &&
           check_edges(&at->cell, "branch/edge", err) &&
           gb_record_array(record, "branch/position", GB_RECORD_DOUBLE, at->count, 3, "d",
                           at->position, err) &&
           check_inside(&at->cell, at->position, at->count, 1.0, "branch/position",
                        err) &&
           exchange_ledger(&at->ledger, world->contacts.kept, world->in_single, record,
                           "branch/pair", "branch/history", err) &&
           check_ledger(&at->ledger, at->count, "branch/pair", err);
}

#undef AT
#undef LENGTH
