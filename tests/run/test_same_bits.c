/* Same parameters, same bits: on 1 to 8 threads, stopped and resumed or not, behind a
 * screen or not, with snapshots or not, for every kind of scene.  Curve and state. */
#include <glib.h>
#include <string.h>

#include "common/die.h"
#include "common/place.h"
#include "common/scene.h"
#include "many/single_run.h"
#include "run/runner/runner.h"

/* How a run is run; all eight combinations, each on another number of threads. */
enum { RESUMED = 1, SCREEN = 2, SNAPSHOTS = 4, WAYS = 8 };

/* Points after which a run is stopped. */
enum { STOP_AFTER = 3 };

static bool has_points(void *data)
{
    return place_points(data) >= STOP_AFTER;
}

static void run_plainly(const struct gb_params *params, struct place *place, bool resumed)
{
    struct gb_error err = {0};
    const struct gb_pool_callbacks callbacks = {.cancelled = has_points, .data = place};
    const bool done =
        gb_single_run(params, place->directory, resumed ? &callbacks : NULL, &err);
    if (done == resumed) {
        g_error("%s", err.text);
    }
    if (resumed) {
        g_assert_cmpint(err.code, ==, GB_ERR_CANCELLED);
        place_go_on(place);
    }
}

/* Looks at everything a screen shows, until so many points are there or the run ends. */
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
                                       const struct place *place)
{
    struct gb_error err = {0};
    struct gb_runner *runner = NULL;
    g_assert_true(gb_runner_create_in(&runner, params, place->directory, &err));
    g_assert_true(gb_runner_send(runner, GB_COMMAND_WATCH));
    watch(runner, STOP_AFTER);
    return runner;
}

static bool was_stopped(const struct place *place)
{
    char *path = g_build_filename(place->directory, "status.json", NULL);
    char *text = NULL;
    g_assert_true(g_file_get_contents(path, &text, NULL, NULL));
    const bool stopped = strstr(text, "\"stopped\"") != NULL;
    g_free(text);
    g_free(path);
    return stopped;
}

/* Stopped in its midst and resumed.  It is begun anew where it was over before this
 * thread had seen its first points. */
static struct gb_runner *resume_watched(const struct gb_params *params,
                                        const struct place *place)
{
    struct gb_error err = {0};
    struct gb_runner *runner = NULL;
    gb_runner_destroy(start_watched(params, place));
    while (!was_stopped(place)) {
        place_clear(place);
        gb_runner_destroy(start_watched(params, place));
    }
    if (!gb_runner_resume(&runner, place->directory, &err)) {
        g_error("%s", err.text);
    }
    return runner;
}

static void run_watched(const struct gb_params *params, const struct place *place,
                        bool resumed)
{
    struct gb_runner *runner =
        resumed ? resume_watched(params, place) : start_watched(params, place);
    pause_once(runner);
    watch(runner, SIZE_MAX);
    const struct gb_snapshot *shot = gb_runner_snapshot(runner, NULL);
    if (shot->state != GB_RUN_DONE) {
        g_error("%s", shot->error.text);
    }
    gb_runner_destroy(runner);
}

/* What is left of a run: its rows without times, and the state without the directory's
 * own numbers. */
struct result {
    char *rows;
    int points;
    struct gb_record state;
};

static void run(struct gb_params params, int way, struct result *result)
{
    struct gb_error err = {0};
    struct place place = place_make("run");
    params.threads = 1 + way;
    if (way & SNAPSHOTS) {
        g_assert_true(gb_params_assign(&params, "output.snapshots_at=every 2", &err));
    }
    if (way & SCREEN) {
        run_watched(&params, &place, way & RESUMED);
    } else {
        run_plainly(&params, &place, way & RESUMED);
    }
    g_assert_cmpint(g_file_test(place.snapshots, G_FILE_TEST_IS_DIR), ==,
                    (way & SNAPSHOTS) != 0);
    result->rows = place_rows(&place);
    result->points = place_points(&place);
    if (!gb_run_recorder_read(place.directory, "state.h5", &params, &result->state,
                              &err)) {
        g_error("%s", err.text);
    }
    gb_record_remove(&result->state, "journal/");
    place_finish(&place);
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
    for (int way = 1; way < WAYS; way++) {
        int64_t row = 0;
        run(*params, way, &other);
        g_assert_cmpstr(first.rows, ==, other.rows);
        const char *name = gb_record_difference(&first.state, &other.state, &row);
        if (name != NULL) {
            g_error("%d threads%s%s%s: %s differs in row %lld", 1 + way,
                    way & RESUMED ? ", resumed" : "", way & SCREEN ? ", screen" : "",
                    way & SNAPSHOTS ? ", snapshots" : "", name, (long long)row);
        }
        finish(&other);
    }
    finish(&first);
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
    return g_test_run();
}
