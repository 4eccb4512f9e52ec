#ifndef GB_TESTS_PLACE_H
#define GB_TESTS_PLACE_H

#include <string.h>

#include <glib.h>
#include <glib/gstdio.h>

#include "run/record/run_recorder.h"

/* A run directory in a folder of its own. */
struct place {
    char *folder, *directory, *state, *curve, *snapshots;
};

static inline struct place place_make(const char *name)
{
    struct place place;
    place.folder = g_dir_make_tmp("greenbody-test-XXXXXX", NULL);
    g_assert_nonnull(place.folder);
    place.directory = g_build_filename(place.folder, name, NULL);
    place.state = g_build_filename(place.directory, "state.h5", NULL);
    place.curve = g_build_filename(place.directory, "curve.csv", NULL);
    place.snapshots = g_build_filename(place.directory, "snapshots", NULL);
    return place;
}

/* Removes a directory and the files in it, if it is there. */
static inline void place_remove(const char *directory)
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

static inline void place_clear(const struct place *place)
{
    place_remove(place->snapshots);
    place_remove(place->directory);
}

static inline void place_finish(struct place *place)
{
    place_clear(place);
    g_assert_cmpint(g_rmdir(place->folder), ==, 0);
    g_free(place->folder);
    g_free(place->directory);
    g_free(place->state);
    g_free(place->curve);
    g_free(place->snapshots);
}

/* The rows without the column of seconds, which are of the clock. */
static inline char *place_rows(const struct place *place)
{
    enum { SECONDS = 13 };
    char *text = NULL;
    g_assert_true(g_file_get_contents(place->curve, &text, NULL, NULL));
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

/* Rows of points that are there now. */
static inline int place_points(const struct place *place)
{
    char *text = NULL;
    int lines = 0, comments = 0;
    if (g_file_get_contents(place->curve, &text, NULL, NULL)) {
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

/* Goes on with what was kept, to the end, without a screen. */
static inline void place_go_on(const struct place *place)
{
    struct gb_run_recorder *keep = NULL;
    struct gb_experiment *experiment = NULL;
    struct gb_error err = {0};
    struct gb_snapshot shot = {0};
    if (!gb_run_recorder_resume(&keep, &experiment, place->directory, &err)) {
        g_error("%s", err.text);
    }
    if (experiment == NULL &&
        !gb_experiment_create(&experiment, gb_run_recorder_params(keep), NULL, NULL,
                              &err)) {
        g_error("%s", err.text);
    }
    enum gb_step_outcome how = GB_STEP_MORE;
    while (how == GB_STEP_MORE || how == GB_STEP_POINT) {
        char text[GB_EVENT_TEXT];
        how = gb_experiment_advance(experiment, 1000, &err);
        while (gb_experiment_event(experiment, text, sizeof text)) {
            g_assert_true(gb_run_recorder_event(keep, 0, text, &err));
        }
        if (how == GB_STEP_POINT) {
            g_assert_true(gb_run_recorder_point(keep, experiment,
                                                gb_experiment_point(experiment), &err));
        }
    }
    g_assert_cmpint(how, ==, GB_STEP_DONE);
    g_assert_true(gb_run_recorder_conclude(keep, &shot, &err));
    gb_run_recorder_destroy(keep);
    gb_experiment_destroy(experiment);
}

#endif
