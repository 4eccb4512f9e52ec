#include <glib.h>
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "tui/panel/plot.h"

enum { POINTS = 101 };

static double xs[POINTS], ys[POINTS];

static const char golden_braille[] = "1000┤ p, MPa                          ⢀●\n"
                                     "    │                               ⢀⠔⠁\n"
                                     "    │                             ⢀⡰⠉\n"
                                     "    │                           ⢀⡰⠊\n"
                                     " 500┤                         ⡠⠖⠉\n"
                                     "    │                     ⢀⡠⠔⠋\n"
                                     "    │                 ⣀⡠⠴⠚⠉\n"
                                     "   0┤⣀⣀⣀⣀⣀⣀⣀⣀⣀⠤⠤⠤⠤⠒⠒⠋⠉           density\n"
                                     "    └──────┬──────────┬──────────┬──────\n"
                                     "          0.3        0.4        0.5\n";

static const char golden_block[] = "1000┤ p, MPa                          ▄●\n"
                                   "    │                               ▄█▀\n"
                                   "    │                             ▄█▀\n"
                                   "    │                           ▄█▀\n"
                                   " 500┤                        ▄▄▀▀\n"
                                   "    │                     ▄▄▀▀\n"
                                   "    │                ▄▄▄█▀▀\n"
                                   "   0┤▄▄▄▄▄▄▄▄▄▄▄█▀▀▀▀▀           density\n"
                                   "    └──────┬──────────┬──────────┬──────\n"
                                   "          0.3        0.4        0.5\n";

static const char golden_ascii[] = "1000+ p, MPa                          .*\n"
                                   "    |                               .:'\n"
                                   "    |                             .:'\n"
                                   "    |                           .:'\n"
                                   " 500+                        ..''\n"
                                   "    |                     ..''\n"
                                   "    |                ...:''\n"
                                   "   0+...........:'''''           density\n"
                                   "    +------+----------+----------+------\n"
                                   "          0.3        0.4        0.5\n";

static const char golden_log[] = "1000+ p, MPa                    .....''*\n"
                                 "    |                    ...:''''\n"
                                 " 100+               ..:'''\n"
                                 "    |           ..''\n"
                                 "    |        ..''\n"
                                 "  10+      .''\n"
                                 "    |    .:'\n"
                                 "   1+   .'                       density\n"
                                 "    +------+----------+----------+------\n"
                                 "          0.3        0.4        0.5\n";

static const char golden_legend[] = "1000+ p, MPa                    |     .*\n"
                                    "    | * load                    |   .:'\n"
                                    "    | a mu 0.2                  | .:'\n"
                                    "    |---------------------------+:'-----\n"
                                    " 500+                        ..''\n"
                                    "    |                     ..''  |\n"
                                    "    |                ...:''     |\n"
                                    "   0+...........:'''''          |density\n"
                                    "    +------+----------+----------+------\n"
                                    "          0.3        0.4        0.5\n";

static const char golden_groups[] =
    "1000+ p, MPa                    .:' .: .:' .:'..' .:' .: .:' .:'..' .:' .:\n"
    "    |                        ..:'..' .:'..''.:'..:'..' .:'..''.:'..:'..'\n"
    "    |                      .:* .:o..# .:+ .^'.:v .:@..* .:o .#'.:+ .:^\n"
    "    |                    .''.:' .:'..''.:' .''.:' .:'..''.:' .''.:'\n"
    " 100+                 .:' .:'..' .:'..:'.:' .:'..' .:'..:'.:' .:'\n"
    "    |               .*'.:o .#'..+'.^' .v'.:@ .*'..o'.#' .+'.:^\n"
    "    |            .:' .:'.:''.:'..''.:' .:'.:''.:'..''.:' .:'\n"
    "  10+          .''.:' .:'.:''.:' .''.:' .:'.:''.:' .''.:'\n"
    "    |       .*' .o'.#' .+'.^''.v' .@'.*' .o'.#''.+' .^'\n"
    "    |     .''.:' .:'..' .:' .''.:' .:'..' .:' .''.:'\n"
    "    |  .:' .''.:''.:'..''.:' .''.:''.:'..''.:' .''\n"
    "   1+*:' o' #:' +''^:' v:' @' *:' o''#:' +:' ^'                        density\n"
    "    ++--------+--------+--------+--------+--------+--------+--------+--------+\n"
    "   0.25     0.30     0.35     0.40     0.45     0.50     0.55     0.60    0.65\n"
    "* alpha = 0.10, mu = 0.0, 2 cells  @ alpha = 0.20, mu = 0.2, 2 cells\n"
    "o alpha = 0.10, mu = 0.1, 2 cells  * alpha = 0.20, mu = 0.3, 2 cells\n"
    "# alpha = 0.10, mu = 0.2, 2 cells  o alpha = 0.30, mu = 0.0, 2 cells\n"
    "+ alpha = 0.10, mu = 0.3, 2 cells  # alpha = 0.30, mu = 0.1, 2 cells\n"
    "^ alpha = 0.20, mu = 0.0, 2 cells  + alpha = 0.30, mu = 0.2, 2 cells\n"
    "v alpha = 0.20, mu = 0.1, 2 cells  ^ alpha = 0.30, mu = 0.3, 2 cells\n";

static const char golden_bars[] = "40┤ %           ███\n"
                                  "  │             ███ ▇▇▇\n"
                                  "  │             ███ ███\n"
                                  "20┤             ███ ███  ▂▂▂\n"
                                  "  │         ▄▄▄ ███ ███  ███\n"
                                  " 0┤    ▃▃▃  ███ ███ ███  ███\n"
                                  "  └┬────────┬───────┬────────┬\n"
                                  "   0        2       4        6\n";

/* A curve like a compaction curve. */
static void make_curve(void)
{
    for (int i = 0; i < POINTS; i++) {
        xs[i] = 0.24 + 0.0032 * i;
        ys[i] = 1000.0 * pow(i / 100.0, 3.0);
    }
}

static struct gb_plot plot_of(int rows, int cols, enum gb_plot_glyphs glyphs)
{
    struct gb_plot plot;
    gb_plot_init(&plot);
    g_assert_true(gb_plot_resize(&plot, rows, cols, glyphs, NULL));
    return plot;
}

static void draw(struct gb_plot *plot, bool log_y)
{
    const double x_ends[2] = {xs[0], xs[POINTS - 1]};
    const double y_ends[2] = {log_y ? 1.0 : 0.0, 1000.0};
    gb_plot_axes(plot, x_ends, y_ends, log_y ? GB_PLOT_LOG : GB_PLOT_LINEAR, "density",
                 "p, MPa");
    const struct gb_plot_series series = {
        .x = xs, .y = ys, .count = POINTS, .ink = GB_PLOT_INK_SERIES, .marker = 1};
    gb_plot_line(plot, &series);
}

static void check_text(struct gb_plot *plot, const char *golden)
{
    char *text = gb_plot_dump(plot);
    g_assert_cmpstr(text, ==, golden);
    g_free(text);
    gb_plot_finish(plot);
}

static void test_braille(void)
{
    struct gb_plot plot = plot_of(10, 40, GB_PLOT_BRAILLE);
    draw(&plot, false);
    check_text(&plot, golden_braille);
}

static void test_block(void)
{
    struct gb_plot plot = plot_of(10, 40, GB_PLOT_BLOCK);
    draw(&plot, false);
    check_text(&plot, golden_block);
}

static void test_ascii(void)
{
    struct gb_plot plot = plot_of(10, 40, GB_PLOT_ASCII);
    draw(&plot, false);
    check_text(&plot, golden_ascii);
}

static void test_log(void)
{
    struct gb_plot plot = plot_of(10, 40, GB_PLOT_ASCII);
    draw(&plot, true);
    check_text(&plot, golden_log);
}

static void test_legend_and_cursor(void)
{
    struct gb_plot plot = plot_of(10, 40, GB_PLOT_ASCII);
    const struct gb_plot_entry entry[2] = {{GB_PLOT_INK_SERIES, 1, "load"},
                                           {GB_PLOT_INK_DIM, 'a', "mu 0.2"}};
    draw(&plot, false);
    gb_plot_legend(&plot, entry, 2);
    gb_plot_cursor(&plot, xs[80], ys[80]);
    check_text(&plot, golden_legend);
}

/* Curves of a sweep over two parameters, which fan out over the whole field. */
static void draw_fan(struct gb_plot *plot, struct gb_plot_entry *entry, int count,
                     int foot)
{
    plot->foot = foot;
    const double x_ends[2] = {0.25, 0.65}, y_ends[2] = {1.0, 1000.0};
    double x[POINTS], y[POINTS];
    gb_plot_axes(plot, x_ends, y_ends, GB_PLOT_LOG, "density", "p, MPa");
    for (int g = 0; g < count; g++) {
        for (int i = 0; i < POINTS; i++) {
            y[i] = pow(10.0, 3.0 * i / (POINTS - 1));
            x[i] = 0.25 + 0.02 * g * 12 / count + 0.16 * i / (POINTS - 1);
        }
        const int ink = GB_PLOT_INK_SERIES + g % GB_PLOT_COLOURS, marker = 1 + g % 7;
        gb_plot_line(plot, &(struct gb_plot_series){.x = x,
                                                    .y = y,
                                                    .count = POINTS,
                                                    .ink = ink,
                                                    .marker = marker,
                                                    .spacing = 8});
        entry[g] = (struct gb_plot_entry){.ink = ink, .marker = marker};
        g_snprintf(entry[g].name, GB_PLOT_NAME, "alpha = %.2f, mu = %.1f, 2 cells",
                   0.1 * (1 + g / 4), 0.1 * (g % 4));
    }
}

/* The curves with their legend as a view draws them: in a foot where there is no other
 * room. */
static bool draw_whole(struct gb_plot *plot, int count, int foot, size_t *covered)
{
    struct gb_plot_entry entry[24];
    const int rows = plot->rows, cols = plot->cols;
    g_assert_true(gb_plot_resize(plot, rows, cols, GB_PLOT_ASCII, NULL));
    draw_fan(plot, entry, count, foot);
    const size_t cells = (size_t)rows * (size_t)cols;
    struct gb_plot_cell *before = g_memdup2(plot->cell, cells * sizeof *plot->cell);
    const bool whole = gb_plot_legend(plot, entry, count);
    *covered = 0;
    for (size_t c = 0; c < cells; c++) {
        *covered += before[c].ch != ' ' && before[c].ch != plot->cell[c].ch;
    }
    g_free(before);
    const int needed = gb_plot_legend_foot(plot, entry, count);
    return whole || foot > 0 ? whole : draw_whole(plot, count, needed, covered);
}

/* For any number of curves the legend covers none of them, and counts the entries left
 * out. */
static void test_crowded_legend(void)
{
    size_t covered = 0;
    for (int count = 1; count <= 24; count++) {
        for (int rows = 12; rows <= 22; rows += 5) {
            struct gb_plot plot = plot_of(rows, 78, GB_PLOT_ASCII);
            const bool whole = draw_whole(&plot, count, 0, &covered);
            char *text = gb_plot_dump(&plot);
            g_assert_cmpuint(covered, ==, 0);
            g_assert_nonnull(strstr(text, "alpha = 0.10, mu = 0.0, 2 cells"));
            g_assert_true(whole || strstr(text, " more") != NULL);
            g_free(text);
            gb_plot_finish(&plot);
        }
    }
    struct gb_plot plot = plot_of(20, 78, GB_PLOT_ASCII);
    g_assert_true(draw_whole(&plot, 12, 0, &covered));
    check_text(&plot, golden_groups);
}

static void test_bars(void)
{
    struct gb_plot plot = plot_of(8, 30, GB_PLOT_BRAILLE);
    const double x_ends[2] = {0.0, 6.0};
    const double y_ends[2] = {0.0, 40.0};
    static const double share[6] = {0.0, 2.5, 10.0, 40.0, 32.5, 15.0};
    gb_plot_axes(&plot, x_ends, y_ends, GB_PLOT_LINEAR, "", "%");
    for (int i = 0; i < 6; i++) {
        gb_plot_bar(&plot, i, i + 1.0, share[i], GB_PLOT_INK_SERIES);
    }
    check_text(&plot, golden_bars);
}

/* NaN, infinities and distant points: the line is interrupted or clipped, and no cell
 * outside the field is written. */
static void test_clipping(void)
{
    static const double x[] = {0.1, 0.5, NAN, 0.6, 1e300, -5.0, 0.5, INFINITY, 0.5};
    static const double y[] = {0.1, 9.0, 0.5, -1e300, 0.5, 0.5, NAN, 0.5, 1e308};
    const double ends[2] = {0.0, 1.0};
    for (int glyphs = 0; glyphs < GB_PLOT_GLYPHS; glyphs++) {
        for (int log_y = 0; log_y < 2; log_y++) {
            struct gb_plot plot = plot_of(12, 30, (enum gb_plot_glyphs)glyphs);
            gb_plot_axes(&plot, ends, ends, log_y == 1 ? GB_PLOT_LOG : GB_PLOT_LINEAR, "",
                         "");
            const struct gb_plot_series series = {.x = x,
                                                  .y = y,
                                                  .count = G_N_ELEMENTS(x),
                                                  .ink = GB_PLOT_INK_SERIES,
                                                  .marker = 2,
                                                  .spacing = 1};
            gb_plot_line(&plot, &series);
            for (int i = 0; i < plot.rows * plot.cols; i++) {
                const int row = i / plot.cols;
                const int col = i % plot.cols;
                const bool field = row >= plot.top && row < plot.top + plot.field_rows &&
                                   col >= plot.left && col < plot.left + plot.field_cols;
                g_assert_true(field || plot.cell[i].ink != GB_PLOT_INK_SERIES);
            }
            gb_plot_finish(&plot);
        }
    }
}

static void test_nan_breaks(void)
{
    const double x[] = {0.0, 0.2, 0.4, 0.6, 0.8, 1.0};
    const double y[] = {0.5, 0.5, 0.5, NAN, 0.5, 0.5};
    const double ends[2] = {0.0, 1.0};
    struct gb_plot plot = plot_of(1, 11, GB_PLOT_ASCII);
    gb_plot_bare(&plot, ends, ends);
    const struct gb_plot_series series = {
        .x = x, .y = y, .count = 6, .ink = GB_PLOT_INK_SERIES};
    gb_plot_line(&plot, &series);
    check_text(&plot, ".....   ...\n");
}

/* Any size, including extreme ones, with all elements. */
static void test_all_sizes(void)
{
    struct gb_plot plot;
    gb_plot_init(&plot);
    const struct gb_plot_entry entry = {GB_PLOT_INK_SERIES, 1, "a name"};
    for (int rows = 0; rows <= 30; rows++) {
        for (int cols = 0; cols <= 60; cols++) {
            for (int glyphs = 0; glyphs < GB_PLOT_GLYPHS; glyphs++) {
                g_assert_true(
                    gb_plot_resize(&plot, rows, cols, (enum gb_plot_glyphs)glyphs, NULL));
                draw(&plot, rows % 2 == 0);
                gb_plot_bar(&plot, 0.3, 0.4, 500.0, GB_PLOT_INK_SERIES);
                gb_plot_cursor(&plot, 0.4, 100.0);
                gb_plot_legend(&plot, &entry, 1);
            }
        }
    }
    gb_plot_finish(&plot);
}

static void check_axis(double low, double high, bool log_y, int most)
{
    struct gb_plot_axis axis;
    gb_plot_axis_fit(&axis, low, high, log_y, most);
    g_assert_cmpfloat(axis.low, <, axis.high);
    g_assert_true(isfinite(axis.low) && isfinite(axis.high));
    g_assert_cmpint(axis.ticks, >=, 1);
    for (int i = 0; i < axis.ticks; i++) {
        const double position = gb_plot_axis_position(&axis, axis.tick[i]);
        g_assert_cmpfloat(position, >=, -1e-6);
        g_assert_cmpfloat(position, <=, 1.0 + 1e-6);
        g_assert_true(i == 0 || axis.tick[i] > axis.tick[i - 1]);
        g_assert_cmpuint(strlen(axis.text[i]), >, 0);
    }
    if (isfinite(low) && isfinite(high) && !axis.log) {
        /* far less than a dot */
        const double slack = 1e-8 * (axis.high - axis.low);
        g_assert_cmpfloat(axis.low, <=, fmin(low, high) + slack);
        g_assert_cmpfloat(axis.high, >=, fmax(low, high) - slack);
    }
}

static void test_axes(void)
{
    static const double value[] = {0.0,   1.0,   -1.0,  0.24,    0.2401, 0.5745,
                                   123.0, 999.9, 1000., 1e-9,    3e12,   -250.0,
                                   1e-3,  7e4,   NAN,   INFINITY};
    for (size_t i = 0; i < G_N_ELEMENTS(value); i++) {
        for (size_t k = 0; k < G_N_ELEMENTS(value); k++) {
            for (int most = 2; most <= 12; most += 2) {
                check_axis(value[i], value[k], false, most);
                check_axis(value[i], value[k], true, most);
            }
        }
    }
}

static void test_tick_texts(void)
{
    struct gb_plot_axis axis;
    gb_plot_axis_fit(&axis, 0.24, 0.58, false, 6);
    g_assert_cmpstr(axis.text[0], ==, "0.3");
    g_assert_cmpstr(axis.text[axis.ticks - 1], ==, "0.5");
    gb_plot_axis_fit(&axis, 1.0, 1000.0, true, 5);
    g_assert_cmpint(axis.ticks, ==, 4);
    g_assert_cmpstr(axis.text[0], ==, "1");
    g_assert_cmpstr(axis.text[3], ==, "1000");
}

static void test_out_of_memory(void)
{
    struct gb_plot plot;
    struct gb_error err = {0};
    for (long k = 1; k <= 2; k++) {
        gb_plot_init(&plot);
        gb_alloc_fail_after(k);
        g_assert_false(gb_plot_resize(&plot, 10, 10, GB_PLOT_ASCII, &err));
        g_assert_cmpint(err.code, ==, GB_ERR_MEMORY);
        gb_alloc_fail_after(0);
        gb_plot_finish(&plot);
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    make_curve();
    g_test_add_func("/tui/plot/braille", test_braille);
    g_test_add_func("/tui/plot/block", test_block);
    g_test_add_func("/tui/plot/ascii", test_ascii);
    g_test_add_func("/tui/plot/log", test_log);
    g_test_add_func("/tui/plot/legend-and-cursor", test_legend_and_cursor);
    g_test_add_func("/tui/plot/crowded-legend", test_crowded_legend);
    g_test_add_func("/tui/plot/bars", test_bars);
    g_test_add_func("/tui/plot/clipping", test_clipping);
    g_test_add_func("/tui/plot/nan-breaks", test_nan_breaks);
    g_test_add_func("/tui/plot/all-sizes", test_all_sizes);
    g_test_add_func("/tui/plot/axes", test_axes);
    g_test_add_func("/tui/plot/tick-texts", test_tick_texts);
    g_test_add_func("/tui/plot/out-of-memory", test_out_of_memory);
    return g_test_run();
}
