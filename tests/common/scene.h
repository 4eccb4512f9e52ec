#ifndef GB_TESTS_SCENE_H
#define GB_TESTS_SCENE_H

#include <glib.h>
#include <stdarg.h>
#include <string.h>

#include "base/alloc.h"
#include "pack/cell/world.h"
#include "pack/kernel/pair_forces.h"
#include "pack/structure/chain_growth.h"
#include "scene/model.h"

/* Parameters of a small alumina packing, then assignments "group.key=value", NULL at the
 * end. */
static inline struct gb_params scene_params(const char *first, ...)
{
    struct gb_params params;
    struct gb_error err = {0};
    gb_params_init(&params);
    g_assert_true(gb_params_assign(&params, "particles.count=200", &err));
    g_assert_true(gb_params_assign(&params, "particles.diameter=9.7 nm", &err));
    va_list more;
    va_start(more, first);
    for (const char *text = first; text; text = va_arg(more, const char *)) {
        if (!gb_params_assign(&params, text, &err)) {
            g_error("%s: %s", text, err.text);
        }
    }
    va_end(more);
    return params;
}

static inline struct gb_model scene_model(const struct gb_params *params)
{
    struct gb_model model;
    struct gb_error err = {0};
    if (!gb_model_init(&model, params, &err)) {
        g_error("%s", err.text);
    }
    return model;
}

/* Positions of the initial structure, freed with gb_alloc_free. */
static inline double *scene_positions(const struct gb_model *model)
{
    struct gb_error err = {0};
    double *position = gb_alloc_array(3 * (size_t)model->count, sizeof *position, &err);
    if (!position || !gb_chain_growth_fill(model, NULL, NULL, position, &err)) {
        g_error("%s", err.text);
    }
    return position;
}

static inline struct gb_world *scene_world(const struct gb_model *model)
{
    struct gb_world *world = NULL;
    struct gb_error err = {0};
    double *position = scene_positions(model);
    if (!gb_world_create(&world, model, position, &err)) {
        g_error("%s", err.text);
    }
    gb_alloc_free(position);
    return world;
}

static inline void scene_evaluate(struct gb_world *world)
{
    struct gb_error err = {0};
    if (!gb_world_evaluate(world, &err)) {
        g_error("%s", err.text);
    }
}

/* Force of one pair of a list on its first particle. */
static inline void scene_force(const struct gb_world *world,
                               enum gb_pair_forces_list list, int64_t k, double force[3])
{
    struct gb_pair_forces forces;
    gb_pair_forces_init(&forces, world, list);
    gb_pair_forces_at(&forces, k, force);
}

static inline void scene_squeeze(struct gb_world *world, double step)
{
    const double factor[3] = {1.0, 1.0, 1.0 - step};
    gb_world_strain(world, factor);
}

/* A crude but deterministic motion: displacements are k times the forces, `moves` times
 * after each squeeze. */
static inline void scene_press(struct gb_world *world, int steps, int moves, double k)
{
    const struct gb_bodies b = gb_world_bodies(world);
    for (int s = 0; s < steps; s++) {
        scene_squeeze(world, 0.002);
        for (int m = 0; m < moves; m++) {
            scene_evaluate(world);
            for (int64_t i = 0; i < 3 * b.count; i++) {
                b.position[i] += k * b.force[i];
                b.rotation[i] += k * b.torque[i];
            }
        }
    }
    scene_evaluate(world);
}

#endif
