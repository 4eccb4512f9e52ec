#ifndef GB_TESTS_RUN_DIRECTORY_H
#define GB_TESTS_RUN_DIRECTORY_H

#include <string.h>

#include <glib.h>
#include <glib/gstdio.h>

#include "run/record/run_recorder.h"

/* A run directory in a temporary folder. */
struct run_directory {
    char *folder, *directory, *state, *curve, *snapshots;
};

static inline struct run_directory run_directory_make(const char *name)
{
    struct run_directory dir;
    dir.folder = g_dir_make_tmp("greenbody-test-XXXXXX", NULL);
    g_assert_nonnull(dir.folder);
    dir.directory = g_build_filename(dir.folder, name, NULL);
    dir.state = g_build_filename(dir.directory, "state.h5", NULL);
    dir.curve = g_build_filename(dir.directory, "curve.csv", NULL);
    dir.snapshots = g_build_filename(dir.directory, "snapshots", NULL);
    return dir;
}

/* Removes a directory and the files in it, if it is there. */
static inline void remove_directory(const char *directory)
{
    GDir *dir = g_dir_open(directory, 0, NULL);
    const char *name;
    while (dir != NULL && (name = g_dir_read_name(dir)) != NULL) {
        char *path = g_build_filename(directory, name, NULL);
        g_unlink(path);
        g_free(path);
    }
    if (dir != NULL) {
        g_dir_close(dir);
    }
    g_rmdir(directory);
}

static inline void run_directory_clear(const struct run_directory *dir)
{
    remove_directory(dir->snapshots);
    remove_directory(dir->directory);
}

static inline void run_directory_finish(struct run_directory *dir)
{
    run_directory_clear(dir);
    g_assert_cmpint(g_rmdir(dir->folder), ==, 0);
    g_free(dir->folder);
    g_free(dir->directory);
    g_free(dir->state);
    g_free(dir->curve);
    g_free(dir->snapshots);
}

/* The rows of curve.csv without the column of seconds, which depends on the machine. */
static inline char *run_directory_rows(const struct run_directory *dir)
{
    enum { SECONDS = 13 };
    char *text = NULL;
    g_assert_true(g_file_get_contents(dir->curve, &text, NULL, NULL));
    char **lines = g_strsplit(text, "\n", -1);
    for (int i = 0; lines[i] != NULL; i++) {
        char **cells = g_strsplit(lines[i], ",", -1);
        if (lines[i][0] != '#' && g_strv_length(cells) > SECONDS) {
            g_free(cells[SECONDS]);
            cells[SECONDS] = g_strdup("");
            g_free(lines[i]);
            lines[i] = g_strjoinv(",", cells);
        }
        g_strfreev(cells);
    }
    char *joined = g_strjoinv("\n", lines);
    g_strfreev(lines);
    g_free(text);
    return joined;
}

/* Number of points recorded so far. */
static inline int run_directory_points(const struct run_directory *dir)
{
    char *text = NULL;
    int lines = 0, comments = 0;
    if (g_file_get_contents(dir->curve, &text, NULL, NULL)) {
        for (const char *at = text; (at = strchr(at, '\n')) != NULL; at++) {
            lines++;
        }
        for (const char *at = text; at != NULL && *at == '#'; at = strchr(at, '\n') + 1) {
            comments++;
        }
        g_free(text);
    }
    return lines > comments ? lines - comments - 1 : 0;
}

/* Resumes the run from its last checkpoint to the end, without a screen. */
static inline void run_directory_continue(const struct run_directory *dir)
{
    struct gb_run_recorder *recorder = NULL;
    struct gb_experiment *experiment = NULL;
    struct gb_error err = {0};
    struct gb_snapshot shot = {0};
    if (!gb_run_recorder_resume(&recorder, &experiment, dir->directory,
                                GB_RUN_RECORDER_LAST, &err)) {
        g_error("%s", err.text);
    }
    if (experiment == NULL &&
        !gb_experiment_create(&experiment, gb_run_recorder_params(recorder), NULL, NULL,
                              &err)) {
        g_error("%s", err.text);
    }
    enum gb_step_outcome how = GB_STEP_MORE;
    while (how == GB_STEP_MORE || how == GB_STEP_POINT) {
        char text[GB_EVENT_TEXT];
        how = gb_experiment_advance(experiment, 1000, &err);
        while (gb_experiment_event(experiment, NULL, text, sizeof text)) {
            g_assert_true(gb_run_recorder_event(recorder, 0, text, &err));
        }
        if (how == GB_STEP_POINT) {
            g_assert_true(gb_run_recorder_point(recorder, experiment,
                                                gb_experiment_point(experiment), &err));
        }
    }
    g_assert_cmpint(how, ==, GB_STEP_DONE);
    g_assert_true(gb_run_recorder_conclude(recorder, &shot, &err));
    gb_run_recorder_destroy(recorder);
    gb_experiment_destroy(experiment);
}

#endif
