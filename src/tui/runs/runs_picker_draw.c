#include <ncurses.h>
#include <stdio.h>

#include "io/runs/run_line.h"
#include "tui/runs/runs_picker_private.h"

enum {
    MIN_ROWS = 12,
    MIN_COLS = 40,
    ALL_COLS = 76, /* from here on with density and pressure */
    ABOVE = 4,     /* header, filter, blank line, head */
    BELOW = 3      /* directory, note or question, keys */
};

static void draw_header(const struct gb_runs_picker *picker, const struct gb_paint *paint)
{
    int64_t bytes = 0;
    int live = 0;
    char text[96];
    for (guint i = 0; i < picker->items->len; i++) {
        const struct gb_run_list_item *item = g_ptr_array_index(picker->items, i);
        bytes += item->bytes;
        live += item->engine != GB_RUN_LIST_NONE;
    }
    char *size = gb_run_line_size(bytes);
    snprintf(text, sizeof text, "%u run%s, %d live, %s", picker->items->len,
             picker->items->len == 1 ? "" : "s", live, size);
    gb_paint_text(paint, 0, 1, GB_STYLE_BOLD, "greenbody");
    gb_paint_text(paint, 0, MAX(paint->rect.cols - gb_paint_width(text) - 1, 12),
                  GB_STYLE_PLAIN, text);
    g_free(size);
}

static enum gb_style style_of(const struct gb_run_list_item *item, bool focused)
{
    return focused                            ? GB_STYLE_SELECTED
           : item->engine != GB_RUN_LIST_NONE ? GB_STYLE_GOOD
                                              : GB_STYLE_PLAIN;
}

static void draw_row(const struct gb_paint *paint, int row, const char *name,
                     const char *values, enum gb_style style)
{
    const int width = gb_paint_width(values);
    const int cols = MAX(paint->rect.cols - 2 - width - 2, 1);
    const int col = gb_paint_cell(paint, row, 1, cols, style, name);
    gb_paint_cell(paint, row, col, paint->rect.cols - 1 - col, style, "");
    gb_paint_text(paint, row, col + 2, style, values);
}

static void draw_list(struct gb_runs_picker *picker, const struct gb_paint *paint)
{
    const enum gb_run_line_extent extent =
        paint->rect.cols >= ALL_COLS ? GB_RUN_LINE_ALL : GB_RUN_LINE_BRIEF;
    const int count = (int)picker->shown->len;
    char *head = gb_run_line_head(extent);
    draw_row(paint, ABOVE - 1, "name", head, GB_STYLE_DIM);
    g_free(head);
    picker->page = paint->rect.rows - ABOVE - BELOW;
    picker->top = CLAMP(picker->top, picker->focus - picker->page + 1, picker->focus);
    picker->top = MAX(MIN(picker->top, count - picker->page), 0);
    for (int i = 0; i < picker->page && picker->top + i < count; i++) {
        const struct gb_run_list_item *item = gb_runs_picker_at(picker, picker->top + i);
        char *values = gb_run_line_values(item, extent);
        draw_row(paint, ABOVE + i, item->name, values,
                 style_of(item, picker->top + i == picker->focus));
        g_free(values);
    }
    if (count == 0) {
        gb_paint_text(paint, ABOVE, 1, GB_STYLE_DIM, "no run matches");
    }
}

/* Directory of the focused run, a question or a note, the keys. */
static void draw_foot(const struct gb_runs_picker *picker, const struct gb_paint *paint)
{
    const struct gb_run_list_item *item = gb_runs_picker_focused(picker);
    const int row = paint->rect.rows - BELOW;
    const int cols = paint->rect.cols - 2;
    char text[400];
    if (item != NULL) {
        snprintf(text, sizeof text, "%.100s: %.250s", item->title, item->directory);
        gb_paint_cell(paint, row, 1, cols, GB_STYLE_DIM, text);
    }
    if (picker->asks && item != NULL) {
        char *size = gb_run_line_size(item->bytes);
        snprintf(text, sizeof text, "Delete it, %d files, %s? y deletes, n keeps",
                 picker->files, size);
        gb_paint_cell(paint, row + 1, 1, cols, GB_STYLE_WARN, text);
        g_free(size);
    } else {
        gb_paint_cell(paint, row + 1, 1, cols, picker->note_style, picker->note);
    }
    gb_paint_cell(paint, row + 2, 1, cols, GB_STYLE_DIM,
                  "Enter shows  Del ^D deletes  typing filters  Esc leaves");
}

void gb_runs_picker_draw(struct gb_runs_picker *picker, const struct gb_term *term)
{
    int rows = 0;
    int cols = 0;
    gb_term_size(term, &rows, &cols);
    const struct gb_paint paint = gb_paint_at(term, (struct gb_rect){0, 0, rows, cols});
    erase();
    if (rows < MIN_ROWS || cols < MIN_COLS) {
        char text[96];
        snprintf(text, sizeof text, "greenbody needs %d x %d, has %d x %d; Esc leaves",
                 MIN_COLS, MIN_ROWS, cols, rows);
        gb_paint_wrap(&paint, 0, rows, GB_STYLE_PLAIN, text);
        return;
    }
    draw_header(picker, &paint);
    gb_paint_text(&paint, 1, 1, GB_STYLE_DIM, "Filter:");
    gb_prompt_draw(&picker->filter, &paint, 1, 9, cols - 10);
    draw_list(picker, &paint);
    draw_foot(picker, &paint);
}
