/* States kept along a run: where they were asked for, and the run is none the wiser. */
#include <glib.h>
#include <glib/gstdio.h>
#include <math.h>
#include <string.h>

#include "base/table.h"
#include "common/scene.h"
#include "io/state.h"
#include "many/single_run.h"
#include "run/record/run_recorder.h"
#include "scene/field/keep_points.h"

static const char *const wanted = "10 MPa; density = 0.26; every 50";

static void test_parse(void)
{
    struct gb_keep_points marks;
    struct gb_error err = {0};
    g_assert_true(gb_keep_points_parse("", &marks, &err));
    g_assert_cmpint(marks.count, ==, 0);
    g_assert_true(gb_keep_points_parse(" 100 MPa;density=0.5 ; every 20;", &marks, &err));
    g_assert_cmpint(marks.count, ==, 2);
    g_assert_cmpint(marks.every, ==, 20);
    g_assert_cmpfloat(marks.point[0].value, ==, 100e6);
    g_assert_true(!marks.point[0].by_density && marks.point[1].by_density);
    g_assert_cmpfloat(marks.point[1].value, ==, 0.5);
    static const char *const bad[] = {"100",         "100 nm",  "density 0.5",
                                      "density = 1", "every 0", "every 1; every 2",
                                      "; 100 MPa",   "every",   "every 20 MPa"};
    for (size_t i = 0; i < G_N_ELEMENTS(bad); i++) {
        err = (struct gb_error){0};
        g_assert_false(gb_keep_points_parse(bad[i], &marks, &err));
        g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
        g_assert_nonnull(strstr(err.text, "output.snapshots_at"));
    }
}

static struct gb_params scene(const char *marks)
{
    struct gb_params params =
        scene_params("numerics.fidelity=fast", "loading.until=density=0.32", NULL);
    g_strlcpy(params.snapshots_at, marks, sizeof params.snapshots_at);
    return params;
}

static void run(const char *directory, const char *marks)
{
    const struct gb_params params = scene(marks);
    struct gb_error err = {0};
    if (!gb_single_run(&params, directory, NULL, &err)) {
        g_error("%s", err.text);
    }
}

static struct gb_state *state_of(const char *directory, const char *name)
{
    struct gb_state *state = NULL;
    struct gb_error err = {0};
    char *path = g_build_filename(directory, name, NULL);
    if (!gb_state_read(&state, path, &err)) {
        g_error("%s", err.text);
    }
    g_free(path);
    return state;
}

static void remove_run(const char *directory)
{
    static const char *const folders[] = {"snapshots", "."};
    for (size_t k = 0; k < G_N_ELEMENTS(folders); k++) {
        char *folder = g_build_filename(directory, folders[k], NULL);
        GDir *dir = g_dir_open(folder, 0, NULL);
        const char *name;
        while (dir != NULL && (name = g_dir_read_name(dir)) != NULL) {
            char *path = g_build_filename(folder, name, NULL);
            g_remove(path);
            g_free(path);
        }
        if (dir != NULL) {
            g_dir_close(dir);
        }
        g_rmdir(folder);
        g_free(folder);
    }
    g_rmdir(directory);
}

static struct gb_table *curve_of(const char *directory)
{
    struct gb_table *table = NULL;
    struct gb_error err = {0};
    char *path = g_build_filename(directory, "curve.csv", NULL);
    if (!gb_table_read(&table, path, "branch", &err)) {
        g_error("%s", err.text);
    }
    g_free(path);
    return table;
}

/* The first row at which a column reaches a value. */
static size_t first_row(const struct gb_table *curve, const char *column, double value)
{
    const double *x = gb_table_column(curve, column, NULL);
    size_t row = 0;
    while (row < gb_table_rows(curve) && x[row] < value) {
        row++;
    }
    g_assert_cmpuint(row, >, 0);
    g_assert_cmpuint(row, <, gb_table_rows(curve));
    return row;
}

static void check_at(const char *directory, const struct gb_table *curve, size_t row,
                     const char *name)
{
    struct gb_state *state = state_of(directory, name);
    g_assert_cmpfloat(state->point.density, ==,
                      gb_table_column(curve, "density", NULL)[row]);
    g_assert_cmpint(state->point.step, ==,
                    (int64_t)gb_table_column(curve, "step", NULL)[row]);
    gb_state_destroy(state);
}

static void check_same_end(const char *a, const char *b)
{
    struct gb_state *one = state_of(a, "state.h5");
    struct gb_state *two = state_of(b, "state.h5");
    g_assert_cmpint(one->count, ==, two->count);
    g_assert_cmpint(memcmp(one->position, two->position, 24 * (size_t)one->count), ==, 0);
    gb_state_destroy(one);
    gb_state_destroy(two);
}

static void test_run(void)
{
    char *base = g_dir_make_tmp("kept-XXXXXX", NULL);
    char *kept = g_build_filename(base, "kept", NULL);
    char *plain = g_build_filename(base, "plain", NULL);
    run(kept, wanted);
    run(plain, "");
    struct gb_table *curve = curve_of(kept);
    struct gb_table *other = curve_of(plain);
    check_at(kept, curve, first_row(curve, "p_MPa", 10.0), "snapshots/p-10MPa.h5");
    check_at(kept, curve, first_row(curve, "density", 0.26), "snapshots/density-0.26.h5");
    check_at(kept, curve, 0, "snapshots/point-000001.h5");
    check_at(kept, curve, 50, "snapshots/point-000051.h5");
    g_assert_cmpuint(gb_table_rows(curve), ==, gb_table_rows(other));
    check_same_end(kept, plain);
    char *none = g_build_filename(plain, "snapshots", NULL);
    g_assert_false(g_file_test(none, G_FILE_TEST_EXISTS));
    g_free(none);
    gb_table_destroy(curve);
    gb_table_destroy(other);
    remove_run(kept);
    remove_run(plain);
    g_rmdir(base);
    g_free(kept);
    g_free(plain);
    g_free(base);
}

/* Some points, then away with it, as a kill does. */
static void press(struct gb_run_recorder *keep, struct gb_experiment *experiment,
                  int points)
{
    struct gb_error err = {0};
    for (int k = 0; k < points;) {
        char text[GB_EVENT_TEXT];
        const enum gb_step_outcome how = gb_experiment_advance(experiment, 100, &err);
        while (gb_experiment_event(experiment, NULL, text, sizeof text)) {
        }
        if (how == GB_STEP_DONE) {
            return;
        }
        if (how == GB_STEP_POINT) {
            k++;
            g_assert_true(gb_run_recorder_point(keep, experiment,
                                                gb_experiment_point(experiment), &err));
        }
        g_assert_true(how == GB_STEP_POINT || how == GB_STEP_MORE);
    }
}

/* What was kept before the stop is left alone, what comes after it is kept. */
static void test_resume(void)
{
    char *base = g_dir_make_tmp("kept-XXXXXX", NULL);
    char *directory = g_build_filename(base, "run", NULL);
    const struct gb_params params = scene("1 kPa; 10 MPa; 20 MPa; every 50");
    struct gb_experiment *experiment = NULL;
    struct gb_run_recorder *keep = NULL;
    struct gb_snapshot shot = {0};
    struct gb_error err = {0};
    g_assert_true(gb_experiment_create(&experiment, &params, NULL, NULL, &err));
    g_assert_true(
        gb_run_recorder_create(&keep, directory, &params, GB_RUNDIR_KEEP, &err));
    press(keep, experiment, 60);
    g_assert_true(gb_run_recorder_conclude(keep, &shot, &err));
    gb_run_recorder_destroy(keep);
    gb_experiment_destroy(experiment);
    char *first = g_build_filename(directory, "snapshots", "point-000051.h5", NULL);
    g_assert_cmpint(g_remove(first), ==, 0);
    g_assert_true(gb_run_recorder_resume(&keep, &experiment, directory,
                                         GB_RUN_RECORDER_LAST, &err));
    press(keep, experiment, 10000);
    gb_run_recorder_destroy(keep);
    gb_experiment_destroy(experiment);
    struct gb_table *curve = curve_of(directory);
    check_at(directory, curve, first_row(curve, "p_MPa", 20.0), "snapshots/p-20MPa.h5");
    check_at(directory, curve, 100, "snapshots/point-000101.h5");
    g_assert_false(g_file_test(first, G_FILE_TEST_EXISTS));
    gb_table_destroy(curve);
    remove_run(directory);
    g_rmdir(base);
    g_free(first);
    g_free(directory);
    g_free(base);
}

/* A state is asked for at the end of the loading of each mode, where rounding and the
 * tolerances of legs leave it a little short. */
static void test_ends(void)
{
    static const struct {
        const char *kind, *state;
        const char *keys[8];
    } modes[] = {
        {"quasistatic to a density", "density-0.28", {"loading.until=density=0.28"}},
        {"quasistatic to a pressure", "p-8MPa", {"loading.until=8 MPa"}},
        {"a leg to a density",
         "density-0.26",
         {"loading.path=isotropic to density 0.26"}},
        {"a leg to a pressure", "p-8MPa", {"loading.path=isotropic to 8 MPa"}},
        {"dynamic",
         "density-0.56",
         {"scene.kind=dynamic", "scene.dimension=2", "loading.geometry=isotropic",
          "loading.until=density=0.56", "loading.rate=1 1/ns", "loading.relax=0.1 ns",
          "loading.hold=0.05 ns"}},
    };
    for (size_t k = 0; k < G_N_ELEMENTS(modes); k++) {
        char *base = g_dir_make_tmp("kept-XXXXXX", NULL);
        char *directory = g_build_filename(base, "run", NULL);
        char *name = g_strdup_printf("snapshots/%s.h5", modes[k].state);
        struct gb_error err = {0};
        struct gb_params params = scene_params(
            "numerics.fidelity=fast", "particles.count=100",
            "output.snapshots_at=8 MPa; density=0.26; density=0.28; density=0.56", NULL);
        for (int i = 0; modes[k].keys[i] != NULL; i++) {
            if (!gb_params_assign(&params, modes[k].keys[i], &err)) {
                g_error("%s", err.text);
            }
        }
        g_test_message("%s", modes[k].kind);
        if (!gb_single_run(&params, directory, NULL, &err)) {
            g_error("%s", err.text);
        }
        gb_state_destroy(state_of(directory, name));
        remove_run(directory);
        g_rmdir(base);
        g_free(name);
        g_free(directory);
        g_free(base);
    }
}

static int frames_of(const char *directory)
{
    char *path = g_build_filename(directory, "trajectory.extxyz", NULL);
    char *text = NULL;
    int frames = 0;
    g_assert_true(g_file_get_contents(path, &text, NULL, NULL));
    for (const char *at = text; (at = strstr(at, "Lattice=")) != NULL; at++) {
        frames++;
    }
    g_free(text);
    g_free(path);
    return frames;
}

/* Stopped while it is unloaded, below a mark that it has passed: on the way up again nothing
 * is kept twice. */
static void test_resume_below(void)
{
    struct gb_params params = scene_params(
        "numerics.fidelity=fast", "particles.count=100", "output.export=extxyz",
        "output.snapshots_at=5 MPa; density=0.27; 14 MPa",
        "loading.path=isotropic to 12 MPa; unload to 1 MPa; isotropic to 15 MPa", NULL);
    char *base = g_dir_make_tmp("kept-XXXXXX", NULL);
    char *directory = g_build_filename(base, "run", NULL);
    struct gb_experiment *experiment = NULL;
    struct gb_run_recorder *keep = NULL;
    struct gb_snapshot shot = {0};
    struct gb_error err = {0};
    g_assert_true(gb_experiment_create(&experiment, &params, NULL, NULL, &err));
    g_assert_true(
        gb_run_recorder_create(&keep, directory, &params, GB_RUNDIR_KEEP, &err));
    double highest = 0.0, last = 0.0;
    while (!(highest > 11e6 && last < 3e6)) {
        press(keep, experiment, 1);
        last = gb_experiment_point(experiment)->p_pa;
        highest = fmax(highest, last);
    }
    g_assert_true(gb_run_recorder_conclude(keep, &shot, &err));
    gb_run_recorder_destroy(keep);
    gb_experiment_destroy(experiment);
    const int frames = frames_of(directory);
    g_assert_cmpint(frames, ==, 2);
    g_assert_true(gb_run_recorder_resume(&keep, &experiment, directory,
                                         GB_RUN_RECORDER_LAST, &err));
    press(keep, experiment, 10000);
    g_assert_true(gb_experiment_over(experiment));
    gb_run_recorder_destroy(keep);
    gb_experiment_destroy(experiment);
    g_assert_cmpint(frames_of(directory), ==,
                    frames + 1); /* of 14 MPa, in the third leg */
    gb_state_destroy(state_of(directory, "snapshots/p-14MPa.h5"));
    remove_run(directory);
    g_rmdir(base);
    g_free(directory);
    g_free(base);
}

/* Rows from before the first state of a run: what was asked for at them is not taken from a
 * later point, and an event says so. */
static void test_rows_before(void)
{
    const struct gb_params params = scene("1 kPa; density = 0.26; every 10");
    char *base = g_dir_make_tmp("kept-XXXXXX", NULL);
    char *directory = g_build_filename(base, "run", NULL);
    struct gb_experiment *experiment = NULL;
    struct gb_run_recorder *keep = NULL;
    struct gb_error err = {0};
    char text[GB_EVENT_TEXT];
    g_assert_true(gb_experiment_create(&experiment, &params, NULL, NULL, &err));
    g_assert_true(
        gb_run_recorder_create(&keep, directory, &params, GB_RUNDIR_KEEP, &err));
    while (gb_run_recorder_points(keep) < 15) {
        const enum gb_step_outcome how = gb_experiment_advance(experiment, 100, &err);
        g_assert_true(how == GB_STEP_POINT || how == GB_STEP_MORE);
        g_assert_true(how == GB_STEP_MORE ||
                      gb_run_recorder_row(keep, gb_experiment_point(experiment), &err));
    }
    press(keep, experiment, 10);
    g_assert_true(gb_run_recorder_missed(keep, text, sizeof text));
    g_assert_true(g_str_has_prefix(text, "output.snapshots_at: 3 states are not kept"));
    g_assert_false(gb_run_recorder_missed(keep, text, sizeof text));
    char *early = g_build_filename(directory, "snapshots", "p-1kPa.h5", NULL);
    g_assert_false(g_file_test(early, G_FILE_TEST_EXISTS));
    gb_state_destroy(state_of(directory, "snapshots/point-000021.h5"));
    gb_run_recorder_destroy(keep);
    gb_experiment_destroy(experiment);
    remove_run(directory);
    g_rmdir(base);
    g_free(early);
    g_free(directory);
    g_free(base);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/kept states/parse", test_parse);
    g_test_add_func("/kept states/run", test_run);
    g_test_add_func("/kept states/resume", test_resume);
    g_test_add_func("/kept states/ends", test_ends);
    g_test_add_func("/kept states/resume-below", test_resume_below);
    g_test_add_func("/kept states/rows-before", test_rows_before);
    return g_test_run();
}
