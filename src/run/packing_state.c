#include "run/packing_state.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/vec.h"
#include "io/state/state_record.h"
#include "measure/observe.h"
#include "measure/observe_die.h"
#include "pack/kernel/pair_forces.h"
#include "run/point_measure.h"

static void copy_world_pairs(const struct gb_world *world, struct gb_state *state)
{
    const struct gb_pair_list *near = &gb_world_pairs(world)->near;
    const struct gb_contacts *contacts = gb_world_contacts(world);
    struct gb_pair_forces forces;
    int64_t line = 0;
    gb_pair_forces_init(&forces, world, GB_PAIR_FORCES_NEAR);
    for (int64_t i = 0; i < state->count; i++) {
        for (int64_t k = near->start[i]; k < near->start[i + 1]; k++) {
            const double deepest = gb_contacts_deepest(contacts, k);
            if (deepest < 0.0) {
                continue;
            }
            double r[3];
            gb_world_branch_vector(world, near, i, k, r);
            state->pair[2 * line] = (int32_t)i;
            state->pair[2 * line + 1] = near->other[k];
            double *force = state->pair_force + 3 * line;
            gb_pair_forces_at(&forces, k, force);
            state->pair_normal[line] = gb_vec_dot(force, r) / gb_vec_length(r);
            state->pair_bridged[line++] = deepest > 0.0;
        }
    }
}

static bool copy_world(const struct gb_loading *loading, struct gb_state **out,
                       struct gb_error *err)
{
    const struct gb_world *world = loading->world;
    const struct gb_model *model = loading->model;
    struct gb_contact_counts counts;
    gb_observe_contacts(world, &counts, NULL, 0, NULL);
    if (!gb_state_create(out, model->count, counts.contacts, err)) {
        return false;
    }
    struct gb_state *state = *out;
    state->dimension = model->dimension;
    memcpy(state->cell, gb_world_cell(world)->edge, sizeof state->cell);
    memcpy(state->tilt, gb_world_cell(world)->tilt, sizeof state->tilt);
    gb_observe_contacts(world, &counts, NULL, 0, state->contacts);
    for (int64_t i = 0; i < model->count; i++) {
        memcpy(state->position + 3 * i, gb_world_position(world) + 3 * i,
               3 * sizeof(double));
        gb_cell_wrap(gb_world_cell(world), state->position + 3 * i);
        state->radius[i] = 0.5 * gb_world_diameter(world, i);
    }
    copy_world_pairs(world, state);
    return true;
}

static void copy_bed_pairs(const struct gb_bed *bed, struct gb_state *state)
{
    int64_t line = 0;
    for (int64_t slot = 0; slot < bed->pairs.count; slot++) {
        if (bed->pairs.contacts.normal[slot] < 0.0) {
            continue;
        }
        double unit[3];
        gb_observe_die_force(bed, slot, unit, state->pair_force + 3 * line);
        state->pair[2 * line] = bed->pairs.first[slot];
        state->pair[2 * line + 1] = bed->pairs.other[slot];
        state->pair_normal[line++] = bed->pairs.contacts.normal[slot];
    }
}

static bool copy_walls(const struct gb_bed *bed, struct gb_state *state,
                       struct gb_error *err)
{
    const struct gb_bed_list *walls = &bed->walls;
    int64_t line = 0;
    for (int64_t slot = 0; slot < walls->count; slot++) {
        line += walls->contacts.normal[slot] >= 0.0;
    }
    if (!gb_state_allocate_walls(state, line, err)) {
        return false;
    }
    line = 0;
    for (int64_t slot = 0; slot < walls->count; slot++) {
        if (walls->contacts.normal[slot] < 0.0) {
            continue;
        }
        const double *x = bed->position[walls->first[slot]];
        double unit[3];
        gb_die_overlap(&bed->die, (enum gb_die_wall)walls->other[slot], x, x[3], unit);
        for (int k = 0; k < 3; k++) {
            state->wall_force[3 * line + k] =
                walls->contacts.normal[slot] * unit[k] + walls->contacts.shear[k][slot];
        }
        state->wall[2 * line] = walls->first[slot];
        state->wall[2 * line++ + 1] = walls->other[slot];
    }
    return true;
}

static bool copy_bed(const struct gb_loading *loading, struct gb_state **out,
                     struct gb_error *err)
{
    const struct gb_bed *bed = loading->bed;
    const double radius = gb_state_record_half_width(
        (const double(*)[4])bed->position, bed->count, &bed->die);
    struct gb_contact_counts counts;
    gb_observe_die_contacts(bed, &counts, NULL, 0, NULL);
    if (!gb_state_create(out, bed->count, counts.contacts, err)) {
        return false;
    }
    struct gb_state *state = *out;
    const double top =
        fmax(gb_bed_top(bed), bed->die.punch ? bed->die.punch_position : 0.0);
    gb_state_record_walls(state, &bed->die);
    state->cell[0] = state->cell[1] = 2.0 * radius;
    state->cell[2] = top;
    gb_observe_die_contacts(bed, &counts, NULL, 0, state->contacts);
    for (int64_t i = 0; i < bed->count; i++) {
        const double position[3] = {bed->position[i][0] + radius,
                                    bed->position[i][1] + radius, bed->position[i][2]};
        memcpy(state->position + 3 * i, position, sizeof position);
        state->radius[i] = bed->position[i][3];
    }
    copy_bed_pairs(bed, state);
    return copy_walls(bed, state, err);
}

bool gb_packing_state_copy(const struct gb_loading *loading, struct gb_state **out,
                           struct gb_error *err)
{
    const struct gb_model *model = loading->model;
    if (!(loading->bed ? copy_bed(loading, out, err) : copy_world(loading, out, err))) {
        return false;
    }
    struct gb_state *state = *out;
    gb_point_measure_packing(loading, &state->point);
    gb_state_record_model(state, model);
    state->metre_per_length = model->metre_per_length;
    state->pascal_per_stress = model->pascal_per_stress;
    state->seed = model->seed.value;
    snprintf(state->preset, sizeof state->preset, "%s", loading->params->title);
    snprintf(state->version, sizeof state->version, "%s", GB_VERSION);
    return true;
}
