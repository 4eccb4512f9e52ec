#include "tui/app/layout.h"

#include <string.h>

/* Fixed widths and heights of the panes, characters; the plot takes the remaining
 * area. */
enum {
    PARAMS_COLS = 31,
    PARAMS_COLS_ROOMY = 37,
    SIDE_COLS = 33,
    SIDE_COLS_ROOMY = 42,
    WIDE_COLS = 116,
    ROOMY_COLS = 160,
    STATE_ROWS = 6,
    STATE_ROWS_SIDE = 20,
    STATE_ROWS_COMPACT = 4,
    STATE_ROWS_TINY = 3,
    EVENTS_ROWS = 3
};

static struct gb_rect rect(int row, int col, int rows, int cols)
{
    return (struct gb_rect){row, col, rows, cols};
}

static int limited(int value, int limit)
{
    return value < limit ? value : limit;
}

/* Cuts off header, message and footer; returns the area between. */
static struct gb_rect cut_edges(struct gb_layout *layout, int rows, int cols,
                                int message_rows)
{
    layout->header = rect(0, 0, 1, cols);
    layout->footer = rect(rows - 1, 0, 1, cols);
    layout->message = rect(rows - 1 - message_rows, 0, message_rows, cols);
    return rect(1, 0, rows - 2 - message_rows, cols);
}

static void make_compact(struct gb_layout *layout, int rows, int cols, enum gb_pane focus)
{
    const struct gb_rect body = cut_edges(layout, rows, cols, rows >= 20 ? 2 : 1);
    if (focus == GB_PANE_PARAMS || focus == GB_PANE_EVENTS) {
        layout->pane[focus] = body;
        return;
    }
    const int state = rows >= 20 ? STATE_ROWS_COMPACT : STATE_ROWS_TINY;
    layout->pane[GB_PANE_PLOT] = rect(body.row, 0, body.rows - state, cols);
    layout->pane[GB_PANE_STATE] = rect(body.row + body.rows - state, 0, state, cols);
}

static void make_full(struct gb_layout *layout, int rows, int cols)
{
    const struct gb_rect body = cut_edges(layout, rows, cols, 2);
    const int col = PARAMS_COLS;
    const int width = cols - col;
    const int events = EVENTS_ROWS + limited((rows - GB_LAYOUT_FULL_ROWS) / 4, 5);
    const int plot = body.rows - STATE_ROWS - events;
    layout->pane[GB_PANE_PARAMS] = rect(body.row, 0, body.rows, col);
    layout->pane[GB_PANE_PLOT] = rect(body.row, col, plot, width);
    layout->pane[GB_PANE_STATE] = rect(body.row + plot, col, STATE_ROWS, width);
    layout->pane[GB_PANE_EVENTS] = rect(body.row + plot + STATE_ROWS, col, events, width);
}

static void make_wide(struct gb_layout *layout, int rows, int cols)
{
    const struct gb_rect body = cut_edges(layout, rows, cols, 2);
    const bool roomy = cols >= ROOMY_COLS;
    const int left = roomy ? PARAMS_COLS_ROOMY : PARAMS_COLS;
    const int side = roomy ? SIDE_COLS_ROOMY : SIDE_COLS;
    const int state = limited(STATE_ROWS_SIDE, body.rows - EVENTS_ROWS - 1);
    layout->pane[GB_PANE_PARAMS] = rect(body.row, 0, body.rows, left);
    layout->pane[GB_PANE_PLOT] = rect(body.row, left, body.rows, cols - left - side);
    layout->pane[GB_PANE_STATE] = rect(body.row, cols - side, state, side);
    layout->pane[GB_PANE_EVENTS] =
        rect(body.row + state, cols - side, body.rows - state, side);
}

void gb_layout_make(struct gb_layout *layout, int rows, int cols, enum gb_pane focus)
{
    memset(layout, 0, sizeof *layout);
    if (rows < GB_LAYOUT_MIN_ROWS || cols < GB_LAYOUT_MIN_COLS) {
        layout->kind = GB_LAYOUT_TOO_SMALL;
        layout->message = rect(0, 0, rows, cols);
    } else if (rows < GB_LAYOUT_FULL_ROWS || cols < GB_LAYOUT_FULL_COLS) {
        layout->kind = GB_LAYOUT_COMPACT;
        make_compact(layout, rows, cols, focus);
    } else if (cols < WIDE_COLS) {
        layout->kind = GB_LAYOUT_FULL;
        make_full(layout, rows, cols);
    } else {
        layout->kind = GB_LAYOUT_WIDE;
        make_wide(layout, rows, cols);
    }
}

void gb_layout_zoom(struct gb_layout *layout, enum gb_pane focus)
{
    if (layout->kind != GB_LAYOUT_TOO_SMALL) {
        const int first = layout->header.row + layout->header.rows;
        memset(layout->pane, 0, sizeof layout->pane);
        layout->kind = GB_LAYOUT_ZOOMED;
        layout->pane[focus] =
            rect(first, 0, layout->message.row - first, layout->header.cols);
    }
}

bool gb_layout_shows(const struct gb_layout *layout, enum gb_pane pane)
{
    return layout->pane[pane].rows > 0 && layout->pane[pane].cols > 0;
}
