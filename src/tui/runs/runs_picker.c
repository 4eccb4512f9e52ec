#include "tui/runs/runs_picker.h"

#include <ncurses.h>
#include <stdio.h>
#include <string.h>

#include "io/runs/run_delete.h"
#include "tui/app/keys.h"
#include "tui/runs/runs_picker_private.h"
#include "tui/term/input/reread_loop.h"

/* Seconds between two readings of the folders. */
static const double reread_s = 2.0;

enum { CTRL_D = 'D' & 31, FAR = 100000 };

const struct gb_run_list_item *gb_runs_picker_at(const struct gb_runs_picker *picker,
                                                 int index)
{
    return index >= 0 && index < (int)picker->shown->len
               ? g_ptr_array_index(picker->items,
                                   g_array_index(picker->shown, guint, index))
               : NULL;
}

const struct gb_run_list_item *gb_runs_picker_focused(const struct gb_runs_picker *picker)
{
    return gb_runs_picker_at(picker, picker->focus);
}

/* Every word of the filter is in the name, the title or the state. */
static bool matches(const struct gb_run_list_item *item, char **words)
{
    const char *engine =
        item->engine != GB_RUN_LIST_NONE ? gb_run_list_engine_word(item->engine) : "";
    char *text =
        g_strdup_printf("%s %s %s %s", item->name, item->title, item->state, engine);
    char *folded = g_utf8_casefold(text, -1);
    bool good = true;
    for (int i = 0; words[i] != NULL && good; i++) {
        good = strstr(folded, words[i]) != NULL;
    }
    g_free(folded);
    g_free(text);
    return good;
}

/* The run of this directory keeps the focus; NULL: the first one. */
static void apply_filter(struct gb_runs_picker *picker, const char *directory)
{
    char *folded = g_utf8_casefold(gb_prompt_text(&picker->filter), -1);
    char **words = g_strsplit(folded, " ", -1);
    g_array_set_size(picker->shown, 0);
    picker->focus = 0;
    for (guint i = 0; i < picker->items->len; i++) {
        const struct gb_run_list_item *item = g_ptr_array_index(picker->items, i);
        if (!matches(item, words)) {
            continue;
        }
        if (g_strcmp0(item->directory, directory) == 0) {
            picker->focus = (int)picker->shown->len;
        }
        g_array_append_val(picker->shown, i);
    }
    g_strfreev(words);
    g_free(folded);
}

static void reread(struct gb_runs_picker *picker)
{
    const struct gb_run_list_item *item =
        picker->items != NULL ? gb_runs_picker_focused(picker) : NULL;
    char *directory = g_strdup(item != NULL ? item->directory : NULL);
    GPtrArray *fresh = picker->list();
    g_clear_pointer(&picker->items, g_ptr_array_unref);
    picker->items = fresh;
    apply_filter(picker, directory);
    /* the question was about another run */
    item = gb_runs_picker_focused(picker);
    picker->asks = picker->asks && item != NULL && item->engine == GB_RUN_LIST_NONE &&
                   g_strcmp0(item->directory, directory) == 0;
    g_free(directory);
}

static void say(struct gb_runs_picker *picker, enum gb_style style, const char *text)
{
    g_strlcpy(picker->note, text, sizeof picker->note);
    picker->note_style = style;
}

static void ask(struct gb_runs_picker *picker)
{
    const struct gb_run_list_item *item = gb_runs_picker_focused(picker);
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

static void delete_focused(struct gb_runs_picker *picker)
{
    const struct gb_run_list_item *item = gb_runs_picker_focused(picker);
    const int focus = picker->focus;
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
    picker->focus = MAX(MIN(focus, (int)picker->shown->len - 1), 0);
}

static void go(struct gb_runs_picker *picker, int by)
{
    const int last = MAX((int)picker->shown->len - 1, 0);
    picker->focus = CLAMP(picker->focus + by, 0, last);
}

/* Esc clears the filter first. */
static void leave(struct gb_runs_picker *picker)
{
    if (*gb_prompt_text(&picker->filter) != '\0') {
        gb_prompt_set(&picker->filter, "");
        reread(picker);
    } else {
        picker->leave = true;
    }
}

static void choose(struct gb_runs_picker *picker)
{
    const struct gb_run_list_item *item = gb_runs_picker_focused(picker);
    if (item != NULL) {
        picker->chosen = g_strdup(item->directory);
        picker->leave = true;
    }
}

/* Keys that are not text; false: the line takes them. */
static bool act(struct gb_runs_picker *picker, int code)
{
    switch (code) {
    case KEY_UP:
        go(picker, -1);
        return true;
    case KEY_DOWN:
        go(picker, 1);
        return true;
    case KEY_PPAGE:
        go(picker, -picker->page);
        return true;
    case KEY_NPAGE:
        go(picker, picker->page);
        return true;
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

static void press(struct gb_runs_picker *picker, const struct gb_term_event *event)
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
    if (gb_prompt_handle(&picker->filter, event)) {
        apply_filter(picker, NULL);
    }
}

static bool on_key(void *data, struct gb_term *term, const struct gb_term_event *event)
{
    struct gb_runs_picker *picker = data;
    (void)term;
    press(picker, event);
    return !picker->leave;
}

static void on_wheel(void *data, int rows)
{
    go(data, rows);
}

static void on_reread(void *data)
{
    reread(data);
}

static void show(void *data, struct gb_term *term)
{
    gb_runs_picker_draw(data, term);
    gb_term_flush(term);
}

int gb_runs_picker_run(GPtrArray *(*list)(void), const struct gb_settings *settings,
                       char **directory, struct gb_error *err)
{
    struct gb_runs_picker *picker = g_new0(struct gb_runs_picker, 1);
    struct gb_term *term = NULL;
    int status = gb_status_exit_code(GB_ERR_MACHINE);
    picker->list = list;
    picker->shown = g_array_new(FALSE, FALSE, sizeof(guint));
    gb_prompt_set(&picker->filter, "");
    *directory = NULL;
    if (gb_term_start(&term, settings, err)) {
        reread(picker);
        const struct gb_reread_loop loop = {reread_s,  on_key, on_wheel,
                                            on_reread, show,   picker};
        status = gb_reread_loop_run(&loop, term);
        *directory = status == 0 ? g_steal_pointer(&picker->chosen) : NULL;
    }
    g_clear_pointer(&picker->items, g_ptr_array_unref);
    g_array_unref(picker->shown);
    g_free(picker->chosen);
    g_free(picker);
    return status;
}
