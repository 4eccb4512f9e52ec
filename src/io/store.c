#include "io/store.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

#include <glib.h>
#include <json-glib/json-glib.h>

#include "base/file.h"
#include "base/number.h"
#include "io/line_file.h"
#include "io/preset.h"
#include "io/rundir.h"
#include "scene/loading_kind.h"

struct gb_store {
    struct gb_rundir dir;
    struct gb_line_file curve, events;
    char *status_path, *state_path, *before_path;
    enum gb_curve_columns columns;
    int64_t points;
};

/* ",value" with the fewest digits that read back the same; only "," where there is none.
 */
static void append_number(GString *row, double value)
{
    char text[GB_NUMBER_MAX];
    g_string_append_c(row, ',');
    if (isfinite(value)) {
        g_string_append(row, gb_number_write(value, text));
    }
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
    case GB_GEOMETRY_DIE:
        return "z";
    case GB_GEOMETRY_BIAXIAL:
        return "y and z";
    default:
        return params->dimension == 2 ? "x and z" : "x, y and z";
    }
}

static void append_nothing(GString *row, const struct gb_point *point)
{
    (void)row;
    (void)point;
}

static void append_energies(GString *row, const struct gb_point *point)
{
    const double values[] = {1e9 * point->time_s, point->kinetic,
                             point->work,         point->elastic,
                             point->dissipated,   point->energy_residual};
    for (size_t k = 0; k < G_N_ELEMENTS(values); k++) {
        append_number(row, values[k]);
    }
}

static void append_die(GString *row, const struct gb_point *point)
{
    const double values[] = {1e9 * point->time_s,     point->central,
                             1e6 * point->height_m,   point->height_change,
                             1e-6 * point->target_pa, point->floor_over_punch};
    for (size_t k = 0; k < G_N_ELEMENTS(values); k++) {
        append_number(row, values[k]);
    }
}

/* By enum gb_curve_columns: a comment of the head of curve.csv, names of the columns, and
 * their values. */
static const struct column_set {
    const char *note, *names;
    void (*append)(GString *row, const struct gb_point *point);
} column_sets[] = {
    [GB_COLUMNS_COMMON] = {"", "", append_nothing},
    [GB_COLUMNS_ENERGY] =
        {"# dynamic: time_ns is simulated time; kinetic, work (done by the moving cell), "
         "elastic and dissipated energy in J; energy_residual is relative to the work\n",
         ",time_ns,kinetic,work,elastic,dissipated,energy_residual", append_energies},
    [GB_COLUMNS_DIE] =
        {"# die: p and pz are what the powder carries under the punch, px and py the "
         "mean "
         "on the side wall; density is that of the whole specimen, central_density that "
         "of a ball in its middle; height_change is relative to the height before "
         "pressing; time_ns is simulated time, wanted_MPa the pressure of the programme, "
         "floor_over_punch a ratio of forces: not quasi-static outside 0.95 to 1.05\n",
         ",time_ns,central_density,height_um,height_change,wanted_MPa,floor_over_punch",
         append_die},
};

static bool write_curve_head(struct gb_line_file *curve, const struct gb_params *params,
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
    const struct column_set *set = &column_sets[gb_loading_kind_of(params)->columns];
    g_string_append(head, set->note);
    g_string_append(head, "branch,step,density,px_MPa,py_MPa,pz_MPa,p_MPa,coordination,"
                          "bridged,rattlers,residual,iterations,evaluations,seconds");
    g_string_append_printf(head, "%s\n", set->names);
    const bool ok = gb_line_file_append(curve, head->str, err);
    g_string_free(head, TRUE);
    return ok;
}

/* Replaces a file whole: after a crash the old or the new one is there, or none, if there
 * was none. */
static bool replace_file(const char *path, const char *text, size_t length,
                         struct gb_error *err)
{
    if (!gb_file_may_write()) {
        return gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be written: %s", path,
                            g_strerror(errno));
    }
    GError *failure = NULL;
    if (g_file_set_contents_full(path, text, (gssize)length,
                                 G_FILE_SET_CONTENTS_CONSISTENT |
                                     G_FILE_SET_CONTENTS_ONLY_EXISTING,
                                 0666, &failure)) {
        return true;
    }
    gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be written: %s", path,
                 gb_file_reason(failure));
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

/* Replaced files are written by the held path: the other one may name another directory
 * by now. */
static void name_files(struct gb_store *store)
{
    const char *held = store->dir.held;
    store->status_path = g_build_filename(held, "status.json", NULL);
    store->state_path = g_build_filename(held, "state.h5", NULL);
    store->before_path = g_build_filename(held, "state-before.h5", NULL);
}

bool gb_store_create(struct gb_store **out, const char *directory,
                     const struct gb_params *params, enum gb_rundir_mode mode,
                     struct gb_error *err)
{
    struct gb_store *store = g_new0(struct gb_store, 1);
    store->curve.fd = store->events.fd = -1;
    store->columns = gb_loading_kind_of(params)->columns;
    if (!gb_rundir_make(&store->dir, directory, mode, err)) {
        g_free(store);
        return false;
    }
    name_files(store);
    if (!write_preset(directory, params, err) ||
        !gb_line_file_open(&store->curve, directory, "curve.csv", err) ||
        !gb_line_file_open(&store->events, directory, "events.log", err) ||
        !write_curve_head(&store->curve, params, err)) { /* synced with the first state */
        gb_store_discard(store);
        return false;
    }
    *out = store;
    return true;
}

static void free_store(struct gb_store *store)
{
    gb_line_file_close(&store->curve);
    gb_line_file_close(&store->events);
    g_free(store->status_path);
    g_free(store->state_path);
    g_free(store->before_path);
    g_free(store);
}

void gb_store_destroy(struct gb_store *store)
{
    if (store != NULL) {
        gb_rundir_finish(&store->dir);
        free_store(store);
    }
}

struct gb_store_extent gb_store_extent(const struct gb_store *store)
{
    return (struct gb_store_extent){store->points, store->curve.length,
                                    store->events.length};
}

/* Empty files as after gb_store_create: rows without a checkpoint are dropped. */
static bool begin_rows(struct gb_store *store, const struct gb_params *params,
                       struct gb_error *err)
{
    static const char *const names[] = {"curve.csv", "events.log"};
    struct gb_line_file *rows[] = {&store->curve, &store->events};
    for (size_t k = 0; k < G_N_ELEMENTS(rows); k++) {
        char *path = g_build_filename(store->dir.path, names[k], NULL);
        (void)unlink(path);
        g_free(path);
        if (!gb_line_file_open(rows[k], store->dir.path, names[k], err)) {
            return false;
        }
    }
    return write_curve_head(&store->curve, params, err);
}

bool gb_store_reopen(struct gb_store **out, struct gb_rundir *dir,
                     const struct gb_params *params, const struct gb_store_extent *extent,
                     struct gb_error *err)
{
    struct gb_store *store = g_new0(struct gb_store, 1);
    store->curve.fd = store->events.fd = -1;
    store->columns = gb_loading_kind_of(params)->columns;
    store->dir = *dir;
    *dir = (struct gb_rundir){.lock = -1};
    name_files(store);
    bool done;
    if (extent == NULL) {
        done = begin_rows(store, params, err);
    } else {
        store->points = extent->points;
        done = gb_line_file_reopen(&store->curve, store->dir.path, "curve.csv",
                                   (off_t)extent->curve_bytes, err) &&
               gb_line_file_reopen(&store->events, store->dir.path, "events.log",
                                   (off_t)extent->events_bytes, err);
    }
    if (!done) {
        gb_store_destroy(store);
        return false;
    }
    *out = store;
    return true;
}

void gb_store_discard(struct gb_store *store)
{
    if (store != NULL) {
        gb_rundir_remove(&store->dir);
        free_store(store);
    }
}

bool gb_store_point(struct gb_store *store, const struct gb_point *point,
                    struct gb_error *err)
{
    char branch[GB_NUMBER_MAX];
    char seconds[GB_NUMBER_MAX];
    GString *row = g_string_new(gb_curve_branch_name(point, branch, sizeof branch));
    g_string_append_printf(row, ",%" PRId64, point->step);
    const double before[] = {point->density,     point->px_pa / 1e6, point->py_pa / 1e6,
                             point->pz_pa / 1e6, point->p_pa / 1e6,  point->coordination,
                             point->bridged,     point->rattlers,    point->residual};
    for (size_t k = 0; k < G_N_ELEMENTS(before); k++) {
        append_number(row, before[k]);
    }
    g_string_append_printf(
        row, ",%" PRId64 ",%" PRId64 ",%s", point->iterations, point->evaluations,
        g_ascii_formatd(seconds, sizeof seconds, "%.3f", point->seconds));
    column_sets[store->columns].append(row, point);
    g_string_append_c(row, '\n');
    const bool ok = gb_rundir_check_identity(&store->dir, err) &&
                    gb_line_file_append(&store->curve, row->str, err);
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
    const bool ok = gb_line_file_append(&store->events, line->str, err);
    g_string_free(line, TRUE);
    return ok;
}

static const char *const state_words[] = {
    [GB_RUN_PACKING] = "packing", [GB_RUN_RUNNING] = "running",
    [GB_RUN_PAUSED] = "paused",   [GB_RUN_DONE] = "done",
    [GB_RUN_STOPPED] = "stopped", [GB_RUN_FAILED] = "failed"};

static const char *state_word(int state)
{
    return state >= 0 && state < (int)G_N_ELEMENTS(state_words) ? state_words[state]
                                                                : "unknown";
}

int gb_store_state_of(const char *word)
{
    for (size_t k = 0; k < G_N_ELEMENTS(state_words); k++) {
        if (strcmp(state_words[k], word) == 0) {
            return (int)k;
        }
    }
    return GB_RUN_STOPPED;
}

/* json-glib writes 1e-08 as "1e-08.0", which no reader accepts.  The next double has more
 * digits and a point, and goes through. */
static double writable(double value)
{
    char text[G_ASCII_DTOSTR_BUF_SIZE];
    g_ascii_dtostr(text, sizeof text, value);
    return strchr(text, 'e') && !strchr(text, '.') ? nextafter(value, INFINITY) : value;
}

static void add_double(JsonBuilder *json, const char *name, double value, bool known)
{
    json_builder_set_member_name(json, name);
    if (known && isfinite(value)) {
        json_builder_add_double_value(json, writable(value));
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

static void add_array(JsonBuilder *json, const char *name, const double *values,
                      int count)
{
    json_builder_set_member_name(json, name);
    json_builder_begin_array(json);
    for (int k = 0; k < count; k++) {
        if (isfinite(values[k])) {
            json_builder_add_double_value(json, writable(values[k]));
        } else {
            json_builder_add_null_value(json);
        }
    }
    json_builder_end_array(json);
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
    add_double(json, "residual", shot->live_residual, true);
    add_double(json, "time_step_s", shot->time_step_s, true);
    add_array(json, "histogram", shot->histogram, GB_SNAPSHOT_HISTOGRAM);
    add_array(json, "rose", shot->rose, GB_SNAPSHOT_ROSE);
}

char *gb_store_status_text(const struct gb_store *store,
                           const struct gb_snapshot *snapshot)
{
    JsonBuilder *json = json_builder_new();
    json_builder_begin_object(json);
    add_text(json, "program", "greenbody " GB_VERSION);
    add_text(json, "state", state_word(snapshot->state));
    add_integer(json, "pid", (int64_t)getpid());
    add_text(json, "host", g_get_host_name());
    add_progress(json, store, snapshot);
    add_text(json, "event", snapshot->event);
    add_text(json, "error", snapshot->error.code == GB_OK ? "" : snapshot->error.text);
    json_builder_end_object(json);
    JsonNode *root = json_builder_get_root(json);
    char *text = json_to_string(root, TRUE);
    char *whole = g_strconcat(text, "\n", NULL);
    g_free(text);
    json_node_unref(root);
    g_object_unref(json);
    return whole;
}

bool gb_store_put_status(const struct gb_store *store, const char *text,
                         struct gb_error *err)
{
    return gb_rundir_check_identity(&store->dir, err) &&
           gb_rundir_result(&store->dir,
                            replace_file(store->status_path, text, strlen(text), err),
                            err);
}

bool gb_store_status(struct gb_store *store, const struct gb_snapshot *snapshot,
                     struct gb_error *err)
{
    char *text = gb_store_status_text(store, snapshot);
    const bool ok = gb_store_put_status(store, text, err);
    g_free(text);
    return ok;
}

/* A second name for the state that is about to be replaced.  Without one (a file system
 * that has no links) verify repeats the run from its beginning. */
static void keep_before(const struct gb_store *store)
{
    if (g_file_test(store->state_path, G_FILE_TEST_IS_REGULAR)) {
        (void)unlink(store->before_path);
        (void)!link(store->state_path, store->before_path);
    }
}

bool gb_store_state(const struct gb_store *store, const struct gb_state *state,
                    const struct gb_record *record, struct gb_error *err)
{
    if (!gb_rundir_check_identity(&store->dir, err) ||
        !gb_line_file_sync(&store->curve, err) ||
        !gb_line_file_sync(&store->events, err)) {
        return false;
    }
    keep_before(store);
    return gb_rundir_result(&store->dir,
                            gb_state_write(state, record, store->state_path, err), err);
}

bool gb_store_sync(struct gb_store *store, struct gb_error *err)
{
    return gb_line_file_sync(&store->curve, err) &&
           gb_line_file_sync(&store->events, err);
}

const char *gb_store_directory(const struct gb_store *store)
{
    return store->dir.path;
}

const struct gb_rundir *gb_store_rundir(const struct gb_store *store)
{
    return &store->dir;
}

char *gb_store_new_directory(const char *folder, const char *preset_path)
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
        path = g_strdup_printf("%s/%s-%d", folder, base, k);
    }
    g_free(base);
    return path;
}

char *gb_store_default_directory(const char *preset_path)
{
    return gb_store_new_directory("runs", preset_path);
}
