/* Each method on both sides of its bound: just below it a disturbance stays, just above
 * it grows. */
#include <glib.h>
#include <math.h>

#include "base/alloc.h"
#include "solve/relax/relax_fire.h"
#include "study/stability.h"

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

/* --- states of a run ---------------------------------------------------------------- */

struct rows {
    int count, in_use, skipped;
    double p_pa, measured; /* of the last one */
};

/* The bound that is measured meets theory, whatever the method and the sizes. */
static bool check_row(void *data, const struct gb_stability_row *row,
                      struct gb_error *err)
{
    struct rows *rows = data;
    (void)err;
    g_test_message("%s at %g MPa: %g of %g", row->method, 1e-6 * row->p_pa, row->measured,
                   row->theory);
    g_assert_cmpfloat_with_epsilon(row->measured / row->theory, 1.0, 0.03);
    g_assert_cmpfloat(row->used, >, 0.0);
    g_assert_cmpfloat(row->density, >, 0.2);
    rows->count++;
    rows->in_use += row->in_use;
    rows->p_pa = row->p_pa;
    rows->measured = row->measured;
    return true;
}

static void count_skipped(void *data, double p_pa, const char *why)
{
    ((struct rows *)data)->skipped++;
    g_test_message("%g MPa: %s", 1e-6 * p_pa, why);
}

static struct rows run_scene(const char *const *assignments, const char *at)
{
    struct rows rows = {0};
    struct gb_params params;
    struct gb_keep_points points;
    struct gb_error err = {0};
    int missed = 0;
    const struct gb_stability_sink sink = {check_row, count_skipped, &rows, NULL};
    gb_params_init(&params);
    for (int i = 0; assignments[i] != NULL; i++) {
        if (!gb_params_assign(&params, assignments[i], &err)) {
            g_error("%s", err.text);
        }
    }
    g_assert_true(gb_keep_points_parse(at, &points, &err));
    if (!gb_stability_run(&params, &points, &sink, &missed, &err)) {
        g_error("%s", err.text);
    }
    g_assert_cmpint(missed, ==, 0);
    return rows;
}

/* The relaxers where the run reaches a pressure, and at its end. */
static void test_relaxers(void)
{
    const char *const scene[] = {"particles.count=60", "loading.until=30 MPa",
                                 "loading.unload_from=", "numerics.relaxer=fire", NULL};
    const struct rows rows = run_scene(scene, "5 MPa");
    g_assert_cmpint(rows.count, ==, 6);
    g_assert_cmpint(rows.in_use, ==, 2);
    g_assert_cmpfloat(rows.p_pa, >=, 30e6);
    const char *const sizes[] = {
        "particles.count=200",  "particles.distribution=lognormal",
        "particles.sigma=0.3",  "loading.until=5 MPa",
        "loading.unload_from=", NULL};
    g_assert_cmpint(run_scene(sizes, "").count, ==, 3);
}

/* Velocity Verlet with masses of unequal spheres, and of discs; damping shortens the step
 * of the former. */
static void test_masses(void)
{
    const char *scene[] = {"scene.kind=dynamic",
                           "particles.count=200",
                           "particles.distribution=lognormal",
                           "particles.sigma=0.3",
                           "loading.until=density = 0.4",
                           "loading.relax=0 s",
                           "loading.hold=0 s",
                           "contact.viscosity=0 Pa s",
                           NULL};
    const struct rows free = run_scene(scene, "");
    g_assert_cmpint(free.count, ==, 1);
    scene[7] = "contact.viscosity=0.1 Pa s";
    const struct rows damped = run_scene(scene, "");
    g_assert_cmpfloat(damped.measured, <, free.measured);
    const char *const discs[] = {"scene.kind=dynamic",
                                 "scene.dimension=2",
                                 "particles.count=60",
                                 "structure.density=0.5",
                                 "loading.geometry=isotropic",
                                 "loading.until=density = 0.75",
                                 "loading.relax=0 s",
                                 "loading.hold=0 s",
                                 NULL};
    g_assert_cmpint(run_scene(discs, "").count, ==, 1);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/stability/sides", test_sides);
    g_test_add_func("/stability/bounds", test_bounds);
    g_test_add_func("/stability/fastest", test_fastest);
    g_test_add_func("/stability/runaway", test_runaway);
    g_test_add_func("/stability/relaxers", test_relaxers);
    g_test_add_func("/stability/masses", test_masses);
    return g_test_run();
}
