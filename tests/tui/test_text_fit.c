/* Texts that are cut or wrapped: an ellipsis, and no part of a number. */

#include <glib.h>
#include <string.h>

#include "tui/panel/plot.h"
#include "tui/term/paint.h"

#define ELLIPSIS "\u2026"

static void test_cells(void)
{
    static const struct {
        const char *text;
        int cols;
        const char *fitted;
    } rows[] = {
        {"mu 0.15", 7, "mu 0.15"},
        {"mu 0.15", 6, "mu " ELLIPSIS},
        {"mu 0.15", 4, "mu " ELLIPSIS},
        {"mu 0.15, alpha 0.24", 8, "mu " ELLIPSIS},
        {"mu 0.15, alpha 0.24", 9, "mu 0.15," ELLIPSIS},
        {"step 1.5e-12 s", 10, "step " ELLIPSIS}, /* not 1.5e */
        {"step 1.5e-12 s", 11, "step " ELLIPSIS},
        {"step 1.5e-12 s", 13, "step " ELLIPSIS},
        {"x -12.5 %", 6, "x -" ELLIPSIS},
        {"the rest of it", 9, "the rest" ELLIPSIS},
        {"mean 2.9 standard errors", 11, "mean " ELLIPSIS}, /* no seconds */
        {"mean 2.9 standard errors", 17, "mean " ELLIPSIS},
        {"mean 2.9 standard errors", 18, "mean 2.9 standard" ELLIPSIS},
        {"a radius of 12.5 nm at most", 19, "a radius of " ELLIPSIS},
        {"runs/default-12/curve.csv", 15, "runs/default-" ELLIPSIS},
        {"1.41421356237", 8, "1.41421" ELLIPSIS}, /* decimals of one number */
        {"1000000", 5, ELLIPSIS},
        {"1.25e-12", 6, ELLIPSIS},
        {"\u03c1 = 0.405", 5, "\u03c1 = " ELLIPSIS},
        {"\u7c89\u672b\u7c92", 4, "\u7c89" ELLIPSIS}, /* two cells each */
        {"abc", 1, ELLIPSIS},
        {"abc", 0, ""},
    };
    for (size_t k = 0; k < G_N_ELEMENTS(rows); k++) {
        char *fitted = gb_paint_fit(rows[k].text, rows[k].cols);
        g_test_message("%s in %d: %s", rows[k].text, rows[k].cols, fitted);
        g_assert_cmpstr(fitted, ==, rows[k].fitted);
        g_free(fitted);
    }
}

static void test_bytes(void)
{
    char text[12];
    g_assert_cmpstr(gb_paint_fit_copy(text, sizeof text, "mu 0.15, al"), ==,
                    "mu 0.15, al");
    g_assert_cmpstr(gb_paint_fit_copy(text, sizeof text, "alpha 0.244 a"), ==,
                    "alpha " ELLIPSIS);
    g_assert_cmpstr(
        gb_paint_fit_copy(text, sizeof text, "\u03c1\u03c1\u03c1\u03c1\u03c1x"), ==,
        "\u03c1\u03c1\u03c1\u03c1\u03c1x");
    g_assert_cmpstr(
        gb_paint_fit_copy(text, sizeof text, "\u03c1\u03c1\u03c1\u03c1\u03c1xy"), ==,
        "\u03c1\u03c1\u03c1\u03c1" ELLIPSIS);
}

/* The legend of a narrow plot, and a text that leaves the plot. */
static void test_plot(void)
{
    struct gb_plot plot;
    const double ends[2] = {0.0, 1.0};
    const struct gb_plot_entry entry = {GB_PLOT_INK_SERIES, 'a', "the quick cell: mu 0.15"};
    gb_plot_init(&plot);
    g_assert_true(gb_plot_resize(&plot, 10, 30, GB_PLOT_ASCII, NULL));
    gb_plot_axes(&plot, ends, ends, GB_PLOT_LINEAR, "", "");
    gb_plot_legend(&plot, &entry, 1);
    gb_plot_text(&plot, 4, 12, GB_PLOT_INK_TEXT, "largest force 12.5 nN");
    char *text = gb_plot_dump(&plot);
    g_test_message("%s", text);
    g_assert_nonnull(strstr(text, "a the quick cell: mu " ELLIPSIS "\n"));
    g_assert_nonnull(strstr(text, "largest force " ELLIPSIS "\n"));
    g_free(text);
    gb_plot_finish(&plot);
}

/* Rows of wrapped text: a number keeps its unit. */
static void test_wrap(void)
{
    static const struct {
        const char *text;
        int rows;
    } wrapped[] = {{"aaaa 12 nN bb", 3},  /* aaaa / 12 nN / bb */
                   {"aaaa 12 nN, b", 3},  /* aaaa / 12 nN, / b */
                   {"aaaa 12 of bb", 2},  /* aaaa 12 / of bb */
                   {"aaa no nN bb", 2},   /* aaa no / nN bb */
                   {"1 MPa 2 MPa", 2},
                   {"", 0}};
    const struct gb_paint paint = {.rect = {.rows = 9, .cols = 9}}; /* 7 between margins */
    for (size_t i = 0; i < G_N_ELEMENTS(wrapped); i++) {
        g_test_message("%s", wrapped[i].text);
        g_assert_cmpint(gb_paint_wrap_rows(&paint, 9, wrapped[i].text), ==,
                        wrapped[i].rows);
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/text_fit/cells", test_cells);
    g_test_add_func("/text_fit/bytes", test_bytes);
    g_test_add_func("/text_fit/plot", test_plot);
    g_test_add_func("/text_fit/wrap", test_wrap);
    return g_test_run();
}
