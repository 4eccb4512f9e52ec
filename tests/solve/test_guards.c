/* Scenes in which a method fails: the failure is detected, handled and reported.
 * Steps beyond their bounds are in test_stability. */
#include <glib.h>
#include <math.h>
#include <string.h>

#include "common/scene.h"
#include "scene/tolerances.h"
#include "solve/loading/loading_quasistatic.h"
#include "solve/loading/strain_step.h"
#include "solve/relax/relax.h"

/* Two particles `gap` apart in a wide cell. */
static struct gb_world *two(struct gb_model *model, double gap)
{
    struct gb_world *world = NULL;
    struct gb_error err = {0};
    const double position[6] = {3.0, 4.0, 4.0, 4.0 + gap, 4.0, 4.0};
    model->count = 2;
    model->edges[0] = model->edges[1] = model->edges[2] = 32.0;
    if (!gb_world_create(&world, model, position, &err)) {
        g_error("%s", err.text);
    }
    return world;
}

/* Attraction grows faster across a gap than anything around resists: the pair jumps into
 * contact however small the step.  The guard halves the step twice, then says so. */
static void test_jump(void)
{
    const struct gb_params params = scene_params(
        "numerics.tolerance=1e-9", "numerics.cutoff=2 d", "numerics.relaxer=fire", NULL);
    struct gb_model model = scene_model(&params);
    struct gb_world *world = two(&model, 0.55);
    struct gb_world_copy *before = NULL;
    struct gb_relax *relax = NULL;
    struct gb_guard guard = {0};
    struct gb_error err = {0};
    char text[400] = "";
    g_assert_true(gb_relax_create(&relax, &model, &err));
    scene_evaluate(world);
    g_assert_true(gb_world_copy_save(world, &before, &err));
    for (int attempt = 0; attempt <= GB_NONAFFINE_HALVINGS_MAX; attempt++) {
        g_assert_true(gb_world_copy_restore(world, before, &err));
        gb_relax_start(relax, world);
        g_assert_cmpint(gb_relax_advance(relax, world, 100000, &err), ==, GB_RELAX_DONE);
        g_assert_cmpint(gb_world_tally(world)->contacts, ==, 1);
        const struct gb_nonaffine nonaffine = gb_nonaffine_since(world, before);
        g_assert_cmpfloat_with_epsilon(nonaffine.farthest, 0.5 * (0.55 + model.h_eq),
                                       0.01);
        const enum gb_guard_action action =
            gb_strain_step_nonaffine(&guard, &nonaffine, text, sizeof text);
        g_assert_cmpint(action, ==,
                        attempt < GB_NONAFFINE_HALVINGS_MAX ? GB_GUARD_RETRY
                                                            : GB_GUARD_ACCEPT);
        g_assert_nonnull(
            strstr(text, attempt < GB_NONAFFINE_HALVINGS_MAX ? "halved" : "jumps by"));
    }
    gb_world_copy_destroy(before);
    gb_relax_destroy(relax);
    gb_world_destroy(world);
}

/* Neither affine motion nor wrapping into the cell is nonaffine displacement. */
static void test_nonaffine(void)
{
    const struct gb_params params = scene_params(NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model);
    struct gb_world_copy *before = NULL;
    struct gb_error err = {0};
    const double factor[3] = {1.0, 0.99, 0.97};
    scene_evaluate(world);
    g_assert_true(gb_world_copy_save(world, &before, &err));
    gb_world_strain(world, factor);
    struct gb_nonaffine nonaffine = gb_nonaffine_since(world, before);
    g_assert_cmpfloat(nonaffine.farthest, <, 1e-12);
    gb_world_bodies(world).position[3 * 17 + 2] += 0.3 + gb_world_cell(world)->edge[2];
    nonaffine = gb_nonaffine_since(world, before);
    g_assert_cmpfloat_with_epsilon(nonaffine.farthest, 0.3, 1e-12);
    g_assert_cmpint(nonaffine.particle, ==, 17);
    g_assert_cmpfloat_with_epsilon(nonaffine.rms, 0.3 / sqrt(200.0), 1e-12);
    gb_world_copy_destroy(before);
    gb_world_destroy(world);
}

/* Pulls a bridge apart and closes the gap again, in turn: the two states between which a
 * relaxer may cycle where a bridge breaks. */
static void tear_and_close(struct gb_relax *relax, struct gb_world *world)
{
    gb_world_bodies(world).position[3] += relax->evaluations % 2 ? 0.03 : -0.03;
}

static void from_rest(struct gb_relax *relax, struct gb_world *world)
{
    (void)relax;
    (void)world;
}

static const struct gb_relaxer cycler = {
    .name = "cycler", .start = from_rest, .move = tear_and_close};

/* Given up after a restart, long before the evaluations are used up; accepted or not by
 * what is left. */
static void check_stall(struct gb_relax *relax, struct gb_world *world)
{
    struct gb_guard guard = {0};
    struct gb_error err = {0};
    char text[400] = "";
    gb_relax_start(relax, world);
    const enum gb_relax_outcome outcome =
        gb_relax_advance(relax, world, relax->max_evaluations, &err);
    g_assert_cmpint(outcome, ==, GB_RELAX_EXHAUSTED);
    g_assert_true(relax->stalled);
    g_assert_cmpint(relax->restarts, ==, 1);
    g_assert_cmpint(relax->evaluations, >=, 2 * GB_STALL_EVALUATIONS);
    g_assert_cmpint(relax->evaluations, <, relax->max_evaluations / 4);
    relax->tolerance = relax->residual / 1e3;
    g_assert_cmpint(gb_strain_step_judge(&guard, outcome, relax, text, sizeof text, &err),
                    ==, GB_GUARD_STOP);
    g_assert_cmpint(err.code, ==, GB_ERR_NOT_CONVERGED);
    relax->tolerance = relax->residual / 2.0;
    g_assert_cmpint(gb_strain_step_judge(&guard, outcome, relax, text, sizeof text, &err),
                    ==, GB_GUARD_ACCEPT);
    g_assert_nonnull(strstr(text, "the relaxation stalls"));
}

static void test_cycle(void)
{
    const struct gb_params params = scene_params("numerics.tolerance=1e-3", NULL);
    struct gb_model model = scene_model(&params);
    struct gb_world *world = two(&model, -0.025);
    struct gb_relax *relax = NULL;
    struct gb_error err = {0};
    g_assert_true(gb_relax_create(&relax, &model, &err));
    relax->method = &cycler;
    check_stall(relax, world);
    gb_relax_destroy(relax);
    gb_world_destroy(world);
}

/* A tolerance below the rounding of the forces cannot be reached by anything. */
static void test_rounding(void)
{
    const struct gb_params params =
        scene_params("numerics.tolerance=1e-12", "particles.count=100",
                     "structure.base=5 d", "numerics.relaxer=fire", NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model);
    struct gb_relax *relax = NULL;
    struct gb_error err = {0};
    g_assert_true(gb_relax_create(&relax, &model, &err));
    relax->tolerance = 1e-18;
    check_stall(relax, world);
    gb_relax_destroy(relax);
    gb_world_destroy(world);
}

/* One that stalls and relaxes after the restart is told. */
static void test_restarted(void)
{
    struct gb_guard guard = {0};
    struct gb_error err = {0};
    const struct gb_relax relax = {
        .tolerance = 1e-3, .residual = 9e-4, .evaluations = 6000, .restarts = 1};
    char text[400];
    g_assert_cmpint(
        gb_strain_step_judge(&guard, GB_RELAX_DONE, &relax, text, sizeof text, &err), ==,
        GB_GUARD_ACCEPT);
    g_assert_nonnull(strstr(text, "restarted"));
}

/* A particle that goes farther than the skin between two evaluations: the list is built
 * anew, or gets the pair, before the forces, so that they are those of a fresh world. */
static void test_skin(void)
{
    const struct gb_params params = scene_params("contact.bridge_length=1 d", NULL);
    struct gb_model model = scene_model(&params);
    struct gb_world *world = two(&model, 0.9);
    scene_evaluate(world);
    g_assert_cmpint(gb_world_tally(world)->contacts, ==, 0);
    const int64_t rebuilds = gb_world_rebuilds(world);
    gb_world_bodies(world).position[3] -= 0.91;
    scene_evaluate(world);
    g_assert_cmpint(gb_world_rebuilds(world) + gb_world_pairs(world)->inserted_count, ==,
                    rebuilds + 1);
    g_assert_cmpint(gb_world_tally(world)->contacts, ==, 1);
    struct gb_world *fresh = two(&model, -0.01);
    scene_evaluate(fresh);
    for (int k = 0; k < 6; k++) {
        g_assert_cmpfloat_with_epsilon(gb_world_bodies(world).force[k],
                                       gb_world_bodies(fresh).force[k], 1e-15);
    }
    gb_world_destroy(fresh);
    gb_world_destroy(world);
}

/* Centres about to cross: the evaluation fails and says why, the strain step is halved,
 * and after six halvings the run stops. */
static void test_cross(void)
{
    const struct gb_params params = scene_params(NULL);
    struct gb_model model = scene_model(&params);
    struct gb_world *world = two(&model, -0.6);
    struct gb_guard guard = {0};
    struct gb_relax relax = {.tolerance = 1e-3};
    struct gb_error err = {0};
    char text[400];
    int retries = 0;
    g_assert_false(gb_world_evaluate(world, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_GUARD);
    g_assert_nonnull(strstr(err.text, "overlap by 0.6"));
    while (gb_strain_step_judge(&guard, GB_RELAX_FAILED, &relax, text, sizeof text,
                                &err) == GB_GUARD_RETRY) {
        g_assert_nonnull(strstr(text, "strain step halved"));
        retries++;
    }
    g_assert_cmpint(retries, ==, 6);
    gb_world_destroy(world);
}

/* The guard on overlaps goes by the smaller particle, in both precisions and for any ratio
 * of sizes: below 0.5 of its diameter a pair has forces, beyond it has none. */
static void test_deep(void)
{
    static const char *const precision[] = {"numerics.precision=single",
                                            "numerics.precision=double"};
    static const char *const sigma[] = {"particles.sigma=0.001", "particles.sigma=0.5",
                                        "particles.sigma=0.7"};
    for (size_t p = 0; p < G_N_ELEMENTS(precision); p++) {
        for (size_t s = 0; s < G_N_ELEMENTS(sigma); s++) {
            const struct gb_params params =
                scene_params("particles.distribution=lognormal", sigma[s], precision[p],
                             "particles.count=8000", NULL);
            struct gb_model model = scene_model(&params);
            struct gb_world *world = two(&model, 0.0);
            const double a = gb_world_diameter(world, 0);
            const double b = gb_world_diameter(world, 1);
            g_test_message("%s: %g and %g d", sigma[s], a, b);
            gb_world_destroy(world);
            for (int deep = 0; deep < 2; deep++) {
                struct gb_error err = {0};
                world =
                    two(&model, 0.5 * (a + b) - (deep ? 0.55 : 0.45) * fmin(a, b) - 1.0);
                const bool good = gb_world_evaluate(world, &err);
                g_assert_true(good == !deep);
                g_assert_true(!deep || err.code == GB_ERR_GUARD);
                gb_world_destroy(world);
            }
        }
    }
}

/* A pressure that does not go to zero, however far the cell is let go. */
static void test_endless(void)
{
    const struct gb_params params =
        scene_params("loading.unload_from=10 MPa", "loading.until=20 MPa",
                     "loading.geometry=isotropic", "loading.step=1 %", NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_quasistatic load;
    double factor[3];
    double density = 0.3, grown = 1.0;
    gb_loading_quasistatic_init(&load, &model);
    const double top[3] = {model.unload_from[0], model.unload_from[0],
                           model.unload_from[0]};
    g_assert_cmpint(gb_loading_quasistatic_next(&load, top, density, factor), ==,
                    GB_QUASISTATIC_UNLOAD);
    enum gb_quasistatic_order order = GB_QUASISTATIC_STRAIN;
    for (int i = 0; i < 1000 && order == GB_QUASISTATIC_STRAIN; i++) {
        const double left[3] = {0.1 * top[0], 0.1 * top[0], 0.1 * top[0]};
        grown *= factor[2];
        density /= factor[0] * factor[1] * factor[2];
        order = gb_loading_quasistatic_next(&load, left, density, factor);
    }
    g_assert_cmpint(order, ==, GB_QUASISTATIC_RESTORE);
    g_assert_true(load.endless);
    g_assert_cmpfloat(grown, <, 1.6);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/guards/deep", test_deep);
    g_test_add_func("/guards/jump", test_jump);
    g_test_add_func("/guards/nonaffine", test_nonaffine);
    g_test_add_func("/guards/cycle", test_cycle);
    g_test_add_func("/guards/rounding", test_rounding);
    g_test_add_func("/guards/restarted", test_restarted);
    g_test_add_func("/guards/skin", test_skin);
    g_test_add_func("/guards/cross", test_cross);
    g_test_add_func("/guards/endless", test_endless);
    return g_test_run();
}
