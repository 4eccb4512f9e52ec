#include "io/follow.h"

#include <errno.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include <glib.h>

#include "io/preset.h"
#include "io/status_json.h"

bool gb_follow_params(const char *directory, struct gb_params *params,
                      struct gb_error *err)
{
    struct gb_preset *preset = NULL;
    struct gb_error why = {0};
    char *path = g_build_filename(directory, "preset.ini", NULL);
    bool done =
        g_file_test(path, G_FILE_TEST_IS_REGULAR) ||
        gb_error_set(err, GB_ERR_INPUT,
                     "%s: is not a run directory: it has no preset.ini", directory);
    done = done && gb_preset_load(&preset, path, err);
    if (done) {
        *params = *gb_preset_params(preset);
        done = gb_params_check(params, &why) ||
               gb_error_set(err, why.code, "%s: %s", path, why.text);
    }
    gb_preset_destroy(preset);
    g_free(path);
    return done;
}

static double number(JsonObject *json, const char *name, double missing)
{
    JsonNode *node = json_object_get_member(json, name);
    const bool is = node != NULL && JSON_NODE_HOLDS_VALUE(node) &&
                    (json_node_get_value_type(node) == G_TYPE_DOUBLE ||
                     json_node_get_value_type(node) == G_TYPE_INT64);
    return is ? json_node_get_double(node) : missing;
}

static const char *word(JsonObject *json, const char *name)
{
    return json_object_get_string_member_with_default(json, name, "");
}

static void fill_array(JsonObject *json, const char *name, double *values, guint count)
{
    JsonNode *node = json_object_get_member(json, name);
    JsonArray *array =
        node != NULL && JSON_NODE_HOLDS_ARRAY(node) ? json_node_get_array(node) : NULL;
    for (guint k = 0; k < count; k++) {
        JsonNode *item = array != NULL && k < json_array_get_length(array)
                             ? json_array_get_element(array, k)
                             : NULL;
        values[k] = item != NULL && JSON_NODE_HOLDS_VALUE(item)
                        ? json_node_get_double(item)
                        : (double)NAN;
    }
}

static void fill_stage(JsonObject *json, struct gb_stage_report *stage)
{
    JsonNode *node = json_object_get_member(json, "stage");
    *stage = (struct gb_stage_report){.timed = (double)NAN};
    if (node == NULL || !JSON_NODE_HOLDS_OBJECT(node)) {
        return;
    }
    JsonObject *from = json_node_get_object(node);
    stage->stage = gb_status_json_stage_find(word(from, "name"));
    stage->measure = gb_status_json_stage_quantity(word(from, "measure"));
    stage->value = number(from, "value", (double)NAN);
    stage->goal = number(from, "goal", (double)NAN);
    stage->share = number(from, "share", (double)NAN);
    stage->poured = (int64_t)number(from, "poured", 0.0);
    stage->time_s = number(from, "time_s", (double)NAN);
    stage->height_m = number(from, "height_m", (double)NAN);
    stage->kinetic_j = number(from, "kinetic_J", (double)NAN);
    stage->coordination = number(from, "coordination", (double)NAN);
}

static void fill_status(JsonObject *json, struct gb_snapshot *shot,
                        struct gb_follow_engine *engine)
{
    shot->state = gb_status_json_state(word(json, "state"));
    shot->progress = number(json, "progress", 0.0);
    shot->now.step = (int64_t)number(json, "step", 0.0);
    shot->evaluations = (int64_t)number(json, "evaluations", 0.0);
    shot->evaluations_per_s = number(json, "evaluations_per_s", 0.0);
    shot->particle_evaluations_per_s = number(json, "particle_evaluations_per_s", 0.0);
    shot->seconds = number(json, "seconds", 0.0);
    shot->seconds_left = number(json, "seconds_left", -1.0);
    shot->live_residual = number(json, "residual", 0.0);
    shot->time_step_s = number(json, "time_step_s", 0.0);
    shot->events = (int64_t)number(json, "events", 0.0);
    fill_array(json, "histogram", shot->histogram, GB_SNAPSHOT_HISTOGRAM);
    fill_array(json, "rose", shot->rose, GB_SNAPSHOT_ROSE);
    fill_stage(json, &shot->stage);
    g_strlcpy(shot->event, word(json, "event"), sizeof shot->event);
    shot->error = (struct gb_error){0};
    if (word(json, "error")[0] != '\0') {
        gb_error_set(&shot->error, GB_ERR_CANCELLED, "%s", word(json, "error"));
    }
    engine->pid = (long long)number(json, "pid", 0.0);
    engine->here = strcmp(word(json, "host"), g_get_host_name()) == 0;
}

bool gb_follow_status(const char *directory, struct gb_snapshot *snapshot,
                      struct gb_follow_engine *engine, struct gb_error *err)
{
    char *path = g_build_filename(directory, "status.json", NULL);
    JsonParser *parser = gb_status_json_open(path, err);
    g_free(path);
    if (parser == NULL) {
        return false;
    }
    fill_status(json_node_get_object(json_parser_get_root(parser)), snapshot, engine);
    g_object_unref(parser);
    return true;
}

/* Reads /proc/PID/stat and returns the text after the process name, " S 1 2 ..."; NULL
 * if there is none. */
static const char *read_stat(long long pid, char *line, int size)
{
    char *path = g_strdup_printf("/proc/%lld/stat", pid);
    FILE *stat_file = fopen(path, "re");
    line[0] = '\0';
    if (stat_file != NULL) {
        (void)!fgets(line, size, stat_file);
        fclose(stat_file);
    }
    g_free(path);
    const char *name_end = strrchr(line, ')'); /* a name may contain ") Z" */
    return name_end != NULL ? name_end + 1 : NULL;
}

/* Is the process a zombie: ended, but not yet waited for by its parent? */
static bool is_zombie(long long pid)
{
    char line[512];
    const char *told = read_stat(pid, line, sizeof line);
    return told != NULL && g_str_has_prefix(told, " Z");
}

bool gb_follow_engine_detached(const struct gb_follow_engine *engine)
{
    char line[512];
    int terminal = 0; /* the fifth field after the name */
    const char *told = engine->here && engine->pid > 1
                           ? read_stat(engine->pid, line, sizeof line)
                           : NULL;
    return told != NULL && sscanf(told, " %*c %*d %*d %*d %d", &terminal) == 1 &&
           terminal == 0;
}

bool gb_follow_engine_gone(const struct gb_follow_engine *engine)
{
    return engine->here && engine->pid > 1 &&
           ((kill((pid_t)engine->pid, 0) != 0 && errno == ESRCH) ||
            is_zombie(engine->pid));
}

/* Does the process have this directory open, as every engine does for its lock?  The
 * process id in a file is not enough to end a process, because another program may have
 * it by now. */
static bool works_in(long long pid, const char *directory)
{
    struct stat wanted;
    struct stat seen;
    bool found = false;
    char *folder = g_strdup_printf("/proc/%lld/fd", pid);
    GDir *dir = g_dir_open(folder, 0, NULL);
    const char *name;
    const bool known = stat(directory, &wanted) == 0;
    while (known && dir != NULL && !found && (name = g_dir_read_name(dir)) != NULL) {
        char *path = g_build_filename(folder, name, NULL);
        found = stat(path, &seen) == 0 && seen.st_dev == wanted.st_dev &&
                seen.st_ino == wanted.st_ino;
        g_free(path);
    }
    if (dir != NULL) {
        g_dir_close(dir);
    }
    g_free(folder);
    return found;
}

bool gb_follow_request_stop(const char *directory, struct gb_error *err)
{
    struct gb_snapshot snapshot;
    struct gb_follow_engine engine = {0};
    if (!gb_follow_status(directory, &snapshot, &engine, err)) {
        return false;
    }
    if (!engine.here || engine.pid <= 1) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%s: its engine runs on another machine; stop it there",
                            directory);
    }
    if (!works_in(engine.pid, directory)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%s: status.json names process %lld, which does not work "
                            "in this directory; stop the run yourself",
                            directory, engine.pid);
    }
    return kill((pid_t)engine.pid, SIGTERM) == 0 ||
           gb_error_set(err, GB_ERR_MACHINE, "process %lld cannot be asked to stop: %s",
                        engine.pid, g_strerror(errno));
}
