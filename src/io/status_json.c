#include "io/status_json.h"

#include <glib.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/alloc.h"
#include "base/file.h"
#include "base/units.h"
#include "greenbody/stage.h"
#include "io/point_columns.h"

/* Words for the stages of a die run, for the screen and status.json.  The second part
 * of this file prints JSON, writes status.json, and reads it with limits, since the
 * file is not trusted. */

static const char *const names[GB_STAGES] = {
    [GB_STAGE_NONE] = "",
    [GB_STAGE_FILLING] = "filling",
    [GB_STAGE_SETTLING] = "settling",
    [GB_STAGE_EASING] = "easing gravity",
    [GB_STAGE_RESETTLING] = "settling",
    [GB_STAGE_FLATTENING] = "flattening",
    [GB_STAGE_LIFTING] = "lifting punch",
    [GB_STAGE_RESTING] = "coming to rest",
    [GB_STAGE_PRESS] = "pressing",
    [GB_STAGE_UNLOADING] = "unloading",
    [GB_STAGE_WITHDRAWAL] = "punch off",
    [GB_STAGE_CONFINED] = "rest in die",
    [GB_STAGE_EJECTION] = "ejection",
    [GB_STAGE_EJECTED] = "rest outside",
};

/* Names of the quantities, and units of value and goal; GB_DIM_NONE: a multiple of a
 * limit. */
static const struct {
    const char *quantity;
    enum gb_dimension dimension;
    const char *limit;
} measures[GB_STAGE_MEASURES] = {
    [GB_STAGE_MEASURE_NONE] = {"", GB_DIM_NONE, ""},
    [GB_STAGE_MEASURE_POURED] = {"particles poured", GB_DIM_NONE, ""},
    [GB_STAGE_MEASURE_KINETIC] = {"kinetic energy", GB_DIM_NONE, "limit"},
    [GB_STAGE_MEASURE_UNBALANCED] = {"unbalanced force", GB_DIM_NONE, "limit"},
    [GB_STAGE_MEASURE_GRAVITY] = {"gravity", GB_DIM_NONE, "final"},
    [GB_STAGE_MEASURE_TRAVEL] = {"travel", GB_DIM_LENGTH, ""},
    [GB_STAGE_MEASURE_PRESSURE] = {"pressure", GB_DIM_PRESSURE, ""},
    [GB_STAGE_MEASURE_TIME] = {"simulated time", GB_DIM_TIME, ""},
};

const char *gb_status_json_stage_name(enum gb_stage stage)
{
    return names[stage];
}

/* "particles poured", "kinetic energy over its limit", ...; "" without a measure. */
static const char *stage_text_quantity(enum gb_stage_measure measure)
{
    return measures[measure].quantity;
}

enum gb_stage gb_status_json_stage_find(const char *name)
{
    for (int k = 0; k < GB_STAGES; k++) {
        if (strcmp(names[k], name) == 0) {
            return (enum gb_stage)k;
        }
    }
    return GB_STAGE_NONE;
}

enum gb_stage_measure gb_status_json_stage_quantity(const char *quantity)
{
    for (int k = 0; k < GB_STAGE_MEASURES; k++) {
        if (strcmp(measures[k].quantity, quantity) == 0) {
            return (enum gb_stage_measure)k;
        }
    }
    return GB_STAGE_MEASURE_NONE;
}

/* "0.4", "35", "48k", "1.2M". */
static void write_multiple(double value, char *text, size_t size)
{
    const char *prefix = value >= 999.5e3 ? "M" : value >= 999.5 ? "k" : "";
    const double scaled = value >= 999.5e3 ? 1e-6 * value
                          : value >= 999.5 ? 1e-3 * value
                                           : value;
    snprintf(text, size, scaled < 9.95 ? "%.1f%s" : "%.0f%s", scaled, prefix);
}

char *gb_status_json_stage_value(const struct gb_stage_report *report, char *text,
                                 size_t size)
{
    const enum gb_dimension dimension = measures[report->measure].dimension;
    char value[48], goal[48];
    text[0] = '\0';
    if (report->measure == GB_STAGE_MEASURE_POURED) {
        snprintf(text, size, "%.0f of %.0f", report->value, report->goal);
    } else if (dimension != GB_DIM_NONE) {
        gb_units_format_short(report->value, dimension, 3, value, sizeof value);
        gb_units_format_short(report->goal, dimension, 3, goal, sizeof goal);
        snprintf(text, size, "%s of %s", value, goal);
        if (!(report->goal > 0.0)) { /* falls to 0 */
            snprintf(text, size, "%s", value);
        }
    } else if (report->measure != GB_STAGE_MEASURE_NONE) {
        write_multiple(report->value, value, sizeof value);
        snprintf(text, size, "%s x %s", value, measures[report->measure].limit);
    }
    return text;
}

char *gb_status_json_stage_line(const struct gb_stage_report *report, char *text,
                                size_t size)
{
    char value[112];
    gb_status_json_stage_value(report, value, sizeof value);
    const bool named = measures[report->measure].dimension == GB_DIM_NONE &&
                       value[0] != '\0'; /* the unit shows the quantity */
    snprintf(text, size, "%s%s%s%s%s", gb_status_json_stage_name(report->stage),
             value[0] != '\0' ? ": " : "",
             named ? stage_text_quantity(report->measure) : "", named ? " " : "", value);
    return text;
}

enum { BYTES_MOST = 1 << 20, DEPTH_MOST = 8 };

static const char *const state_words[] = {
    [GB_RUN_PACKING] = "packing", [GB_RUN_RUNNING] = "running",
    [GB_RUN_PAUSED] = "paused",   [GB_RUN_DONE] = "done",
    [GB_RUN_STOPPED] = "stopped", [GB_RUN_FAILED] = "failed"};

const char *gb_status_json_word(enum gb_run_state state)
{
    return (size_t)state < G_N_ELEMENTS(state_words) ? state_words[state] : "unknown";
}

/* Are brackets outside strings nested no deeper than in a status file? */
static bool is_shallow(const char *text, size_t length)
{
    int depth = 0, deepest = 0;
    bool quoted = false;
    for (size_t i = 0; i < length; i++) {
        if (quoted) {
            quoted = text[i] != '"';
            i += text[i] == '\\'; /* skips the escaped character */
        } else if (text[i] == '"') {
            quoted = true;
        } else if (text[i] == '{' || text[i] == '[') {
            deepest = MAX(deepest, ++depth);
        } else if (text[i] == '}' || text[i] == ']') {
            depth--;
        }
    }
    return deepest <= DEPTH_MOST;
}

static bool parse(JsonParser *parser, const char *path, const char *text, size_t length,
                  struct gb_error *err)
{
    GError *failure = NULL;
    if (!is_shallow(text, length)) {
        return gb_error_set(err, GB_ERR_INPUT, "%s: is no status of a run", path);
    }
    if (!json_parser_load_from_data(parser, text, (gssize)length, &failure)) {
        gb_error_set(err, GB_ERR_INPUT, "%s: cannot be read: %s", path, failure->message);
        g_error_free(failure);
        return false;
    }
    JsonNode *root = json_parser_get_root(parser);
    return (root != NULL && JSON_NODE_HOLDS_OBJECT(root)) ||
           gb_error_set(err, GB_ERR_INPUT, "%s: is no status of a run", path);
}

JsonParser *gb_status_json_open(const char *path, struct gb_error *err)
{
    char *text = NULL;
    size_t length = 0;
    if (!gb_file_read(path, BYTES_MOST, &text, &length, err)) {
        return NULL;
    }
    JsonParser *parser = json_parser_new_immutable();
    if (!parse(parser, path, text, length, err)) {
        g_clear_object(&parser);
    }
    gb_alloc_free(text);
    return parser;
}

enum gb_run_state gb_status_json_state(const char *word)
{
    for (size_t k = 0; k < G_N_ELEMENTS(state_words); k++) {
        if (strcmp(state_words[k], word) == 0) {
            return (enum gb_run_state)k;
        }
    }
    return GB_RUN_STOPPED;
}

/* Repairs numbers: json-glib appends ".0" to a number without a point, even after an
 * exponent.  Outside strings, this is the only place where a point follows an exponent.
 */
char *gb_status_json_print(JsonNode *root)
{
    char *text = json_to_string(root, TRUE);
    char *to = text;
    bool quoted = false, exponent = false;
    for (const char *from = text; *from != '\0'; from++) {
        if (*from == '"') {
            quoted = !quoted;
        }
        if (!quoted && exponent && *from == '.') {
            from++;
            continue;
        }
        exponent = !quoted &&
                   (*from == 'e' || (exponent && strchr("+-0123456789", *from) != NULL));
        *to++ = *from;
        if (quoted && *from == '\\') {
            *to++ = *++from;
        }
    }
    *to = '\0';
    return text;
}

/* Adds a number, or null if it is not finite. */
static void add_double(JsonBuilder *json, const char *name, double value)
{
    json_builder_set_member_name(json, name);
    if (isfinite(value)) {
        json_builder_add_double_value(json, value);
    } else {
        json_builder_add_null_value(json);
    }
}

static void add_integer(JsonBuilder *json, const char *name, int64_t value)
{
    json_builder_set_member_name(json, name);
    json_builder_add_int_value(json, value);
}

/* Adds a text as valid UTF-8; paths in an error may contain any bytes. */
static void add_text(JsonBuilder *json, const char *name, const char *text)
{
    char *valid = g_utf8_make_valid(text, -1);
    json_builder_set_member_name(json, name);
    json_builder_add_string_value(json, valid);
    g_free(valid);
}

static void add_array(JsonBuilder *json, const char *name, const double *values,
                      int count)
{
    json_builder_set_member_name(json, name);
    json_builder_begin_array(json);
    for (int k = 0; k < count; k++) {
        if (isfinite(values[k])) {
            json_builder_add_double_value(json, values[k]);
        } else {
            json_builder_add_null_value(json);
        }
    }
    json_builder_end_array(json);
}

/* Adds the stage of a die run: the known values in SI units. */
static void add_stage(JsonBuilder *json, const struct gb_stage_report *stage)
{
    json_builder_set_member_name(json, "stage");
    json_builder_begin_object(json);
    add_text(json, "name", gb_status_json_stage_name(stage->stage));
    add_text(json, "measure", stage_text_quantity(stage->measure));
    add_double(json, "value", stage->value);
    add_double(json, "goal", stage->goal);
    add_double(json, "share", stage->share);
    add_integer(json, "poured", stage->poured);
    add_double(json, "time_s", stage->time_s);
    add_double(json, "height_m", stage->height_m);
    add_double(json, "kinetic_J", stage->kinetic_j);
    add_double(json, "coordination", stage->coordination);
    json_builder_end_object(json);
}

static void add_progress(JsonBuilder *json, const struct gb_snapshot *shot,
                         int64_t points)
{
    const struct gb_point_column *row;
    add_double(json, "progress", shot->progress);
    add_integer(json, "points", points);
    for (size_t k = 0; (row = gb_point_columns_at(k)) != NULL; k++) {
        const double value = shot->now_valid && row->status != NULL
                                 ? gb_point_columns_value(row, &shot->now, 0)
                                 : (double)NAN;
        if (row->status != NULL && row->type == 'q') {
            add_integer(json, row->status, isnan(value) ? 0 : (int64_t)value);
        } else if (row->status != NULL) {
            add_double(json, row->status, value);
        }
    }
    add_integer(json, "evaluations", shot->evaluations);
    add_double(json, "evaluations_per_s", shot->evaluations_per_s);
    add_double(json, "particle_evaluations_per_s", shot->particle_evaluations_per_s);
    add_double(json, "seconds", shot->seconds);
    add_double(json, "seconds_left",
               shot->seconds_left >= 0.0 ? shot->seconds_left : (double)NAN);
    add_integer(json, "events", shot->events);
    add_double(json, "residual", shot->live_residual);
    add_double(json, "time_step_s", shot->time_step_s);
    add_array(json, "histogram", shot->histogram, GB_SNAPSHOT_HISTOGRAM);
    add_array(json, "rose", shot->rose, GB_SNAPSHOT_ROSE);
    if (shot->stage.stage != GB_STAGE_NONE) {
        add_stage(json, &shot->stage);
    }
}

char *gb_status_json_text(const struct gb_snapshot *snapshot, int64_t points)
{
    JsonBuilder *json = json_builder_new();
    json_builder_begin_object(json);
    add_text(json, "program", "greenbody " GB_VERSION);
    add_text(json, "state", gb_status_json_word(snapshot->state));
    add_integer(json, "pid", (int64_t)getpid());
    add_text(json, "host", g_get_host_name());
    add_progress(json, snapshot, points);
    add_text(json, "event", snapshot->event);
    add_text(json, "error", snapshot->error.code == GB_OK ? "" : snapshot->error.text);
    json_builder_end_object(json);
    JsonNode *root = json_builder_get_root(json);
    char *text = gb_status_json_print(root);
    char *whole = g_strconcat(text, "\n", NULL);
    g_free(text);
    json_node_unref(root);
    g_object_unref(json);
    return whole;
}

bool gb_status_json_is_done(const char *path)
{
    JsonParser *parser = gb_status_json_open(path, NULL);
    if (parser == NULL) {
        return false;
    }
    JsonObject *status = json_node_get_object(json_parser_get_root(parser));
    const bool done =
        strcmp(json_object_get_string_member_with_default(status, "state", ""), "done") ==
        0;
    g_object_unref(parser);
    return done;
}
