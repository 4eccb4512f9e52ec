/* Ranges of axes as they are typed, and axes that end there. */
#include <glib.h>
#include <math.h>

#include "tui/panel/panels.h"

static struct gb_plot_ranges parsed(const char *text)
{
    struct gb_plot_ranges ranges = {.of = {{.typed = false}}};
    struct gb_error err = {0};
    if (!gb_panel_plot_ranges_parse(&ranges, text, &err)) {
        g_error("%s", err.text);
    }
    return ranges;
}

static void assert_range(const struct gb_plot_ranges *ranges, enum gb_plot_range_of of,
                         double low, double high)
{
    g_assert_true(ranges->of[of].typed);
    g_assert_cmpfloat_with_epsilon(ranges->of[of].low, low, 1e-9 * fabs(high));
    g_assert_cmpfloat_with_epsilon(ranges->of[of].high, high, 1e-9 * fabs(high));
}

static void test_parse(void)
{
    struct gb_plot_ranges ranges = parsed("p=10 MPa:500 MPa rho=0.3:0.6");
    assert_range(&ranges, GB_PLOT_RANGE_PRESSURE, 10e6, 500e6);
    assert_range(&ranges, GB_PLOT_RANGE_DENSITY, 0.3, 0.6);
    g_assert_false(ranges.of[GB_PLOT_RANGE_TIME].typed);
    ranges = parsed(" rho = 0.3 : 0.6,p=0.01:1 GPa; drho=-0.02:0.02 ");
    assert_range(&ranges, GB_PLOT_RANGE_PRESSURE, 10e6, 1e9);
    assert_range(&ranges, GB_PLOT_RANGE_DENSITY, 0.3, 0.6);
    assert_range(&ranges, GB_PLOT_RANGE_DIFFERENCE, -0.02, 0.02);
    g_assert_true(gb_panel_plot_ranges_any(&ranges));
    g_assert_true(gb_panel_plot_ranges_inside(&ranges, GB_PLOT_RANGE_DENSITY, 0.45));
    g_assert_false(gb_panel_plot_ranges_inside(&ranges, GB_PLOT_RANGE_DENSITY, 0.61));
    g_assert_true(gb_panel_plot_ranges_inside(&ranges, GB_PLOT_RANGE_TIME, 1e9));
    ranges = parsed("  ");
    g_assert_false(gb_panel_plot_ranges_any(&ranges));
}

/* What the prompt offers sets the same ranges again. */
static void test_write(void)
{
    char text[200], again[200];
    struct gb_plot_ranges ranges = parsed("rho=0.3:0.625 p=15 MPa:1.5 GPa t=0:12");
    gb_panel_plot_ranges_write(&ranges, text, sizeof text);
    g_assert_cmpstr(text, ==, "p=15 MPa:1.5 GPa rho=0.3:0.625 t=0:12");
    ranges = parsed(text);
    gb_panel_plot_ranges_write(&ranges, again, sizeof again);
    g_assert_cmpstr(again, ==, text);
}

/* One line that says what is wrong; nothing is changed. */
static void test_refuse(void)
{
    static const char *const wrong[][2] = {
        {"rho=0.3", "two values"},
        {"rho=0.3:0.4:0.5", "two values"},
        {"rho=0.6:0.3", "below the second"},
        {"rho=0.3:0.3", "below the second"},
        {"p=-5 MPa:10 MPa", "not negative"},
        {"p=10:500", "unit"},
        {"p=10 nm:500 nm", "nm"},
        {"q=1:2", "expected ranges"},
        {"rubbish", "expected ranges"},
        {"p=10 MPa:500 MPa rubbish", "p:"},
        {"rho=a:b", "rho:"},
        {"rho=nan:0.5", "rho:"},
        {"=1:2", "expected ranges"},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(wrong); i++) {
        struct gb_plot_ranges ranges = parsed("t=1:2");
        struct gb_error err = {0};
        if (gb_panel_plot_ranges_parse(&ranges, wrong[i][0], &err)) {
            g_error("%s is taken", wrong[i][0]);
        }
        g_test_message("%s", err.text);
        g_assert_nonnull(g_strstr_len(err.text, -1, wrong[i][1]));
        assert_range(&ranges, GB_PLOT_RANGE_TIME, 1.0, 2.0);
    }
}

static void assert_ends(bool log, double low, double high)
{
    struct gb_plot plot;
    struct gb_plot_ranges ranges = {.of = {{true, low, high}}};
    double x[2] = {-1.0, 1.0};
    double y[2] = {0.0, 1.0};
    gb_plot_init(&plot);
    g_assert_true(gb_plot_resize(&plot, 12, 60, GB_PLOT_ASCII, NULL));
    plot.log_x = log;
    gb_panel_plot_ranges_x(&ranges, GB_PLOT_RANGE_PRESSURE, 1.0, &plot, x);
    gb_panel_plot_ranges_y(&ranges, GB_PLOT_RANGE_PRESSURE, 1.0, &plot, y);
    gb_plot_axes(&plot, x, y, log ? GB_PLOT_LOG : GB_PLOT_LINEAR, "x", "y");
    const struct gb_plot_axis *axis[] = {&plot.x, &plot.y};
    for (size_t i = 0; i < 2; i++) {
        g_assert_cmpfloat_with_epsilon(axis[i]->low, low, 1e-12);
        g_assert_cmpfloat_with_epsilon(axis[i]->high, high, 1e-12);
        g_assert_cmpint(axis[i]->ticks, >=, 2);
        for (int k = 0; k < axis[i]->ticks; k++) {
            const double at = gb_plot_axis_position(axis[i], axis[i]->tick[k]);
            g_assert_cmpfloat(at, >=, -1e-6);
            g_assert_cmpfloat(at, <=, 1.0 + 1e-6);
        }
    }
    gb_plot_finish(&plot);
}

static void test_ends(void)
{
    assert_ends(false, 0.301, 0.599);
    assert_ends(false, 13.0, 517.0);
    assert_ends(false, 0.41, 0.42);
    assert_ends(true, 13.0, 517.0);
    assert_ends(true, 13.0, 17.0);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/tui/ranges/parse", test_parse);
    g_test_add_func("/tui/ranges/write", test_write);
    g_test_add_func("/tui/ranges/refuse", test_refuse);
    g_test_add_func("/tui/ranges/ends", test_ends);
    return g_test_run();
}
