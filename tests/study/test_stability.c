/* Each method on both sides of its bound: just below it a disturbance stays, just above
 * it grows. */
#include <glib.h>
#include <math.h>

#include "base/alloc.h"
#include "solve/relax/relax_fire.h"
#include "study/stability/stability.h"
#include "study/stability/stability_scene.h"

static void test_sides(void)
{
    struct gb_error err = {0};
    for (int i = 0; i < gb_stability_rows(); i++) {
        bool below = true, above = false;
        if (!gb_stability_grows(i, 0.97, &below, &err) ||
            !gb_stability_grows(i, 1.03, &above, &err)) {
            g_error("row %d: %s", i, err.text);
        }
        g_test_message("row %d", i);
        g_assert_false(below);
        g_assert_true(above);
    }
}

/* The measured bound meets the theoretical one, and this the closed form. */
static void test_bounds(void)
{
    struct gb_error err = {0};
    int closed = 0;
    for (int i = 0; i < gb_stability_rows(); i += 5) {
        struct gb_stability_row row;
        g_assert_true(gb_stability_measure(i, &row, &err));
        g_assert_cmpfloat_with_epsilon(row.measured / row.theory, 1.0, 0.02);
        g_assert_cmpfloat(row.used, >, 0.0);
        if (isfinite(row.exact)) {
            g_assert_cmpfloat_with_epsilon(row.exact / row.theory, 1.0, 1e-3);
            closed++;
        }
    }
    g_assert_cmpint(closed, >, 2);
}

/* Shear and rotation of a Hertz pair together are sqrt(3) faster than the normal mode at
 * nu = 0.25, physics of P3 (23)-(29); the rod part of P1's law stiffens the latter. */
static void test_fastest(void)
{
    struct gb_stability_scene normal, shear;
    struct gb_error err = {0};
    g_assert_true(
        gb_stability_scene_init(&normal, GB_STABILITY_PAIR, GB_STABILITY_ROD, 0.1, &err));
    g_assert_true(gb_stability_scene_init(&shear, GB_STABILITY_PAIR,
                                          GB_STABILITY_FRICTION, 0.1, &err));
    const double h = normal.model.h_eq;
    const double hertz = 1.5 * normal.model.rod.hertz * sqrt(h);
    /* the lever is half the distance of the centres, not half a diameter */
    const double lever = sqrt((2.0 + 5.0 * (1.0 - h) * (1.0 - h)) / 7.0);
    g_assert_cmpfloat_with_epsilon(shear.frequency / sqrt(2.0 * hertz), sqrt(3.0) * lever,
                                   1e-3);
    g_assert_cmpfloat(shear.frequency, >, normal.frequency);
    gb_stability_scene_finish(&normal);
    gb_stability_scene_finish(&shear);
}

/* A first step far above the bound is cut until it is below: FIRE does not run away. */
static void test_runaway(void)
{
    struct gb_stability_scene scene;
    struct gb_error err = {0};
    g_assert_true(gb_stability_scene_init(&scene, GB_STABILITY_LATTICE,
                                          GB_STABILITY_BRIDGE, GB_RELAX_INERTIA, &err));
    struct gb_relax relax = {.method = &gb_relax_fire};
    struct gb_relax_fire_state state;
    struct gb_relax_fire_tuning tuning = gb_relax_predict_tuning;
    tuning.step_first = 3.0;
    tuning.step_most = 3.0;
    const int64_t n = 3 * scene.model.count;
    for (int v = 0; v < 2; v++) {
        relax.vector[v] = gb_alloc_array((size_t)n, sizeof(double), &err);
        g_assert_nonnull(relax.vector[v]);
    }
    g_assert_true(gb_stability_scene_reset(&scene, &err));
    const struct gb_bodies b = gb_world_bodies(scene.world);
    for (int64_t i = 0; i < n; i++) {
        b.position[i] += 1e-4 * scene.mode[i];
    }
    gb_relax_fire_rest(&relax, &state, &tuning, scene.world);
    double residual = 0.0, most = 0.0;
    for (int i = 0; i < 400; i++) {
        g_assert_true(gb_relax_evaluate(&relax, scene.world, &err));
        residual = gb_world_residual(scene.world);
        most = fmax(most, residual);
        gb_relax_fire_move(&relax, &state, &tuning, scene.world);
    }
    g_assert_cmpfloat(residual, <, 1e-4 * most);
    gb_alloc_free(relax.vector[0]);
    gb_alloc_free(relax.vector[1]);
    gb_stability_scene_finish(&scene);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/stability/sides", test_sides);
    g_test_add_func("/stability/bounds", test_bounds);
    g_test_add_func("/stability/fastest", test_fastest);
    g_test_add_func("/stability/runaway", test_runaway);
    return g_test_run();
}
