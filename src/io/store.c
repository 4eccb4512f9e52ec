#include "io/store.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <glib.h>

#include "base/file.h"
#include "base/record.h"
#include "io/curve_csv.h"
#include "io/preset.h"
#include "io/rundir.h"
#include "io/status_json.h"
#include "io/text_file.h"
#include "scene/imported/imported.h"
#include "scene/loading_kind.h"

/* A file to which whole lines are appended.  A checkpoint syncs it and records its
 * length and checksum.  A resumed run checks these and drops everything after that
 * length. */
struct lines {
    char *path;
    int fd;
    off_t length; /* of the complete lines so far */
    uint64_t sum; /* FNV-1a of these lines */
};

struct gb_store {
    struct gb_rundir dir;
    struct lines curve, events;
    char *status_path, *state_path, *before_path;
    enum gb_curve_columns columns;
    int64_t points;
};

/* Creates the file, which must not exist. close_lines must be called in any case. */
static bool create_lines(struct lines *lines, const char *directory, const char *name,
                         struct gb_error *err)
{
    *lines = (struct lines){.path = g_build_filename(directory, name, NULL),
                            .sum = GB_RECORD_FNV};
    lines->fd = open(lines->path, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    return lines->fd >= 0 || gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be made: %s",
                                          lines->path, g_strerror(errno));
}

/* Adds the first `length` bytes of the file to length and checksum.  False unless they
 * are whole lines. */
static bool read_lines(struct lines *lines, off_t length)
{
    char part[1 << 16], last = '\n';
    while (lines->length < length) {
        const size_t wanted = (size_t)MIN((off_t)sizeof part, length - lines->length);
        const ssize_t n = pread(lines->fd, part, wanted, lines->length);
        if (n < 0 && errno == EINTR) {
            continue;
        }
        if (n <= 0) {
            return false;
        }
        lines->sum = gb_record_fnv(lines->sum, part, (size_t)n);
        lines->length += n;
        last = part[n - 1];
    }
    return last == '\n';
}

/* Opens an existing file and reads its first `length` bytes. */
static bool reopen_lines(struct lines *lines, const char *directory, const char *name,
                         off_t length, struct gb_error *err)
{
    struct stat info;
    *lines = (struct lines){.path = g_build_filename(directory, name, NULL),
                            .sum = GB_RECORD_FNV};
    lines->fd = open(lines->path, O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (lines->fd < 0) {
        return gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be opened: %s", lines->path,
                            g_strerror(errno));
    }
    if (fstat(lines->fd, &info) != 0 || !S_ISREG(info.st_mode)) {
        return gb_error_set(err, GB_ERR_INPUT, "%s: is not a regular file", lines->path);
    }
    return (length >= 0 && read_lines(lines, length)) ||
           gb_error_set(err, GB_ERR_INPUT,
                        "%s: does not match the checkpoint: expected whole lines in its "
                        "first %lld bytes",
                        lines->path, (long long)length);
}

static void close_lines(struct lines *lines)
{
    if (lines->fd >= 0) {
        close(lines->fd);
    }
    g_free(lines->path);
}

static bool write_error(const struct lines *lines, struct gb_error *err)
{
    return gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be written: %s", lines->path,
                        g_strerror(errno));
}

/* Appends text, or leaves the file as it was, so that a full disk leaves no partial
 * row. */
static bool append_lines(struct lines *lines, const char *text, struct gb_error *err)
{
    const size_t size = strlen(text);
    if (!gb_file_append_at(lines->fd, lines->length, text, size)) {
        return write_error(lines, err);
    }
    lines->sum = gb_record_fnv(lines->sum, text, size);
    lines->length += (off_t)size;
    return true;
}

/* Truncates the file after the lines that were read. */
static bool cut_lines(const struct lines *lines, struct gb_error *err)
{
    return ftruncate(lines->fd, lines->length) == 0 || write_error(lines, err);
}

static bool sync_lines(const struct lines *lines, struct gb_error *err)
{
    return fsync(lines->fd) == 0 || write_error(lines, err);
}

static bool write_curve_head(struct lines *curve, const struct gb_params *params,
                             struct gb_error *err)
{
    GString *head = gb_curve_csv_head(params);
    const bool ok = append_lines(curve, head->str, err);
    g_string_free(head, TRUE);
    return ok;
}

static const char packing_name[] = "structure.csv";

/* Copies the initial packing next to the preset, which then names the copy. */
static bool write_packing(const char *directory, struct gb_params *params,
                          struct gb_error *err)
{
    const struct gb_imported *packing = gb_imported_of(params, err);
    if (packing == NULL) {
        return !gb_imported_given(params);
    }
    char *path = g_build_filename(directory, packing_name, NULL);
    char *text = gb_imported_text(packing);
    const bool ok = gb_file_replace(path, text, strlen(text), err);
    g_free(text);
    g_free(path);
    g_strlcpy(params->from.path, packing_name, sizeof params->from.path);
    return ok;
}

/* Writes a complete preset.  Presets that were not read from a file name the version of
 * the program. */
static bool write_preset(const char *directory, const struct gb_params *params,
                         struct gb_error *err)
{
    struct gb_preset *preset = NULL;
    if (!gb_preset_create(&preset, err)) {
        return false;
    }
    *gb_preset_params(preset) = *params;
    char *path = g_build_filename(directory, "preset.ini", NULL);
    const bool ok = write_packing(directory, gb_preset_params(preset), err) &&
                    gb_preset_save(preset, path, GB_PRESET_ALL_KEYS, err);
    g_free(path);
    gb_preset_destroy(preset);
    return ok;
}

/* Paths of replaced files use the held path, because the original path may name another
 * directory by now. */
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
        !create_lines(&store->curve, directory, "curve.csv", err) ||
        !create_lines(&store->events, directory, "events.log", err) ||
        !write_curve_head(&store->curve, params, err)) { /* the first state syncs it */
        gb_store_discard(store);
        return false;
    }
    *out = store;
    return true;
}

static void free_store(struct gb_store *store)
{
    close_lines(&store->curve);
    close_lines(&store->events);
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
                                    store->events.length, (int64_t)store->curve.sum};
}

static bool check_sum(const struct lines *curve, const struct gb_store_extent *extent,
                      struct gb_error *err)
{
    return extent->curve_sum == 0 || extent->curve_sum == (int64_t)curve->sum ||
           gb_error_set(err, GB_ERR_INPUT,
                        "%s: was changed since the checkpoint: restore the file that the "
                        "run wrote, or start a new run",
                        curve->path);
}

bool gb_store_check_curve(const char *directory, const struct gb_store_extent *extent,
                          struct gb_error *err)
{
    struct lines curve;
    const bool same =
        reopen_lines(&curve, directory, "curve.csv", (off_t)extent->curve_bytes, err) &&
        check_sum(&curve, extent, err);
    close_lines(&curve);
    return same;
}

/* Empties the files as after gb_store_create: rows without a checkpoint are dropped. */
static bool begin_rows(struct gb_store *store, const struct gb_params *params,
                       struct gb_error *err)
{
    static const char *const names[] = {"curve.csv", "events.log"};
    struct lines *rows[] = {&store->curve, &store->events};
    for (size_t k = 0; k < G_N_ELEMENTS(rows); k++) {
        char *path = g_build_filename(store->dir.path, names[k], NULL);
        (void)unlink(path);
        g_free(path);
        if (!create_lines(rows[k], store->dir.path, names[k], err)) {
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
    *dir = GB_RUNDIR_NONE;
    name_files(store);
    bool done;
    if (extent == NULL) {
        done = begin_rows(store, params, err);
    } else {
        store->points = extent->points;
        done = reopen_lines(&store->curve, store->dir.path, "curve.csv",
                            (off_t)extent->curve_bytes, err) &&
               check_sum(&store->curve, extent, err) &&
               reopen_lines(&store->events, store->dir.path, "events.log",
                            (off_t)extent->events_bytes, err) &&
               cut_lines(&store->curve, err) && cut_lines(&store->events, err);
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
    GString *row = gb_curve_csv_row(point, store->columns);
    const bool ok = gb_rundir_check_identity(&store->dir, err) &&
                    append_lines(&store->curve, row->str, err);
    store->points += ok;
    g_string_free(row, TRUE);
    return ok;
}

bool gb_store_event(struct gb_store *store, int64_t step, const char *text,
                    struct gb_error *err)
{
    GString *line = g_string_new(NULL);
    g_string_append_printf(line, "step %" PRId64 ": ", step);
    gb_text_file_add_line(line, text);
    const bool ok = gb_rundir_check_identity(&store->dir, err) &&
                    append_lines(&store->events, line->str, err);
    g_string_free(line, TRUE);
    return ok;
}

char *gb_store_status_text(const struct gb_store *store,
                           const struct gb_snapshot *snapshot)
{
    return gb_status_json_text(snapshot, store->points);
}

bool gb_store_put_status(const struct gb_store *store, const char *text,
                         struct gb_error *err)
{
    return gb_rundir_check_identity(&store->dir, err) &&
           gb_rundir_result(&store->dir,
                            gb_text_file_replace(store->status_path, text, strlen(text),
                                                 GB_TEXT_FILE_OF_RUN, err),
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

/* Makes a second link to the state that is about to be replaced.  On a file system
 * without links `verify` repeats the run from its beginning. */
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
    if (!gb_rundir_check_identity(&store->dir, err) || !sync_lines(&store->curve, err) ||
        !sync_lines(&store->events, err)) {
        return false;
    }
    keep_before(store);
    return gb_rundir_result(&store->dir,
                            gb_state_write(state, record, store->state_path, err), err);
}

bool gb_store_sync(struct gb_store *store, struct gb_error *err)
{
    return sync_lines(&store->curve, err) && sync_lines(&store->events, err);
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
