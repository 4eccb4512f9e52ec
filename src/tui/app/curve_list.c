#include "tui/app/curve_list.h"

#include <glib.h>
#include <math.h>
#include <stdio.h>

#include "base/units.h"
#include "run/quick.h"
#include "tui/app/keys.h"
#include "tui/session/pressure_rows.h"
#include "tui/session/previous.h"
#include "tui/view/views.h"

enum {
    SIGN_COLS = 2,
    MARK_COLS = 2,
    CELL_COLS = 12,
    VALUE_COLS = 9,
    FOOT_ROWS = 2 /* what the signs mean */
};

static const char foot[] =
    "* pinned: stays, also with m; - hidden. ~ within, ! beyond two standard deviations. "
    "D takes a curve off the plot, its files stay.";

void gb_curve_list_init(struct gb_curve_list *list, const struct gb_session *session,
                        double pressure_pa)
{
    *list = (struct gb_curve_list){.pressure_pa =
                                       gb_pressure_rows_usual(session, pressure_pa)};
}

/* The run first, then the newest curve. */
static int count_lines(const struct gb_session *session)
{
    return session->previous_count + (session->runner != NULL);
}

static int index_of(const struct gb_session *session, int line)
{
    return session->previous_count - 1 - line + (session->runner != NULL);
}

void gb_curve_list_go(struct gb_curve_list *list, const struct gb_session *session,
                      int by)
{
    list->focus = CLAMP(list->focus + by, 0, MAX(count_lines(session) - 1, 0));
}

int gb_curve_list_focused(struct gb_curve_list *list, const struct gb_session *session)
{
    gb_curve_list_go(list, session, 0);
    if (count_lines(session) == 0) {
        return GB_CURVE_LIST_NONE;
    }
    const int index = index_of(session, list->focus);
    return index < session->previous_count ? index : GB_CURVE_LIST_RUN;
}

void gb_curve_list_rename(struct gb_curve_list *list, struct gb_session *session)
{
    const int index = gb_curve_list_focused(list, session);
    if (index != GB_CURVE_LIST_NONE) {
        gb_prompt_set(&list->prompt, gb_previous_list_label(session, index)->name);
        list->naming = true;
    }
}

bool gb_curve_list_type(struct gb_curve_list *list, const struct gb_term_event *event)
{
    if (list->naming && event->kind == GB_TERM_KEY && event->code == GB_KEY_ESCAPE) {
        list->naming = false;
        return true;
    }
    return list->naming && gb_prompt_handle(&list->prompt, event);
}

/* A line of the list. */
struct line {
    struct gb_pressure_row row;
    struct gb_curve_label label;
    const char *name;
    enum gb_style ink;
};

static struct line line_of(const struct gb_session *session, int number)
{
    const int index = index_of(session, number);
    if (index == session->previous_count) {
        const struct gb_curve_label *label = &session->run_label;
        return (struct line){gb_pressure_rows_run(session), *label,
                             label->name[0] != '\0' ? label->name : "run on display",
                             GB_STYLE_SERIES};
    }
    const struct gb_previous_curve *previous = &session->previous[index];
    const int colour = previous->label.colour;
    return (struct line){gb_pressure_rows_previous(session, index), previous->label,
                         gb_previous_list_name(previous),
                         colour > 0 ? (enum gb_style)(GB_STYLE_SERIES + colour)
                                    : GB_STYLE_DIM};
}

/* "N 8000", "quick 1000". */
static void write_cell(const struct gb_pressure_row *row, char *text, size_t size)
{
    struct gb_params small;
    const bool quick = row->quick && gb_quick_params(row->params, &small);
    snprintf(text, size, "%s %lld", row->quick ? "quick" : "N",
             (long long)(quick ? small.count : row->params->count));
}

static void write_right(const struct gb_paint *paint, int row, int end,
                        enum gb_style style, const char *text)
{
    gb_paint_text(paint, row, end - gb_paint_width(text), style, text);
}

static void draw_values(const struct gb_paint *paint, int row,
                        const struct gb_session *session, const struct line *line,
                        double pressure_pa, enum gb_style style)
{
    char text[24];
    const int cols = paint->rect.cols;
    const struct gb_pressure_value value =
        gb_pressure_rows_at(session, &line->row, pressure_pa);
    write_cell(&line->row, text, sizeof text);
    write_right(paint, row, cols - 2 * VALUE_COLS - 1, style, text);
    gb_pressure_rows_write(value, text, sizeof text);
    write_right(paint, row, cols - VALUE_COLS - 1, style, text);
    if (line->row.kind == GB_PRESSURE_ROW_PREVIOUS && session->runner != NULL) {
        const struct gb_pressure_row run = gb_pressure_rows_run(session);
        gb_pressure_rows_write_difference(&line->row, value, &run,
                                          gb_pressure_rows_at(session, &run, pressure_pa),
                                          text, sizeof text);
        write_right(paint, row, cols, style, text);
    }
}

static void draw_line(const struct gb_curve_list *list, const struct gb_session *session,
                      const struct gb_paint *paint, int row, int number)
{
    const struct line line = line_of(session, number);
    const bool focused = number == list->focus;
    const enum gb_style style = focused             ? GB_STYLE_SELECTED
                                : line.label.hidden ? GB_STYLE_DIM
                                                    : GB_STYLE_PLAIN;
    const char mark[2] = {line.label.marker != '\0' ? line.label.marker : '>', '\0'};
    const int from = SIGN_COLS + MARK_COLS;
    const int name_cols = paint->rect.cols - from - CELL_COLS - 2 * VALUE_COLS;
    gb_paint_cell(paint, row, 0, paint->rect.cols, style, "");
    gb_paint_text(paint, row, 0, style, line.label.pinned ? "*" : "");
    gb_paint_text(paint, row, 1, style, line.label.hidden ? "-" : "");
    gb_paint_text(paint, row, SIGN_COLS,
                  line.row.kind == GB_PRESSURE_ROW_RUN ? GB_STYLE_SERIES : line.ink,
                  line.row.kind == GB_PRESSURE_ROW_RUN ? ">" : mark);
    gb_paint_cell(paint, row, from, name_cols, style, line.name);
    draw_values(paint, row, session, &line, list->pressure_pa, style);
    if (focused && list->naming) {
        gb_prompt_draw(&list->prompt, paint, row, from, name_cols);
    }
}

static void draw_head(const struct gb_curve_list *list, const struct gb_paint *paint)
{
    char pressure[24];
    const int cols = paint->rect.cols;
    gb_units_format_short(list->pressure_pa, GB_DIM_PRESSURE, 4, pressure,
                          sizeof pressure);
    gb_paint_text(paint, 0, SIGN_COLS + MARK_COLS, GB_STYLE_BOLD, "curve");
    write_right(paint, 0, cols - 2 * VALUE_COLS - 1, GB_STYLE_BOLD, "cell");
    write_right(paint, 0, cols - VALUE_COLS - 1, GB_STYLE_BOLD, pressure);
    write_right(paint, 0, cols - 1, GB_STYLE_BOLD, "- run");
}

void gb_curve_list_draw(struct gb_curve_list *list, const struct gb_session *session,
                        const struct gb_paint *paint)
{
    const int count = count_lines(session);
    list->page = MAX(1, paint->rect.rows - FOOT_ROWS - 1);
    gb_curve_list_go(list, session, 0);
    list->top = CLAMP(list->top, MAX(0, list->focus - list->page + 1), list->focus);
    draw_head(list, paint);
    for (int i = 0; i < list->page && list->top + i < count; i++) {
        draw_line(list, session, paint, 1 + i, list->top + i);
    }
    if (count == 0) {
        gb_paint_text(paint, 1, 0, GB_STYLE_DIM, "no curve yet: r starts a run");
    }
    gb_paint_wrap(paint, paint->rect.rows - FOOT_ROWS, FOOT_ROWS, GB_STYLE_DIM, foot);
}
