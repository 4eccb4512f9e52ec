#include <glib.h>
#include <string.h>

#include "tui/session/run_lifecycle.h"

/* Discs of P2 at a loading rate, without measured speed, on one core. */
static struct gb_params planar(const char *rate, const char *time_step)
{
    static const char *const scene[] = {"scene.kind=dynamic",
                                        "scene.dimension=2",
                                        "particles.count=1000",
                                        "particles.diameter=10 nm",
                                        "structure.density=0.5",
                                        "loading.geometry=isotropic",
                                        "loading.until=density = 0.95",
                                        "loading.relax=10 ns",
                                        "loading.hold=30 ns"};
    struct gb_params params;
    struct gb_error err = {0};
    gb_params_init(&params);
    for (size_t i = 0; i < G_N_ELEMENTS(scene); i++) {
        if (!gb_params_assign(&params, scene[i], &err)) {
            g_error("%s", err.text);
        }
    }
    char *assign = g_strdup_printf("loading.rate=%s", rate);
    g_assert_true(gb_params_assign(&params, assign, &err));
    g_free(assign);
    assign = g_strdup_printf("numerics.time_step=%s", time_step);
    g_assert_true(gb_params_assign(&params, assign, &err));
    g_free(assign);
    return params;
}

static bool asks(const char *rate, const char *time_step, double measured)
{
    const struct gb_params params = planar(rate, time_step);
    char text[400] = "";
    const bool needed = gb_run_lifecycle_cost_question(&params, measured, text, sizeof text);
    g_test_message("%s %s: %s", rate, time_step, text);
    return needed;
}

/* All rates of the paper, at its step and at the chosen one. */
static void test_rates(void)
{
    g_assert_false(asks("6.8e8 1/s", "auto", 0.0));
    g_assert_false(asks("6.8e7 1/s", "auto", 0.0));
    g_assert_false(asks("6.8e6 1/s", "auto", 0.0));
    g_assert_false(asks("6.8e5 1/s", "auto", 0.0));
    g_assert_true(asks("6.8e4 1/s", "auto", 0.0));
    g_assert_false(asks("6.8e6 1/s", "0.04 T", 0.0));
    g_assert_true(asks("6.8e5 1/s", "0.04 T", 0.0));
    g_assert_true(asks("6.8e4 1/s", "0.04 T", 0.0));
}

static void test_measured(void)
{
    g_assert_false(asks("6.8e4 1/s", "auto", 2e7));
    g_assert_true(asks("6.8e5 1/s", "auto", 1e5));
}

static void test_text(void)
{
    struct gb_params params = planar("6.8e4 1/s", "0.04 T");
    char text[400];
    g_assert_true(gb_run_lifecycle_cost_question(&params, 1e7, text, sizeof text));
    g_assert_nonnull(strstr(text, "8 h 55 min"));
    g_assert_nonnull(strstr(text, "3.2e+08 steps of 29.6 fs"));
    g_assert_nonnull(strstr(text, "as the last run"));
    g_assert_nonnull(strstr(text, "loading.rate"));
    g_assert_nonnull(strstr(text, "numerics.time_step = auto"));
    g_assert_cmpuint(strlen(text), <, sizeof text - 1);
    params = planar("6.8e8 1/s", "auto");
    params.hold_s = 1e-4;
    g_assert_true(gb_run_lifecycle_cost_question(&params, 0.0, text, sizeof text));
    g_assert_nonnull(strstr(text, "loading.relax or hold"));
    g_assert_nonnull(strstr(text, "(assumed)"));
    g_assert_null(strstr(text, "time_step"));
}

/* No question without an estimate and for invalid parameters. */
static void test_others(void)
{
    struct gb_params params;
    char text[400];
    gb_params_init(&params);
    g_assert_false(gb_run_lifecycle_cost_question(&params, 1.0, text, sizeof text));
    params = planar("6.8e4 1/s", "auto");
    params.until_density = params.structure_density / 2.0;
    g_assert_false(gb_run_lifecycle_cost_question(&params, 0.0, text, sizeof text));
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/tui/cost_confirm/rates", test_rates);
    g_test_add_func("/tui/cost_confirm/measured", test_measured);
    g_test_add_func("/tui/cost_confirm/text", test_text);
    g_test_add_func("/tui/cost_confirm/others", test_others);
    return g_test_run();
}
