#include <glib.h>
#include <json-glib/json-glib.h>
#include <math.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "base/visible.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "io/run_list.h"
#include "io/rundir.h"
#include "runner/runner.h"
#include "tui/app/app.h"
#include "tui/app/watch.h"
#include "tui/session/run_lifecycle.h"
#include "tui/session/runset_view.h"
#include "tui/term/term_profile.h"

static const char working[] = "runs";

/* How runs are named, so that names are unique: runs of the workbench by their path
 * below the workbench's folder, or all by whole paths. */
enum names { NAMES_BELOW, NAMES_WHOLE };

static void add(GPtrArray *list, const char *folder, enum names names)
{
    const guint before = list->len;
    gb_run_list_add(list, folder);
    for (guint i = before; i < list->len && names == NAMES_WHOLE; i++) {
        struct gb_run_list_item *item = g_ptr_array_index(list, i);
        g_free(item->name);
        item->name = g_strdup(item->directory);
    }
}

/* The runs (io/run_list.h) below these folders, sorted.  Without folders: below the
 * workbench's folder and below `runs` in the working folder, where `run` writes without
 * --out. g_ptr_array_unref. */
static GPtrArray *runs_folders_list(char **folders)
{
    GPtrArray *list = gb_run_list_new();
    GHashTable *seen = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
    const bool one = folders != NULL && folders[0] != NULL && folders[1] == NULL;
    for (int i = 0; folders != NULL && folders[i] != NULL; i++) {
        add(list, folders[i], one ? NAMES_BELOW : NAMES_WHOLE);
    }
    if (folders == NULL || folders[0] == NULL) {
        char *folder = gb_run_lifecycle_folder();
        add(list, folder, NAMES_BELOW);
        add(list, working, NAMES_WHOLE);
        g_free(folder);
    }
    for (guint i = 0; i < list->len;) {
        const struct gb_run_list_item *item = g_ptr_array_index(list, i);
        char *real = realpath(item->directory, NULL);
        if (g_hash_table_add(seen, g_strdup(real ? real : item->directory))) {
            i++;
        } else { /* found below two of the folders */
            g_ptr_array_remove_index(list, i);
        }
        free(real);
    }
    g_hash_table_destroy(seen);
    gb_run_list_sort(list);
    return list;
}

/* The same, but only runs with an engine. */
static GPtrArray *runs_folders_live(void)
{
    GPtrArray *list = runs_folders_list(NULL);
    for (guint i = list->len; i > 0; i--) {
        const struct gb_run_list_item *item = g_ptr_array_index(list, i - 1);
        if (item->engine == GB_RUN_LIST_NONE) {
            g_ptr_array_remove_index(list, i - 1);
        }
    }
    return list;
}

/* The directory of a workbench run with this name, if nothing else has the name;
 * otherwise the name itself. g_free. */
static char *runs_folders_find(const char *name)
{
    char *folder = gb_run_lifecycle_folder();
    char *below = g_build_filename(folder, name, NULL);
    const bool is_below = !g_file_test(name, G_FILE_TEST_EXISTS) && name[0] != '\0' &&
                          g_file_test(below, G_FILE_TEST_IS_DIR);
    g_free(folder);
    if (is_below) {
        return below;
    }
    g_free(below);
    return g_strdup(name);
}

/* The default folders as text: "DIR and runs".  g_free. */
static char *runs_folders_text(void)
{
    char *folder = gb_run_lifecycle_folder();
    char *text = g_strdup_printf("%s and ./%s", folder, working);
    g_free(folder);
    return text;
}

/* Prints one line about a directory of many runs. */
static int print_runs(const char *directory, struct gb_error *err)
{
    struct gb_runset_view view;
    const bool read = gb_runset_view_read(&view, directory, err);
    if (read) {
        gb_visible_print(stdout, "%zu runs: %zu done, %zu under way, %zu failed\n",
                         view.runs, view.done, view.live, view.failed);
    }
    gb_runset_view_finish(&view);
    return read ? 0 : gb_options_fail(err);
}

/* Prints progress lines until the run or this command ends. */
static int print_progress(const char *directory, struct gb_error *err)
{
    struct gb_runner *runner = NULL;
    struct gb_progress progress;
    if (gb_runset_view_any(directory)) {
        return print_runs(directory, err);
    }
    if (!gb_runner_follow(&runner, directory, err)) {
        return gb_options_fail(err);
    }
    gb_progress_catch_signals(GB_SIGNALS_HANGUP_NOTED);
    gb_progress_init(&progress, false);
    const struct gb_snapshot *shot = gb_runner_snapshot(runner, NULL);
    while (gb_progress_caught() == 0 && shot->state <= GB_RUN_PAUSED) {
        g_usleep(200000);
        shot = gb_runner_snapshot(runner, NULL);
        if (shot->now_valid && gb_progress_due(&progress, shot->seconds)) {
            gb_progress_show(&progress, shot);
        }
    }
    if (shot->error.code == GB_ERR_MACHINE || shot->error.code == GB_ERR_INPUT) {
        /* the run could not be read; its error is printed below */
        *err = shot->error;
        gb_progress_clear(&progress);
        gb_runner_destroy(runner);
        return gb_options_fail(err);
    }
    char where[GB_PROGRESS_POINT];
    gb_progress_point(where, &shot->now, ", ");
    gb_progress_say(&progress, "%s: %s, step %lld%s%s", directory, where,
                    (long long)shot->now.step, shot->error.text[0] != '\0' ? ", " : "",
                    shot->error.text);
    gb_runner_destroy(runner);
    const int number = gb_progress_caught();
    return number != 0 ? 128 + number : 0;
}

static int show(const char *directory, const struct gb_settings *settings,
                struct gb_error *err)
{
    struct gb_preset *preset = NULL;
    char *path = g_build_filename(directory, "preset.ini", NULL);
    int status = 0;
    if (gb_runset_view_any(directory)) {
        status = gb_watch_run(directory, settings, err);
    } else if (!g_file_test(path, G_FILE_TEST_IS_REGULAR)) {
        gb_error_set(err, GB_ERR_INPUT,
                     "%s: is not a run directory: it has no preset.ini", directory);
    } else if (gb_preset_load(&preset, path, err)) {
        status = gb_app_run(preset, NULL, directory, settings, err);
    }
    gb_preset_destroy(preset);
    g_free(path);
    return err->code != GB_OK ? gb_options_fail(err) : status;
}

static GPtrArray *list_runs(void)
{
    return runs_folders_list(NULL);
}

/* The run chosen on the screen, g_free; NULL: none, or an error. */
static char *choose(const struct gb_settings *settings, int *status, struct gb_error *err)
{
    char *directory = NULL;
    GPtrArray *list = list_runs();
    if (list->len == 0) {
        char *where = runs_folders_text();
        gb_error_set(err, GB_ERR_INPUT,
                     "attach: there are no runs below %.200s; expected a run directory",
                     where);
        g_free(where);
    } else {
        *status = gb_watch_pick(list_runs, settings, &directory, err);
    }
    g_ptr_array_unref(list);
    return directory;
}

/* Without a terminal: lists the live runs in the error. */
static void name_live(struct gb_error *err)
{
    GPtrArray *list = runs_folders_live();
    if (list->len == 0) {
        char *where = runs_folders_text();
        gb_error_set(err, GB_ERR_INPUT,
                     "attach: no run is live below %.200s; expected a run directory "
                     "(`greenbody runs` lists all)",
                     where);
        g_free(where);
    } else {
        const struct gb_run_list_item *first = g_ptr_array_index(list, 0);
        gb_error_set(err, GB_ERR_INPUT,
                     "attach: expected one run directory; %u live, the newest in %.200s "
                     "(`greenbody runs` lists all)",
                     list->len, first->directory);
    }
    g_ptr_array_unref(list);
}

/* The directory to follow, g_free; NULL: none, or an error. */
static char *find_directory(char **words, const struct gb_settings *settings, int *status,
                            struct gb_error *err)
{
    if (words[0] == NULL && isatty(STDOUT_FILENO) && isatty(STDIN_FILENO)) {
        return choose(settings, status, err);
    }
    if (words[0] == NULL) {
        name_live(err);
        return NULL;
    }
    const char *name = gb_options_directory(words, "attach", err);
    return name != NULL ? runs_folders_find(name) : NULL;
}

static int attach(const struct gb_screen_options *screen, char **words)
{
    struct gb_error err = {0};
    struct gb_settings settings;
    if (screen->diagnose && gb_options_screen_settings(screen, &settings, &err)) {
        gb_term_profile_print(stdout, STDOUT_FILENO, &settings);
        return 0;
    }
    if (!gb_options_screen_settings(screen, &settings, &err)) {
        return gb_options_fail(&err);
    }
    int status = 0;
    char *directory = find_directory(words, &settings, &status, &err);
    if (err.code != GB_OK) {
        status = gb_options_fail(&err);
    } else if (directory != NULL) {
        status = isatty(STDOUT_FILENO) ? show(directory, &settings, &err)
                                       : print_progress(directory, &err);
    }
    g_free(directory);
    return status;
}

int gb_cmd_attach(int argc, char **argv)
{
    static const struct gb_options_page page = {
        "[DIR]",
        "Shows a running simulation of another process, live, from its directory;\n"
        "without one a list of live, detached and past runs to choose from, with a\n"
        "filter, sizes and a key that deletes.  A name of `greenbody runs` is enough\n"
        "for a run of the workbench.\n"
        "Leaving does not affect it.  For a directory of many runs (sweep, calibrate)\n"
        "it shows their mean curves with standard errors, the density over the varied\n"
        "values, and the progress of each run.",
        "t takes the run over: the other process is asked to stop with a checkpoint,\n"
        "and the run continues here.  Where stdout is no terminal, progress is\n"
        "printed line by line."};
    char **words = NULL;
    int status = 0;
    struct gb_screen_options screen = {0};
    GOptionEntry entries[GB_SCREEN_OPTIONS_ENTRIES + 1] = {0};
    gb_options_screen_entries(&screen, entries);
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        status = attach(&screen, words);
    }
    gb_options_screen_finish(&screen);
    g_strfreev(words);
    return status;
}

enum { NAME_COLS_MIN = 4 };

static const struct gb_run_list_item *item_at(const GPtrArray *list, guint index)
{
    return g_ptr_array_index(list, index);
}

static int name_cols(const GPtrArray *list)
{
    glong cols = NAME_COLS_MIN;
    for (guint i = 0; i < list->len; i++) {
        cols = MAX(cols, g_utf8_strlen(item_at(list, i)->name, -1));
    }
    return (int)cols;
}

static void print_line(const char *name, int cols, char *values)
{
    const int pad = cols - (int)g_utf8_strlen(name, -1);
    gb_visible_line(stdout, "%s%*s  %s", name, pad, "", values);
    g_free(values);
}

/* Prints a list of runs: one line each below a head, or with --json an object {"runs":
 * [{...}, ...]} with null for missing values. */
static void runs_output_table(const GPtrArray *list)
{
    const int cols = name_cols(list);
    print_line("name", cols, gb_run_list_line_head(GB_RUN_LIST_LINE_ALL));
    for (guint i = 0; i < list->len; i++) {
        const struct gb_run_list_item *item = item_at(list, i);
        print_line(item->name, cols, gb_run_list_line(item, GB_RUN_LIST_LINE_ALL));
    }
}

static void add_text(JsonBuilder *json, const char *name, const char *text)
{
    char *valid = g_utf8_make_valid(text, -1);
    json_builder_set_member_name(json, name);
    json_builder_add_string_value(json, valid);
    g_free(valid);
}

static void add_number(JsonBuilder *json, const char *name, double value)
{
    json_builder_set_member_name(json, name);
    if (isfinite(value)) {
        json_builder_add_double_value(json, value);
    } else {
        json_builder_add_null_value(json);
    }
}

static void add_item(JsonBuilder *json, const struct gb_run_list_item *item)
{
    GDateTime *time = g_date_time_new_from_unix_utc(item->modified_s);
    char *date = time != NULL ? g_date_time_format_iso8601(time) : g_strdup("");
    json_builder_begin_object(json);
    add_text(json, "directory", item->directory);
    add_text(json, "name", item->name);
    add_text(json, "title", item->title);
    add_text(json, "state", item->state);
    add_text(json, "engine", gb_run_list_engine_word(item->engine));
    add_number(json, "progress", item->progress);
    add_number(json, "density", item->density);
    add_number(json, "pressure_MPa", 1e-6 * item->pressure_pa);
    json_builder_set_member_name(json, "bytes");
    json_builder_add_int_value(json, item->bytes);
    add_text(json, "modified", date);
    json_builder_end_object(json);
    g_free(date);
    if (time != NULL) {
        g_date_time_unref(time);
    }
}

static void runs_output_json(const GPtrArray *list)
{
    JsonBuilder *json = gb_options_json_begin("runs");
    for (guint i = 0; i < list->len; i++) {
        add_item(json, item_at(list, i));
    }
    gb_options_json_end(json);
}

static bool check_folders(char **folders, struct gb_error *err)
{
    for (int i = 0; folders[i] != NULL; i++) {
        if (!g_file_test(folders[i], G_FILE_TEST_IS_DIR)) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "%.300s: expected a folder of run directories",
                                folders[i]);
        }
    }
    return true;
}

static int print(char **folders, bool json)
{
    struct gb_error err = {0};
    if (!check_folders(folders, &err)) {
        return gb_options_fail(&err);
    }
    GPtrArray *list = runs_folders_list(folders);
    if (json) {
        runs_output_json(list);
    } else if (list->len > 0) {
        runs_output_table(list);
    } else {
        char *where =
            folders[0] != NULL ? g_strjoinv(", ", folders) : runs_folders_text();
        gb_visible_line(stderr, "greenbody: no runs below %s", where);
        g_free(where);
    }
    g_ptr_array_unref(list);
    return 0;
}

int gb_cmd_runs(int argc, char **argv)
{
    static const struct gb_options_page page = {
        "[FOLDER]...",
        "Lists the runs below folders: live, detached and past ones, with the density and\n"
        "pressure of their last point, size on the disk and date.  Without FOLDER, the runs\n"
        "of the workbench and those below the folder `runs` here.",
        "live: a process with a terminal computes the run; detached: one without a terminal\n"
        "does; interrupted: its process ended before the run was finished, and\n"
        "`greenbody resume` continues it.  A run of the workbench is named by its path below\n"
        "the workbench's folder; `attach NAME` takes this name.  --json has the directories."};
    char **words = NULL;
    int status = 0;
    gboolean json = FALSE;
    const GOptionEntry entries[] = {gb_options_json(&json), {0}};
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        status = print(words, json);
    }
    g_strfreev(words);
    return status;
}
