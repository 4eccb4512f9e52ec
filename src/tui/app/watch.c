#include "tui/app/watch.h"

#include <glib.h>
#include <math.h>
#include <ncurses.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>

#include "base/clock.h"
#include "base/number.h"
#include "base/units.h"
#include "greenbody/status.h"
#include "io/run_list.h"
#include "tui/app/keys.h"
#include "tui/panel/list_box.h"
#include "tui/panel/panels.h"
#include "tui/session/runset_view.h"
#include "tui/term/paint.h"
#include "tui/term/settings.h"
#include "tui/term/term.h"

/* Screens for runs of other processes: the loop that reads their files repeatedly, the
 * list to choose a run from, and the screen of many runs. */

/* A screen that shows files of other processes: its events, and reading the files. */
struct reread_loop {
    /* Seconds between two reads, or ten times the duration of a read if that is longer.
     */
    double reread_s;
    /* False: leave the screen. */
    bool (*key)(void *data, struct gb_term *term, const struct gb_term_event *event);
    void (*wheel)(void *data, int rows); /* -1, 0 or 1 */
    void (*reread)(void *data);
    void (*draw)(void *data, struct gb_term *term);
    void *data;
};

/* Least time between two reads, over the duration of a read. */
static const double share = 10.0;

enum { STATUS_SIGNAL = 128 };

/* Handles an event.  Returns the exit status; -1: continue. */
static int handle(const struct reread_loop *loop, struct gb_term *term,
                  const struct gb_term_event *event)
{
    switch (event->kind) {
    case GB_TERM_KEY:
    case GB_TERM_TEXT:
        return loop->key(loop->data, term, event) ? -1 : 0;
    case GB_TERM_MOUSE:
        loop->wheel(loop->data, event->code == GB_TERM_WHEEL_UP     ? -1
                                : event->code == GB_TERM_WHEEL_DOWN ? 1
                                                                    : 0);
        return -1;
    case GB_TERM_INTERRUPT:
        return STATUS_SIGNAL + SIGINT;
    case GB_TERM_TERMINATE:
        return STATUS_SIGNAL + event->code;
    case GB_TERM_HANGUP:
        return STATUS_SIGNAL + SIGHUP;
    case GB_TERM_TIMEOUT:
    case GB_TERM_RESIZED:
        break;
    }
    return -1;
}

/* Reads the files and returns when to read them again. */
static double read_again(const struct reread_loop *loop)
{
    const double from = gb_clock_s();
    loop->reread(loop->data);
    const double now = gb_clock_s();
    return now + fmax(loop->reread_s, share * (now - from));
}

/* Runs until the screen is left or a signal arrives, then stops and destroys the
 * terminal.  Returns the exit status. */
static int reread_loop_run(const struct reread_loop *loop, struct gb_term *term)
{
    double due = gb_clock_s() + loop->reread_s;
    bool hangup = false;
    int status = -1;
    while (status < 0) {
        loop->draw(loop->data, term);
        const double left = due - gb_clock_s();
        const struct gb_term_event event =
            gb_term_wait(term, left > 0.0 ? (int)(1e3 * left) + 1 : 0);
        status = handle(loop, term, &event);
        hangup = event.kind == GB_TERM_HANGUP;
        if (status < 0 && gb_clock_s() >= due) {
            due = read_again(loop);
        }
    }
    if (hangup) {
        gb_term_abandon(term);
    } else {
        gb_term_stop(term);
    }
    gb_term_destroy(term);
    return status;
}

/* The list of runs. */
struct picker {
    GPtrArray *(*list)(void);
    GPtrArray *items;       /* all runs */
    struct gb_list_box box; /* runs that match the filter */
    bool asks;              /* asks whether to delete the focused run */
    int files;              /* number of files of that run */
    char note[400];
    enum gb_style note_style;
    bool leave;
    char *chosen; /* directory; NULL: none */
};

/* The focused run; NULL: none matches. */
static const struct gb_run_list_item *focused(const struct picker *picker)
{
    const int item = gb_list_box_focused(&picker->box);
    return item >= 0 ? g_ptr_array_index(picker->items, (guint)item) : NULL;
}

/* Rank of a run: is every word of the filter in its name, title or state? */
static int rank_run(void *data, int at, char **words)
{
    const struct picker *picker = data;
    const struct gb_run_list_item *item = g_ptr_array_index(picker->items, (guint)at);
    const char *engine =
        item->engine != GB_RUN_LIST_NONE ? gb_run_list_engine_word(item->engine) : "";
    char *text =
        g_strdup_printf("%s %s %s %s", item->name, item->title, item->state, engine);
    const bool good = gb_list_box_matches(words, text);
    g_free(text);
    return good;
}

/* Applies the filter and keeps the focus on the run of this directory; NULL: the first
 * run. */
static void apply_filter(struct picker *picker, const char *directory)
{
    const int top = picker->box.top;
    gb_list_box_search(&picker->box, (int)picker->items->len, rank_run, picker);
    picker->box.top = top;
    while (directory != NULL && picker->box.focus < picker->box.count &&
           g_strcmp0(focused(picker)->directory, directory) != 0) {
        picker->box.focus++;
    }
    if (picker->box.focus == picker->box.count) {
        picker->box.focus = 0;
    }
}

static void picker_reread(struct picker *picker)
{
    const struct gb_run_list_item *item = picker->items != NULL ? focused(picker) : NULL;
    char *directory = g_strdup(item != NULL ? item->directory : NULL);
    GPtrArray *fresh = picker->list();
    g_clear_pointer(&picker->items, g_ptr_array_unref);
    picker->items = fresh;
    apply_filter(picker, directory);
    /* the question referred to another run */
    item = focused(picker);
    picker->asks = picker->asks && item != NULL && item->engine == GB_RUN_LIST_NONE &&
                   g_strcmp0(item->directory, directory) == 0;
    g_free(directory);
}

/* Leaves the list; if there is a filter, Esc clears it first. */
static void picker_leave(struct picker *picker)
{
    if (*gb_prompt_text(&picker->box.filter) != '\0') {
        gb_prompt_set(&picker->box.filter, "");
        picker_reread(picker);
    } else {
        picker->leave = true;
    }
}

enum {
    PICKER_MIN_ROWS = 12,
    PICKER_MIN_COLS = 40,
    ALL_COLS = 76, /* columns from which density and pressure are shown */
    ABOVE = 4,     /* header, filter, blank line, head */
    BELOW = 3      /* directory, note or question, keys */
};

static void picker_draw_header(const struct picker *picker, const struct gb_paint *paint)
{
    int64_t bytes = 0;
    int live = 0;
    char text[96];
    for (guint i = 0; i < picker->items->len; i++) {
        const struct gb_run_list_item *item = g_ptr_array_index(picker->items, i);
        bytes += item->bytes;
        live += item->engine != GB_RUN_LIST_NONE;
    }
    char *size = gb_run_list_size_text(bytes);
    snprintf(text, sizeof text, "%u run%s, %d live, %s", picker->items->len,
             picker->items->len == 1 ? "" : "s", live, size);
    gb_paint_text(paint, 0, 1, GB_STYLE_BOLD, "greenbody");
    gb_paint_text(paint, 0, MAX(paint->rect.cols - gb_paint_width(text) - 1, 12),
                  GB_STYLE_PLAIN, text);
    g_free(size);
}

/* Data from which a row is written. */
struct source {
    const struct picker *picker;
    enum gb_run_list_extent extent;
};

static void picker_write_run(void *data, int at, struct gb_list_box_line *line)
{
    const struct source *source = data;
    const struct gb_run_list_item *item =
        g_ptr_array_index(source->picker->items, (guint)at);
    line->style = item->engine != GB_RUN_LIST_NONE ? GB_STYLE_GOOD : GB_STYLE_PLAIN;
    line->cell[0] = g_strdup(item->name);
    line->cell[1] = gb_run_list_line(item, source->extent);
}

static void picker_draw_list(struct picker *picker, const struct gb_paint *paint)
{
    struct source source = {picker, paint->rect.cols >= ALL_COLS
                                        ? GB_RUN_LIST_LINE_ALL
                                        : GB_RUN_LIST_LINE_BRIEF};
    char *head = gb_run_list_line_head(source.extent);
    const struct gb_list_box_look look = {
        .columns = 2,
        .column = {{.title = "name"},
                   {.title = head, .cols = gb_paint_width(head) + 1, .right = true}},
        .head = GB_STYLE_DIM,
        .titled = true,
        .empty = "no run matches",
        .empty_style = GB_STYLE_DIM,
        .write = picker_write_run};
    const struct gb_rect rect = {ABOVE - 1, 1, paint->rect.rows - ABOVE - BELOW + 1,
                                 paint->rect.cols - 2};
    const struct gb_paint rows = gb_paint_at(paint->term, rect);
    gb_list_box_draw(&picker->box, &rows, &look, &source);
    g_free(head);
}

/* Directory of the focused run, a question or a note, the keys. */
static void draw_foot(const struct picker *picker, const struct gb_paint *paint)
{
    const struct gb_run_list_item *item = focused(picker);
    const int row = paint->rect.rows - BELOW;
    const int cols = paint->rect.cols - 2;
    char text[400];
    if (item != NULL) {
        snprintf(text, sizeof text, "%.100s: %.250s", item->title, item->directory);
        gb_paint_cell(paint, row, 1, cols, GB_STYLE_DIM, text);
    }
    if (picker->asks && item != NULL) {
        char *size = gb_run_list_size_text(item->bytes);
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

static void draw_screen(struct picker *picker, const struct gb_term *term)
{
    int rows = 0;
    int cols = 0;
    gb_term_size(term, &rows, &cols);
    const struct gb_paint paint = gb_paint_at(term, (struct gb_rect){0, 0, rows, cols});
    erase();
    if (rows < PICKER_MIN_ROWS || cols < PICKER_MIN_COLS) {
        char text[96];
        snprintf(text, sizeof text, "greenbody needs %d x %d, has %d x %d; Esc leaves",
                 PICKER_MIN_COLS, PICKER_MIN_ROWS, cols, rows);
        gb_paint_wrap(&paint, 0, rows, GB_STYLE_PLAIN, text);
        return;
    }
    picker_draw_header(picker, &paint);
    gb_list_box_draw_filter(&picker->box, &paint, 1, 1, "Filter:");
    picker_draw_list(picker, &paint);
    draw_foot(picker, &paint);
}

/* Seconds between two reads of the folders. */
static const double picker_reread_s = 2.0;

enum { CTRL_D = 'D' & 31 };

static void say(struct picker *picker, enum gb_style style, const char *text)
{
    g_strlcpy(picker->note, text, sizeof picker->note);
    picker->note_style = style;
}

static void ask(struct picker *picker)
{
    const struct gb_run_list_item *item = focused(picker);
    if (item == NULL) {
        return;
    }
    if (item->engine != GB_RUN_LIST_NONE) {
        say(picker, GB_STYLE_WARN,
            "a live run is not deleted: Enter shows it, t there takes it over");
        return;
    }
    picker->files = gb_run_list_count_files(item->directory);
    picker->asks = true;
}

static void delete_focused(struct picker *picker)
{
    const struct gb_run_list_item *item = focused(picker);
    const int focus = picker->box.focus;
    struct gb_error err = {0};
    char text[400];
    if (gb_run_list_delete(item->directory, &err)) {
        snprintf(text, sizeof text, "deleted: %.300s", item->name);
        say(picker, GB_STYLE_GOOD, text);
    } else {
        say(picker, GB_STYLE_BAD, err.text);
    }
    picker->asks = false;
    picker_reread(picker);
    picker->box.focus = focus;
    gb_list_box_go(&picker->box, 0);
}

static void choose(struct picker *picker)
{
    const struct gb_run_list_item *item = focused(picker);
    if (item != NULL) {
        picker->chosen = g_strdup(item->directory);
        picker->leave = true;
    }
}

/* Handles keys that are not text; false: the filter handles them. */
static bool picker_act(struct picker *picker, int code)
{
    switch (code) {
    case KEY_DC:
    case CTRL_D:
        ask(picker);
        return true;
    case '\n':
    case '\r':
    case KEY_ENTER:
        choose(picker);
        return true;
    case GB_KEY_ESCAPE:
    case KEY_F(10):
        picker_leave(picker);
        return true;
    default:
        return false;
    }
}

static void press(struct picker *picker, const struct gb_term_event *event)
{
    if (picker->asks) {
        if (event->code == 'y' || event->code == 'Y') {
            delete_focused(picker);
        }
        picker->asks = false;
        return;
    }
    picker->note[0] = '\0';
    if (event->kind == GB_TERM_KEY && picker_act(picker, event->code)) {
        return;
    }
    if (gb_list_box_handle(&picker->box, event) == GB_LIST_BOX_TYPED) {
        apply_filter(picker, NULL);
    }
}

static bool picker_on_key(void *data, struct gb_term *term,
                          const struct gb_term_event *event)
{
    struct picker *picker = data;
    (void)term;
    press(picker, event);
    return !picker->leave;
}

static void picker_on_wheel(void *data, int rows)
{
    struct picker *picker = data;
    gb_list_box_go(&picker->box, rows);
}

static void picker_on_reread(void *data)
{
    picker_reread(data);
}

static void show(void *data, struct gb_term *term)
{
    draw_screen(data, term);
    gb_term_flush(term);
}

int gb_watch_pick(GPtrArray *(*list)(void), const struct gb_settings *settings,
                  char **directory, struct gb_error *err)
{
    struct picker *picker = g_new0(struct picker, 1);
    struct gb_term *term = NULL;
    int status = gb_status_exit_code(GB_ERR_MACHINE);
    picker->list = list;
    *directory = NULL;
    if (gb_term_start(&term, settings, err)) {
        picker_reread(picker);
        const struct reread_loop loop = {picker_reread_s,  picker_on_key, picker_on_wheel,
                                         picker_on_reread, show,          picker};
        status = reread_loop_run(&loop, term);
        *directory = status == 0 ? g_steal_pointer(&picker->chosen) : NULL;
    }
    g_clear_pointer(&picker->items, g_ptr_array_unref);
    gb_list_box_finish(&picker->box);
    g_free(picker->chosen);
    g_free(picker);
    return status;
}

/* The screen of many runs: four views, each a row of a table, the keys, and reading the
 * files repeatedly. */

enum { MIN_ROWS = 12, MIN_COLS = 40, LAST_ASCII = 126 };

/* State of the screen of many runs, which is read-only: mean curves with bands, a map
 * over two varied keys at a pressure, the runs, the fit of a calibration. */
struct watch {
    struct gb_runset_view runset;
    struct gb_error error; /* error of the last reading */
    bool leave;
    int view;     /* row of `views` */
    size_t level; /* pressure of the map */
    bool linear;  /* linear pressure axis */
    struct gb_list_box runs;
    int glyphs; /* enum gb_plot_glyphs */
    struct gb_plot plot;
};

/* "8 runs: 5 done, 2 live, 1 failed  72 %" */
static void draw_header(const struct watch *watch, const struct gb_paint *paint)
{
    const struct gb_runset_view *runset = &watch->runset;
    char *name = g_path_get_basename(runset->directory);
    char text[160];
    snprintf(text, sizeof text, "%zu runs: %zu done, %zu under way, %zu failed %4.0f %%",
             runset->runs, runset->done, runset->live, runset->failed,
             100.0 * runset->progress);
    const int col = gb_paint_text(paint, 0, 1, GB_STYLE_BOLD, "greenbody") + 2;
    const int from = paint->rect.cols - gb_paint_width(text) - 1;
    gb_paint_cell(paint, 0, col, from - col - 1, GB_STYLE_PLAIN, name);
    gb_paint_text(paint, 0, from, runset->failed > 0 ? GB_STYLE_WARN : GB_STYLE_PLAIN,
                  text);
    g_free(name);
}

static void watch_fit_draw(struct watch *watch, const struct gb_paint *paint)
{
    struct gb_rect rect = paint->rect;
    rect.col += 1;
    rect.cols -= 2;
    const struct gb_paint inside = gb_paint_at(paint->term, rect);
    int row = 1;
    for (char **line = watch->runset.fit; line != NULL && *line != NULL; line++) {
        const int left = rect.rows - row;
        const int rows = left > 0 ? gb_paint_wrap_rows(&inside, left, *line) : 0;
        gb_paint_wrap(&inside, row, rows, GB_STYLE_PLAIN, *line);
        row += rows;
    }
}

static void write_run(void *data, int item, struct gb_list_box_line *line)
{
    const struct watch *watch = data;
    const struct gb_runset_view_run *run = &watch->runset.run[item];
    enum gb_style style = GB_STYLE_PLAIN;
    line->cell[0] = g_strdup(gb_panel_state_word(run->state, run->error, &style));
    line->ink[0] = (int)style;
    line->cell[1] = g_strdup_printf("%4.0f %%", floor(100.0 * run->progress));
    line->cell[2] = g_strdup(run->name);
    line->cell[3] = g_strdup(run->error);
    line->ink[3] = GB_STYLE_WARN;
}

/* Draws state, progress, name and the reason of a failure for each run. */
static void watch_runs_draw(struct watch *watch, const struct gb_paint *paint)
{
    const struct gb_rect rect = {paint->rect.row + 1, paint->rect.col + 2,
                                 paint->rect.rows - 1, paint->rect.cols - 2};
    const struct gb_paint rows = gb_paint_at(paint->term, rect);
    struct gb_list_box_look look = {
        .columns = 4, .column = {{.cols = 12}, {.cols = 8}}, .write = write_run};
    for (size_t i = 0; i < watch->runset.runs; i++) {
        look.column[2].cols =
            MAX(look.column[2].cols, gb_paint_width(watch->runset.run[i].name) + 2);
    }
    gb_list_box_set_count(&watch->runs, (int)watch->runset.runs);
    gb_list_box_draw(&watch->runs, &rows, &look, watch);
}

static void write_pressure(const struct watch *watch, char *text, size_t size)
{
    gb_units_format_short(watch->runset.level_pa[watch->level], GB_DIM_PRESSURE, 3, text,
                          size);
}

/* Columns of a cell: with two digits of the error, with one, or without it. */
enum { NAME_COLS = 14, CELL_COLS = 20, CELL_COLS_ERROR = 15, CELL_COLS_MIN = 7 };

struct range {
    double min, max;
};

static struct range range_of(const struct watch *watch)
{
    struct range range = {HUGE_VAL, -HUGE_VAL};
    for (size_t g = 0; g < watch->runset.groups; g++) {
        const double mean = watch->runset.group[g].mean[watch->level];
        range.min = fmin(range.min, mean); /* fmin and fmax ignore NaN */
        range.max = fmax(range.max, mean);
    }
    return range;
}

/* "▓▓ 0.5120 +-0.0030": darker is denser; "▓0.512 +-0.003" and "▓0.512" in narrow
 * columns. */
static void draw_cell(const struct watch *watch, const struct gb_paint *paint, int row,
                      int col, int cols, const struct gb_runset_view_group *group,
                      struct range range)
{
    static const char *const shades[] = {"\u2591", "\u2592", "\u2593", "\u2588"};
    char text[64] = "   ...";
    const double mean = group != NULL ? group->mean[watch->level] : (double)NAN;
    if (isfinite(mean)) {
        const double error = group->error[watch->level];
        const double part =
            range.max > range.min ? (mean - range.min) / (range.max - range.min) : 1.0;
        const char *shade = shades[(int)fmin(3.0, floor(4.0 * part))];
        const bool wide = cols >= CELL_COLS;
        char number[GB_NUMBER_ERROR_MAX];
        if (error > 0.0 && cols >= CELL_COLS_ERROR) {
            gb_number_error(mean, error, wide ? 2 : 1, " +-", number);
        } else {
            snprintf(number, sizeof number, "%.*f", wide ? 4 : 3, mean);
        }
        snprintf(text, sizeof text, "%s%s%s%.40s", shade, wide ? shade : "",
                 wide ? " " : "", number);
    }
    gb_paint_cell(paint, row, col, cols, GB_STYLE_PLAIN, text);
}

static void draw_matrix(const struct watch *watch, const struct gb_paint *paint)
{
    const struct gb_runset_view *runset = &watch->runset;
    const struct gb_runset_view_key *across = &runset->key[0], *down = &runset->key[1];
    const struct range range = range_of(watch);
    const int room = (paint->rect.cols - NAME_COLS - 1) / (int)across->count;
    const int cols = room >= CELL_COLS         ? CELL_COLS
                     : room >= CELL_COLS_ERROR ? CELL_COLS_ERROR
                                               : MAX(room, CELL_COLS_MIN);
    char text[128];
    snprintf(text, sizeof text, "%s.%s \u2192", across->field->group, across->field->key);
    gb_paint_text(paint, 3, NAME_COLS + 1, GB_STYLE_DIM, text);
    snprintf(text, sizeof text, "%s", down->field->key);
    gb_paint_cell(paint, 4, 1, NAME_COLS - 1, GB_STYLE_DIM, text);
    for (size_t i = 0; i < across->count; i++) {
        gb_paint_cell(paint, 4, NAME_COLS + 1 + (int)i * cols, cols - 1, GB_STYLE_BOLD,
                      across->values[i]);
    }
    for (size_t j = 0; j < down->count; j++) {
        const int row = 5 + (int)j;
        gb_paint_cell(paint, row, 1, NAME_COLS - 1, GB_STYLE_BOLD, down->values[j]);
        for (size_t i = 0; i < across->count; i++) {
            draw_cell(watch, paint, row, NAME_COLS + 1 + (int)i * cols, cols,
                      gb_runset_view_at(runset, i, j), range);
        }
    }
}

/* Label of a group with its number of cells. */
static void watch_views_group_name(const struct gb_runset_view_group *group, char *name,
                                   size_t size)
{
    char cells[40];
    snprintf(cells, sizeof cells, "%s%zu %s", *group->label != '\0' ? ", " : "",
             group->members, group->members == 1 ? "cell" : "cells");
    gb_paint_fit_copy(name, size - strlen(cells), group->label);
    strcat(name, cells);
}

/* One row per group, if one key or more than two keys vary. */
static void draw_list(const struct watch *watch, const struct gb_paint *paint)
{
    const struct range range = range_of(watch);
    for (size_t g = 0; g < watch->runset.groups; g++) {
        const struct gb_runset_view_group *group = &watch->runset.group[g];
        char name[80];
        watch_views_group_name(group, name, sizeof name);
        draw_cell(watch, paint, 3 + (int)g, 1, CELL_COLS, group, range);
        gb_paint_text(paint, 3 + (int)g, CELL_COLS + 2, GB_STYLE_PLAIN, name);
    }
}

static void watch_map_draw(struct watch *watch, const struct gb_paint *paint)
{
    char pressure[32];
    write_pressure(watch, pressure, sizeof pressure);
    gb_paint_format(paint, 1, 1, GB_STYLE_PLAIN,
                    "relative density at %s, +- standard error", pressure);
    if (watch->runset.keys == GB_RUNSET_VIEW_VARIED) {
        draw_matrix(watch, paint);
    } else {
        draw_list(watch, paint);
    }
}

static void find_ends(const struct watch *watch, double x[2], double y[2])
{
    const struct gb_runset_view *runset = &watch->runset;
    x[0] = y[0] = HUGE_VAL;
    x[1] = y[1] = -HUGE_VAL;
    for (size_t g = 0; g < runset->groups; g++) {
        for (size_t k = 0; k < runset->levels; k++) {
            const double error = runset->group[g].error[k];
            const double mean = runset->group[g].mean[k];
            const double wide = isfinite(error) ? error : 0.0;
            if (isfinite(mean)) {
                x[0] = fmin(x[0], mean - wide);
                x[1] = fmax(x[1], mean + wide);
                y[0] = fmin(y[0], runset->level_pa[k] / 1e6);
                y[1] = fmax(y[1], runset->level_pa[k] / 1e6);
            }
        }
    }
}

enum { ENTRIES = 64 };

/* Draws the mean plus `off` standard errors. */
static void draw_curve(struct watch *watch, const struct gb_runset_view_group *group,
                       double off, int ink, int marker)
{
    double x[GB_RUNSET_VIEW_LEVELS];
    double y[GB_RUNSET_VIEW_LEVELS];
    for (size_t k = 0; k < watch->runset.levels; k++) {
        x[k] = group->mean[k] + (off != 0.0 ? off * group->error[k] : 0.0);
        y[k] = watch->runset.level_pa[k] / 1e6;
    }
    gb_plot_line(&watch->plot, &(struct gb_plot_series){.x = x,
                                                        .y = y,
                                                        .count = watch->runset.levels,
                                                        .ink = ink,
                                                        .marker = marker,
                                                        .spacing = 8});
}

/* Draws all groups and the legend, with `foot` rows for it below the plot.  False: the
 * legend is incomplete or covers a line. *needed: rows of a complete foot. */
static bool draw_groups(struct watch *watch, const struct gb_paint *paint,
                        const double x[2], const double y[2], int foot, int *needed)
{
    const struct gb_runset_view *runset = &watch->runset;
    struct gb_plot_entry entry[ENTRIES];
    int entries = 0;
    if (!gb_plot_resize(&watch->plot, paint->rect.rows - 1, paint->rect.cols - 2,
                        (enum gb_plot_glyphs)watch->glyphs, NULL)) {
        return true;
    }
    watch->plot.foot = foot;
    gb_plot_axes(&watch->plot, x, y, watch->linear ? GB_PLOT_LINEAR : GB_PLOT_LOG,
                 "relative density", "p, MPa");
    for (size_t g = 0; g < runset->groups; g++) { /* bands first */
        draw_curve(watch, &runset->group[g], -1.0, GB_PLOT_INK_DIM, 0);
        draw_curve(watch, &runset->group[g], 1.0, GB_PLOT_INK_DIM, 0);
    }
    for (size_t g = 0; g < runset->groups; g++) {
        const int ink = GB_PLOT_INK_SERIES + (int)(g % GB_PLOT_COLOURS);
        const int marker = 1 + (int)(g % 7);
        draw_curve(watch, &runset->group[g], 0.0, ink, marker);
        if (entries < ENTRIES) {
            entry[entries] = (struct gb_plot_entry){.ink = ink, .marker = marker};
            watch_views_group_name(&runset->group[g], entry[entries].name, GB_PLOT_NAME);
            entries++;
        }
    }
    *needed = gb_plot_legend_foot(&watch->plot, entry, entries);
    return gb_plot_legend(&watch->plot, entry, entries);
}

/* Drawing functions, each in the file of its name. */
static void watch_curves_draw(struct watch *watch, const struct gb_paint *paint)
{
    double x[2], y[2];
    int foot = 0;
    find_ends(watch, x, y);
    if (!(x[1] > x[0])) {
        gb_paint_text(paint, 2, 2, GB_STYLE_PLAIN, "no curve has reached 1 MPa yet");
        return;
    }
    if (!draw_groups(watch, paint, x, y, 0, &foot)) { /* no free area in the plot */
        (void)draw_groups(watch, paint, x, y, foot, &foot);
    }
    gb_paint_plot(paint, 1, 1, &watch->plot);
}

/* One row per view of the screen of many runs; digit, title and footer use it.  A new
 * view needs a drawing function and a row.  Views of calibrations are the last rows. */
struct watch_view {
    const char *title; /* without the digit */
    const char *hint;  /* footer: keys of the view; "" without */
    enum { GB_WATCH_VIEW_ALWAYS, GB_WATCH_VIEW_CALIBRATION } shown;
    void (*draw)(struct watch *watch, const struct gb_paint *paint);
};

static const struct watch_view views[] = {
    {"Pressure against relative density: mean and standard error",
     "L log or linear  b glyphs", GB_WATCH_VIEW_ALWAYS, watch_curves_draw},
    {"Relative density over the varied parameters", "Left and Right pressure",
     GB_WATCH_VIEW_ALWAYS, watch_map_draw},
    {"Runs", "Up and Down scroll", GB_WATCH_VIEW_ALWAYS, watch_runs_draw},
    {"Fit", "", GB_WATCH_VIEW_CALIBRATION, watch_fit_draw},
};

/* Number of views for a directory, and the row of one. */
static int watch_views_count(const struct watch *watch)
{
    int count = 0;
    for (size_t i = 0; i < G_N_ELEMENTS(views); i++) {
        count += views[i].shown == GB_WATCH_VIEW_ALWAYS || watch->runset.fit != NULL;
    }
    return count;
}

static const struct watch_view *watch_views_at(int index)
{
    return &views[index];
}

/* Writes the common keys and the keys of the view. */
static void write_hint(const struct watch *watch, char *text, size_t size)
{
    const char *hint = watch_views_at(watch->view)->hint;
    snprintf(text, size, "1-%d views  v next  %s%sq quit", watch_views_count(watch), hint,
             *hint != '\0' ? "  " : "");
}

static void draw_footer(const struct watch *watch, const struct gb_paint *paint)
{
    char hint[120];
    const bool whole = watch->error.code == GB_OK;
    write_hint(watch, hint, sizeof hint);
    gb_paint_cell(paint, paint->rect.rows - 1, 1, paint->rect.cols - 2,
                  whole ? GB_STYLE_DIM : GB_STYLE_WARN, whole ? hint : watch->error.text);
}

static void draw_view(struct watch *watch, const struct gb_paint *paint)
{
    char title[120];
    const struct watch_view *view = watch_views_at(watch->view);
    snprintf(title, sizeof title, "%d %s", watch->view + 1, view->title);
    gb_paint_title(paint, title, GB_PAINT_FOCUSED);
    view->draw(watch, paint);
}

static void draw(struct watch *watch, struct gb_term *term)
{
    int rows = 0;
    int cols = 0;
    gb_term_size(term, &rows, &cols);
    const struct gb_paint whole = gb_paint_at(term, (struct gb_rect){0, 0, rows, cols});
    const struct gb_paint body =
        gb_paint_at(term, (struct gb_rect){1, 0, rows - 2, cols});
    erase();
    if (rows < MIN_ROWS || cols < MIN_COLS) {
        char text[96];
        snprintf(text, sizeof text, "greenbody needs %d x %d, has %d x %d; q quits",
                 MIN_COLS, MIN_ROWS, cols, rows);
        gb_paint_wrap(&whole, 0, rows, GB_STYLE_PLAIN, text);
    } else {
        draw_header(watch, &whole);
        draw_view(watch, &body);
        draw_footer(watch, &whole);
    }
    gb_term_flush(term);
}

/* The view shown first: the fit of a calibration, otherwise the curves. */
static int watch_views_first(const struct watch *watch)
{
    const int last = watch_views_count(watch) - 1;
    return views[last].shown == GB_WATCH_VIEW_CALIBRATION ? last : 0;
}

/* Seconds between two reads of the files. */
static const double reread_s = 1.0;
/* Initial pressure of the map, at which P1 compares powders. */
static const double default_pa = 100e6;

static void move_level(struct watch *watch, int by)
{
    const int to = (int)watch->level + by;
    watch->level = (size_t)CLAMP(to, 0, MAX((int)watch->runset.levels - 1, 0));
}

static void show_view(struct watch *watch, int view)
{
    if (view < watch_views_count(watch)) {
        watch->view = view;
    }
}

enum { CTRL_L = 'L' & 31 };

static void next_view(struct watch *watch, struct gb_term *term)
{
    (void)term;
    show_view(watch, (watch->view + 1) % watch_views_count(watch));
}

static void previous_view(struct watch *watch, struct gb_term *term)
{
    (void)term;
    show_view(watch,
              (watch->view + watch_views_count(watch) - 1) % watch_views_count(watch));
}

static void toggle_log(struct watch *watch, struct gb_term *term)
{
    (void)term;
    watch->linear = !watch->linear;
}

static void next_glyphs(struct watch *watch, struct gb_term *term)
{
    if (gb_term_utf8(term)) {
        watch->glyphs = (watch->glyphs + 1) % GB_PLOT_GLYPHS;
    }
}

static void repaint(struct watch *watch, struct gb_term *term)
{
    (void)watch;
    gb_term_repaint(term);
}

static void leave(struct watch *watch, struct gb_term *term)
{
    (void)term;
    watch->leave = true;
}

static void navigate(struct watch *watch, enum gb_action action)
{
    switch (action) {
    case GB_ACTION_LEFT:
        move_level(watch, -1);
        break;
    case GB_ACTION_RIGHT:
        move_level(watch, 1);
        break;
    default:
        (void)gb_list_box_navigate(&watch->runs, action);
        break;
    }
}

/* Keys other than digits of the views and navigation. */
static const struct {
    int code[4];
    void (*act)(struct watch *watch, struct gb_term *term);
} keys[] = {
    {{'v', '\t', 'n'}, next_view}, {{'V', KEY_BTAB, 'N'}, previous_view},
    {{'L'}, toggle_log},           {{'b'}, next_glyphs},
    {{CTRL_L}, repaint},           {{'q', KEY_F(10)}, leave},
};

static void act(struct watch *watch, struct gb_term *term, int code)
{
    for (size_t i = 0; i < G_N_ELEMENTS(keys); i++) {
        for (size_t k = 0; k < G_N_ELEMENTS(keys[i].code) && keys[i].code[k] != 0; k++) {
            if (keys[i].code[k] == code) {
                keys[i].act(watch, term);
                return;
            }
        }
    }
    if (code >= '1' && code <= '9') {
        show_view(watch, code - '1');
    } else {
        navigate(watch, gb_keys_action(code));
    }
}

/* Reads the files.  After an error the old data stay on the screen with the message,
 * and the files are read again later. */
static void reread(struct watch *watch)
{
    struct gb_runset_view fresh;
    char *directory = g_strdup(watch->runset.directory);
    watch->error = (struct gb_error){0};
    if (gb_runset_view_read(&fresh, directory, &watch->error)) {
        const double kept_pa = watch->runset.level_pa[watch->level];
        watch->level = kept_pa > 0.0 ? gb_runset_view_nearest(&fresh, kept_pa)
                                     : gb_runset_view_level(&fresh, default_pa);
        gb_runset_view_finish(&watch->runset);
        watch->runset = fresh;
    } else {
        gb_runset_view_finish(&fresh);
    }
    g_free(directory);
}

static bool on_key(void *data, struct gb_term *term, const struct gb_term_event *event)
{
    struct watch *watch = data;
    if (event->code <= LAST_ASCII || event->kind == GB_TERM_KEY) {
        act(watch, term, event->code);
    }
    return !watch->leave;
}

static void on_wheel(void *data, int rows)
{
    struct watch *watch = data;
    gb_list_box_go(&watch->runs, rows);
}

static void on_reread(void *data)
{
    reread(data);
}

static void on_draw(void *data, struct gb_term *term)
{
    draw(data, term);
}

static int first_glyphs(const struct gb_term *term, const struct gb_settings *settings)
{
    const bool utf8 = gb_term_utf8(term);
    if (utf8 && settings->graph != GB_GRAPH_AUTO) {
        return settings->graph - GB_GRAPH_BRAILLE;
    }
    return gb_term_braille(term) ? GB_PLOT_BRAILLE : utf8 ? GB_PLOT_BLOCK : GB_PLOT_ASCII;
}

int gb_watch_run(const char *directory, const struct gb_settings *settings,
                 struct gb_error *err)
{
    struct watch watch = {.runs = {.unfocused = true}};
    struct gb_term *term = NULL;
    if (!gb_runset_view_read(&watch.runset, directory, err) ||
        !gb_term_start(&term, settings, err)) {
        gb_runset_view_finish(&watch.runset);
        return gb_status_exit_code(err->code);
    }
    gb_plot_init(&watch.plot);
    watch.glyphs = first_glyphs(term, settings);
    watch.level = gb_runset_view_level(&watch.runset, default_pa);
    watch.view = watch_views_first(&watch);
    const struct reread_loop loop = {reread_s,  on_key,  on_wheel,
                                     on_reread, on_draw, &watch};
    const int status = reread_loop_run(&loop, term);
    gb_plot_finish(&watch.plot);
    gb_runset_view_finish(&watch.runset);
    return status;
}
