/* Steps of the parameters and runs kept in memory. */
#include <glib.h>

#include "tui/session/past.h"

static void set_mu(struct gb_preset *preset, double mu)
{
    gb_preset_params(preset)->mu = mu;
}

static void test_steps(void)
{
    struct gb_param_steps steps = {.count = 0};
    struct gb_preset *preset = NULL;
    struct gb_preset *other = NULL;
    g_assert_true(gb_preset_create(&preset, NULL));
    g_assert_true(gb_preset_create(&other, NULL));
    g_assert_null(gb_past_steps_move(&steps, -1));
    gb_past_steps_note(&steps, preset);
    for (int i = 1; i <= 3; i++) {
        set_mu(preset, 0.1 * i + 0.1);
        gb_past_steps_note(&steps, preset);
        gb_past_steps_note(&steps, preset); /* nothing has changed */
    }
    g_assert_cmpint(gb_past_steps_left(&steps, -1), ==, 3);
    gb_past_steps_note(&steps, other);
    g_assert_cmpint(gb_past_steps_left(&steps, -1), ==, 4);
    g_assert_true(gb_past_steps_move(&steps, -1) == preset);
    g_assert_true(gb_past_steps_move(&steps, -1) == preset);
    g_assert_cmpfloat_with_epsilon(gb_preset_params(preset)->mu, 0.3, 1e-12);
    g_assert_cmpint(gb_past_steps_left(&steps, 1), ==, 2);
    gb_past_steps_note(&steps, preset); /* what an undo shows is no change */
    g_assert_cmpint(gb_past_steps_left(&steps, 1), ==, 2);
    g_assert_true(gb_past_steps_move(&steps, 1) == preset);
    g_assert_true(gb_past_steps_move(&steps, 1) == other);
    g_assert_null(gb_past_steps_move(&steps, 1));
    gb_past_steps_move(&steps, -1);
    set_mu(preset, 0.9);
    gb_past_steps_note(&steps, preset);
    g_assert_null(gb_past_steps_move(&steps, 1)); /* a new branch */
    for (int i = 0; i < 2 * GB_PARAM_STEPS; i++) {
        set_mu(preset, 0.001 * i);
        gb_past_steps_note(&steps, preset);
    }
    g_assert_cmpint(gb_past_steps_left(&steps, -1), ==, GB_PARAM_STEPS - 1);
    gb_past_steps_finish(&steps);
    gb_preset_destroy(preset);
    gb_preset_destroy(other);
}

/* A run of a few points, not recorded. */
static struct gb_kept_run small_run(double mu)
{
    struct gb_kept_run run = {.label = {.marker = 'a'}};
    struct gb_error err = {0};
    gb_params_init(&run.params);
    g_assert_true(gb_params_assign(&run.params, "particles.count=60", &err));
    g_assert_true(gb_params_assign(&run.params, "loading.until=0.1 MPa", &err));
    g_assert_true(gb_params_assign(&run.params, "loading.unload_from=", &err));
    run.params.mu = mu;
    if (!gb_runner_create(&run.runner, &run.params, &err)) {
        g_error("%s", err.text);
    }
    while (gb_curve_count(gb_runner_curve(run.runner)) < 2) {
        g_assert_cmpint(gb_runner_snapshot(run.runner, NULL)->state, !=, GB_RUN_FAILED);
        g_usleep(1000);
    }
    return run;
}

static void test_kept(void)
{
    struct gb_kept_runs kept = {.count = 0};
    struct gb_kept_run out;
    const struct gb_kept_run first = small_run(0.1);
    const struct gb_params params = first.params;
    gb_past_runs_add(&kept, &first);
    struct gb_kept_run quick = small_run(0.1);
    quick.quick = true;
    gb_past_runs_add(&kept, &quick);
    g_assert_cmpint(kept.count, ==, 2);
    const size_t points = gb_curve_count(gb_runner_curve(first.runner));
    g_assert_true(gb_past_runs_take(&kept, &params, false, &out));
    g_assert_true(out.runner == first.runner && out.label.marker == 'a');
    g_assert_cmpuint(gb_curve_count(gb_runner_curve(out.runner)), ==, points);
    g_assert_cmpint(gb_runner_snapshot(out.runner, NULL)->state, >=, GB_RUN_DONE);
    g_assert_false(gb_past_runs_take(&kept, &params, false, &out));
    gb_past_runs_add(&kept, &first);
    const struct gb_kept_run again = small_run(0.1); /* takes the place of the first */
    gb_past_runs_add(&kept, &again);
    g_assert_cmpint(kept.count, ==, 2);
    for (int i = 0; i < GB_KEPT_RUNS; i++) { /* these take that of all before */
        const struct gb_kept_run next = small_run(0.2 + 0.01 * i);
        gb_past_runs_add(&kept, &next);
    }
    g_assert_cmpint(kept.count, ==, GB_KEPT_RUNS);
    g_assert_false(gb_past_runs_take(&kept, &params, true, &out));
    gb_past_runs_finish(&kept);
    g_assert_cmpint(kept.count, ==, 0);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/tui/past/steps", test_steps);
    g_test_add_func("/tui/past/kept-runs", test_kept);
    return g_test_run();
}
