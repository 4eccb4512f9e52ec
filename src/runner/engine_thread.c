#include <glib.h>
#include <stdio.h>

#include "base/alloc.h"
#include "base/clock.h"
#include "io/follow.h"
#include "io/rundir.h"
#include "run/checkpoint.h"
#include "runner/runner_private.h"

/* The reason of GB_COMMAND_STOP. */
static const char stopped[] = "stopped on request";

static void obey(struct gb_runner *runner, struct gb_command command)
{
    switch (command.kind) {
    case GB_COMMAND_PAUSE:
        runner->paused = true;
        break;
    case GB_COMMAND_RESUME:
        runner->paused = false;
        break;
    case GB_COMMAND_STOP:
        runner->stop = true;
        break;
    case GB_COMMAND_WATCH:
        runner->view_wanted = true;
        break;
    case GB_COMMAND_FORK:
        runner->fork_wanted = true;
        break;
    case GB_COMMAND_YIELD:
        runner->yielded = true;
        break;
    case GB_COMMAND_CONTINUE:
        runner->yielded = false;
        break;
    case GB_COMMAND_STORE:
        runner->store_wanted = true;
        break;
    }
}

void gb_engine_thread_drain(struct gb_runner *runner)
{
    struct gb_command command;
    while (gb_command_ring_pop(&runner->ring, &command)) {
        obey(runner, command);
    }
    pthread_mutex_lock(&runner->mutex);
    runner->stop = runner->stop || runner->quit;
    pthread_mutex_unlock(&runner->mutex);
}

/* A run without a recorded point has no state to store yet. */
static bool store_is_due(const struct gb_runner *runner)
{
    const struct gb_run_recorder *recorder = gb_runner_loop(runner)->recorder;
    return runner->store_wanted &&
           (recorder == NULL || gb_run_recorder_points(recorder) > 0);
}

static void store_if_due(struct gb_runner *runner)
{
    if (store_is_due(runner)) {
        gb_run_loop_store(gb_runner_loop(runner));
        gb_runner_publish_stored(runner);
    }
}

/* Sleeps until a command clears the reason; the time does not count for the run. */
static void sleep_while(struct gb_runner *runner, const bool *reason)
{
    const double from = gb_clock_s();
    pthread_mutex_lock(&runner->mutex);
    while (*reason && !runner->stop) {
        struct gb_command command;
        if (runner->quit) {
            runner->stop = true;
        } else if (store_is_due(runner)) {
            pthread_mutex_unlock(&runner->mutex);
            store_if_due(runner);
            pthread_mutex_lock(&runner->mutex);
        } else if (gb_command_ring_pop(&runner->ring, &command)) {
            obey(runner, command);
        } else {
            pthread_cond_wait(&runner->wake, &runner->mutex);
        }
    }
    pthread_mutex_unlock(&runner->mutex);
    gb_run_loop_exclude(gb_runner_loop(runner), gb_clock_s() - from);
}

static void sleep_paused(struct gb_runner *runner)
{
    gb_runner_publish_event(runner, "paused");
    gb_runner_publish_state(runner, GB_RUN_PAUSED);
    gb_run_loop_save(gb_runner_loop(runner));
    sleep_while(runner, &runner->paused);
    if (!runner->stop) {
        gb_runner_publish_event(runner, "resumed");
        gb_runner_publish_state(runner, GB_RUN_RUNNING);
    }
}

/* --- hooks and callbacks of the simulation ----------------------------------------- */

static void cancel_if_stopped(struct gb_runner *runner)
{
    if (runner->stop) {
        gb_simulation_cancel(runner->simulation, stopped);
    }
}

static void between_slices(void *data)
{
    struct gb_runner *runner = data;
    gb_engine_thread_drain(runner);
    store_if_due(runner);
    if (runner->yielded && !runner->stop) {
        sleep_while(runner, &runner->yielded);
    }
    if (runner->paused && !runner->stop) {
        sleep_paused(runner);
    }
    cancel_if_stopped(runner);
}

static void on_event(void *data, struct gb_simulation *simulation, int64_t step,
                     const char *text)
{
    (void)simulation;
    (void)step;
    gb_runner_publish_event(data, text);
}

static bool is_unloading(const struct gb_record *record)
{
    const struct gb_record_item *branch = gb_record_find(record, "load/branch");
    return branch != NULL && *(const int32_t *)branch->data > 0;
}

/* The state at a point of the loading branch, when it was requested and the one before
 * has been taken. */
static void hand_over(struct gb_runner *runner, const struct gb_point *point)
{
    struct gb_error err = {0};
    pthread_mutex_lock(&runner->mutex);
    const bool forked = runner->forked;
    pthread_mutex_unlock(&runner->mutex);
    if (!runner->fork_wanted || point->branch > 0 || forked) {
        return;
    }
    if (!gb_checkpoint_take(gb_runner_loop(runner)->experiment, &runner->record, &err)) {
        runner->fork_wanted = false;
        gb_runner_publish_event(runner, err.text);
        return;
    }
    if (is_unloading(&runner->record)) {
        return; /* an unloading begins here: at the next point */
    }
    runner->fork_wanted = false;
    pthread_mutex_lock(&runner->mutex);
    runner->forked = true;
    runner->forked_points = gb_simulation_points(runner->simulation);
    pthread_mutex_unlock(&runner->mutex);
}

static void on_point(void *data, struct gb_simulation *simulation,
                     const struct gb_point *point)
{
    (void)simulation;
    hand_over(data, point);
}

/* Also while the packing is built. */
static void on_progress(void *data, struct gb_simulation *simulation, double share)
{
    struct gb_runner *runner = data;
    (void)share;
    if (simulation->loop.experiment == NULL) {
        gb_engine_thread_drain(runner);
        gb_runner_publish_if_due(runner, GB_RUN_PACKING);
        cancel_if_stopped(runner);
        return;
    }
    gb_runner_publish_view_if_due(runner);
    gb_runner_publish_if_due(runner, GB_RUN_RUNNING);
}

/* The end itself is published once the last files are there: what is done can be pictured,
 * reported and measured at once. */
static void on_end(void *data)
{
    gb_runner_publish_view(data); /* first, so that it is there with the state */
}

/* The run of a workbench continues without its directory. */
static bool on_record_error(void *data, const struct gb_error *err)
{
    char text[GB_EVENT_TEXT];
    snprintf(text, sizeof text, "no longer recorded: %s", err->text);
    gb_runner_publish_event(data, text);
    return true;
}

/* --- the beginning --------------------------------------------------------------- */

/* A new run in a new directory; without one it is not recorded. */
static void create_recorder(struct gb_runner *runner)
{
    char text[GB_EVENT_TEXT];
    struct gb_error err = {0};
    if (runner->directory == NULL) {
        return;
    }
    if (gb_simulation_start_record(runner->simulation, runner->directory, GB_RUNDIR_KEEP,
                                   &err)) {
        snprintf(text, sizeof text, "recorded in %s", runner->directory);
    } else {
        snprintf(text, sizeof text, "not recorded: %s", err.text);
    }
    gb_runner_publish_event(runner, text);
    gb_run_loop_inherit(gb_runner_loop(runner), gb_runner_curve(runner));
}

/* The engine that holds the lock has been told to stop. */
static bool wait_for_lock(struct gb_runner *runner, struct gb_error *err)
{
    while (gb_rundir_busy(runner->directory)) {
        gb_engine_thread_drain(runner);
        gb_runner_publish_if_due(runner, GB_RUN_PACKING);
        if (runner->stop) {
            return gb_error_set(err, GB_ERR_CANCELLED, "%s", stopped);
        }
        g_usleep(50000);
    }
    return true;
}

static bool begin(struct gb_runner *runner, struct gb_error *err)
{
    if (runner->resumed) {
        return wait_for_lock(runner, err) &&
               gb_simulation_open(runner->simulation, runner->directory,
                                  GB_RUN_RECORDER_LAST, err) &&
               gb_simulation_build(runner->simulation, err);
    }
    if (!gb_simulation_build(runner->simulation, err)) {
        return false;
    }
    create_recorder(runner);
    return true;
}

static void fail_to_begin(struct gb_runner *runner, const struct gb_error *err)
{
    struct gb_run_loop *loop = gb_runner_loop(runner);
    gb_simulation_release(runner->simulation);
    gb_run_loop_observe(loop, gb_run_loop_state(gb_run_loop_outcome(err)));
    loop->snapshot.error = *err;
    gb_runner_publish_snapshot(runner);
}

static void listen(struct gb_runner *runner)
{
    struct gb_simulation *simulation = runner->simulation;
    gb_simulation_on_event(simulation, on_event, runner);
    gb_simulation_on_point(simulation, on_point, runner);
    gb_simulation_on_progress(simulation, on_progress, runner, 0.0);
    gb_simulation_set_hooks(
        simulation, &(struct gb_simulation_hooks){.between_slices = between_slices,
                                                  .on_end = on_end,
                                                  .on_record_error = on_record_error,
                                                  .data = runner});
}

void *gb_engine_thread(void *data)
{
    struct gb_runner *runner = data;
    struct gb_error err = {0};
    listen(runner);
    if (!begin(runner, &err)) {
        fail_to_begin(runner, &err);
        return NULL;
    }
    gb_runner_publish_state(runner, GB_RUN_RUNNING);
    (void)gb_simulation_advance(runner->simulation, INT64_MAX, &err); /* in the snapshot */
    gb_runner_publish_snapshot(runner);
    gb_simulation_release(runner->simulation);
    return NULL;
}
