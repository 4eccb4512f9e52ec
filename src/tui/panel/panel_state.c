#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "base/units.h"
#include "io/status/stage_text.h"
#include "tui/panel/panel_state_items.h"
#include "tui/panel/panels.h"
#include "tui/session/overlay/pressure_rows.h"

/* Width of a column from which on names are not abbreviated; least width of the bar. */
enum { FULL_NAME_COLS = 30, BAR_MIN = 4 };

/* Height of a pane that has a line for the density at a pressure, for that of replicas. */
enum { DENSITY_FROM_ROWS = 5, MEAN_FROM_ROWS = 4 };

const char *gb_panel_state_word(enum gb_run_state state, const char *error,
                                enum gb_style *style)
{
    static const struct {
        const char *word;
        enum gb_style style;
    } words[] = {
        [GB_RUN_PACKING] = {"\u25cc packing", GB_STYLE_SERIES},
        [GB_RUN_RUNNING] = {"\u25b6 running", GB_STYLE_GOOD},
        [GB_RUN_PAUSED] = {"\u2016 paused", GB_STYLE_WARN},
        [GB_RUN_DONE] = {"\u2713 done", GB_STYLE_GOOD},
        [GB_RUN_STOPPED] = {"\u25a0 stopped", GB_STYLE_WARN},
        [GB_RUN_FAILED] = {"\u2717 failed", GB_STYLE_BAD},
    };
    if (state == GB_RUN_DONE && error[0] != '\0') {
        *style = GB_STYLE_WARN;
        return "! done";
    }
    *style = words[state].style;
    return words[state].word;
}

bool gb_panel_state_stage(const struct gb_snapshot *now, enum gb_run_state state,
                          int cols, char *text, size_t size)
{
    char value[112];
    const struct gb_stage_report *stage = &now->stage;
    if (state != GB_RUN_RUNNING || stage->stage == GB_STAGE_NONE) {
        return false;
    }
    gb_stage_text_value(stage, value, sizeof value);
    snprintf(text, size, "%s%s%s", gb_stage_text_name(stage->stage),
             value[0] != '\0' ? " " : "", value);
    if ((int)strlen(text) > cols) {
        snprintf(text, size, "%s", gb_stage_text_name(stage->stage));
    }
    return (int)strlen(text) <= cols;
}

/* "done in 0.7 s", "stopped after 3:04"; of a live run only the state. */
static void write_state(const struct gb_snapshot *now, const char *word, char *text,
                        size_t size)
{
    char time[24];
    if (now->state > GB_RUN_PAUSED) {
        gb_panel_state_items_duration(now->seconds, time, sizeof time);
        snprintf(text, size, "%s %s %s", word, now->state == GB_RUN_DONE ? "in" : "after",
                 time);
    } else {
        snprintf(text, size, "%s", word);
    }
}

/* " 45 %", " 45 % 0:12 left"; " 45 % estimating" where powder comes to rest when it does. */
static void write_share(const struct gb_snapshot *now, double share, char *text,
                        size_t size)
{
    char time[24];
    const bool live = now->seconds_left >= 0.0 && now->state <= GB_RUN_PAUSED;
    const bool stages = now->stage.stage != GB_STAGE_NONE && now->state <= GB_RUN_PAUSED;
    snprintf(text, size, "%4.0f %%%s%s%s", floor(100.0 * share), live ? " " : "",
             live ? gb_paint_time(now->seconds_left, time, sizeof time) : "",
             live     ? " left"
             : stages ? " estimating"
                      : "");
}

/* The stage in place of the word "running". */
static void write_stage(const struct gb_snapshot *now, int cols, char *text, size_t size)
{
    char stage[128];
    if (gb_panel_state_stage(now, now->state, cols - 2, stage, sizeof stage)) {
        snprintf(text, size, "\u25b6 %s", stage);
    }
}

/* State, bar, percentage and time in one row, or the bar in a row of its own. */
static void draw_progress(const struct gb_paint *paint, const struct gb_session *session,
                          bool own_row)
{
    char state[160] = "not started";
    char tail[48];
    enum gb_style style = GB_STYLE_DIM;
    const struct gb_session_shown shown = gb_session_shown(session);
    const struct gb_snapshot *now = shown.now;
    if (shown.curve != NULL) {
        write_state(now, gb_panel_state_word(now->state, now->error.text, &style), state,
                    sizeof state);
    }
    /* the last time step of a dynamic run ends slightly before or after its end time */
    const bool done = shown.curve != NULL && now->state == GB_RUN_DONE;
    const double share = done ? 1.0 : now->progress;
    const int inner = paint->rect.cols - 2;
    write_share(now, share, tail, sizeof tail);
    if (!own_row && shown.curve != NULL) {
        write_stage(now, inner - (int)strlen(tail), state, sizeof state);
    }
    const int end = gb_paint_text(paint, 1, 1, style, state) + 1;
    const int room = inner + 1 - end - (int)strlen(tail);
    const int bar = own_row || room <= BAR_MIN ? 0 : room;
    if (own_row) {
        gb_paint_bar(paint, 2, 1, inner, share);
        if (gb_panel_state_stage(now, now->state, inner, state, sizeof state)) {
            gb_paint_text(paint, 3, 1, GB_STYLE_PLAIN, state);
        }
        gb_paint_text(paint, 1, 1 + inner - (int)strlen(tail), GB_STYLE_PLAIN, tail);
        return;
    }
    gb_paint_bar(paint, 1, end, bar, share);
    gb_paint_text(paint, 1, end + bar, GB_STYLE_PLAIN, tail);
}

static void draw_item(const struct gb_paint *paint, int row, int col, int cols,
                      const struct gb_panel_state_item *item,
                      const struct gb_session_shown *shown)
{
    char text[48];
    gb_panel_state_items_write(item, shown, text, sizeof text);
    const char *name = cols >= FULL_NAME_COLS ? item->name : item->brief;
    gb_paint_cell(paint, row, col, cols - 1 - (int)strlen(text), GB_STYLE_DIM, name);
    gb_paint_text(paint, row, col + cols - (int)strlen(text), GB_STYLE_PLAIN, text);
}

static void draw_items(const struct gb_paint *paint, int first, int rows,
                       const struct gb_session_shown *shown,
                       const struct gb_panel_state_choice *choice)
{
    const int count = choice->count;
    const int inner = paint->rect.cols - 2;
    int columns = inner >= 47 ? 3 : inner >= 34 ? 2 : 1;
    if (rows >= count) {
        columns = 1;
    } else if (2 * rows >= count && columns > 2) {
        columns = 2;
    }
    const int gap = columns > 1 ? 2 : 0;
    int width = (inner - gap * (columns - 1)) / columns;
    width = width > 34 ? 34 : width;
    const bool all = rows * columns >= count;
    const int each = all ? (count + columns - 1) / columns : rows;
    for (int i = 0; i < count && i < each * columns; i++) {
        const int column = all ? i / each : i % columns;
        const int row = all ? i % each : i / columns;
        draw_item(paint, first + row, 1 + column * (width + gap), width,
                  all ? choice->item[i] : choice->by_weight[i], shown);
    }
}

/* What the density is of: the quick cell or the run, or the mean of replicas of the run. */
static bool find_row(const struct gb_session *session,
                     const struct gb_session_shown *shown, struct gb_pressure_row *row)
{
    const struct gb_replica_band *band = &session->replica_band;
    struct gb_pressure_rows rows;
    bool found = false;
    gb_pressure_rows_list(&rows, session, false);
    for (int i = 0; i < rows.count; i++) {
        const enum gb_pressure_row_kind kind = rows.row[i].kind;
        const bool of_shown =
            kind == (shown->quick ? GB_PRESSURE_ROW_QUICK : GB_PRESSURE_ROW_RUN);
        const bool mean = kind == GB_PRESSURE_ROW_REPLICAS && !shown->quick &&
                          gb_params_diff_count(&band->params, shown->params) == 0;
        if (of_shown || mean) {
            *row = rows.row[i];
            found = true;
        }
    }
    return found;
}

/* "(5 cells)", "(cell scatter)": what the error is, the longest of three that fits. */
static void write_origin(const struct gb_session *session,
                         const struct gb_pressure_row *row, double error, int cols,
                         char *text, size_t size)
{
    static const char *const scatter[] = {"(scatter expected of one cell)",
                                          "(cell scatter)", "(1 cell)"};
    static const char *const unknown[] = {"(1 cell, scatter unknown)", "(1 cell)", ""};
    const char *const *choice = isnan(error) ? unknown : scatter;
    int fits = 0;
    if (row->kind == GB_PRESSURE_ROW_REPLICAS) {
        snprintf(text, size, "(%zu cells)",
                 gb_replica_band_group(&session->replica_band)->members);
        return;
    }
    while (fits < 2 && (int)strlen(choice[fits]) > cols) {
        fits++;
    }
    snprintf(text, size, "%s", choice[fits]);
}

enum { DENSITY_TEXT = 128 };

/* "rho(100 MPa) = 0.4062 +- 0.0064" and "(cell scatter)", the latter for a row of `cols`
 * columns behind the former, or of its own where it has no room there.  False: not
 * reached. */
static bool write_density(const struct gb_session *session,
                          const struct gb_session_shown *shown, int cols,
                          char head[DENSITY_TEXT], char origin[DENSITY_TEXT])
{
    char number[GB_NUMBER_ERROR_MAX], pressure[24];
    struct gb_pressure_row row;
    const double at_pa = gb_pressure_rows_usual(session, 0.0);
    if (!find_row(session, shown, &row)) {
        return false;
    }
    const struct gb_pressure_value value = gb_pressure_rows_at(session, &row, at_pa);
    if (!isfinite(value.density)) {
        return false;
    }
    gb_units_format_short(at_pa, GB_DIM_PRESSURE, 4, pressure, sizeof pressure);
    if (isnan(value.error)) {
        snprintf(number, sizeof number, "%.4f", value.density);
    } else {
        gb_number_error(value.density, value.error, 2, " +- ", number);
    }
    snprintf(head, DENSITY_TEXT, "rho(%s) = %s", pressure, number);
    const int left = cols - (int)strlen(head) - 1;
    write_origin(session, &row, value.error, left, origin, DENSITY_TEXT);
    if ((int)strlen(origin) > left) {
        write_origin(session, &row, value.error, cols, origin, DENSITY_TEXT);
    }
    return true;
}

static bool shows_density(const struct gb_paint *paint, const struct gb_session *session,
                          const struct gb_session_shown *shown)
{
    struct gb_pressure_row row;
    return paint->rect.rows >= DENSITY_FROM_ROWS ||
           (paint->rect.rows >= MEAN_FROM_ROWS && find_row(session, shown, &row) &&
            row.kind == GB_PRESSURE_ROW_REPLICAS);
}

/* In a row, or in two where there is room for them; returns how many. */
static int draw_density(const struct gb_paint *paint, const struct gb_session *session,
                        const struct gb_session_shown *shown, int row, bool roomy)
{
    char head[DENSITY_TEXT], origin[DENSITY_TEXT];
    const int cols = paint->rect.cols - 2;
    if (!write_density(session, shown, cols, head, origin)) {
        return 0;
    }
    gb_paint_text(paint, row, 1, GB_STYLE_BOLD, head);
    if ((int)(strlen(head) + strlen(origin)) < cols) {
        gb_paint_text(paint, row, 2 + (int)strlen(head), GB_STYLE_BOLD, origin);
    } else if (roomy) {
        gb_paint_text(paint, row + 1, 1, GB_STYLE_PLAIN, origin);
        return 2;
    }
    return 1;
}

void gb_panel_state_draw(const struct gb_paint *paint, const struct gb_session *session,
                         enum gb_paint_focus focus)
{
    const struct gb_session_shown shown = gb_session_shown(session);
    const struct gb_snapshot *now = shown.now;
    gb_paint_title(paint, shown.quick ? "State of the quick cell" : "State", focus);
    const struct gb_panel_state_choice choice = gb_panel_state_items_choose(session);
    const bool roomy = paint->rect.rows >= choice.count + 6;
    draw_progress(paint, session, roomy);
    int row = roomy ? 4 : 2;
    if (shows_density(paint, session, &shown)) {
        row += draw_density(paint, session, &shown, row, roomy);
    }
    draw_items(paint, row, paint->rect.rows - row, &shown, &choice);
    if (roomy && now->error.text[0] != '\0') {
        row += choice.count + 1;
        gb_paint_wrap(paint, row, paint->rect.rows - row, GB_STYLE_WARN, now->error.text);
    }
}
