/* output.export: the kept states as a trajectory along the run, the same after a kill and a
 * resumption; a full disk is told and ends no run. */
#include <glib.h>
#include <glib/gstdio.h>
#include <string.h>

#include "base/file.h"
#include "common/scene.h"
#include "io/state.h"
#include "run/record/live_export.h"
#include "run/record/run_recorder.h"

static char *base;

struct live_run {
    struct gb_experiment *experiment;
    struct gb_run_recorder *recorder;
    char *directory;
    struct gb_params params;
};

static struct gb_params scene(const char *format)
{
    char assignment[64];
    g_snprintf(assignment, sizeof assignment, "output.export=%s", format);
    return scene_params("numerics.fidelity=fast", "loading.until=density=0.32",
                        "output.snapshots_at=every 10", assignment, NULL);
}

static struct live_run start(const char *name, const char *format)
{
    struct gb_error err = {0};
    struct live_run run = {.directory = g_build_filename(base, name, NULL),
                           .params = scene(format)};
    g_assert_true(gb_experiment_create(&run.experiment, &run.params, NULL, NULL, &err));
    g_assert_true(gb_run_recorder_create(&run.recorder, run.directory, &run.params,
                                         GB_RUNDIR_KEEP, &err));
    return run;
}

/* Away with it, as a kill does; the directory stays. */
static void leave(struct live_run *run)
{
    gb_run_recorder_destroy(run->recorder);
    gb_experiment_destroy(run->experiment);
}

static void resume(struct live_run *run)
{
    struct gb_error err = {0};
    const bool resumed = gb_run_recorder_resume(
        &run->recorder, &run->experiment, run->directory, GB_RUN_RECORDER_LAST, &err);
    g_assert_cmpstr(err.text, ==, "");
    g_assert_true(resumed);
}

/* Points until there are `points`; *told counts what was told. */
static void press(struct live_run *run, int64_t points, int *told)
{
    struct gb_error err = {0};
    while (gb_run_recorder_points(run->recorder) < points) {
        char text[GB_EVENT_TEXT];
        const enum gb_step_outcome how =
            gb_experiment_advance(run->experiment, 100, &err);
        while (gb_experiment_event(run->experiment, NULL, text, sizeof text)) {
        }
        g_assert_true(how == GB_STEP_POINT || how == GB_STEP_MORE);
        if (how == GB_STEP_POINT) {
            const bool recorded =
                gb_run_recorder_point(run->recorder, run->experiment,
                                      gb_experiment_point(run->experiment), &err);
            g_assert_cmpstr(err.text, ==, "");
            g_assert_true(recorded);
        }
        while (gb_run_recorder_missed(run->recorder, text, sizeof text)) {
            g_assert_nonnull(strstr(text, "output.export"));
            (*told)++;
        }
    }
}

static char *text_of(const struct live_run *run, const char *name)
{
    char *path = g_build_filename(run->directory, name, NULL);
    char *text = NULL;
    if (!g_file_get_contents(path, &text, NULL, NULL)) {
        g_error("%s: cannot be read", path);
    }
    g_free(path);
    return text;
}

static int count_of(const char *text, const char *word)
{
    char **parts = g_strsplit(text, word, 0);
    const int count = (int)g_strv_length(parts) - 1;
    g_strfreev(parts);
    return count;
}

static char *trajectory_of(const struct live_run *run, const char *format, int which)
{
    struct gb_error err = {0};
    char *name = which == 0 ? g_strdup_printf("trajectory.%s", format)
                            : g_strdup_printf("trajectory-contacts.%s",
                                              gb_export_find(format, &err)->contacts);
    char *text = text_of(run, name);
    g_free(name);
    return text;
}

static void assert_same_files(const struct live_run *a, const struct live_run *b,
                              const char *format)
{
    for (int k = 0; k < 2; k++) {
        char *one = trajectory_of(a, format, k), *two = trajectory_of(b, format, k);
        g_assert_true(strcmp(one, two) == 0);
        g_free(one);
        g_free(two);
    }
}

/* The frames are the exports of the kept states, one behind the other. */
static void assert_exports(const struct live_run *run, const char *format, int frames)
{
    struct gb_error err = {0};
    GString *text[2] = {g_string_new(NULL), g_string_new(NULL)};
    for (int k = 0; k < frames; k++) {
        struct gb_state *state = NULL;
        char *path =
            g_strdup_printf("%s/snapshots/point-%06d.h5", run->directory, 10 * k + 1);
        g_assert_true(gb_state_read(&state, path, &err));
        g_assert_true(gb_export_add(gb_export_find(format, &err), state,
                                    run->params.density_kg_m3, k, text[0], text[1],
                                    &err));
        gb_state_destroy(state);
        g_free(path);
    }
    for (int k = 0; k < 2; k++) {
        char *written = trajectory_of(run, format, k);
        g_assert_true(strcmp(written, text[k]->str) == 0);
        g_assert_cmpuint(text[k]->len, >, 1000);
        g_string_free(text[k], TRUE);
        g_free(written);
    }
}

static void clear(struct live_run *run)
{
    struct gb_error err = {0};
    leave(run);
    struct gb_rundir dir = GB_RUNDIR_NONE;
    g_assert_true(gb_rundir_open(&dir, run->directory, &err));
    gb_rundir_remove(&dir);
    g_rmdir(run->directory);
    g_free(run->directory);
}

static void append_junk(const struct live_run *run, const char *name)
{
    char *path = g_build_filename(run->directory, name, NULL);
    FILE *file = g_fopen(path, "ab");
    fputs("half a frame", file);
    fclose(file);
    g_free(path);
}

/* A checkpoint at 25, killed at 45 with half a frame behind: frames 31 and 41 are written
 * again. */
static void check_resumed(const char *format)
{
    int told = 0;
    struct live_run whole = start("whole", format), broken = start("broken", format);
    struct gb_error err = {0};
    press(&whole, 61, &told);
    assert_exports(&whole, format, 7);
    press(&broken, 25, &told);
    g_assert_true(gb_run_recorder_save(broken.recorder, 1.0, &err));
    press(&broken, 45, &told);
    leave(&broken);
    char *name = g_strdup_printf("trajectory.%s", format);
    append_junk(&broken, name);
    g_free(name);
    resume(&broken);
    press(&broken, 31, &told);
    assert_exports(&broken, format, 4);
    press(&broken, 61, &told);
    assert_same_files(&whole, &broken, format);
    g_assert_cmpint(told, ==, 0);
    clear(&whole);
    clear(&broken);
}

/* A checkpoint at a kept point counts the frame of that point. */
static void test_resume(void)
{
    check_resumed("extxyz");
    check_resumed("lammps-dump");
    int told = 0;
    struct gb_error err = {0};
    struct live_run run = start("kept", "extxyz");
    press(&run, 21, &told);
    g_assert_true(gb_run_recorder_save(run.recorder, 1.0, &err));
    leave(&run);
    resume(&run);
    press(&run, 31, &told);
    assert_exports(&run, "extxyz", 4);
    g_assert_cmpint(told, ==, 0);
    clear(&run);
}

/* Of the writes at a kept point the second and third are those of the frame: it is left out
 * of both files, with an event, and the next one follows. */
static void test_full_disk(void)
{
    for (long which = 2; which <= 3; which++) {
        int told = 0;
        struct live_run run = start("full", "extxyz");
        press(&run, 10, &told);
        gb_file_fail_after(which);
        press(&run, 11, &told);
        g_assert_cmpint(gb_file_fail_after(0), ==, 0);
        g_assert_cmpint(told, ==, 1);
        press(&run, 21, &told);
        g_assert_cmpint(told, ==, 1);
        char *text = text_of(&run, "trajectory.extxyz");
        char *contacts = text_of(&run, "trajectory-contacts.csv");
        g_assert_cmpint(count_of(text, "Lattice="), ==, 2);
        g_assert_cmpint(
            count_of(contacts, "provenance") + count_of(contacts, "frame,i,j"), ==, 1);
        g_assert_nonnull(strstr(contacts, "\n1,")); /* the frame behind the first */
        g_assert_null(strstr(contacts, "\n2,"));
        g_free(text);
        g_free(contacts);
        clear(&run);
    }
}

/* A trajectory that was cut is left alone, and told once. */
static void test_cut(void)
{
    int told = 0;
    struct gb_error err = {0};
    struct live_run run = start("cut", "extxyz");
    press(&run, 21, &told);
    g_assert_true(gb_run_recorder_save(run.recorder, 1.0, &err));
    leave(&run);
    char *path = g_build_filename(run.directory, "trajectory.extxyz", NULL);
    g_assert_true(g_file_set_contents(path, "cut", 3, NULL));
    resume(&run);
    press(&run, 41, &told);
    g_assert_cmpint(told, ==, 1);
    char *text = text_of(&run, "trajectory.extxyz");
    g_assert_cmpstr(text, ==, "cut");
    g_free(text);
    g_free(path);
    clear(&run);
}

/* Formats of one state have a file for each. */
static void test_files(void)
{
    static const char *const formats[] = {"csv", "vtkhdf", "lammps-data"};
    for (size_t k = 0; k < G_N_ELEMENTS(formats); k++) {
        int told = 0;
        struct gb_error err = {0};
        struct live_run run = start("files", formats[k]);
        press(&run, 10, &told);
        gb_file_fail_after(3); /* the row, the state */
        press(&run, 11, &told);
        g_assert_cmpint(gb_file_fail_after(0), ==, 0);
        g_assert_cmpint(told, ==, 1);
        press(&run, 21, &told);
        char *path = g_strdup_printf("%s/snapshots/point-000021.h5", run.directory);
        char *file =
            g_strdup_printf("%s/snapshots/point-000021.%s", run.directory, formats[k]);
        GString *want = g_string_new(NULL);
        struct gb_state *state = NULL;
        char *text = NULL;
        gsize size = 0;
        g_assert_true(gb_state_read(&state, path, &err));
        g_assert_true(gb_export_add(gb_export_find(formats[k], &err), state,
                                    run.params.density_kg_m3, 0, want, NULL, &err));
        g_assert_true(g_file_get_contents(file, &text, &size, NULL));
        g_assert_cmpuint(size, ==, want->len);
        g_assert_cmpint(memcmp(text, want->str, size), ==, 0);
        g_string_free(want, TRUE);
        gb_state_destroy(state);
        g_free(text);
        g_free(file);
        g_free(path);
        clear(&run);
    }
}

/* The names of the key are those of the formats; without kept states it is refused. */
static void test_key(void)
{
    struct gb_error err = {0};
    const struct gb_field *field = gb_params_find("output", "export");
    size_t count = 0;
    for (; gb_export_at(count) != NULL; count++) {
        g_assert_cmpstr(field->choices[count + 1], ==, gb_export_at(count)->name);
    }
    g_assert_null(field->choices[count + 1]);
    struct gb_params params = scene("csv");
    g_assert_true(gb_params_check(&params, &err));
    params.snapshots_at[0] = '\0';
    g_assert_false(gb_params_check(&params, &err));
    g_assert_nonnull(strstr(err.text, "output.snapshots_at"));
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    base = g_dir_make_tmp("live-XXXXXX", NULL);
    g_test_add_func("/run/live-export/key", test_key);
    g_test_add_func("/run/live-export/resume", test_resume);
    g_test_add_func("/run/live-export/full-disk", test_full_disk);
    g_test_add_func("/run/live-export/cut", test_cut);
    g_test_add_func("/run/live-export/files", test_files);
    const int failed = g_test_run();
    g_rmdir(base);
    g_free(base);
    return failed;
}
