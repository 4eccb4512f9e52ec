#include <glib.h>
#include <glib/gstdio.h>

#include "base/clock.h"
#include "io/follow.h"
#include "io/rundir.h"
#include "runner/runner_private.h"

/* Interval between two readings of the directory, s. */
static const double follow_every_s = 0.4;
/* Age of an unchanged status at which the lock is tested for a living engine, s. */
static const double silence_s = 5.0;

/* Share of the time in which states are read at most: that of a million particles takes
 * seconds. */
static const double state_share = 0.1;

/* What the thread has seen. */
struct seen {
    double changed_s; /* clock reading at the last change of the status */
    GStatBuf state;   /* of the last state.h5 */
    double read_s, cost_s; /* clock reading and seconds of its reading; 0: none */
};

/* Reads the directory into the snapshot and the curve.  True: its engine is gone. */
static bool read_run(struct gb_runner *runner)
{
    struct gb_snapshot *shown = &gb_runner_loop(runner)->snapshot;
    const int64_t events = shown->events;
    struct gb_follow_engine engine = {0};
    struct gb_error err = {0};
    if (!gb_follow_status(runner->directory, shown, &engine, &err) ||
        !gb_follow_curve(runner->directory, &runner->params, runner->simulation->curve,
                         &err)) {
        if (shown->error.code == GB_OK) {
            gb_runner_publish_event(runner, err.text);
        }
        shown->error = err;
    }
    const size_t points = gb_curve_count(runner->simulation->curve);
    shown->now_valid = points > 0;
    if (points > 0) {
        shown->now = *gb_curve_at(runner->simulation->curve, points - 1);
    }
    if (shown->events > events && shown->event[0] != '\0') {
        gb_runner_publish_event(runner, shown->event);
    }
    return gb_follow_engine_gone(&engine);
}

static void lose_directory(struct gb_runner *runner)
{
    struct gb_snapshot *shown = &gb_runner_loop(runner)->snapshot;
    gb_error_set(&shown->error, GB_ERR_MACHINE,
                 "%s: was moved or removed while it was shown", runner->directory);
    gb_runner_publish_event(runner, shown->error.text);
    shown->state = GB_RUN_FAILED;
}

/* Of an engine that has gone; where its files cannot be read, that is told already. */
static void tell_end(struct gb_runner *runner)
{
    struct gb_snapshot *shown = &gb_runner_loop(runner)->snapshot;
    const enum gb_status told = shown->error.code;
    if (told == GB_OK || told == GB_ERR_CANCELLED) { /* none, or one of its status */
        gb_error_set(&shown->error, GB_ERR_CANCELLED,
                     "its engine has ended without a final status: t here or `greenbody "
                     "resume %s` continues the run",
                     runner->directory);
        gb_runner_publish_event(runner, shown->error.text);
    }
}

/* Reads the directory; false when no engine works there any more. */
static bool refresh(struct gb_runner *runner, struct seen *seen)
{
    struct gb_snapshot *shown = &gb_runner_loop(runner)->snapshot;
    const double seconds = shown->seconds;
    const enum gb_run_state state = shown->state;
    if (!g_file_test(runner->directory, G_FILE_TEST_IS_DIR)) {
        lose_directory(runner);
        return false;
    }
    /* again: its last status may have come after the first reading */
    const bool gone =
        read_run(runner) && shown->state <= GB_RUN_PAUSED && read_run(runner);
    if (shown->seconds != seconds || shown->state != state) {
        seen->changed_s = gb_clock_s();
    }
    if (shown->state <= GB_RUN_PAUSED &&
        (gone || gb_clock_s() - seen->changed_s > silence_s) &&
        !gb_rundir_busy(runner->directory)) {
        tell_end(runner);
        shown->state = GB_RUN_STOPPED;
    }
    return shown->state <= GB_RUN_PAUSED;
}

/* Files are replaced: another one has another number, time or size. */
static bool is_same(const GStatBuf *a, const GStatBuf *b)
{
    return a->st_ino == b->st_ino && a->st_mtime == b->st_mtime &&
           a->st_mtim.tv_nsec == b->st_mtim.tv_nsec && a->st_size == b->st_size;
}

/* Publishes the packing of a state.h5 that has not been shown.  One that cannot be read is
 * an event, once. */
static void show_state(struct gb_runner *runner, struct seen *seen)
{
    const double from_s = gb_clock_s();
    const double wait_s = seen->cost_s / state_share;
    char *path = g_build_filename(runner->directory, "state.h5", NULL);
    struct gb_state *state = NULL;
    struct gb_error err = {0};
    GStatBuf now;
    if ((seen->cost_s > 0.0 && from_s - seen->read_s < wait_s) ||
        g_stat(path, &now) != 0 || is_same(&now, &seen->state)) {
        g_free(path);
        return;
    }
    if (gb_state_read(&state, path, &err)) {
        gb_runner_publish_view_of(runner, state);
    } else {
        gb_runner_publish_event(runner, err.text);
    }
    gb_state_destroy(state);
    g_free(path);
    seen->state = now;
    seen->read_s = gb_clock_s();
    seen->cost_s = seen->read_s - from_s;
}

static void wait_for_next(struct gb_runner *runner)
{
    const double until = gb_clock_s() + follow_every_s;
    while (!runner->stop && gb_clock_s() < until) {
        gb_engine_thread_drain(runner);
        if (runner->store_wanted) {
            gb_runner_publish_stored(runner);
        }
        g_usleep(100000);
    }
}

void *gb_follow_thread(void *data)
{
    struct gb_runner *runner = data;
    struct seen seen = {.changed_s = gb_clock_s()};
    bool more = true;
    while (more && !runner->stop) {
        more = refresh(runner, &seen);
        seen.cost_s = more ? seen.cost_s : 0.0; /* the last state is shown in any case */
        show_state(runner, &seen);
        gb_runner_publish_snapshot(runner);
        if (more) {
            wait_for_next(runner);
        }
    }
    return NULL;
}
