#include "tui/watch/runs_picker.h"

#include <ncurses.h>
#include <stdio.h>

#include "io/runs/run_delete.h"
#include "io/runs/run_line.h"
#include "io/runs/run_list.h"
#include "tui/app/keys.h"
#include "tui/panel/list_box.h"
#include "tui/term/paint.h"
#include "tui/watch/reread_loop.h"

/* State of the screen. */
struct picker {
    GPtrArray *(*list)(void);
    GPtrArray *items;       /* all runs */
    struct gb_list_box box; /* of those that match the filter */
    bool asks;              /* whether to delete the focused one */
    int files;              /* of that */
    char note[400];
    enum gb_style note_style;
    bool leave;
    char *chosen; /* directory; NULL: none */
};

/* The run in focus; NULL: none matches. */
static const struct gb_run_list_item *focused(const struct picker *picker)
{
    const int item = gb_list_box_focused(&picker->box);
    return item >= 0 ? g_ptr_array_index(picker->items, (guint)item) : NULL;
}

/* Every word of the filter is in the name, the title or the state. */
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

/* The run of this directory keeps the focus; NULL: the first one. */
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

static void reread(struct picker *picker)
{
    const struct gb_run_list_item *item = picker->items != NULL ? focused(picker) : NULL;
    char *directory = g_strdup(item != NULL ? item->directory : NULL);
    GPtrArray *fresh = picker->list();
    g_clear_pointer(&picker->items, g_ptr_array_unref);
    picker->items = fresh;
    apply_filter(picker, directory);
    /* the question was about another run */
    item = focused(picker);
    picker->asks = picker->asks && item != NULL && item->engine == GB_RUN_LIST_NONE &&
                   g_strcmp0(item->directory, directory) == 0;
    g_free(directory);
}

/* Esc clears the filter first. */
static void leave(struct picker *picker)
{
    if (*gb_prompt_text(&picker->box.filter) != '\0') {
        gb_prompt_set(&picker->box.filter, "");
        reread(picker);
    } else {
        picker->leave = true;
    }
}

enum {
    MIN_ROWS = 12,
    MIN_COLS = 40,
    ALL_COLS = 76, /* from here on with density and pressure */
    ABOVE = 4,     /* header, filter, blank line, head */
    BELOW = 3      /* directory, note or question, keys */
};

static void draw_header(const struct picker *picker, const struct gb_paint *paint)
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

/* What a row is written from. */
struct source {
    const struct picker *picker;
    enum gb_run_line_extent extent;
};

static void write_run(void *data, int at, struct gb_list_box_line *line)
{
    const struct source *source = data;
    const struct gb_run_list_item *item =
        g_ptr_array_index(source->picker->items, (guint)at);
    line->style = item->engine != GB_RUN_LIST_NONE ? GB_STYLE_GOOD : GB_STYLE_PLAIN;
    line->cell[0] = g_strdup(item->name);
    line->cell[1] = gb_run_line_values(item, source->extent);
}

static void draw_list(struct picker *picker, const struct gb_paint *paint)
{
    struct source source = {picker, paint->rect.cols >= ALL_COLS ? GB_RUN_LINE_ALL
                                                                 : GB_RUN_LINE_BRIEF};
    char *head = gb_run_line_head(source.extent);
    const struct gb_list_box_look look = {
        .columns = 2,
        .column = {{.title = "name"},
                   {.title = head, .cols = gb_paint_width(head) + 1, .right = true}},
        .head = GB_STYLE_DIM,
        .titled = true,
        .empty = "no run matches",
        .empty_style = GB_STYLE_DIM,
        .write = write_run};
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

static void draw_screen(struct picker *picker, const struct gb_term *term)
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
    gb_list_box_draw_filter(&picker->box, &paint, 1, 1, "Filter:");
    draw_list(picker, &paint);
    draw_foot(picker, &paint);
}

/* Seconds between two readings of the folders. */
static const double reread_s = 2.0;

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
    picker->files = gb_run_delete_count(item->directory);
    picker->asks = true;
}

static void delete_focused(struct picker *picker)
{
    const struct gb_run_list_item *item = focused(picker);
    const int focus = picker->box.focus;
    struct gb_error err = {0};
    char text[400];
    if (gb_run_delete(item->directory, &err)) {
        snprintf(text, sizeof text, "deleted: %.300s", item->name);
        say(picker, GB_STYLE_GOOD, text);
    } else {
        say(picker, GB_STYLE_BAD, err.text);
    }
    picker->asks = false;
    reread(picker);
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

/* Keys that are not text; false: the line takes them. */
static bool act(struct picker *picker, int code)
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
        leave(picker);
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
    if (event->kind == GB_TERM_KEY && act(picker, event->code)) {
        return;
    }
    if (gb_list_box_handle(&picker->box, event) == GB_LIST_BOX_TYPED) {
        apply_filter(picker, NULL);
    }
}

static bool on_key(void *data, struct gb_term *term, const struct gb_term_event *event)
{
    struct picker *picker = data;
    (void)term;
    press(picker, event);
    return !picker->leave;
}

static void on_wheel(void *data, int rows)
{
    struct picker *picker = data;
    gb_list_box_go(&picker->box, rows);
}

static void on_reread(void *data)
{
    reread(data);
}

static void show(void *data, struct gb_term *term)
{
    draw_screen(data, term);
    gb_term_flush(term);
}

int gb_runs_picker_run(GPtrArray *(*list)(void), const struct gb_settings *settings,
                       char **directory, struct gb_error *err)
{
    struct picker *picker = g_new0(struct picker, 1);
    struct gb_term *term = NULL;
    int status = gb_status_exit_code(GB_ERR_MACHINE);
    picker->list = list;
    *directory = NULL;
    if (gb_term_start(&term, settings, err)) {
        reread(picker);
        const struct gb_reread_loop loop = {reread_s,  on_key, on_wheel,
                                            on_reread, show,   picker};
        status = gb_reread_loop_run(&loop, term);
        *directory = status == 0 ? g_steal_pointer(&picker->chosen) : NULL;
    }
    g_clear_pointer(&picker->items, g_ptr_array_unref);
    gb_list_box_finish(&picker->box);
    g_free(picker->chosen);
    g_free(picker);
    return status;
}
