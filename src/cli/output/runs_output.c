#include "cli/output/runs_output.h"

#include <json-glib/json-glib.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/text/visible.h"
#include "base/units.h"
#include "cli/output/json_output.h"
#include "io/runs/run_list.h"

enum { NAME_COLS_MIN = 4, STATE_COLS = 14 };

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

/* "done", "live 45 %", "detached 45 %", "paused 45 %". */
static void write_state(const struct gb_run_list_item *item, char *text, size_t size)
{
    const bool paused = strcmp(item->state, "paused") == 0;
    if (item->engine == GB_RUN_LIST_NONE) {
        snprintf(text, size, "%s", item->state);
    } else {
        snprintf(text, size, "%s %.0f %%",
                 paused ? item->state : gb_run_list_engine_word(item->engine),
                 floor(100.0 * item->progress));
    }
}

/* "94.2 kB" and "11-25 23:58", or "2025-11-25" of another year. */
static char *size_text(int64_t bytes)
{
    char *size = g_format_size((guint64)bytes);
    char **parts = g_strsplit(size, "\u00a0", 2); /* no-break space */
    char *text = g_strjoinv(" ", parts);
    g_strfreev(parts);
    g_free(size);
    return text;
}

static char *date_text(int64_t seconds)
{
    GDateTime *time = g_date_time_new_from_unix_local(seconds);
    GDateTime *now = g_date_time_new_now_local();
    const bool known = time != NULL && now != NULL;
    char *text = !known ? g_strdup("-")
                        : g_date_time_format(time, g_date_time_get_year(time) ==
                                                           g_date_time_get_year(now)
                                                       ? "%m-%d %H:%M"
                                                       : "%Y-%m-%d");
    g_clear_pointer(&time, g_date_time_unref);
    g_clear_pointer(&now, g_date_time_unref);
    return text;
}

static void print_line(const struct gb_run_list_item *item, int cols)
{
    char state[48];
    char density[16] = "-";
    char pressure[32] = "-";
    char *date = date_text(item->modified_s);
    char *size = size_text(item->bytes);
    write_state(item, state, sizeof state);
    if (isfinite(item->density)) {
        snprintf(density, sizeof density, "%.4f", item->density);
    }
    if (isfinite(item->pressure_pa)) {
        gb_units_format_short(item->pressure_pa, GB_DIM_PRESSURE, 3, pressure,
                              sizeof pressure);
    }
    const int pad = cols - (int)g_utf8_strlen(item->name, -1);
    gb_visible_line(stdout, "%s%*s  %-*s  %7s  %8s  %8s  %s", item->name, pad, "",
                    STATE_COLS, state, density, pressure, size, date);
    g_free(size);
    g_free(date);
}

static void print_head(int cols, const char *before)
{
    gb_visible_line(stdout, "%s%-*s  %-*s  %7s  %8s  %8s  %s", before, cols, "name",
                    STATE_COLS, "state", "density", "pressure", "size", "date");
}

void gb_runs_output_table(const GPtrArray *list)
{
    const int cols = name_cols(list);
    print_head(cols, "");
    for (guint i = 0; i < list->len; i++) {
        print_line(item_at(list, i), cols);
    }
}

void gb_runs_output_choices(const GPtrArray *list)
{
    const int cols = name_cols(list);
    print_head(cols, "    ");
    for (guint i = 0; i < list->len; i++) {
        gb_visible_print(stdout, "%2u  ", i + 1);
        print_line(item_at(list, i), cols);
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

void gb_runs_output_json(const GPtrArray *list)
{
    JsonBuilder *json = gb_json_output_begin("runs");
    for (guint i = 0; i < list->len; i++) {
        add_item(json, item_at(list, i));
    }
    gb_json_output_end(json);
}
