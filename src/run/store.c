#include "run/store.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

#include <glib.h>
#include <json-glib/json-glib.h>

#include "run/preset.h"
#include "run/rundir.h"

/* A file that grows by whole lines. */
struct log {
    char *path;
    int fd;
    off_t length; /* of the whole lines so far */
};

struct gb_store {
    struct gb_rundir dir;
    struct log curve, events;
    char *status_path, *state_path;
    int64_t points;
};

enum { NUMBER_MAX = 32 };

static bool log_open(struct log *log, const char *directory, const char *name,
                     struct gb_error *err)
{
    log->path = g_build_filename(directory, name, NULL);
    log->length = 0;
    log->fd = open(log->path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (log->fd < 0) {
        return gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be made: %s", log->path,
                            g_strerror(errno));
    }
    return true;
}

static void log_close(struct log *log)
{
    if (log->fd >= 0) {
        close(log->fd);
    }
    g_free(log->path);
}

static bool log_error(const struct log *log, int why, struct gb_error *err)
{
    return gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be written: %s", log->path,
                        g_strerror(why));
}

/* Appends text, or leaves the file as it was: a full disk must not leave half a row. */
static bool log_append(struct log *log, const GString *text, struct gb_error *err)
{
    size_t done = 0;
    while (done < text->len) {
        const ssize_t n = pwrite(log->fd, text->str + done, text->len - done,
                                 log->length + (off_t)done);
        if (n < 0 && errno == EINTR) {
            continue;
        }
        if (n <= 0) {
            const int why = n < 0 ? errno : EIO;
            if (ftruncate(log->fd, log->length) != 0) {
                return log_error(log, errno, err);
            }
            return log_error(log, why, err);
        }
        done += (size_t)n;
    }
    log->length += (off_t)text->len;
    return true;
}

static bool log_sync(const struct log *log, struct gb_error *err)
{
    return fsync(log->fd) == 0 || log_error(log, errno, err);
}

/* ",value" with the fewest digits that read back the same; only "," where there is none.
 */
static void append_number(GString *row, double value)
{
    char text[NUMBER_MAX];
    g_string_append_c(row, ',');
    if (!isfinite(value)) {
        return;
    }
    const char *const format[] = {"%.15g", "%.16g", "%.17g"};
    for (size_t k = 0; k < G_N_ELEMENTS(format); k++) {
        g_ascii_formatd(text, sizeof text, format[k], value);
        if (g_ascii_strtod(text, NULL) == value) {
            break;
        }
    }
    g_string_append(row, text);
}

/* Adds text without the characters that would break a line. */
static void append_line_text(GString *line, const char *text)
{
    for (const char *c = text; *c != '\0'; c++) {
        g_string_append_c(line, g_ascii_iscntrl(*c) ? '?' : *c);
    }
    g_string_append_c(line, '\n');
}

static const char *compressed_axes(const struct gb_params *params)
{
    switch (params->geometry) {
    case GB_GEOMETRY_UNIAXIAL:
        return "z";
    case GB_GEOMETRY_BIAXIAL:
        return "y and z";
    default:
        return params->dimension == 2 ? "x and z" : "x, y and z";
    }
}

static bool write_curve_head(struct log *curve, const struct gb_params *params,
                             struct gb_error *err)
{
    GString *head = g_string_new("# greenbody " GB_VERSION "\n# preset: ");
    append_line_text(head, params->title);
    g_string_append_printf(head, "# seed: %" PRIu64 "\n", params->seed);
    g_string_append(head,
                    "# units: pressures in MPa; density is the share of the volume "
                    "that is solid; bridged is a share of the contacts, rattlers of "
                    "the particles; residual is relative to the force scale; seconds "
                    "of wall time since the start\n");
    g_string_append_printf(
        head,
        "# p_MPa: mean pressure over the compressed axes (%s), positive "
        "in compression\n",
        compressed_axes(params));
    g_string_append(head, "branch,step,density,px_MPa,py_MPa,pz_MPa,p_MPa,coordination,"
                          "bridged,rattlers,residual,iterations,evaluations,seconds\n");
    const bool ok = log_append(curve, head, err);
    g_string_free(head, TRUE);
    return ok;
}

/* Replaces a file whole: after a crash the old or the new one is there. */
static bool replace_file(const char *path, const char *text, size_t length,
                         struct gb_error *err)
{
    GError *failure = NULL;
    if (g_file_set_contents_full(path, text, (gssize)length,
                                 G_FILE_SET_CONTENTS_CONSISTENT, 0666, &failure)) {
        return true;
    }
    gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be written: %s", path,
                 failure->message);
    g_error_free(failure);
    return false;
}

/* A complete preset written without a file before it names the program's version. */
static bool write_preset(const char *directory, const struct gb_params *params,
                         struct gb_error *err)
{
    struct gb_preset *preset = NULL;
    if (!gb_preset_create(&preset, err)) {
        return false;
    }
    *gb_preset_params(preset) = *params;
    char *path = g_build_filename(directory, "preset.ini", NULL);
    const bool ok = gb_preset_save(preset, path, true, err);
    g_free(path);
    gb_preset_destroy(preset);
    return ok;
}

bool gb_store_create(struct gb_store **out, const char *directory,
                     const struct gb_params *params, bool force, struct gb_error *err)
{
    struct gb_store *store = g_new0(struct gb_store, 1);
    store->curve.fd = store->events.fd = -1;
    if (!gb_rundir_make(&store->dir, directory, force, err)) {
        g_free(store);
        return false;
    }
    store->status_path = g_build_filename(directory, "status.json", NULL);
    store->state_path = g_build_filename(directory, "state.h5", NULL);
    if (!write_preset(directory, params, err) ||
        !log_open(&store->curve, directory, "curve.csv", err) ||
        !log_open(&store->events, directory, "events.log", err) ||
        !write_curve_head(&store->curve, params, err) || !gb_store_sync(store, err)) {
        gb_store_discard(store);
        return false;
    }
    *out = store;
    return true;
}

static void free_store(struct gb_store *store)
{
    log_close(&store->curve);
    log_close(&store->events);
    g_free(store->status_path);
    g_free(store->state_path);
    g_free(store);
}

void gb_store_destroy(struct gb_store *store)
{
    if (store != NULL) {
        gb_rundir_finish(&store->dir);
        free_store(store);
    }
}

void gb_store_discard(struct gb_store *store)
{
    if (store != NULL) {
        gb_rundir_unmake(&store->dir);
        free_store(store);
    }
}

bool gb_store_point(struct gb_store *store, const struct gb_point *point,
                    struct gb_error *err)
{
    char branch[NUMBER_MAX];
    char seconds[NUMBER_MAX];
    GString *row = g_string_new(gb_curve_branch_name(point, branch, sizeof branch));
    g_string_append_printf(row, ",%" PRId64, point->step);
    const double before[] = {point->density,     point->px_pa / 1e6, point->py_pa / 1e6,
                             point->pz_pa / 1e6, point->p_pa / 1e6,  point->coordination,
                             point->bridged,     point->rattlers,    point->residual};
    for (size_t k = 0; k < G_N_ELEMENTS(before); k++) {
        append_number(row, before[k]);
    }
    g_string_append_printf(
        row, ",%" PRId64 ",%" PRId64 ",%s\n", point->iterations, point->evaluations,
        g_ascii_formatd(seconds, sizeof seconds, "%.3f", point->seconds));
    const bool ok = log_append(&store->curve, row, err);
    store->points += ok;
    g_string_free(row, TRUE);
    return ok;
}

bool gb_store_event(struct gb_store *store, int64_t step, const char *text,
                    struct gb_error *err)
{
    GString *line = g_string_new(NULL);
    g_string_append_printf(line, "step %" PRId64 ": ", step);
    append_line_text(line, text);
    const bool ok = log_append(&store->events, line, err);
    g_string_free(line, TRUE);
    return ok;
}

static const char *state_word(int state)
{
    static const char *const words[] = {
        [GB_RUN_PACKING] = "packing", [GB_RUN_RUNNING] = "running",
        [GB_RUN_PAUSED] = "paused",   [GB_RUN_DONE] = "done",
        [GB_RUN_STOPPED] = "stopped", [GB_RUN_FAILED] = "failed"};
    return state >= 0 && state < (int)G_N_ELEMENTS(words) ? words[state] : "unknown";
}

static void add_double(JsonBuilder *json, const char *name, double value, bool known)
{
    json_builder_set_member_name(json, name);
    if (known && isfinite(value)) {
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

/* JSON is UTF-8; paths in an error may be anything. */
static void add_text(JsonBuilder *json, const char *name, const char *text)
{
    char *valid = g_utf8_make_valid(text, -1);
    json_builder_set_member_name(json, name);
    json_builder_add_string_value(json, valid);
    g_free(valid);
}

static void add_progress(JsonBuilder *json, const struct gb_store *store,
                         const struct gb_snapshot *shot)
{
    const struct gb_point *now = &shot->now;
    const bool known = shot->now_valid;
    add_double(json, "progress", shot->progress, true);
    add_integer(json, "points", store->points);
    add_integer(json, "step", known ? now->step : 0);
    add_double(json, "density", now->density, known);
    add_double(json, "pressure_MPa", now->p_pa / 1e6, known);
    add_double(json, "coordination", now->coordination, known);
    add_integer(json, "evaluations", shot->evaluations);
    add_double(json, "evaluations_per_s", shot->evaluations_per_s, true);
    add_double(json, "particle_evaluations_per_s", shot->particle_evaluations_per_s,
               true);
    add_double(json, "seconds", shot->seconds, true);
    add_double(json, "seconds_left", shot->seconds_left, shot->seconds_left >= 0.0);
    add_integer(json, "events", shot->events);
}

bool gb_store_status(struct gb_store *store, const struct gb_snapshot *snapshot,
                     struct gb_error *err)
{
    JsonBuilder *json = json_builder_new();
    json_builder_begin_object(json);
    add_text(json, "program", "greenbody " GB_VERSION);
    add_text(json, "state", state_word(snapshot->state));
    add_integer(json, "pid", (int64_t)getpid());
    add_progress(json, store, snapshot);
    add_text(json, "event", snapshot->event);
    add_text(json, "error", snapshot->error.code == GB_OK ? "" : snapshot->error.text);
    json_builder_end_object(json);
    JsonNode *root = json_builder_get_root(json);
    char *text = json_to_string(root, TRUE);
    char *whole = g_strconcat(text, "\n", NULL);
    const bool ok = replace_file(store->status_path, whole, strlen(whole), err);
    g_free(whole);
    g_free(text);
    json_node_unref(root);
    g_object_unref(json);
    return ok;
}

bool gb_store_state(struct gb_store *store, const struct gb_state *state,
                    struct gb_error *err)
{
    return gb_state_write(state, store->state_path, err);
}

bool gb_store_sync(struct gb_store *store, struct gb_error *err)
{
    return log_sync(&store->curve, err) && log_sync(&store->events, err);
}

const char *gb_store_directory(const struct gb_store *store)
{
    return store->dir.path;
}

char *gb_store_default_directory(const char *preset_path)
{
    char *base = g_path_get_basename(preset_path);
    if (preset_path[0] == '\0' || !g_ascii_isalnum(base[0])) {
        g_free(base);
        base = g_strdup("default");
    } else if (g_str_has_suffix(base, ".ini")) {
        base[strlen(base) - strlen(".ini")] = '\0';
    }
    char *path = NULL;
    for (int k = 1; path == NULL || g_file_test(path, G_FILE_TEST_EXISTS); k++) {
        g_free(path);
        path = g_strdup_printf("runs/%s-%d", base, k);
    }
    g_free(base);
    return path;
}
