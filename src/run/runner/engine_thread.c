#include <glib.h>
#include <stdio.h>

#include "base/alloc.h"
#include "base/clock.h"
#include "io/follow.h"
#include "io/rundir.h"
#include "run/checkpoint.h"
#include "run/runner/runner_private.h"

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
    const struct gb_run_recorder *recorder = runner->loop.recorder;
    return runner->store_wanted &&
           (recorder == NULL || gb_run_recorder_points(recorder) > 0);
}

static void store_if_due(struct gb_runner *runner)
{
    if (store_is_due(runner)) {
        gb_run_loop_store(&runner->loop);
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
    gb_run_loop_exclude(&runner->loop, gb_clock_s() - from);
}

static void sleep_paused(struct gb_runner *runner)
{
    gb_runner_publish_event(runner, "paused");
    gb_runner_publish_state(runner, GB_RUN_PAUSED);
    gb_run_loop_save(&runner->loop);
    sleep_while(runner, &runner->paused);
    if (!runner->stop) {
        gb_runner_publish_event(runner, "resumed");
        gb_runner_publish_state(runner, GB_RUN_RUNNING);
    }
}

/* --- hooks of the loop ----------------------------------------------------------- */

static bool may_continue(void *data, struct gb_error *err)
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
    return !runner->stop || gb_error_set(err, GB_ERR_CANCELLED, "stopped on request");
}

static void on_event(void *data, int64_t step, const char *text)
{
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
    if (!gb_checkpoint_take(runner->loop.experiment, &runner->record, &err)) {
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
    runner->forked_points = gb_curve_count(runner->curve);
    pthread_mutex_unlock(&runner->mutex);
}

static bool on_point(void *data, const struct gb_point *point, struct gb_error *err)
{
    struct gb_runner *runner = data;
    if (!gb_curve_append(runner->curve, point, err)) {
        return false;
    }
    hand_over(runner, point);
    return true;
}

static void on_tick(void *data)
{
    gb_runner_publish_view_if_due(data);
    gb_runner_publish_if_due(data, GB_RUN_RUNNING);
}

static void on_end(void *data)
{
    gb_runner_publish_view(data); /* first, so that it is there with the state */
    gb_runner_publish_snapshot(data);
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

/* Polled while the packing is built. */
static bool packing_cancelled(void *data)
{
    struct gb_runner *runner = data;
    gb_engine_thread_drain(runner);
    gb_runner_publish_if_due(runner, GB_RUN_PACKING);
    return runner->stop;
}

static bool create_experiment(struct gb_runner *runner, struct gb_error *err)
{
    struct gb_experiment *experiment = NULL;
    bool good;
    if (runner->origin == NULL) {
        good = gb_experiment_create(&experiment, &runner->params, packing_cancelled,
                                    runner, err);
    } else {
        good = gb_experiment_resume(&experiment, &runner->params, runner->origin, err);
        gb_record_finish(runner->origin);
    }
    if (good) {
        gb_run_loop_attach(&runner->loop, experiment);
    }
    return good;
}

/* A new run in a new directory; without one it is not recorded. */
static void create_recorder(struct gb_runner *runner)
{
    char text[GB_EVENT_TEXT];
    struct gb_error err = {0};
    if (runner->directory == NULL) {
        return;
    }
    if (gb_run_recorder_create(&runner->loop.recorder, runner->directory, &runner->params,
                               GB_RUNDIR_KEEP, &err)) {
        snprintf(text, sizeof text, "recorded in %s", runner->directory);
    } else {
        snprintf(text, sizeof text, "not recorded: %s", err.text);
    }
    gb_runner_publish_event(runner, text);
    gb_run_loop_inherit(&runner->loop, runner->curve);
}

/* The engine that holds the lock has been told to stop. */
static bool wait_for_lock(struct gb_runner *runner, struct gb_error *err)
{
    while (gb_rundir_busy(runner->directory)) {
        if (packing_cancelled(runner)) {
            return gb_error_set(err, GB_ERR_CANCELLED, "stopped on request");
        }
        g_usleep(50000);
    }
    return true;
}

/* From the checkpoint; without one from the beginning. */
static bool resume(struct gb_runner *runner, struct gb_error *err)
{
    char text[96];
    struct gb_run_loop *loop = &runner->loop;
    struct gb_experiment *experiment = NULL;
    if (!wait_for_lock(runner, err) ||
        !gb_run_recorder_resume(&loop->recorder, &experiment, runner->directory,
                                GB_RUN_RECORDER_LAST, err)) {
        return false;
    }
    if (experiment == NULL) {
        return gb_follow_curve(runner->directory, &runner->params, runner->curve, err) &&
               create_experiment(runner, err);
    }
    gb_run_loop_set_seconds(loop, gb_run_recorder_seconds(loop->recorder));
    gb_run_loop_attach(loop, experiment);
    if (!gb_follow_curve(runner->directory, &runner->params, runner->curve, err)) {
        return false;
    }
    snprintf(text, sizeof text, "resumed from the checkpoint of step %lld",
             (long long)gb_experiment_point(experiment)->step);
    gb_run_loop_event(loop, text);
    return true;
}

static bool begin(struct gb_runner *runner, struct gb_error *err)
{
    if (runner->resumed) {
        return resume(runner, err);
    }
    if (!create_experiment(runner, err)) {
        return false;
    }
    create_recorder(runner);
    return true;
}

static void fail_to_begin(struct gb_runner *runner, const struct gb_error *err)
{
    gb_run_loop_finish(&runner->loop);
    gb_run_loop_observe(&runner->loop, gb_run_loop_state(gb_run_loop_outcome(err)));
    runner->loop.snapshot.error = *err;
    gb_runner_publish_snapshot(runner);
}

void *gb_engine_thread(void *data)
{
    struct gb_runner *runner = data;
    struct gb_error err = {0};
    runner->loop.hooks = (struct gb_run_loop_hooks){
        .may_continue = may_continue,
        .on_event = on_event,
        .on_point = on_point,
        .on_tick = on_tick,
        .on_end = on_end,
        .on_record_error = on_record_error,
        .data = runner,
    };
    if (!begin(runner, &err)) {
        fail_to_begin(runner, &err);
        return NULL;
    }
    gb_runner_publish_state(runner, GB_RUN_RUNNING);
    (void)gb_run_loop_run(&runner->loop); /* the result is in the snapshot */
    gb_runner_publish_snapshot(runner);   /* with an event of the last files */
    gb_run_loop_finish(&runner->loop);    /* the lock of the directory goes with it */
    return NULL;
}
