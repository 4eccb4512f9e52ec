#include "io/rundir.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <glib.h>
#include <glib/gstdio.h>

#include "io/rundir_files.h"
#include "io/status/status_json.h"

static const char lock_name[] = ".lock";

/* Locks dir->path and keeps the lock. */
static bool hold(struct gb_rundir *dir)
{
    struct stat info;
    if (!gb_lock_take(&dir->lock, dir->path, lock_name)) {
        return false;
    }
    dir->held = g_strdup_printf("/proc/self/fd/%d", dir->lock.folder);
    if (stat(dir->held, &info) != 0) { /* no such file system here */
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

/* May the files in this directory be replaced by those of a new run? */
static bool check_content(const char *path, enum gb_rundir_mode mode,
                          struct gb_error *err)
{
    int entries = 0;
    GError *failure = NULL;
    char *foreign = gb_rundir_files_foreign(path, &entries, &failure);
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

/* Removes the directories from path up to made, as long as they are empty. */
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

/* The names of new folders, from full up to the one below `above`, outlast a power failure. */
static void sync_names(const char *full, const char *above)
{
    char *at = g_strdup(full);
    while (strcmp(at, above) != 0 && at[1] != '\0') {
        char *up = g_path_get_dirname(at);
        const int fd = open(up, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        if (fd >= 0) {
            (void)fsync(fd); /* some file systems cannot */
            close(fd);
        }
        g_free(at);
        at = up;
    }
    g_free(at);
}

/* Makes path, which does not exist, with its parents; only one of two processes that do
 * so at the same time succeeds.  Sets dir->made. */
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
    /* again: it may have changed before it was locked */
    if (!check_content(path, mode, err) || !gb_rundir_files_remove(path, err)) {
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
    (void)gb_rundir_files_remove(dir->held, NULL);
    gb_lock_release(&dir->lock);
    if (dir->made != NULL) {
        remove_made(dir->path, dir->made);
    }
    gb_rundir_finish(dir);
}

/* Characters of a value in the name of a directory, and those before a checksum. */
enum { VALUE_MAX = 60, VALUE_KEPT = 40 };

void gb_rundir_name_value(GString *name, const char *value, bool free_text)
{
    const gsize before = name->len;
    for (const char *c = value; *c != '\0'; c++) {
        if (g_ascii_isalnum(*c) || *c == '.' || *c == '-' || *c == '+') {
            g_string_append_c(name, *c);
        } else if (free_text) { /* not the blanks in "10 nm" */
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
