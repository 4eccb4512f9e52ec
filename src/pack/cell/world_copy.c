#include <string.h>

#include "base/alloc.h"
#include "pack/cell/world_private.h"

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
    const struct gb_contact_history *known = &world->checkpoint_history;
    if (!gb_world_copy_ensure(world, copy, err)) {
        return false;
    }
    (*copy)->cell = particles->cell;
    (*copy)->count = particles->count;
    memcpy((*copy)->position, particles->position,
           3 * (size_t)particles->count * sizeof *particles->position);
    /* a checkpoint of this state has the same contacts */
    return engine->history_version > 0 && known->version == engine->history_version
               ? gb_contact_history_copy(&(*copy)->history, known, err)
               : gb_contact_history_write(&(*copy)->history, engine,
                                          GB_CONTACT_HISTORY_KEPT, err);
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
