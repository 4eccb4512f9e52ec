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

enum { SIGNS, MARK, NAME, CELL, DENSITY, DIFFERENCE, COLUMNS };
enum { FOOT_ROWS = 2 }; /* what the signs mean */

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

void gb_curve_list_navigate(struct gb_curve_list *list, const struct gb_session *session,
                            enum gb_action action)
{
    gb_list_box_set_count(&list->box, count_lines(session));
    (void)gb_list_box_navigate(&list->box, action);
}

int gb_curve_list_focused(struct gb_curve_list *list, const struct gb_session *session)
{
    gb_list_box_set_count(&list->box, count_lines(session));
    if (list->box.count == 0) {
        return GB_CURVE_LIST_NONE;
    }
    const int index = index_of(session, list->box.focus);
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

/* What a row is written from. */
struct source {
    const struct gb_curve_list *list;
    const struct gb_session *session;
};

static void write_values(const struct source *source, const struct line *curve,
                         struct gb_list_box_line *line)
{
    const struct gb_session *session = source->session;
    const double pressure_pa = source->list->pressure_pa;
    char text[24];
    const struct gb_pressure_value value =
        gb_pressure_rows_at(session, &curve->row, pressure_pa);
    write_cell(&curve->row, text, sizeof text);
    line->cell[CELL] = g_strdup(text);
    gb_pressure_rows_write(value, text, sizeof text);
    line->cell[DENSITY] = g_strdup(text);
    if (curve->row.kind == GB_PRESSURE_ROW_PREVIOUS && session->runner != NULL) {
        const struct gb_pressure_row run = gb_pressure_rows_run(session);
        gb_pressure_rows_write_difference(&curve->row, value, &run,
                                          gb_pressure_rows_at(session, &run, pressure_pa),
                                          text, sizeof text);
        line->cell[DIFFERENCE] = g_strdup(text);
    }
}

static void write_curve(void *data, int item, struct gb_list_box_line *line)
{
    const struct source *source = data;
    const struct line curve = line_of(source->session, item);
    const bool run = curve.row.kind == GB_PRESSURE_ROW_RUN;
    const char marker = curve.label.marker;
    line->style = curve.label.hidden ? GB_STYLE_DIM : GB_STYLE_PLAIN;
    line->cell[SIGNS] = g_strdup_printf("%s%s", curve.label.pinned ? "*" : " ",
                                        curve.label.hidden ? "-" : "");
    line->cell[MARK] = g_strdup_printf("%c", run || marker == '\0' ? '>' : marker);
    line->ink[MARK] = run ? GB_STYLE_SERIES : (int)curve.ink;
    line->cell[NAME] = g_strdup(curve.name);
    write_values(source, &curve, line);
}

void gb_curve_list_draw(struct gb_curve_list *list, const struct gb_session *session,
                        const struct gb_paint *paint)
{
    char pressure[24];
    struct source source = {list, session};
    gb_units_format_short(list->pressure_pa, GB_DIM_PRESSURE, 4, pressure,
                          sizeof pressure);
    const struct gb_list_box_look look = {
        .columns = COLUMNS,
        .column = {[SIGNS] = {.cols = 2, .tight = true},
                   [MARK] = {.cols = 2},
                   [NAME] = {.title = "curve", .cols = 0},
                   [CELL] = {.title = "cell", .cols = 12, .right = true},
                   [DENSITY] = {.title = pressure, .cols = 9, .right = true},
                   [DIFFERENCE] = {.title = "- run ", .cols = 9, .right = true}},
        .head = GB_STYLE_BOLD,
        .titled = true,
        .empty = "no curve yet: r starts a run",
        .empty_style = GB_STYLE_DIM,
        .write = write_curve};
    struct gb_rect rect = paint->rect;
    rect.rows -= FOOT_ROWS;
    const struct gb_paint rows = gb_paint_at(paint->term, rect);
    gb_list_box_set_count(&list->box, count_lines(session));
    gb_list_box_draw(&list->box, &rows, &look, &source);
    if (list->naming) {
        const struct gb_rect name = gb_list_box_cell(&list->box, &rows, &look, NAME);
        gb_prompt_draw(&list->prompt, &rows, name.row, name.col, name.cols);
    }
    gb_paint_wrap(paint, paint->rect.rows - FOOT_ROWS, FOOT_ROWS, GB_STYLE_DIM, foot);
}
