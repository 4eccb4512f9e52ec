#include <glib.h>

#include "common/world.h"
#include "pack/cell/world_record.h"
#include "pack/f32/integrate_f32.h"

/* Every transition of the motion from every state; -1: not legal, stops at an assertion. */
typedef void transition(struct gb_engine_state *state);
static const struct {
    transition *apply;
    int next[GB_ENGINE_MOTIONS];
} transitions[] = {
    /* EDITED, EVALUATED, MOVED, MOVED_SYNCHRONISED, RELAXING, RELAXING_SYNCHRONISED */
    {gb_engine_state_synchronise, {0, 1, 3, 3, 5, 5}},
    {gb_engine_state_lend, {0, 0, -1, 3, -1, 0}},
    {gb_engine_state_replace, {0, 0, 0, 0, 0, 0}},
    {gb_engine_state_move, {2, 2, -1, -1, 2, 2}},
    {gb_engine_state_evaluate, {1, 1, 4, 5, -1, 1}},
};

static void test_transitions(void)
{
    for (size_t t = 0; t < G_N_ELEMENTS(transitions); t++) {
        for (int m = 0; m < GB_ENGINE_MOTIONS; m++) {
            struct gb_engine_state state = {.real = GB_REAL_F32,
                                            .motion = (enum gb_engine_motion)m,
                                            .lists = GB_ENGINE_LISTS};
            if (transitions[t].next[m] >= 0) {
                transitions[t].apply(&state);
                g_assert_cmpint((int)state.motion, ==, transitions[t].next[m]);
            }
        }
    }
}

/* Transition t / 10 from motion t % 10, in a process of its own that it stops. */
static void test_illegal(void)
{
    for (size_t t = 0; t < G_N_ELEMENTS(transitions); t++) {
        for (int m = 0; m < GB_ENGINE_MOTIONS; m++) {
            if (transitions[t].next[m] < 0) {
                char *path = g_strdup_printf("/engine_state/subprocess/%zu/%d", t, m);
                g_test_trap_subprocess(path, 0, G_TEST_SUBPROCESS_DEFAULT);
                g_test_trap_assert_failed();
                g_free(path);
            }
        }
    }
}

static void apply_illegal(gconstpointer data)
{
    const size_t number = GPOINTER_TO_SIZE(data);
    struct gb_engine_state state = {
        .real = GB_REAL_F32,
        .motion = (enum gb_engine_motion)(number % GB_ENGINE_MOTIONS),
        .lists = GB_ENGINE_LISTS};
    transitions[number / GB_ENGINE_MOTIONS].apply(&state);
}

static void add_illegal(void)
{
    for (size_t t = 0; t < G_N_ELEMENTS(transitions); t++) {
        for (int m = 0; m < GB_ENGINE_MOTIONS; m++) {
            char *path = g_strdup_printf("/engine_state/subprocess/%zu/%d", t, m);
            if (transitions[t].next[m] < 0) {
                g_test_add_data_func(path,
                                     GSIZE_TO_POINTER(t * GB_ENGINE_MOTIONS + (size_t)m),
                                     apply_illegal);
            }
            g_free(path);
        }
    }
}

/* Which form of the positions is stale, and whether bounds are known, follows from the
 * motion. */
static void test_queries(void)
{
    const char *const expected[GB_ENGINE_MOTIONS] = {"f", "", "pmb", "mb", "pb", "b"};
    for (int m = 0; m < GB_ENGINE_MOTIONS; m++) {
        const struct gb_engine_state state = {.motion = (enum gb_engine_motion)m};
        char *found = g_strconcat(gb_engine_state_fixed_stale(&state) ? "f" : "",
                                  gb_engine_state_position_stale(&state) ? "p" : "",
                                  gb_engine_state_moved(&state) ? "m" : "",
                                  gb_engine_state_bounds_known(&state) ? "b" : "", NULL);
        g_assert_cmpstr(found, ==, expected[m]);
        g_free(found);
    }
}

/* The states that a world passes through. */
static void test_sequence(void)
{
    const struct gb_params params =
        scene_params("particles.count=300", "numerics.precision=single", NULL);
    const struct gb_model model = scene_model(&params);
    const struct gb_integrate_f32 by = {
        .keep = 1.0, .step = 1.0, .inertia = 0.4, .displacement_max = 1.0};
    const double factor[3] = {1.0, 1.0, 0.999};
    struct gb_world *world = scene_world(&model);
    const struct gb_engine_state *state = &world->engine.state;
    struct gb_error err = {0};
    g_assert_cmpint(state->motion, ==, GB_ENGINE_EDITED);
    g_assert_cmpint(state->lists, ==, GB_ENGINE_NO_LISTS);
    scene_evaluate(world);
    g_assert_cmpint(state->motion, ==, GB_ENGINE_EVALUATED);
    g_assert_cmpint(state->lists, ==, GB_ENGINE_LISTS);
    g_assert_cmpint(state->forces, ==, GB_ENGINE_FORCES_F64);
    gb_integrate_f32_reset(world);
    gb_integrate_f32_step(world, &by, NULL);
    g_assert_cmpint(state->motion, ==, GB_ENGINE_MOVED);
    g_assert_true(gb_world_evaluate_along(world, NULL, NULL, &err));
    g_assert_cmpint(state->motion, ==, GB_ENGINE_RELAXING);
    g_assert_cmpint(state->forces, ==, GB_ENGINE_FORCES_F32);
    gb_world_synchronise(world);
    g_assert_cmpint(state->motion, ==, GB_ENGINE_RELAXING_SYNCHRONISED);
    gb_integrate_f32_step(world, &by, NULL);
    gb_world_synchronise(world);
    g_assert_cmpint(state->motion, ==, GB_ENGINE_MOVED_SYNCHRONISED);
    gb_world_strain(world, factor);
    g_assert_cmpint(state->motion, ==, GB_ENGINE_EDITED);
    scene_evaluate(world);
    (void)gb_world_bodies(world);
    g_assert_cmpint(state->motion, ==, GB_ENGINE_EDITED);
    gb_world_destroy(world);
}

/* A velocity update with random velocities, and its evaluation. */
static void random_update(struct gb_world *world, GRand *random)
{
    const struct gb_integrate_f32 by = {
        .keep = 1.0, .step = 1.0, .inertia = 0.4, .displacement_max = 1.0};
    struct gb_error err = {0};
    for (int64_t k = 0; k < 3 * world->engine.particles.count; k++) {
        float *velocity = &world->engine.f32.velocity[k / 3][k % 3];
        velocity[0] = (float)g_rand_double_range(random, -5e-3, 5e-3);
        velocity[GB_WRENCH_ROWS_TORQUE] = (float)g_rand_double_range(random, -5e-3, 5e-3);
    }
    gb_integrate_f32_step(world, &by, NULL);
    if (!gb_world_evaluate_along(world, NULL, NULL, &err)) {
        g_assert_cmpint(err.code, ==, GB_ERR_GUARD);
    }
}

/* Synchronising `position` with the fixed-point positions changes no bit, whenever it is
 * done: three worlds with the same motion are synchronised at the end only, after every
 * evaluation, or by a caller that may move the particles; a fourth one is loaded from a
 * checkpoint of the first. */
static void test_synchronised(void)
{
    const struct gb_params params =
        scene_params("particles.count=600", "numerics.precision=single", NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world[4];
    struct gb_world_copy *copy = NULL;
    struct gb_record record = {0};
    struct gb_error err = {0};
    GRand *random[4];
    for (int w = 0; w < 4; w++) {
        random[w] = g_rand_new_with_seed(23);
        world[w] = scene_world(&model);
    }
    scene_press(world[0], 120, 10, 2.0);
    g_assert_true(gb_world_copy_save(world[0], &copy, &err));
    for (int w = 0; w < 3; w++) {
        g_assert_true(gb_world_copy_restore(world[w], copy, &err));
        scene_evaluate(world[w]);
        gb_integrate_f32_reset(world[w]);
    }
    for (int step = 0; step < 60; step++) {
        const double factor[3] = {1.0, 0.9995, 0.9995};
        if (step == 30) {
            g_assert_true(gb_world_record(world[0], &record, &err));
            record.loading = true;
            g_assert_true(gb_world_record(world[3], &record, &err));
            g_rand_free(random[3]);
            random[3] = g_rand_copy(random[0]);
        }
        for (int w = 0; w < (step < 30 ? 3 : 4); w++) {
            if (step % 10 == 5) {
                gb_world_strain(world[w], factor);
                g_assert_true(gb_world_evaluate_along(world[w], NULL, NULL, &err));
            }
            random_update(world[w], random[w]);
        }
        gb_world_synchronise(world[1]);
        (void)gb_world_bodies(world[2]);
    }
    for (int w = 0; w < 4; w++) {
        gb_world_synchronise(world[w]);
        g_assert_cmpuint(gb_world_hash(world[w]), ==, gb_world_hash(world[0]));
    }
    g_assert_cmpint(gb_world_rebuilds(world[0]), >, 2);
    for (int w = 0; w < 4; w++) {
        g_rand_free(random[w]);
        gb_world_destroy(world[w]);
    }
    gb_record_finish(&record);
    gb_world_copy_destroy(copy);
}

/* A particle moved by a caller between an evaluation and a velocity update continues from
 * there, to half a fixed-point unit. */
static void test_edited(void)
{
    const struct gb_params params =
        scene_params("particles.count=300", "numerics.precision=single", NULL);
    const struct gb_model model = scene_model(&params);
    const struct gb_integrate_f32 by = {
        .keep = 1.0, .step = 1.0, .inertia = 0.4, .displacement_max = 1.0};
    struct gb_world *world = scene_world(&model);
    scene_evaluate(world);
    gb_integrate_f32_reset(world);
    gb_integrate_f32_step(world, &by, NULL);
    scene_evaluate(world);
    double *position = gb_world_bodies(world).position;
    double *before = g_memdup2(position, 3 * (size_t)model.count * sizeof *before);
    position[3 * 17 + 1] += 0.02;
    world->engine.f32.velocity[17][1] = 0.01F;
    world->engine.f32.velocity[18][2] = -0.01F;
    gb_integrate_f32_step(world, &by, NULL);
    gb_world_synchronise(world);
    for (int64_t k = 0; k < 3 * model.count; k++) {
        const double moved = k == 3 * 17 + 1 ? 0.03 : k == 3 * 18 + 2 ? -0.01 : 0.0;
        g_assert_cmpfloat_with_epsilon(gb_world_position(world)[k] - before[k], moved,
                                       1e-8);
    }
    g_free(before);
    gb_world_destroy(world);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/engine_state/transitions", test_transitions);
    g_test_add_func("/engine_state/illegal", test_illegal);
    add_illegal();
    g_test_add_func("/engine_state/queries", test_queries);
    g_test_add_func("/engine_state/sequence", test_sequence);
    g_test_add_func("/engine_state/synchronised", test_synchronised);
    g_test_add_func("/engine_state/edited", test_edited);
    return g_test_run();
}
