/* Time from a changed parameter to its curves: the laws within a frame, the whole quick
 * curve of 1000 particles to 1 GPa within two seconds of processor time of one core.
 * These limits are asserted with 'hard' on an idle machine; otherwise only what does not
 * depend on the machine: both laws are drawn, and the curve needs no more evaluations
 * than before.
 * Usage: test_answer [hard] */
#include <glib.h>
#include <math.h>
#include <string.h>

#include "base/clock.h"
#include "run/cost.h"
#include "run/experiment.h"
#include "tui/view/views.h"

static bool hard;

static struct gb_params powder(void)
{
    struct gb_params params;
    struct gb_error err = {0};
    static const char *const words[] = {"particles.count=8000", "loading.until=1 GPa",
                                        "loading.unload_from=100 MPa; 1 GPa",
                                        "numerics.threads=1"};
    gb_params_init(&params);
    for (size_t i = 0; i < G_N_ELEMENTS(words); i++) {
        if (!gb_params_assign(&params, words[i], &err)) {
            g_error("%s", err.text);
        }
    }
    return params;
}

/* Both laws on a screen of 200 x 60, with dim laws of the run. */
static double draw_laws(struct gb_panel_plot *panel, const struct gb_session *session)
{
    const double from = gb_clock_process_s();
    for (int i = 0; i < GB_PANEL_INSETS; i++) {
        panel->target = &panel->inset[i];
        g_assert_true(gb_plot_resize(panel->target, 20, 60, GB_PLOT_BRAILLE, NULL));
        if (i == 0) {
            gb_view_law_force(panel, session);
        } else {
            gb_view_law_strength(panel, session);
        }
        char *dump = gb_plot_dump(panel->target);
        g_assert_nonnull(strstr(dump, "h"));
        g_free(dump);
    }
    return gb_clock_process_s() - from;
}

static void test_laws(void)
{
    struct gb_preset *preset = NULL;
    struct gb_session session;
    struct gb_panel_plot panel = {.view = gb_views_at(0)};
    double least = HUGE_VAL;
    g_assert_true(gb_preset_create(&preset, NULL));
    *gb_preset_params(preset) = powder();
    gb_session_init(&session, preset);
    for (int i = 0; i < GB_PANEL_INSETS; i++) {
        gb_plot_init(&panel.inset[i]);
    }
    for (int i = 0; i < 5; i++) {
        panel.edited = powder();
        panel.edited.mu = 0.1 * (i + 1);
        least = fmin(least, draw_laws(&panel, &session));
    }
    g_test_message("both laws in %.2f ms", 1e3 * least);
    g_assert_true(!hard || least < 0.1);
    gb_panel_plot_finish(&panel);
    gb_session_finish(&session);
    gb_preset_destroy(preset);
}

/* Twice as many as today. */
enum { EVALUATIONS_MOST = 10000 };

static double press(const struct gb_params *params)
{
    struct gb_experiment *experiment = NULL;
    struct gb_error err = {0};
    const double from = gb_clock_process_s();
    int points = 0;
    if (!gb_experiment_create(&experiment, params, NULL, NULL, &err)) {
        g_error("%s", err.text);
    }
    enum gb_step_outcome how = GB_STEP_MORE;
    while (how == GB_STEP_MORE || how == GB_STEP_POINT) {
        how = gb_experiment_advance(experiment, 1000, &err);
        points += how == GB_STEP_POINT;
    }
    const double seconds = gb_clock_process_s() - from;
    g_assert_cmpint(how, ==, GB_STEP_DONE);
    g_assert_cmpfloat(gb_experiment_point(experiment)->p_pa, >=, 0.99e9);
    g_assert_cmpint(points, >, 100);
    const int64_t evaluations = gb_experiment_evaluations(experiment);
    g_test_message("%lld evaluations", (long long)evaluations);
    g_assert_cmpint(evaluations, <, EVALUATIONS_MOST);
    gb_experiment_destroy(experiment);
    return seconds;
}

/* The quick cell of 8000 particles, packing included. */
static void test_quick_curve(void)
{
    struct gb_params quick;
    const struct gb_params full = powder();
    double least = HUGE_VAL;
    g_assert_true(gb_cost_quick(&full, &quick));
    g_assert_cmpint(quick.count, ==, 1000);
    for (int i = 0; i < (hard ? 3 : 1); i++) {
        least = fmin(least, press(&quick));
    }
    g_test_message("quick curve of %lld particles to 1 GPa in %.2f s of one core",
                   (long long)quick.count, least);
    g_assert_true(!hard || least < 2.0);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    hard = argc > 1;
    g_test_add_func("/tui/answer/laws", test_laws);
    g_test_add_func("/tui/answer/quick-curve", test_quick_curve);
    return g_test_run();
}
