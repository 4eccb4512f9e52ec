#include <string.h>

#include "base/alloc.h"
#include "pack/cell/record_checks.h"
#include "pack/cell/world_private.h"
#include "pack/cell/world_record.h"

bool gb_world_copy_ensure(const struct gb_world *world, struct gb_world_copy **copy,
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
    if (!gb_world_copy_ensure(world, copy, err)) {
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

bool gb_world_copy_record(const struct gb_world *world, struct gb_world_copy **copy,
                          struct gb_record *record, struct gb_error *err)
{
    const struct gb_particles *particles = &world->engine.particles;
    if (!gb_world_copy_ensure(world, copy, err)) {
        return false;
    }
    struct gb_world_copy *at = *copy;
    if (record->loading) {
        at->cell = particles->cell;
        at->count = particles->count;
    }
    return gb_record_array(record, "branch/edge", GB_RECORD_DOUBLE, 1, 3, "d",
                           at->cell.edge, err) &&
           (!world->engine.model->sheared ||
            (gb_record_array(record, "branch/tilt", GB_RECORD_DOUBLE, 1, 3, "d",
                             at->cell.tilt, err) &&
             gb_record_array(record, "branch/shear", GB_RECORD_DOUBLE, 1, 3, "1",
                             at->cell.shear, err))) &&
           gb_record_checks_edges(&at->cell, "branch/edge", err) &&
           gb_record_array(record, "branch/position", GB_RECORD_DOUBLE, at->count, 3, "d",
                           at->position, err) &&
           gb_record_checks_inside(&at->cell, at->position, at->count, 1.0,
                                   "branch/position", err) &&
           gb_contact_history_record(&at->history, &world->engine, record,
                                     &gb_contact_history_branch, err) &&
           gb_record_checks_history(&at->history, at->count,
                                    gb_contact_history_branch.pair, err);
}
