/* The k-th write and the k-th allocation fail, for every k until the run passes: one
 * clear line, nothing half written, and what was kept goes on to the undisturbed end.
 * With "-m slow" in every kind of run, else in one. */
#include <glib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/file.h"
#include "common/die.h"
#include "common/place.h"
#include "common/scene.h"
#include "io/hdf/hdf_record.h"
#include "io/rundir.h"
#include "many/single_run.h"
#include "run/runner/runner.h"

static struct gb_params scene(void)
{
    return scene_params("particles.count=60", "structure.base=5.5 d",
                        "loading.until=8 MPa", "loading.unload_from=3 MPa",
                        "loading.step=0.6 %", "numerics.tolerance=1e-2",
                        "output.checkpoint_every=0.1 s", "numerics.threads=1", NULL);
}

static struct gb_params scene_of_sizes(void)
{
    return scene_params("particles.distribution=lognormal", "particles.sigma=0.25",
                        "particles.largest=14 nm", "particles.count=80",
                        "structure.base=5.5 d", "loading.until=20 MPa",
                        "loading.unload_from=12 MPa", "loading.step=1 %",
                        "numerics.tolerance=3e-2", "output.checkpoint_every=0.1 s",
                        "numerics.threads=1", NULL);
}

static struct gb_params scene_in_motion(void)
{
    return scene_params("scene.kind=dynamic", "scene.dimension=2", "particles.count=60",
                        "contact.mu=0.5", "loading.geometry=isotropic",
                        "loading.rate=6.8e9 1/s", "loading.relax=0.001 ns",
                        "loading.hold=0.001 ns", "loading.record_time=0.0005 ns",
                        "loading.record=1 %", "loading.until=density = 0.56",
                        "output.checkpoint_every=0.1 s", "numerics.threads=1", NULL);
}

static struct gb_params scene_in_die(void)
{
    return die_params("particles.count=20", "loading.until=10 MPa",
                      "loading.record_pressure=1 MPa", "output.checkpoint_every=0.1 s",
                      "numerics.threads=1", NULL);
}

/* What there is, is whole: rows end with a line, a state can be read. */
static void check_whole(const struct place *place)
{
    char *text = NULL;
    gsize size = 0;
    if (g_file_get_contents(place->curve, &text, &size, NULL)) {
        g_assert_true(size == 0 || text[size - 1] == '\n');
        g_free(text);
    }
    if (g_file_test(place->state, G_FILE_TEST_EXISTS)) {
        struct gb_record record = {0};
        struct gb_error err = {0};
        if (!gb_hdf_record_read(&record, place->state, &err)) {
            g_error("%s", err.text);
        }
        gb_record_finish(&record);
    }
}

static void check_line(const struct gb_error *err, enum gb_status code)
{
    if (err->code != code) {
        g_error("%s", err->text);
    }
    g_assert_cmpstr(err->text, !=, "");
    g_assert_null(strchr(err->text, '\n'));
}

static void fail_writes(struct gb_params params)
{
    struct place place = place_make("run");
    struct gb_error err = {0};
    g_assert_true(gb_single_run(&params, place.directory, NULL, &err));
    char *whole = place_rows(&place);
    bool done = false;
    long k = 1;
    for (; !done; k++) {
        place_clear(&place);
        err = (struct gb_error){0};
        gb_file_fail_after(k);
        done = gb_single_run(&params, place.directory, NULL, &err);
        const long left = gb_file_fail_after(0);
        if (done) { /* not because a failure was passed over */
            g_assert_cmpint(left, >, 0);
            break;
        }
        check_line(&err, GB_ERR_MACHINE);
        g_assert_nonnull(strstr(err.text, place.directory));
        check_whole(&place);
        if (g_file_test(place.directory, G_FILE_TEST_IS_DIR)) {
            place_go_on(&place);
            char *rows = place_rows(&place);
            g_assert_cmpstr(rows, ==, whole);
            g_free(rows);
        }
    }
    g_assert_cmpint(k, >, 20);
    g_test_message("%ld writes failed, one at a time", k - 1);
    g_free(whole);
    place_finish(&place);
}

static void test_writes(void)
{
    fail_writes(scene());
    if (g_test_slow()) {
        fail_writes(scene_of_sizes());
        fail_writes(scene_in_motion());
        fail_writes(scene_in_die());
    }
}

static void fail_allocations(struct gb_params params)
{
    struct place place = place_make("run");
    bool done = false;
    long k = 1;
    for (; !done; k++) {
        struct gb_error err = {0};
        const size_t before = gb_alloc_bytes();
        place_clear(&place);
        gb_alloc_fail_after(k);
        done = gb_single_run(&params, place.directory, NULL, &err);
        const long left = gb_alloc_fail_after(0);
        g_assert_cmpint(left > 0, ==, done);
        if (!done) {
            check_line(&err, GB_ERR_MEMORY);
        }
        check_whole(&place);
        g_assert_cmpuint(gb_alloc_bytes(), ==, before);
    }
    g_assert_cmpint(k, >, 60);
    g_test_message("%ld allocations failed, one at a time", k - 2);
    place_finish(&place);
}

static void test_memory(void)
{
    fail_allocations(scene());
    if (g_test_slow()) {
        fail_allocations(scene_of_sizes());
        fail_allocations(scene_in_motion());
        fail_allocations(scene_in_die());
    }
}

/* What happens to a directory behind the back of its run, once it has points. */
enum loss { MOVED, REPLACED, REMOVED };

struct thief {
    struct place place;
    char *elsewhere;
    enum loss loss;
    bool done;
};

/* Looked at between slices; never cancels. */
static bool steal(void *data)
{
    struct thief *thief = data;
    const char *directory = thief->place.directory;
    if (thief->done || place_points(&thief->place) < 3) {
        return false;
    }
    thief->done = true;
    g_assert_cmpint(g_rename(directory, thief->elsewhere), ==, 0);
    if (thief->loss == REMOVED) {
        place_remove(thief->elsewhere);
    } else if (thief->loss == REPLACED) {
        g_assert_cmpint(g_mkdir(directory, 0777), ==, 0);
    }
    return false;
}

static struct thief thief_make(enum loss loss)
{
    struct thief thief = {.place = place_make("run"), .loss = loss};
    thief.elsewhere = g_build_filename(thief.place.folder, "elsewhere", NULL);
    return thief;
}

static void thief_finish(struct thief *thief)
{
    place_remove(thief->elsewhere);
    g_free(thief->elsewhere);
    place_finish(&thief->place);
}

/* Nothing is written by the old name any more; what was moved goes on from its new one.
 */
static void check_lost(enum loss loss, const struct gb_params *params, const char *whole)
{
    struct thief thief = thief_make(loss);
    struct place *place = &thief.place;
    const struct gb_pool_callbacks callbacks = {.cancelled = steal, .data = &thief};
    struct gb_error err = {0};
    g_assert_false(gb_single_run(params, place->directory, &callbacks, &err));
    check_line(&err, GB_ERR_MACHINE);
    g_assert_nonnull(strstr(err.text, place->directory));
    g_assert_nonnull(strstr(err.text, "was moved or removed"));
    g_assert_cmpint(g_rmdir(place->directory) == 0, ==, loss == REPLACED);
    if (loss != REMOVED) {
        g_assert_cmpint(g_rename(thief.elsewhere, place->directory), ==, 0);
        check_whole(place);
        place_go_on(place);
        char *rows = place_rows(place);
        g_assert_cmpstr(rows, ==, whole);
        g_free(rows);
    }
    thief_finish(&thief);
}

static void test_lost(void)
{
    struct gb_params params = scene();
    struct place place = place_make("run");
    struct gb_error err = {0};
    g_assert_true(gb_single_run(&params, place.directory, NULL, &err));
    char *whole = place_rows(&place);
    place_finish(&place);
    check_lost(MOVED, &params, whole);
    check_lost(REMOVED, &params, whole);
    check_lost(REPLACED, &params, whole);
    g_free(whole);
}

static char *read_text(const char *folder, const char *name)
{
    char *path = g_build_filename(folder, name, NULL);
    char *text = NULL;
    (void)g_file_get_contents(path, &text, NULL, NULL);
    g_free(path);
    return text;
}

/* What is on its way while another directory takes the name lands in the one it is of. */
static void test_held(void)
{
    struct thief thief = thief_make(REPLACED);
    struct gb_rundir dir = {.lock = -1};
    struct gb_error err = {0};
    g_assert_true(gb_rundir_make(&dir, thief.place.directory, GB_RUNDIR_KEEP, &err));
    char *path = g_build_filename(dir.held, "status.json", NULL);
    g_assert_true(gb_rundir_result(&dir, gb_file_replace(path, "old", 3, &err), &err));
    gb_file_fail_after(1);
    g_assert_false(gb_rundir_result(&dir, gb_file_replace(path, "new", 3, &err), &err));
    g_assert_true(g_str_has_prefix(err.text, thief.place.directory));
    g_assert_cmpint(g_rename(thief.place.directory, thief.elsewhere), ==, 0);
    g_assert_cmpint(g_mkdir(thief.place.directory, 0777), ==, 0);
    g_assert_true(gb_file_replace(path, "new", 3, &err));
    char *moved = read_text(thief.elsewhere, "status.json");
    g_assert_cmpstr(moved, ==, "new");
    g_assert_cmpint(g_rmdir(thief.place.directory), ==, 0);
    gb_file_fail_after(1);
    g_assert_false(gb_rundir_result(&dir, gb_file_replace(path, "no", 2, &err), &err));
    g_assert_nonnull(strstr(err.text, "was moved or removed"));
    g_free(moved);
    g_free(path);
    gb_rundir_finish(&dir);
    thief_finish(&thief);
}

/* False: the run was over before this thread could ask for a pause. */
static bool pause_early(struct gb_runner **runner, const struct gb_params *params,
                        const char *directory)
{
    struct gb_error err = {0};
    g_assert_true(gb_runner_create_in(runner, params, directory, &err));
    g_assert_true(gb_runner_send(*runner, GB_COMMAND_PAUSE));
    while (gb_runner_snapshot(*runner, NULL)->state < GB_RUN_PAUSED) {
        g_usleep(1000);
    }
    return gb_runner_snapshot(*runner, NULL)->state == GB_RUN_PAUSED;
}

/* Behind a screen the run goes on without its directory, and says so once. */
static void test_lost_watched(void)
{
    const struct gb_params params = scene();
    struct thief thief = thief_make(MOVED);
    struct gb_runner *runner = NULL;
    char text[GB_EVENT_TEXT];
    int told = 0;
    while (!pause_early(&runner, &params, thief.place.directory)) {
        gb_runner_destroy(runner);
        place_clear(&thief.place);
    }
    g_assert_cmpint(g_rename(thief.place.directory, thief.elsewhere), ==, 0);
    g_assert_true(gb_runner_send(runner, GB_COMMAND_RESUME));
    while (gb_runner_snapshot(runner, NULL)->state < GB_RUN_DONE) {
        g_usleep(1000);
    }
    g_assert_cmpint(gb_runner_snapshot(runner, NULL)->state, ==, GB_RUN_DONE);
    for (int64_t k = 0; gb_runner_event(runner, k, text, sizeof text); k++) {
        told += strstr(text, "no longer recorded") && strstr(text, "was moved or removed");
    }
    g_assert_cmpint(told, ==, 1);
    g_assert_false(g_file_test(thief.place.directory, G_FILE_TEST_EXISTS));
    gb_runner_destroy(runner);
    thief_finish(&thief);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/faults/writes", test_writes);
    g_test_add_func("/faults/memory", test_memory);
    g_test_add_func("/faults/lost", test_lost);
    g_test_add_func("/faults/held", test_held);
    g_test_add_func("/faults/lost-watched", test_lost_watched);
    return g_test_run();
}
