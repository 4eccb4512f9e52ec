/* The k-th write or the k-th allocation fails, for every k until the run succeeds: the
 * error is one line, no file is incomplete, and the run resumes from its checkpoint to the
 * same result.  With "-m slow" for every kind of scene, else for one. */
#include <glib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/file.h"
#include "common/die.h"
#include "common/run_directory.h"
#include "common/scene.h"
#include "hdf/hdf_record.h"
#include "io/rundir.h"
#include "many/single_run.h"
#include "runner/runner.h"

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

/* Files that exist are complete: curve.csv ends with a line, the state can be read. */
static void check_whole(const struct run_directory *run_dir)
{
    char *text = NULL;
    gsize size = 0;
    if (g_file_get_contents(run_dir->curve, &text, &size, NULL)) {
        g_assert_true(size == 0 || text[size - 1] == '\n');
        g_free(text);
    }
    if (g_file_test(run_dir->state, G_FILE_TEST_EXISTS)) {
        struct gb_record record = {0};
        struct gb_error err = {0};
        if (!gb_hdf_record_read(&record, run_dir->state, &err)) {
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
    struct run_directory run_dir = run_directory_make("run");
    struct gb_error err = {0};
    g_assert_true(gb_single_run(&params, run_dir.directory, NULL, &err));
    char *whole = run_directory_rows(&run_dir);
    bool done = false;
    long k = 1;
    for (; !done; k++) {
        run_directory_clear(&run_dir);
        err = (struct gb_error){0};
        gb_file_fail_after(k);
        done = gb_single_run(&params, run_dir.directory, NULL, &err);
        const long left = gb_file_fail_after(0);
        if (done) { /* not because a failure was passed over */
            g_assert_cmpint(left, >, 0);
            break;
        }
        check_line(&err, GB_ERR_MACHINE);
        g_assert_nonnull(strstr(err.text, run_dir.directory));
        check_whole(&run_dir);
        if (g_file_test(run_dir.directory, G_FILE_TEST_IS_DIR)) {
            run_directory_continue(&run_dir);
            char *rows = run_directory_rows(&run_dir);
            g_assert_cmpstr(rows, ==, whole);
            g_free(rows);
        }
    }
    g_assert_cmpint(k, >, 20);
    g_test_message("%ld writes failed, one at a time", k - 1);
    g_free(whole);
    run_directory_finish(&run_dir);
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
    struct run_directory run_dir = run_directory_make("run");
    bool done = false;
    long k = 1;
    for (; !done; k++) {
        struct gb_error err = {0};
        const size_t before = gb_alloc_bytes();
        run_directory_clear(&run_dir);
        gb_alloc_fail_after(k);
        done = gb_single_run(&params, run_dir.directory, NULL, &err);
        const long left = gb_alloc_fail_after(0);
        g_assert_cmpint(left > 0, ==, done);
        if (!done) {
            check_line(&err, GB_ERR_MEMORY);
        }
        check_whole(&run_dir);
        g_assert_cmpuint(gb_alloc_bytes(), ==, before);
    }
    g_assert_cmpint(k, >, 60);
    g_test_message("%ld allocations failed, one at a time", k - 2);
    run_directory_finish(&run_dir);
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

/* What another process does to the directory of a run, once it has points. */
enum loss { MOVED, REPLACED, REMOVED };

struct run_to_move {
    struct run_directory run_dir;
    char *elsewhere;
    enum loss loss;
    bool done;
};

/* Callback between two slices: moves the directory once, never cancels. */
static bool move_once(void *data)
{
    struct run_to_move *moved = data;
    const char *directory = moved->run_dir.directory;
    if (moved->done || run_directory_points(&moved->run_dir) < 3) {
        return false;
    }
    moved->done = true;
    g_assert_cmpint(g_rename(directory, moved->elsewhere), ==, 0);
    if (moved->loss == REMOVED) {
        remove_directory(moved->elsewhere);
    } else if (moved->loss == REPLACED) {
        g_assert_cmpint(g_mkdir(directory, 0777), ==, 0);
    }
    return false;
}

static struct run_to_move run_to_move_make(enum loss loss)
{
    struct run_to_move moved = {.run_dir = run_directory_make("run"), .loss = loss};
    moved.elsewhere = g_build_filename(moved.run_dir.folder, "elsewhere", NULL);
    return moved;
}

static void run_to_move_finish(struct run_to_move *moved)
{
    remove_directory(moved->elsewhere);
    g_free(moved->elsewhere);
    run_directory_finish(&moved->run_dir);
}

/* Nothing is written under the old name any more; the moved directory can be resumed. */
static void check_lost(enum loss loss, const struct gb_params *params, const char *whole)
{
    struct run_to_move moved = run_to_move_make(loss);
    struct run_directory *run_dir = &moved.run_dir;
    const struct gb_pool_callbacks callbacks = {.cancelled = move_once, .data = &moved};
    struct gb_error err = {0};
    g_assert_false(gb_single_run(params, run_dir->directory, &callbacks, &err));
    check_line(&err, GB_ERR_MACHINE);
    g_assert_nonnull(strstr(err.text, run_dir->directory));
    g_assert_nonnull(strstr(err.text, "was moved or removed"));
    g_assert_cmpint(g_rmdir(run_dir->directory) == 0, ==, loss == REPLACED);
    if (loss != REMOVED) {
        g_assert_cmpint(g_rename(moved.elsewhere, run_dir->directory), ==, 0);
        check_whole(run_dir);
        run_directory_continue(run_dir);
        char *rows = run_directory_rows(run_dir);
        g_assert_cmpstr(rows, ==, whole);
        g_free(rows);
    }
    run_to_move_finish(&moved);
}

static void test_lost(void)
{
    struct gb_params params = scene();
    struct run_directory run_dir = run_directory_make("run");
    struct gb_error err = {0};
    g_assert_true(gb_single_run(&params, run_dir.directory, NULL, &err));
    char *whole = run_directory_rows(&run_dir);
    run_directory_finish(&run_dir);
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

/* A file being written while another directory takes the name goes to the moved one. */
static void test_held(void)
{
    struct run_to_move moved = run_to_move_make(REPLACED);
    struct gb_rundir dir = GB_RUNDIR_NONE;
    struct gb_error err = {0};
    g_assert_true(gb_rundir_make(&dir, moved.run_dir.directory, GB_RUNDIR_KEEP, &err));
    char *path = g_build_filename(dir.held, "status.json", NULL);
    g_assert_true(gb_rundir_result(&dir, gb_file_replace(path, "old", 3, &err), &err));
    gb_file_fail_after(1);
    g_assert_false(gb_rundir_result(&dir, gb_file_replace(path, "new", 3, &err), &err));
    g_assert_true(g_str_has_prefix(err.text, moved.run_dir.directory));
    g_assert_cmpint(g_rename(moved.run_dir.directory, moved.elsewhere), ==, 0);
    g_assert_cmpint(g_mkdir(moved.run_dir.directory, 0777), ==, 0);
    g_assert_true(gb_file_replace(path, "new", 3, &err));
    char *text = read_text(moved.elsewhere, "status.json");
    g_assert_cmpstr(text, ==, "new");
    g_assert_cmpint(g_rmdir(moved.run_dir.directory), ==, 0);
    gb_file_fail_after(1);
    g_assert_false(gb_rundir_result(&dir, gb_file_replace(path, "no", 2, &err), &err));
    g_assert_nonnull(strstr(err.text, "was moved or removed"));
    g_free(text);
    g_free(path);
    gb_rundir_finish(&dir);
    run_to_move_finish(&moved);
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

/* In the workbench a run continues without its directory, with one event. */
static void test_lost_watched(void)
{
    const struct gb_params params = scene();
    struct run_to_move moved = run_to_move_make(MOVED);
    struct gb_runner *runner = NULL;
    char text[GB_EVENT_TEXT];
    int told = 0;
    while (!pause_early(&runner, &params, moved.run_dir.directory)) {
        gb_runner_destroy(runner);
        run_directory_clear(&moved.run_dir);
    }
    g_assert_cmpint(g_rename(moved.run_dir.directory, moved.elsewhere), ==, 0);
    g_assert_true(gb_runner_send(runner, GB_COMMAND_RESUME));
    while (gb_runner_snapshot(runner, NULL)->state < GB_RUN_DONE) {
        g_usleep(1000);
    }
    g_assert_cmpint(gb_runner_snapshot(runner, NULL)->state, ==, GB_RUN_DONE);
    for (int64_t k = 0; gb_runner_event(runner, k, text, sizeof text); k++) {
        told +=
            strstr(text, "no longer recorded") && strstr(text, "was moved or removed");
    }
    g_assert_cmpint(told, ==, 1);
    g_assert_false(g_file_test(moved.run_dir.directory, G_FILE_TEST_EXISTS));
    gb_runner_destroy(runner);
    run_to_move_finish(&moved);
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
