#include "io/rundir.h"

#include <errno.h>
#include <fcntl.h>
#include <glib.h>
#include <glib/gstdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "greenbody/status.h"
#include "io/status_json.h"

/* The directory of a run: creation, lock, and removal of its files.
 *
 * Only files that a run writes are ever removed.  They are known by name; any other
 * file makes a directory foreign, and a foreign directory is not touched.  Replacing a
 * run first checks everything, so that an error changes nothing.  A lock (io/lock.h)
 * shows that a process computes the run.
 *
 * Order of this file: file names, the checks before a directory is used, and creating,
 * opening and closing it. */

static const char *const known_files[] = {
    "preset.ini", "curve.csv", "events.log", "status.json", "state.h5", "packing.csv",
    "g.csv", "structure.json", "state-before.h5", "moduli.csv", "structure.csv",
    /* output.export */
    "trajectory.extxyz", "trajectory-contacts.csv", "trajectory.lammps-dump",
    "trajectory-contacts.lammps-dump"};
static const char snapshot_folder[] = "snapshots";

/* Is this the tail of a temporary file, "status.json.X7TQ2C" or "state.h5.tmp", left by
 * a killed atomic replacement? */
static bool is_leftover(const char *tail)
{
    if (strcmp(tail, ".tmp") == 0) {
        return true;
    }
    if (strlen(tail) != 7 || tail[0] != '.') {
        return false;
    }
    for (const char *c = tail + 1; *c != '\0'; c++) {
        if (!g_ascii_isalnum(*c)) {
            return false;
        }
    }
    return true;
}

static bool is_known_name(const char *name)
{
    for (size_t k = 0; k < G_N_ELEMENTS(known_files); k++) {
        const size_t length = strlen(known_files[k]);
        if (strncmp(name, known_files[k], length) == 0 &&
            (name[length] == '\0' || is_leftover(name + length))) {
            return true;
        }
    }
    return false;
}

static bool has_run(const char *directory)
{
    char *preset = g_build_filename(directory, known_files[0], NULL);
    char *curve = g_build_filename(directory, known_files[1], NULL);
    const bool has =
        g_file_test(preset, G_FILE_TEST_EXISTS) && g_file_test(curve, G_FILE_TEST_EXISTS);
    g_free(curve);
    g_free(preset);
    return has;
}

bool gb_rundir_files_protect(const char *path, struct gb_error *err)
{
    char *true_path = realpath(path, NULL); /* resolves links */
    const char *target = true_path != NULL ? true_path : path;
    char *name = g_path_get_basename(target);
    char *directory = g_path_get_dirname(target);
    char *folder = g_path_get_basename(directory);
    char *above = g_path_get_dirname(directory);
    const bool own =
        (is_known_name(name) && has_run(directory)) ||
        (true_path != NULL && strcmp(folder, snapshot_folder) == 0 && has_run(above));
    if (own) {
        gb_error_set(err, GB_ERR_INPUT,
                     "%.300s: is a file of a run: expected another name", path);
    }
    g_free(above);
    g_free(folder);
    g_free(directory);
    g_free(name);
    free(true_path);
    return !own;
}

/* Is this a temporary file of a file that only an engine replaces? */
static bool is_engine_leftover(const char *name)
{
    static const char *const replaced[] = {"state.h5", "status.json", "curve.csv",
                                           "events.log"};
    for (size_t k = 0; k < G_N_ELEMENTS(replaced); k++) {
        const size_t length = strlen(replaced[k]);
        if (strncmp(name, replaced[k], length) == 0 && is_leftover(name + length)) {
            return true;
        }
    }
    return false;
}

/* The part of a name after the last occurrence of `ending`; NULL: none. */
static const char *after_ending(const char *name, const char *ending)
{
    const char *at = g_strrstr(name, ending);
    return at != NULL ? at + strlen(ending) : NULL;
}

static bool is_snapshot_name(const char *name)
{
    static const char *const ends[] = {".h5", ".png", ".lammps-data", ".csv", ".vtkhdf"};
    bool known = false;
    for (size_t k = 0; k < G_N_ELEMENTS(ends); k++) {
        const char *tail = after_ending(name, ends[k]);
        known = known || (tail != NULL && (*tail == '\0' || is_leftover(tail)));
    }
    return known;
}

/* Is this a temporary file of a state that only an engine keeps in the snapshot folder?
 */
static bool is_state_leftover(const char *name)
{
    const char *tail = after_ending(name, ".h5");
    return tail != NULL && is_leftover(tail);
}

static bool has_type(const char *path, mode_t type)
{
    struct stat info;
    return lstat(path, &info) == 0 && (info.st_mode & S_IFMT) == type;
}

/* Name of the first entry that no run writes (g_free); NULL if there is none.  Adds the
 * number of entries seen to *entries. */
static char *first_foreign(const char *path, bool (*known)(const char *name),
                           int *entries, GError **failure)
{
    GDir *dir = g_dir_open(path, 0, failure);
    if (dir == NULL) {
        return NULL;
    }
    char *foreign = NULL;
    const char *name;
    while (foreign == NULL && (name = g_dir_read_name(dir)) != NULL) {
        if (strcmp(name, ".lock") == 0) { /* the lock alone does not make a run */
            continue;
        }
        char *full = g_build_filename(path, name, NULL);
        (*entries)++;
        if (known == is_known_name && strcmp(name, snapshot_folder) == 0 &&
            has_type(full, S_IFDIR)) {
            int inside = 0;
            char *deeper = first_foreign(full, is_snapshot_name, &inside, failure);
            foreign = deeper != NULL ? g_build_filename(name, deeper, NULL) : NULL;
            g_free(deeper);
        } else if (!known(name) || !has_type(full, S_IFREG)) {
            foreign = g_strdup(name);
        }
        g_free(full);
    }
    g_dir_close(dir);
    return foreign;
}

/* The same for the directory of a run, including its folder of snapshots. */
static char *rundir_files_foreign(const char *path, int *entries, GError **failure)
{
    return first_foreign(path, is_known_name, entries, failure);
}

/* Removes the files with known names; other entries stay. */
static bool clear_files(const char *path, bool (*known)(const char *name),
                        struct gb_error *err)
{
    GDir *dir = g_dir_open(path, 0, NULL);
    bool ok =
        dir != NULL || gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be read", path);
    const char *name;
    while (ok && (name = g_dir_read_name(dir)) != NULL) {
        char *full = g_build_filename(path, name, NULL);
        if (known(name) && has_type(full, S_IFREG) && g_unlink(full) != 0) {
            ok = gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be removed: %s", full,
                              g_strerror(errno));
        }
        g_free(full);
    }
    if (dir != NULL) {
        g_dir_close(dir);
    }
    return ok;
}

/* Removes the files of a run, including its kept states; other entries stay. */
static bool rundir_files_remove(const char *path, struct gb_error *err)
{
    char *snapshots = g_build_filename(path, snapshot_folder, NULL);
    bool ok = true;
    if (has_type(snapshots, S_IFDIR)) {
        ok = clear_files(snapshots, is_snapshot_name, err);
        if (ok && g_rmdir(snapshots) != 0) {
            ok = gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be removed: %s", snapshots,
                              g_strerror(errno));
        }
    }
    g_free(snapshots);
    return ok && clear_files(path, is_known_name, err);
}

void gb_rundir_files_tidy(const char *path)
{
    struct gb_error ignored;
    char *snapshots = g_build_filename(path, snapshot_folder, NULL);
    (void)clear_files(path, is_engine_leftover, &ignored);
    if (has_type(snapshots, S_IFDIR)) {
        (void)clear_files(snapshots, is_state_leftover, &ignored);
    }
    g_free(snapshots);
}

static const char lock_name[] = ".lock";

/* Opens and locks dir->path. */
static bool hold(struct gb_rundir *dir)
{
    struct stat info;
    if (!gb_lock_take(&dir->lock, dir->path, lock_name)) {
        return false;
    }
    dir->held = g_strdup_printf("/proc/self/fd/%d", dir->lock.folder);
    if (stat(dir->held, &info) != 0) { /* no /proc/self/fd here */
        g_free(dir->held);
        dir->held = g_strdup(dir->path);
    }
    return true;
}

static bool busy_error(const char *path, struct gb_error *err)
{
    return gb_error_set(
        err, GB_ERR_INPUT,
        "%s: a run that is under way writes there; stop it first or choose "
        "another directory",
        path);
}

static bool is_done(const char *path)
{
    char *status = g_build_filename(path, "status.json", NULL);
    const bool done = gb_status_json_is_done(status);
    g_free(status);
    return done;
}

/* May the files in this directory be replaced by a new run? */
static bool check_content(const char *path, enum gb_rundir_mode mode,
                          struct gb_error *err)
{
    int entries = 0;
    GError *failure = NULL;
    char *foreign = rundir_files_foreign(path, &entries, &failure);
    bool ok = true;
    if (failure != NULL) {
        ok = gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be read: %s", path,
                          failure->message);
        g_clear_error(&failure);
    } else if (foreign != NULL) {
        ok = gb_error_set(err, GB_ERR_INPUT,
                          "%s: holds \"%s\", which does not belong to a run; nothing "
                          "was changed; choose another directory",
                          path, foreign);
    } else if (entries > 0 && mode == GB_RUNDIR_KEEP) {
        ok = gb_error_set(err, GB_ERR_INPUT,
                          "%s: holds a run already; choose another directory, or --force "
                          "to replace it",
                          path);
    } else if (entries > 0 && mode == GB_RUNDIR_MISSING && is_done(path)) {
        ok = gb_error_set(err, GB_ERR_INPUT, "%s: holds a run that is done", path);
    }
    g_free(foreign);
    return ok;
}

/* The nearest directory at or above path that exists (g_free). */
static char *nearest_existing(const char *path)
{
    char *at = g_canonicalize_filename(path, NULL);
    while (!g_file_test(at, G_FILE_TEST_EXISTS)) {
        char *up = g_path_get_dirname(at);
        g_free(at);
        at = up;
    }
    return at;
}

static bool check_parent(const char *path, struct gb_error *err)
{
    char *at = nearest_existing(path);
    bool ok = true;
    if (!g_file_test(at, G_FILE_TEST_IS_DIR)) {
        ok =
            gb_error_set(err, GB_ERR_INPUT, "%s: cannot be made: %s is a file", path, at);
    } else if (access(at, W_OK | X_OK) != 0) {
        ok = gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be made in %s: %s", path, at,
                          g_strerror(errno));
    }
    g_free(at);
    return ok;
}

static bool check_existing(const char *path, enum gb_rundir_mode mode,
                           struct gb_error *err)
{
    if (!g_file_test(path, G_FILE_TEST_IS_DIR)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%s: is a file; a run needs a directory of its own", path);
    }
    if (gb_rundir_busy(path)) {
        return busy_error(path, err);
    }
    if (access(path, W_OK | X_OK) != 0) {
        return gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be written: %s", path,
                            g_strerror(errno));
    }
    return check_content(path, mode, err);
}

bool gb_rundir_check(const char *path, enum gb_rundir_mode mode, struct gb_error *err)
{
    struct stat info;
    if (path[0] == '\0') {
        return gb_error_set(err, GB_ERR_INPUT, "the run directory has an empty name");
    }
    return lstat(path, &info) == 0 ? check_existing(path, mode, err)
                                   : check_parent(path, err);
}

/* Removes the directories from path up to made if they are empty. */
static void remove_made(const char *path, const char *made)
{
    char *at = g_canonicalize_filename(path, NULL);
    while (g_str_has_prefix(at, made) && g_rmdir(at) == 0) {
        char *up = g_path_get_dirname(at);
        g_free(at);
        at = up;
    }
    g_free(at);
}

/* Syncs the names of new folders, from full up to the one below `above`, so that they
 * survive a power failure. */
static void sync_names(const char *full, const char *above)
{
    char *at = g_strdup(full);
    while (strcmp(at, above) != 0 && at[1] != '\0') {
        char *up = g_path_get_dirname(at);
        const int fd = open(up, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        if (fd >= 0) {
            (void)fsync(fd); /* not supported by some file systems */
            close(fd);
        }
        g_free(at);
        at = up;
    }
    g_free(at);
}

/* Creates path, which does not exist, and its parents.  If two processes do so at the
 * same time, only one succeeds.  Sets dir->made. */
static bool make_missing(struct gb_rundir *dir, struct gb_error *err)
{
    char *full = g_canonicalize_filename(dir->path, NULL);
    char *parent = g_path_get_dirname(full);
    char *above = nearest_existing(full);
    const char *rest = full + strlen(above) + (above[1] != '\0' ? 1 : 0);
    const size_t length = (size_t)(rest - full) + strcspn(rest, "/");
    char *made = g_strndup(full, length);
    bool ok = g_mkdir_with_parents(parent, 0777) == 0 && g_mkdir(full, 0777) == 0;
    if (ok) {
        sync_names(full, above);
        dir->made = g_steal_pointer(&made);
    } else {
        const int why = errno;
        remove_made(parent, made);
        ok = gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be made: %s", dir->path,
                          g_strerror(why));
    }
    g_free(made);
    g_free(above);
    g_free(parent);
    g_free(full);
    return ok;
}

bool gb_rundir_make(struct gb_rundir *dir, const char *path, enum gb_rundir_mode mode,
                    struct gb_error *err)
{
    if (!gb_rundir_check(path, mode, err)) {
        return false;
    }
    *dir = (struct gb_rundir){.path = g_strdup(path), .lock = GB_LOCK_NONE};
    if (!g_file_test(path, G_FILE_TEST_IS_DIR) && !make_missing(dir, err)) {
        goto fail;
    }
    if (!hold(dir)) {
        (void)(errno == EWOULDBLOCK
                   ? busy_error(path, err)
                   : gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be opened: %s", path,
                                  g_strerror(errno)));
        goto fail;
    }
    /* check again: the directory may have changed before it was locked */
    if (!check_content(path, mode, err) || !rundir_files_remove(path, err)) {
        goto fail;
    }
    return true;

fail:
    gb_rundir_finish(dir);
    return false;
}

bool gb_rundir_busy(const char *path)
{
    return gb_lock_is_held(path, lock_name);
}

bool gb_rundir_open(struct gb_rundir *dir, const char *path, struct gb_error *err)
{
    struct stat info;
    char *preset = g_build_filename(path, "preset.ini", NULL);
    const bool is_run = lstat(preset, &info) == 0 && S_ISREG(info.st_mode);
    g_free(preset);
    if (!is_run) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%s: is not a run directory: it has no preset.ini", path);
    }
    *dir = (struct gb_rundir){.path = g_strdup(path), .lock = GB_LOCK_NONE};
    if (hold(dir)) {
        return true;
    }
    (void)(errno == EWOULDBLOCK
               ? busy_error(path, err)
               : gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be opened: %s", path,
                              g_strerror(errno)));
    gb_rundir_finish(dir);
    return false;
}

bool gb_rundir_check_identity(const struct gb_rundir *dir, struct gb_error *err)
{
    struct stat ours;
    struct stat named;
    return (fstat(dir->lock.folder, &ours) == 0 && stat(dir->path, &named) == 0 &&
            ours.st_dev == named.st_dev && ours.st_ino == named.st_ino) ||
           gb_error_set(err, GB_ERR_MACHINE,
                        "%s: was moved or removed while the run wrote there", dir->path);
}

bool gb_rundir_result(const struct gb_rundir *dir, bool good, struct gb_error *err)
{
    if (good || err == NULL || !gb_rundir_check_identity(dir, err)) {
        return good;
    }
    if (g_str_has_prefix(err->text, dir->held)) {
        gb_error_set(err, err->code, "%s%s", dir->path, err->text + strlen(dir->held));
    }
    return false;
}

char *gb_rundir_holder(const char *path)
{
    return gb_lock_holder(path, lock_name);
}

void gb_rundir_finish(struct gb_rundir *dir)
{
    gb_lock_release(&dir->lock);
    g_free(dir->made);
    g_free(dir->held);
    g_free(dir->path);
    *dir = GB_RUNDIR_NONE;
}

void gb_rundir_remove(struct gb_rundir *dir)
{
    (void)rundir_files_remove(dir->held, NULL);
    gb_lock_release(&dir->lock);
    if (dir->made != NULL) {
        remove_made(dir->path, dir->made);
    }
    gb_rundir_finish(dir);
}

/* Longest value in a directory name, and the characters kept before a checksum. */
enum { VALUE_MAX = 60, VALUE_KEPT = 40 };

void gb_rundir_name_value(GString *name, const char *value, bool free_text)
{
    const gsize before = name->len;
    for (const char *c = value; *c != '\0'; c++) {
        if (g_ascii_isalnum(*c) || *c == '.' || *c == '-' || *c == '+') {
            g_string_append_c(name, *c);
        } else if (free_text) { /* a number drops the blank in "10 nm" */
            g_string_append_printf(name, "~%02X", (unsigned)(unsigned char)*c);
        }
    }
    if (name->len - before > VALUE_MAX) {
        char *sum = g_compute_checksum_for_string(G_CHECKSUM_SHA256, value, -1);
        g_string_truncate(name, before + VALUE_KEPT);
        g_string_append_printf(name, "~~%.16s", sum);
        g_free(sum);
    }
}
