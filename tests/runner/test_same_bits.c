/* Same parameters, same bits: on 1 to 8 threads, resumed or not, with a screen or without,
 * with kept states or without, with the vectors of any level, for every kind of scene.
 * Compared: curve and state. */
#include <glib.h>
#include <string.h>

#include "common/die.h"
#include "common/run_directory.h"
#include "common/scene.h"
#include "many/single_run.h"
#include "pack/kernel/simd.h"
#include "runner/runner.h"

/* Options of a run; all eight combinations, each on another number of threads. */
enum { RESUMED = 1, SCREEN = 2, SNAPSHOTS = 4, COMBINATIONS = 8 };

/* Points after which a run is stopped. */
enum { STOP_AFTER = 3 };

static bool has_points(void *data)
{
    return run_directory_points(data) >= STOP_AFTER;
}

static void run_without_screen(const struct gb_params *params,
                               struct run_directory *run_dir, bool resumed)
{
    struct gb_error err = {0};
    const struct gb_pool_callbacks callbacks = {.cancelled = has_points, .data = run_dir};
    const bool done =
        gb_single_run(params, run_dir->directory, resumed ? &callbacks : NULL, &err);
    if (done == resumed) {
        g_error("%s", err.text);
    }
    if (resumed) {
        g_assert_cmpint(err.code, ==, GB_ERR_CANCELLED);
        run_directory_continue(run_dir);
    }
}

/* Reads all that a screen reads, until there are so many points or the run ends. */
static void watch(struct gb_runner *runner, size_t points)
{
    const struct gb_curve *curve = gb_runner_curve(runner);
    double seen = 0.0;
    while (gb_runner_snapshot(runner, NULL)->state < GB_RUN_DONE &&
           gb_curve_count(curve) < points) {
        char text[GB_EVENT_TEXT];
        const size_t count = gb_curve_count(curve);
        seen += count > 0 ? gb_curve_at(curve, count - 1)->density : 0.0;
        seen += gb_runner_view_sample(runner, NULL)->valid;
        (void)gb_runner_event(runner, 0, text, sizeof text);
        g_usleep(1000);
    }
    g_assert_cmpfloat(seen, >=, 0.0);
}

static void pause_once(struct gb_runner *runner)
{
    g_assert_true(gb_runner_send(runner, GB_COMMAND_PAUSE));
    while (gb_runner_snapshot(runner, NULL)->state < GB_RUN_PAUSED) {
        g_usleep(1000);
    }
    g_assert_true(gb_runner_send(runner, GB_COMMAND_RESUME));
}

static struct gb_runner *start_watched(const struct gb_params *params,
                                       const struct run_directory *run_dir)
{
    struct gb_error err = {0};
    struct gb_runner *runner = NULL;
    g_assert_true(gb_runner_create_in(&runner, params, run_dir->directory, &err));
    g_assert_true(gb_runner_send(runner, GB_COMMAND_WATCH));
    watch(runner, STOP_AFTER);
    return runner;
}

static bool was_stopped(const struct run_directory *run_dir)
{
    char *path = g_build_filename(run_dir->directory, "status.json", NULL);
    char *text = NULL;
    g_assert_true(g_file_get_contents(path, &text, NULL, NULL));
    const bool stopped = strstr(text, "\"stopped\"") != NULL;
    g_free(text);
    g_free(path);
    return stopped;
}

/* Stops a run under way and resumes it.  A run that had ended before this thread saw its
 * first points is started again. */
static struct gb_runner *resume_watched(const struct gb_params *params,
                                        const struct run_directory *run_dir)
{
    struct gb_error err = {0};
    struct gb_runner *runner = NULL;
    gb_runner_destroy(start_watched(params, run_dir));
    while (!was_stopped(run_dir)) {
        run_directory_clear(run_dir);
        gb_runner_destroy(start_watched(params, run_dir));
    }
    if (!gb_runner_resume(&runner, run_dir->directory, &err)) {
        g_error("%s", err.text);
    }
    return runner;
}

static void run_watched(const struct gb_params *params,
                        const struct run_directory *run_dir, bool resumed)
{
    struct gb_runner *runner =
        resumed ? resume_watched(params, run_dir) : start_watched(params, run_dir);
    pause_once(runner);
    watch(runner, SIZE_MAX);
    const struct gb_snapshot *shot = gb_runner_snapshot(runner, NULL);
    if (shot->state != GB_RUN_DONE) {
        g_error("%s", shot->error.text);
    }
    gb_runner_destroy(runner);
}

/* Result of a run: its rows without times, and the state without the journal of its
 * directory. */
struct result {
    char *rows;
    int points;
    struct gb_record state;
};

static void run(struct gb_params params, int options, struct result *result)
{
    struct gb_error err = {0};
    struct run_directory run_dir = run_directory_make("run");
    params.threads = 1 + options;
    if (options & SNAPSHOTS) {
        g_assert_true(gb_params_assign(&params, "output.snapshots_at=every 2", &err));
    }
    if (options & SCREEN) {
        run_watched(&params, &run_dir, options & RESUMED);
    } else {
        run_without_screen(&params, &run_dir, options & RESUMED);
    }
    g_assert_cmpint(g_file_test(run_dir.snapshots, G_FILE_TEST_IS_DIR), ==,
                    (options & SNAPSHOTS) != 0);
    result->rows = run_directory_rows(&run_dir);
    result->points = run_directory_points(&run_dir);
    if (!gb_run_recorder_read(run_dir.directory, "state.h5", &params, &result->state,
                              &err)) {
        g_error("%s", err.text);
    }
    gb_record_remove(&result->state, "journal/");
    run_directory_finish(&run_dir);
}

static void finish(struct result *result)
{
    g_free(result->rows);
    gb_record_finish(&result->state);
}

static void check(const struct gb_params *params)
{
    static struct result first, other;
    run(*params, 0, &first);
    g_assert_cmpint(first.points, >, 2 * STOP_AFTER);
    for (int options = 1; options < COMBINATIONS; options++) {
        int64_t row = 0;
        run(*params, options, &other);
        g_assert_cmpstr(first.rows, ==, other.rows);
        const char *name = gb_record_difference(&first.state, &other.state, &row);
        if (name != NULL) {
            g_error("%d threads%s%s%s: %s differs in row %lld", 1 + options,
                    options & RESUMED ? ", resumed" : "",
                    options & SCREEN ? ", screen" : "",
                    options & SNAPSHOTS ? ", snapshots" : "", name, (long long)row);
        }
        finish(&other);
    }
    finish(&first);
}

/* With each level of vectors that this processor has. */
static void check_levels(const struct gb_params *params)
{
    static struct result widest, other;
    const int most = gb_simd_most;
    gb_simd_most = 512;
    const int best = gb_simd_width(0);
    run(*params, 0, &widest);
    g_assert_cmpint(widest.points, >, 2 * STOP_AFTER);
    if (best < 512) {
        g_test_message("no AVX-512 here: up to %d bits", best);
    }
    for (int bits = 128; bits < best; bits *= 2) {
        int64_t row = 0;
        gb_simd_most = bits;
        g_assert_cmpint(gb_simd_width(0), ==, bits);
        run(*params, 0, &other);
        g_assert_cmpstr(widest.rows, ==, other.rows);
        const char *name = gb_record_difference(&widest.state, &other.state, &row);
        if (name != NULL) {
            g_error("vectors of %d and %d bits: %s differs in row %lld", best, bits, name,
                    (long long)row);
        }
        finish(&other);
    }
    finish(&widest);
    gb_simd_most = most;
}

static void test_levels_single(void)
{
    const struct gb_params params =
        scene_params("numerics.precision=single", "particles.count=400",
                     "loading.until=40 MPa", "loading.unload_from=20 MPa",
                     "loading.step=1 %", "numerics.tolerance=1e-3", NULL);
    check_levels(&params);
}

static void test_levels_double(void)
{
    const struct gb_params params = scene_params(
        "numerics.precision=double", "loading.until=60 MPa", "loading.unload_from=30 MPa",
        "loading.step=1 %", "numerics.tolerance=1e-3", NULL);
    check_levels(&params);
}

static void test_levels_steepest(void)
{
    const struct gb_params params = scene_params(
        "numerics.relaxer=steepest", "particles.count=100", "structure.base=5.5 d",
        "loading.until=10 MPa", "loading.step=1 %", "numerics.tolerance=1e-2", NULL);
    check_levels(&params);
}

static void test_levels_sizes(void)
{
    const struct gb_params params =
        scene_params("particles.distribution=lognormal", "particles.sigma=0.25",
                     "particles.largest=14 nm", "particles.count=120",
                     "loading.until=20 MPa", "loading.unload_from=12 MPa",
                     "loading.step=1 %", "numerics.tolerance=3e-2", NULL);
    check_levels(&params);
}

static void test_levels_dynamic(void)
{
    const struct gb_params flat = scene_params(
        "scene.kind=dynamic", "scene.dimension=2", "particles.count=100",
        "contact.mu=0.5", "loading.geometry=isotropic", "loading.rate=6.8e9 1/s",
        "loading.relax=0.002 ns", "loading.hold=0.002 ns", "loading.record_time=0.001 ns",
        "loading.record=2 %", "loading.until=density = 0.58", NULL);
    check_levels(&flat);
    const struct gb_params solid = scene_params(
        "scene.kind=dynamic", "loading.geometry=isotropic", "loading.rate=6.8e9 1/s",
        "loading.relax=0.002 ns", "loading.hold=0.002 ns", "loading.record_time=0.001 ns",
        "loading.record=2 %", "loading.until=density = 0.3", NULL);
    check_levels(&solid);
}

static void test_levels_die(void)
{
    static const char *const normals[] = {"contact.normal=hertz",
                                          "contact.normal=storakers"};
    for (size_t i = 0; i < G_N_ELEMENTS(normals); i++) {
        const struct gb_params params = die_params(
            "particles.count=30", "loading.until=10 MPa", "loading.record_pressure=1 MPa",
            "contact.mu=0.05", normals[i], NULL);
        check_levels(&params);
    }
}

static void test_quasistatic(void)
{
    const struct gb_params params =
        scene_params("particles.count=100", "structure.base=5.5 d",
                     "loading.until=30 MPa", "loading.unload_from=8 MPa; 20 MPa",
                     "loading.step=1 %", "numerics.tolerance=1e-2", NULL);
    check(&params);
}

static void test_sizes(void)
{
    const struct gb_params params =
        scene_params("particles.distribution=lognormal", "particles.sigma=0.25",
                     "particles.largest=14 nm", "particles.count=120",
                     "loading.until=20 MPa", "loading.unload_from=12 MPa",
                     "loading.step=1 %", "numerics.tolerance=3e-2", NULL);
    check(&params);
}

static void test_dynamic(void)
{
    const struct gb_params params = scene_params(
        "scene.kind=dynamic", "scene.dimension=2", "particles.count=100",
        "contact.mu=0.5", "loading.geometry=isotropic", "loading.rate=6.8e9 1/s",
        "loading.relax=0.002 ns", "loading.hold=0.002 ns", "loading.record_time=0.001 ns",
        "loading.record=2 %", "loading.until=density = 0.58", NULL);
    check(&params);
}

static void test_die(void)
{
    const struct gb_params params =
        die_params("particles.count=30", "loading.until=10 MPa",
                   "loading.record_pressure=1 MPa", "contact.mu=0.05", NULL);
    check(&params);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/same/cell/quasistatic", test_quasistatic);
    g_test_add_func("/same/cell/sizes", test_sizes);
    g_test_add_func("/same/cell/dynamic", test_dynamic);
    g_test_add_func("/same/die", test_die);
    g_test_add_func("/same/levels/single", test_levels_single);
    g_test_add_func("/same/levels/double", test_levels_double);
    g_test_add_func("/same/levels/steepest", test_levels_steepest);
    g_test_add_func("/same/levels/sizes", test_levels_sizes);
    g_test_add_func("/same/levels/dynamic", test_levels_dynamic);
    g_test_add_func("/same/levels/die", test_levels_die);
    return g_test_run();
}
