#include <glib.h>

#include "tui/app/layout.h"

enum { MOST_ROWS = 100, MOST_COLS = 300, RECTS = GB_PANES + 3 };

static void collect(const struct gb_layout *layout, struct gb_rect all[RECTS])
{
    for (int i = 0; i < GB_PANES; i++) {
        all[i] = layout->pane[i];
    }
    all[GB_PANES] = layout->header;
    all[GB_PANES + 1] = layout->message;
    all[GB_PANES + 2] = layout->footer;
}

static bool shown(const struct gb_rect *rect)
{
    return rect->rows != 0 || rect->cols != 0;
}

static void check_inside(const struct gb_rect *rect, int rows, int cols)
{
    g_assert_cmpint(rect->rows, >, 0);
    g_assert_cmpint(rect->cols, >, 0);
    g_assert_cmpint(rect->row, >=, 0);
    g_assert_cmpint(rect->col, >=, 0);
    g_assert_cmpint(rect->row + rect->rows, <=, rows);
    g_assert_cmpint(rect->col + rect->cols, <=, cols);
}

static bool overlap(const struct gb_rect *a, const struct gb_rect *b)
{
    return a->row < b->row + b->rows && b->row < a->row + a->rows &&
           a->col < b->col + b->cols && b->col < a->col + a->cols;
}

static void check(int rows, int cols, enum gb_pane focus, bool zoom)
{
    struct gb_layout layout;
    struct gb_rect all[RECTS];
    int cells = 0;
    gb_layout_make(&layout, rows, cols, focus);
    if (zoom) {
        gb_layout_zoom(&layout, focus);
    }
    collect(&layout, all);
    for (int i = 0; i < RECTS; i++) {
        if (!shown(&all[i])) {
            continue;
        }
        check_inside(&all[i], rows, cols);
        cells += all[i].rows * all[i].cols;
        for (int k = 0; k < i; k++) {
            g_assert_false(shown(&all[k]) && overlap(&all[i], &all[k]));
        }
    }
    g_assert_cmpint(cells, ==, rows * cols); /* no cell is unused */
}

static void test_all_sizes(void)
{
    for (int rows = 1; rows <= MOST_ROWS; rows++) {
        for (int cols = 1; cols <= MOST_COLS; cols++) {
            for (int focus = 0; focus < GB_PANES; focus++) {
                check(rows, cols, (enum gb_pane)focus, false);
                check(rows, cols, (enum gb_pane)focus, true);
            }
        }
    }
}

/* The layouts of the sizes that the manual names. */
static void test_promises(void)
{
    struct gb_layout layout;
    for (int focus = 0; focus < GB_PANES; focus++) {
        gb_layout_make(&layout, 24, 80, (enum gb_pane)focus);
        g_assert_cmpint(layout.kind, ==, GB_LAYOUT_FULL);
        for (int pane = 0; pane < GB_PANES; pane++) {
            g_assert_true(gb_layout_shows(&layout, (enum gb_pane)pane));
        }
    }
    gb_layout_make(&layout, 20, 60, GB_PANE_PLOT);
    g_assert_cmpint(layout.kind, ==, GB_LAYOUT_COMPACT);
    g_assert_true(gb_layout_shows(&layout, GB_PANE_PLOT));
    g_assert_true(gb_layout_shows(&layout, GB_PANE_STATE));
    gb_layout_make(&layout, 20, 60, GB_PANE_PARAMS);
    g_assert_true(gb_layout_shows(&layout, GB_PANE_PARAMS));
    gb_layout_make(&layout, 12, 40, GB_PANE_PLOT);
    g_assert_cmpint(layout.kind, ==, GB_LAYOUT_COMPACT);
    gb_layout_make(&layout, 11, 40, GB_PANE_PLOT);
    g_assert_cmpint(layout.kind, ==, GB_LAYOUT_TOO_SMALL);
    gb_layout_make(&layout, 12, 39, GB_PANE_PLOT);
    g_assert_cmpint(layout.kind, ==, GB_LAYOUT_TOO_SMALL);
}

/* A zoomed pane has the screen for itself, but for header, message and footer. */
static void test_zoom(void)
{
    struct gb_layout layout;
    for (int focus = 0; focus < GB_PANES; focus++) {
        gb_layout_make(&layout, 24, 80, (enum gb_pane)focus);
        gb_layout_zoom(&layout, (enum gb_pane)focus);
        g_assert_cmpint(layout.kind, ==, GB_LAYOUT_ZOOMED);
        for (int pane = 0; pane < GB_PANES; pane++) {
            g_assert_cmpint(gb_layout_shows(&layout, (enum gb_pane)pane), ==,
                            pane == focus);
        }
        g_assert_cmpint(layout.pane[focus].rows, ==, 20);
        g_assert_cmpint(layout.pane[focus].cols, ==, 80);
    }
    gb_layout_make(&layout, 11, 40, GB_PANE_PLOT);
    gb_layout_zoom(&layout, GB_PANE_PLOT);
    g_assert_cmpint(layout.kind, ==, GB_LAYOUT_TOO_SMALL);
}

/* The pane with the focus is on the screen wherever there is one. */
static void test_focus_is_seen(void)
{
    for (int rows = GB_LAYOUT_MIN_ROWS; rows <= MOST_ROWS; rows++) {
        for (int cols = GB_LAYOUT_MIN_COLS; cols <= MOST_COLS; cols += 7) {
            for (int focus = 0; focus < GB_PANES; focus++) {
                struct gb_layout layout;
                gb_layout_make(&layout, rows, cols, (enum gb_pane)focus);
                g_assert_true(gb_layout_shows(&layout, (enum gb_pane)focus));
                g_assert_cmpint(layout.pane[focus].rows, >=, 3);
            }
        }
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/tui/layout/all-sizes", test_all_sizes);
    g_test_add_func("/tui/layout/promises", test_promises);
    g_test_add_func("/tui/layout/zoom", test_zoom);
    g_test_add_func("/tui/layout/focus-is-seen", test_focus_is_seen);
    return g_test_run();
}
