#include <math.h>
#include <string.h>

#include <glib.h>

#include "pack/cell/world.h"
#include "run/cost.h"
#include "run/experiment.h"

/* P2's scene at its slowest rate, v5, with the paper's step. */
static struct gb_params slowest(void)
{
    static const char *const sets[] = {
        "scene.kind=dynamic",         "scene.dimension=2",
        "particles.count=1000",       "contact.mu=0.5",
        "loading.geometry=isotropic", "loading.until=density=0.95",
        "loading.rate=68 1/ms",       "numerics.time_step=0.04 T"};
    struct gb_params params;
    gb_params_init(&params);
    for (size_t i = 0; i < G_N_ELEMENTS(sets); i++) {
        g_assert_true(gb_params_assign(&params, sets[i], NULL));
    }
    return params;
}

static struct gb_cost cost_of(const struct gb_params *params, double rate)
{
    struct gb_cost cost;
    struct gb_error err = {0};
    if (!gb_cost_estimate(params, rate, &cost, &err)) {
        g_error("%s", err.text);
    }
    return cost;
}

/* Physics of P2 section 2: ln(0.95/0.5) / v / (0.04 T) is 3.2e8 steps. */
static void test_slowest(void)
{
    const struct gb_params params = slowest();
    const struct gb_cost cost = cost_of(&params, 1e7);
    g_assert_cmpfloat_with_epsilon(cost.compress_steps, 3.191e8, 1e5);
    g_assert_cmpfloat_with_epsilon(cost.relax_steps, 10e-9 / 29.581e-15, 100.0);
    g_assert_cmpfloat_with_epsilon(cost.hold_steps, 30e-9 / 29.581e-15, 100.0);
    g_assert_cmpfloat(cost.particle_steps, ==, 1000.0 * cost.steps);
    g_assert_cmpfloat(cost.seconds, ==, cost.particle_steps / 1e7);
    /* 500 of relax, 643 of compression, 1500 of hold, and the first */
    g_assert_cmpfloat_with_epsilon(cost.points, 2644.0, 2.0);
    g_assert_cmpfloat(cost.curve_bytes, >, 100.0 * cost.points);
    g_assert_false(cost.step_assumed);
}

static void test_rate_and_step(void)
{
    struct gb_params params = slowest();
    const struct gb_cost slow = cost_of(&params, 1e7);
    params.rate_per_s *= 1e4;
    const struct gb_cost fast = cost_of(&params, 1e7);
    g_assert_cmpfloat_with_epsilon(slow.compress_steps / fast.compress_steps, 1e4, 1.0);
    g_assert_cmpfloat(slow.hold_steps, ==, fast.hold_steps);
    g_assert_true(gb_params_assign(&params, "numerics.time_step=auto", NULL));
    const struct gb_cost assumed = cost_of(&params, 1e7);
    g_assert_true(assumed.step_assumed);
    g_assert_cmpfloat_with_epsilon(assumed.time_step_s / fast.time_step_s, 10.0, 1e-9);
    params.relax_s = params.hold_s = 0.0;
    g_assert_cmpfloat(cost_of(&params, 1e7).steps, ==, assumed.compress_steps);
    params.record_density = 1e-6; /* no more points than steps */
    g_assert_cmpfloat(cost_of(&params, 1e7).points, ==, assumed.compress_steps + 1.0);
}

static void test_refused(void)
{
    struct gb_params params = slowest();
    struct gb_cost cost;
    struct gb_error err = {0};
    g_assert_false(gb_cost_estimate(&params, 0.0, &cost, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    gb_params_init(&params);
    g_assert_false(gb_cost_estimate(&params, 1e7, &cost, &err));
    g_assert_nonnull(strstr(err.text, "scene.kind"));
}

static void test_unasked(void)
{
    const struct gb_params params = slowest();
    const struct gb_cost slow = cost_of(&params, 1e7), fast = cost_of(&params, 1e9);
    struct gb_error err = {0};
    char line[320];
    g_assert_true(gb_cost_check_limit(&fast, &err));
    g_assert_false(gb_cost_check_limit(&slow, &err));
    g_test_message("%s", err.text);
    g_assert_cmpint(gb_status_exit_code(err.code), ==, 2);
    g_assert_nonnull(strstr(err.text, "8 h 55 min"));
    g_assert_nonnull(strstr(err.text, "--yes"));
    g_assert_null(strchr(err.text, '\n'));
    g_test_message("%s", gb_cost_line(&slow, line, sizeof line));
    g_assert_nonnull(strstr(line, "compress 3.19e+08"));
    g_assert_nonnull(strstr(line, "8 h 55 min at 10M/s"));
}

/* State and evaluations after so many points; tried: a copy was timed before the first. */
static uint64_t hash_after(const struct gb_params *params, bool tried,
                           int64_t *evaluations)
{
    struct gb_experiment *experiment = NULL;
    struct gb_error err = {0};
    double rate = 0.0;
    bool ended = false;
    g_assert_true(gb_experiment_create(&experiment, params, NULL, NULL, &err));
    if (tried) {
        g_assert_true(gb_cost_rate_try(experiment, 1e-3, &rate, &ended, &err));
        g_assert_cmpfloat(rate, >, 0.0);
        g_assert_false(ended);
        g_assert_true(gb_cost_rate_try(experiment, 0.0, &rate, &ended, &err));
        g_assert_cmpfloat(rate, ==, 0.0);
    }
    for (int points = 0; points < 20;) {
        points += gb_experiment_advance(experiment, 100, &err) == GB_STEP_POINT;
    }
    const uint64_t hash = gb_world_hash(gb_experiment_world(experiment));
    *evaluations = gb_experiment_evaluations(experiment);
    gb_experiment_destroy(experiment);
    return hash;
}

/* A copy gives the rate: no point of the run is lost, and no bit depends on it. */
static void test_tried(void)
{
    struct gb_params params = slowest();
    int64_t evaluations[2];
    params.count = 200;
    params.threads = 1;
    params.rate_per_s = 1e9;
    params.relax_s = 0.5e-9;
    g_assert_true(hash_after(&params, true, &evaluations[0]) ==
                  hash_after(&params, false, &evaluations[1]));
    g_assert_cmpint(evaluations[0], ==, evaluations[1]);
    g_assert_cmpfloat(gb_cost_rate_assumed(&params), ==, 8e6);
    params.threads = -1; /* auto: too few particles for a second thread */
    g_assert_cmpfloat(gb_cost_rate_assumed(&params), ==, 8e6);
}

/* A full cell by its quick one: as many times longer as it has more particles, finer
 * steps and tighter tolerances, and shorter by the threads it keeps busy. */
static void test_from_quick(void)
{
    struct gb_params full;
    struct gb_params quick;
    gb_params_init(&full);
    full.threads = 1;
    full.count = 8000;
    full.fidelity = GB_FIDELITY_FAST;
    full.unload_count = 0;
    g_assert_true(gb_cost_quick(&full, &quick));
    g_assert_cmpfloat(gb_cost_from_quick(&full, &quick, 2.0), ==, 16.0);
    full.fidelity = GB_FIDELITY_BALANCED;
    const double balanced = gb_cost_from_quick(&full, &quick, 2.0);
    g_assert_cmpfloat(balanced, >, 30.0); /* 2.1 times as many sweeps were counted */
    g_assert_cmpfloat(balanced, <, 45.0);
    full.fidelity = GB_FIDELITY_REFERENCE;
    const double reference = gb_cost_from_quick(&full, &quick, 2.0);
    g_assert_cmpfloat(reference, >, 30.0 * 16.0); /* 36 times */
    g_assert_cmpfloat(reference, <, 45.0 * 16.0);
    full.unload_count = 2;
    g_assert_cmpfloat(gb_cost_from_quick(&full, &quick, 2.0), >, reference);
    full.kind = GB_KIND_DYNAMIC;
    g_assert_true(isnan(gb_cost_from_quick(&full, &quick, 2.0)));
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/cost/slowest", test_slowest);
    g_test_add_func("/cost/rate-and-step", test_rate_and_step);
    g_test_add_func("/cost/refused", test_refused);
    g_test_add_func("/cost/unasked", test_unasked);
    g_test_add_func("/cost/tried", test_tried);
    g_test_add_func("/cost/from-quick", test_from_quick);
    return g_test_run();
}
