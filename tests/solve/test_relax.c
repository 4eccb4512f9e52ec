#include <glib.h>
#include <math.h>

#include "common/scene.h"
#include "measure/observe.h"
#include "solve/guard.h"
#include "solve/relax.h"

/* Every relaxer brings every small problem to the same stopping rule. */
static void test_all(void)
{
    static const char *const problem[][3] = {
        {"particles.diameter=9.7 nm", "contact.mu=0.1", "contact.bridge_length=0.008 d"},
        {"particles.diameter=38 nm", "contact.mu=0.1", "contact.bridge_length=0.008 d"},
        {"particles.diameter=10.4 nm", "contact.mu=0.13", "contact.bridge_length=1 d"},
        {"particles.diameter=10.4 nm", "contact.mu=0", "contact.bridge_length=1 d"},
        {"scene.dimension=2", "contact.mu=0.5", "contact.bridge_length=0.008 d"},
    };
    for (int m = 0; gb_relax_table()[m]; m++) {
        for (size_t p = 0; p < G_N_ELEMENTS(problem); p++) {
            char relaxer[64];
            g_snprintf(relaxer, sizeof relaxer, "numerics.relaxer=%s",
                       gb_relax_table()[m]->name);
            const struct gb_params params =
                scene_params(relaxer, problem[p][0], problem[p][1], problem[p][2],
                             "numerics.tolerance=5e-3", NULL);
            const struct gb_model model = scene_model(&params);
            struct gb_world *world = scene_world(&model);
            struct gb_relax *relax = NULL;
            struct gb_error err = {0};
            g_assert_true(gb_relax_create(&relax, &model, &err));
            for (int step = 0; step < 5; step++) {
                gb_relax_start(relax, world);
                g_assert_cmpint(gb_relax_advance(relax, world, 500000, &err), ==,
                                GB_RELAX_DONE);
                g_assert_cmpfloat(gb_world_residual(world), <=, 5e-3);
                const double factor[3] = {1.0, 1.0, 0.998};
                gb_world_strain(world, factor);
            }
            gb_relax_destroy(relax);
            gb_world_destroy(world);
        }
    }
}

/* A packing out of equilibrium, and a relaxation of it that is about to begin. */
static struct gb_world *squeezed(const struct gb_model *model, struct gb_relax **relax)
{
    static const double factor[3] = {1.0, 1.0, 0.99};
    struct gb_error err = {0};
    struct gb_world *world = scene_world(model);
    g_assert_true(gb_relax_create(relax, model, &err));
    gb_world_strain(world, factor);
    gb_relax_start(*relax, world);
    return world;
}

/* Evaluations of fifty equal strain steps and ten back, and the contacts per particle
 * they end with. */
static int64_t pressed(const char *relaxer, double factor_z, double *contacts)
{
    char assignment[64];
    g_snprintf(assignment, sizeof assignment, "numerics.relaxer=%s", relaxer);
    const struct gb_params params =
        scene_params(assignment, "particles.count=400", "numerics.tolerance=1e-2", NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model);
    struct gb_relax *relax = NULL;
    struct gb_error err = {0};
    int64_t spent = 0;
    g_assert_true(gb_relax_create(&relax, &model, &err));
    for (int step = 0; step < 60; step++) {
        const double along = step < 50 ? factor_z : 1.0 / factor_z;
        const double factor[3] = {1.0, 1.0, along};
        gb_world_strain(world, factor);
        gb_relax_start(relax, world);
        g_assert_cmpint(gb_relax_advance(relax, world, 100000, &err), ==, GB_RELAX_DONE);
        spent += relax->evaluations;
    }
    *contacts = (double)gb_world_tally(world)->contacts / (double)model.count;
    gb_relax_destroy(relax);
    gb_world_destroy(world);
    return spent;
}

/* What the last step has done is foretold: fewer evaluations, the same packing. */
static void test_predict(void)
{
    double plain = 0.0, foretold = 0.0;
    const int64_t many = pressed("fire", 0.998, &plain);
    const int64_t few = pressed("predict", 0.998, &foretold);
    g_test_message("fire %" G_GINT64_FORMAT ", predict %" G_GINT64_FORMAT " evaluations",
                   many, few);
    g_assert_cmpint(4 * few, <, 3 * many);
    g_assert_cmpfloat_with_epsilon(foretold, plain, 0.05);
}

/* A slice never runs over, and slices of any length give the same bits. */
static void test_slices(void)
{
    const struct gb_params params = scene_params("numerics.tolerance=1e-3", NULL);
    const struct gb_model model = scene_model(&params);
    uint64_t hash[2];
    for (int s = 0; s < 2; s++) {
        struct gb_relax *relax = NULL;
        struct gb_error err = {0};
        struct gb_world *world = squeezed(&model, &relax);
        int64_t last = 0;
        while (gb_relax_advance(relax, world, s == 0 ? 1 : 7, &err) == GB_RELAX_MORE) {
            g_assert_cmpint(relax->evaluations - last, ==, s == 0 ? 1 : 7);
            last = relax->evaluations;
        }
        hash[s] = gb_world_hash(world);
        gb_relax_destroy(relax);
        gb_world_destroy(world);
    }
    g_assert_cmpuint(hash[0], ==, hash[1]);
}

static void test_exhausted(void)
{
    const struct gb_params params =
        scene_params("numerics.tolerance=1e-9", "numerics.max_evaluations=20", NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_relax *relax = NULL;
    struct gb_error err = {0};
    struct gb_world *world = squeezed(&model, &relax);
    g_assert_cmpint(gb_relax_advance(relax, world, 1000, &err), ==, GB_RELAX_EXHAUSTED);
    g_assert_cmpint(relax->evaluations, ==, 20);
    gb_relax_destroy(relax);
    gb_world_destroy(world);
}

static void test_unknown(void)
{
    struct gb_params params = scene_params(NULL);
    struct gb_model model = scene_model(&params);
    struct gb_relax *relax = NULL;
    struct gb_error err = {0};
    g_strlcpy(model.numerics.relaxer, "fyre", sizeof model.numerics.relaxer);
    g_assert_false(gb_relax_create(&relax, &model, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    g_assert_nonnull(strstr(err.text, "fire"));
    g_assert_nonnull(strstr(err.text, "steepest"));
}

/* What the guard decides in each case. */
static void test_guard(void)
{
    struct gb_guard guard = {0};
    struct gb_error err = {0};
    struct gb_relax relax = {.tolerance = 1e-3, .residual = 2e-3, .evaluations = 100};
    char text[400];
    g_assert_cmpint(
        gb_guard_judge(&guard, GB_RELAX_DONE, &relax, text, sizeof text, &err), ==,
        GB_GUARD_ACCEPT);
    g_assert_cmpstr(text, ==, "");
    g_assert_cmpint(
        gb_guard_judge(&guard, GB_RELAX_EXHAUSTED, &relax, text, sizeof text, &err), ==,
        GB_GUARD_ACCEPT);
    g_assert_nonnull(strstr(text, "not fully relaxed"));
    relax.residual = 1.0;
    g_assert_cmpint(
        gb_guard_judge(&guard, GB_RELAX_EXHAUSTED, &relax, text, sizeof text, &err), ==,
        GB_GUARD_STOP);
    g_assert_cmpint(err.code, ==, GB_ERR_NOT_CONVERGED);
    int retries = 0;
    for (;;) {
        gb_error_set(&err, GB_ERR_GUARD, "made up");
        if (gb_guard_judge(&guard, GB_RELAX_FAILED, &relax, text, sizeof text, &err) ==
            GB_GUARD_STOP) {
            break;
        }
        retries++;
    }
    g_assert_cmpint(retries, >, 2);
    g_assert_cmpint(retries, <, 20);
    gb_error_set(&err, GB_ERR_MEMORY, "made up");
    guard.halvings = 0;
    g_assert_cmpint(
        gb_guard_judge(&guard, GB_RELAX_FAILED, &relax, text, sizeof text, &err), ==,
        GB_GUARD_STOP);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/relax/all", test_all);
    g_test_add_func("/relax/predict", test_predict);
    g_test_add_func("/relax/slices", test_slices);
    g_test_add_func("/relax/exhausted", test_exhausted);
    g_test_add_func("/relax/unknown", test_unknown);
    g_test_add_func("/relax/guard", test_guard);
    return g_test_run();
}
