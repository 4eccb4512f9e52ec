/* The band between two lines of a plot. */
#include <glib.h>

#include "tui/panel/plot.h"

/* Number of a field's dots, of braille, or of its cells that are not empty. */
static int count_dots(const struct gb_plot *plot, int row, int col)
{
    const uint32_t ch = plot->cell[row * plot->cols + col].ch;
    int count = 0;
    if (plot->glyphs != GB_PLOT_BRAILLE) {
        return ch != ' ';
    }
    for (uint32_t bits = ch - 0x2800; ch >= 0x2800 && bits != 0; bits >>= 1) {
        count += (int)(bits & 1);
    }
    return count;
}

/* A band is an even tone: two dots of eight in every cell in braille, a light shade in blocks,
 * every second cell in ASCII; the line through it keeps its own dots, as without the band. */
static void test_band(void)
{
    static const double x[2] = {0.0, 1.0}, low[2] = {0.2, 0.2}, high[2] = {0.8, 0.8};
    static const double line[2] = {0.1, 0.9};
    enum { ROWS = 20, COLS = 60 };
    for (int glyphs = 0; glyphs < GB_PLOT_GLYPHS; glyphs++) {
        struct gb_plot plot[2];
        const struct gb_plot_band band = {
            .x = {x, x}, .y = {low, high}, .count = 2, .ink = GB_PLOT_INK_DIM};
        const struct gb_plot_series series = {
            .x = x, .y = line, .count = 2, .ink = GB_PLOT_INK_SERIES};
        for (int k = 0; k < 2; k++) {
            gb_plot_init(&plot[k]);
            g_assert_true(
                gb_plot_resize(&plot[k], ROWS, COLS, (enum gb_plot_glyphs)glyphs, NULL));
            gb_plot_bare(&plot[k], (double[]){0.0, 1.0}, (double[]){0.0, 1.0});
            if (k == 0) {
                gb_plot_band(&plot[k], &band);
            }
            gb_plot_line(&plot[k], &series);
        }
        char *text = gb_plot_dump(&plot[0]);
        g_test_message("%s", text);
        g_free(text);
        int cells = 0, marked = 0;
        for (int i = 0; i < ROWS * COLS; i++) {
            const int row = i / COLS;
            if (plot[1].cell[i].ch != ' ') { /* the line */
                g_assert_cmpuint(plot[0].cell[i].ch, ==, plot[1].cell[i].ch);
                g_assert_cmpint(plot[0].cell[i].ink, ==, GB_PLOT_INK_SERIES);
            } else if (row >= 5 && row < 15) {
                const int dots = count_dots(&plot[0], row, i % COLS);
                g_assert_cmpint(dots, ==,
                                glyphs == GB_PLOT_BRAILLE ? 2
                                : glyphs == GB_PLOT_BLOCK ? 1
                                                          : (row + i % COLS + 1) % 2);
                cells++;
                marked += dots > 0;
            } else if (row < 3 || row > 16) {
                g_assert_cmpuint(plot[0].cell[i].ch, ==, ' ');
            }
        }
        g_assert_cmpint(cells, >, 400);
        g_assert_cmpint(marked, >=, cells / 2 - 20);
        for (int k = 0; k < 2; k++) {
            gb_plot_finish(&plot[k]);
        }
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/tui/plot/band", test_band);
    return g_test_run();
}
