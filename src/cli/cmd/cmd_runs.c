#include <glib.h>
#include <json-glib/json-glib.h>
#include <math.h>
#include <stdio.h>

#include "base/text/visible.h"
#include "cli/commands.h"
#include "cli/json_output.h"
#include "cli/options.h"
#include "cli/runs_folders.h"
#include "io/runs/run_line.h"

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

/* A list of runs (io/runs/run_list.h) on stdout: a line each below a head, or with --json an
 * object {"runs": [{...}, ...]}, in which what is not there is null. */
static void runs_output_table(const GPtrArray *list)
{
    const int cols = name_cols(list);
    print_line("name", cols, gb_run_line_head(GB_RUN_LINE_ALL));
    for (guint i = 0; i < list->len; i++) {
        const struct gb_run_list_item *item = item_at(list, i);
        print_line(item->name, cols, gb_run_line_values(item, GB_RUN_LINE_ALL));
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
    JsonBuilder *json = gb_json_output_begin("runs");
    for (guint i = 0; i < list->len; i++) {
        add_item(json, item_at(list, i));
    }
    gb_json_output_end(json);
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
    GPtrArray *list = gb_runs_folders_list(folders);
    if (json) {
        runs_output_json(list);
    } else if (list->len > 0) {
        runs_output_table(list);
    } else {
        char *where =
            folders[0] != NULL ? g_strjoinv(", ", folders) : gb_runs_folders_text();
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
