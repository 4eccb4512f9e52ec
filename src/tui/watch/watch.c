#include "tui/watch/watch.h"

#include <glib.h>
#include <ncurses.h>
#include <stdio.h>
#include <string.h>

#include "tui/app/keys.h"
#include "tui/term/input/reread_loop.h"
#include "tui/watch/watch_views.h"

/* Seconds between two readings of the files. */
static const double reread_s = 1.0;
/* Initial pressure of the map: P1 compares powders there. */
static const double default_pa = 100e6;

enum { MIN_ROWS = 12, MIN_COLS = 40, PAGE = 10, LAST_ASCII = 126 };

/* "8 runs: 5 done, 2 live, 1 failed  72 %" */
static void draw_header(const struct gb_watch *watch, const struct gb_paint *paint)
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

/* Common keys, and those of the view. */
static void write_hint(const struct gb_watch *watch, char *text, size_t size)
{
    const char *hint = gb_watch_views_at(watch->view)->hint;
    snprintf(text, size, "1-%d views  v next  %s%sq quit", gb_watch_views_count(watch),
             hint, *hint != '\0' ? "  " : "");
}

static void draw_footer(const struct gb_watch *watch, const struct gb_paint *paint)
{
    char hint[120];
    const bool whole = watch->error.code == GB_OK;
    write_hint(watch, hint, sizeof hint);
    gb_paint_cell(paint, paint->rect.rows - 1, 1, paint->rect.cols - 2,
                  whole ? GB_STYLE_DIM : GB_STYLE_WARN, whole ? hint : watch->error.text);
}

static void draw_view(struct gb_watch *watch, const struct gb_paint *paint)
{
    char title[120];
    const struct gb_watch_view *view = gb_watch_views_at(watch->view);
    snprintf(title, sizeof title, "%d %s", watch->view + 1, view->title);
    gb_paint_title(paint, title, GB_PAINT_FOCUSED);
    view->draw(watch, paint);
}

static void draw(struct gb_watch *watch, struct gb_term *term)
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

static void move_level(struct gb_watch *watch, int by)
{
    const int to = (int)watch->level + by;
    watch->level = (size_t)CLAMP(to, 0, MAX((int)watch->runset.levels - 1, 0));
}

static void show_view(struct gb_watch *watch, int view)
{
    if (view < gb_watch_views_count(watch)) {
        watch->view = view;
    }
}

enum { CTRL_L = 'L' & 31 };

static void next_view(struct gb_watch *watch, struct gb_term *term)
{
    (void)term;
    show_view(watch, (watch->view + 1) % gb_watch_views_count(watch));
}

static void previous_view(struct gb_watch *watch, struct gb_term *term)
{
    (void)term;
    show_view(watch, (watch->view + gb_watch_views_count(watch) - 1) %
                         gb_watch_views_count(watch));
}

static void toggle_log(struct gb_watch *watch, struct gb_term *term)
{
    (void)term;
    watch->linear = !watch->linear;
}

static void next_glyphs(struct gb_watch *watch, struct gb_term *term)
{
    if (gb_term_utf8(term)) {
        watch->glyphs = (watch->glyphs + 1) % GB_PLOT_GLYPHS;
    }
}

static void repaint(struct gb_watch *watch, struct gb_term *term)
{
    (void)watch;
    gb_term_repaint(term);
}

static void leave(struct gb_watch *watch, struct gb_term *term)
{
    (void)term;
    watch->leave = true;
}

/* Keys other than digits of the views and navigation. */
static const struct {
    int code[4];
    void (*act)(struct gb_watch *watch, struct gb_term *term);
} keys[] = {
    {{'v', '\t', 'n'}, next_view}, {{'V', KEY_BTAB, 'N'}, previous_view},
    {{'L'}, toggle_log},           {{'b'}, next_glyphs},
    {{CTRL_L}, repaint},           {{'q', KEY_F(10)}, leave},
};

static void navigate(struct gb_watch *watch, enum gb_action action)
{
    switch (action) {
    case GB_ACTION_LEFT:
        move_level(watch, -1);
        break;
    case GB_ACTION_RIGHT:
        move_level(watch, 1);
        break;
    case GB_ACTION_UP:
        watch->top--;
        break;
    case GB_ACTION_DOWN:
        watch->top++;
        break;
    case GB_ACTION_PAGE_UP:
        watch->top -= PAGE;
        break;
    case GB_ACTION_PAGE_DOWN:
        watch->top += PAGE;
        break;
    default:
        break;
    }
}

static void act(struct gb_watch *watch, struct gb_term *term, int code)
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

/* After an error the old data stay on the screen with the message; the files are read
 * again later. */
static void reread(struct gb_watch *watch)
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
    struct gb_watch *watch = data;
    if (event->code <= LAST_ASCII || event->kind == GB_TERM_KEY) {
        act(watch, term, event->code);
    }
    return !watch->leave;
}

static void on_wheel(void *data, int rows)
{
    struct gb_watch *watch = data;
    watch->top += rows;
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
    struct gb_watch watch = {.view = 0};
    struct gb_term *term = NULL;
    if (!gb_runset_view_read(&watch.runset, directory, err) ||
        !gb_term_start(&term, settings, err)) {
        gb_runset_view_finish(&watch.runset);
        return gb_status_exit_code(err->code);
    }
    gb_plot_init(&watch.plot);
    watch.glyphs = first_glyphs(term, settings);
    watch.level = gb_runset_view_level(&watch.runset, default_pa);
    watch.view = gb_watch_views_first(&watch);
    const struct gb_reread_loop loop = {reread_s,  on_key,  on_wheel,
                                        on_reread, on_draw, &watch};
    const int status = gb_reread_loop_run(&loop, term);
    gb_plot_finish(&watch.plot);
    gb_runset_view_finish(&watch.runset);
    return status;
}
