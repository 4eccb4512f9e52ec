#include "io/rundir_files.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <glib/gstdio.h>

/* Files of a run by name; other files in a directory are never removed. */
static const char *const known_files[] = {
    "preset.ini", "curve.csv", "events.log", "status.json", "state.h5", "packing.csv",
    "g.csv", "structure.json", "state-before.h5", "moduli.csv", "structure.csv",
    /* output.export */
    "trajectory.extxyz", "trajectory-contacts.csv", "trajectory.lammps-dump",
    "trajectory-contacts.lammps-dump"};
static const char snapshot_folder[] = "snapshots";

/* "status.json.X7TQ2C" or "state.h5.tmp": left by an atomic replacement that was killed.
 */
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
    char *true_path = realpath(path, NULL); /* links lead to the file that is replaced */
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

/* Of the files that an engine alone replaces. */
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

/* What is left of a name behind the last ending of this kind; NULL: it has none. */
static const char *behind_ending(const char *name, const char *ending)
{
    const char *at = g_strrstr(name, ending);
    return at != NULL ? at + strlen(ending) : NULL;
}

static bool is_snapshot_name(const char *name)
{
    static const char *const ends[] = {".h5", ".png", ".lammps-data", ".csv", ".vtkhdf"};
    bool known = false;
    for (size_t k = 0; k < G_N_ELEMENTS(ends); k++) {
        const char *tail = behind_ending(name, ends[k]);
        known = known || (tail != NULL && (*tail == '\0' || is_leftover(tail)));
    }
    return known;
}

/* Of the states that an engine alone keeps among the snapshots. */
static bool is_state_leftover(const char *name)
{
    const char *tail = behind_ending(name, ".h5");
    return tail != NULL && is_leftover(tail);
}

static bool has_type(const char *path, mode_t type)
{
    struct stat info;
    return lstat(path, &info) == 0 && (info.st_mode & S_IFMT) == type;
}

/* Name of the first entry that no run writes (g_free), NULL when there is none.  *entries
 * counts what was seen. */
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
        if (strcmp(name, ".lock") == 0) { /* of rundir.c; it says nothing of a run */
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

char *gb_rundir_files_foreign(const char *path, int *entries, GError **failure)
{
    return first_foreign(path, is_known_name, entries, failure);
}

/* Removes the files of a run; entries of other names stay. */
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

bool gb_rundir_files_remove(const char *path, struct gb_error *err)
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
