#include <glib.h>
#include <string.h>

#include "common/patience.h"
#include "common/run_directory.h"
#include "common/scene.h"
#include "runner/publish.h"
#include "runner/runner.h"

/* Two threads hammer the buffer; built with -Db_sanitize=thread this also proves that the
 * atomics are enough. */
enum { SNAPSHOTS = 50000, COMMANDS = 50000 };

/* A snapshot whose parts agree only if it was neither torn nor overwritten. */
static void fill(struct gb_snapshot *snapshot, int64_t number)
{
    snapshot->evaluations = number;
    for (int i = 0; i < GB_SNAPSHOT_HISTOGRAM; i++) {
        snapshot->histogram[i] = (double)number;
    }
    snapshot->now.step = number;
    snapshot->events = number;
}

static void check(const struct gb_snapshot *snapshot)
{
    const int64_t number = snapshot->evaluations;
    g_assert_cmpint(snapshot->now.step, ==, number);
    g_assert_cmpint(snapshot->events, ==, number);
    for (int i = 0; i < GB_SNAPSHOT_HISTOGRAM; i++) {
        g_assert_cmpfloat(snapshot->histogram[i], ==, (double)number);
    }
}

static gpointer write_snapshots(gpointer data)
{
    struct gb_publish *publish = data;
    for (int64_t number = 1; number <= SNAPSHOTS; number++) {
        fill(gb_publish_back(publish), number);
        gb_publish_swap(publish);
    }
    return NULL;
}

static void test_snapshots(void)
{
    static struct gb_publish publish;
    gb_publish_init(&publish);
    g_assert_false(gb_publish_take(&publish));
    GThread *writer = g_thread_new("writer", write_snapshots, &publish);
    int64_t last = 0;
    while (last < SNAPSHOTS) {
        const bool changed = gb_publish_take(&publish);
        const struct gb_snapshot *snapshot = gb_publish_front(&publish);
        check(snapshot);
        if (changed) {
            g_assert_cmpint(snapshot->evaluations, >, last);
        } else {
            g_assert_cmpint(snapshot->evaluations, ==, last);
        }
        last = snapshot->evaluations;
    }
    g_thread_join(writer);
    g_assert_false(gb_publish_take(&publish));
}

static void test_newest_wins(void)
{
    static struct gb_publish publish;
    gb_publish_init(&publish);
    for (int64_t number = 1; number <= 7; number++) {
        fill(gb_publish_back(&publish), number);
        gb_publish_swap(&publish);
    }
    g_assert_true(gb_publish_take(&publish));
    g_assert_cmpint(gb_publish_front(&publish)->evaluations, ==, 7);
    g_assert_false(gb_publish_take(&publish));
    g_assert_cmpint(gb_publish_front(&publish)->evaluations, ==, 7);
}

static enum gb_command_kind kind_of(int number)
{
    return (enum gb_command_kind)(number % 3);
}

static gpointer push_commands(gpointer data)
{
    struct gb_command_ring *ring = data;
    for (int number = 0; number < COMMANDS; number++) {
        while (!gb_command_ring_push(ring, (struct gb_command){kind_of(number)})) {
            g_thread_yield();
        }
    }
    return NULL;
}

static void test_commands(void)
{
    static struct gb_command_ring ring;
    gb_command_ring_init(&ring);
    GThread *pusher = g_thread_new("pusher", push_commands, &ring);
    for (int number = 0; number < COMMANDS; number++) {
        struct gb_command command;
        while (!gb_command_ring_pop(&ring, &command)) {
            g_thread_yield();
        }
        g_assert_cmpint(command.kind, ==, kind_of(number));
    }
    g_thread_join(pusher);
}

static void test_ring_is_bounded(void)
{
    static struct gb_command_ring ring;
    gb_command_ring_init(&ring);
    const struct gb_command stop = {GB_COMMAND_STOP};
    struct gb_command command;
    g_assert_false(gb_command_ring_pop(&ring, &command));
    for (int i = 0; i < GB_COMMAND_RING; i++) {
        g_assert_true(gb_command_ring_push(&ring, stop));
    }
    g_assert_false(gb_command_ring_push(&ring, stop));
    g_assert_true(gb_command_ring_pop(&ring, &command));
    g_assert_cmpint(command.kind, ==, GB_COMMAND_STOP);
    g_assert_true(gb_command_ring_push(&ring, stop));
}

/* Once a run is seen to have ended, its last files are there: what is done with it next
 * reads them. */
static void test_end_is_stored(void)
{
    const struct gb_params params =
        scene_params("particles.count=400", "loading.until=density = 0.27",
                     "numerics.fidelity=fast", "numerics.threads=1", NULL);
    struct run_directory run_dir = run_directory_make("run");
    struct gb_runner *runner = NULL;
    struct gb_error err = {0};
    const gint64 from = g_get_monotonic_time();
    char *status = g_build_filename(run_dir.directory, "status.json", NULL), *text = NULL;
    g_assert_true(gb_runner_create_in(&runner, &params, run_dir.directory, &err));
    while (gb_runner_snapshot(runner, NULL)->state < GB_RUN_DONE) {
        patience_check(from, "the end of the run");
    }
    const bool stored = g_file_test(run_dir.state, G_FILE_TEST_EXISTS);
    g_assert_true(g_file_get_contents(status, &text, NULL, NULL));
    g_assert_cmpint(gb_runner_snapshot(runner, NULL)->state, ==, GB_RUN_DONE);
    g_assert_true(stored);
    g_assert_nonnull(strstr(text, "\"done\""));
    gb_runner_destroy(runner);
    g_free(text);
    g_free(status);
    run_directory_finish(&run_dir);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/run/publish/snapshots", test_snapshots);
    g_test_add_func("/run/publish/newest-wins", test_newest_wins);
    g_test_add_func("/run/publish/commands", test_commands);
    g_test_add_func("/run/publish/ring-is-bounded", test_ring_is_bounded);
    g_test_add_func("/run/publish/end-is-stored", test_end_is_stored);
    return g_test_run();
}
