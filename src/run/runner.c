#include "run/runner.h"

#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "base/alloc.h"
#include "run/experiment.h"
#include "run/pace.h"

/* The screen cannot use more than this, and each one costs a sweep over the contacts. */
static const double publish_every_s = 0.05;
/* Share of the engine's time that filling snapshots may take: a large packing is looked
 * at less often. */
static const double publish_share = 0.1;

enum { EVENTS = 256 };

struct gb_runner {
    /* const once the thread runs */
    struct gb_params params;
    struct gb_curve *curve;
    pthread_t thread;

    /* shared without a lock: see publish.h */
    struct gb_publish publish;
    struct gb_command_ring ring;

    /* guarded by the mutex: the paused engine sleeps on wake */
    pthread_mutex_t mutex;
    pthread_cond_t wake;
    bool quit;
    int64_t events; /* how many there were; the last EVENTS are kept */
    char event[EVENTS][GB_SNAPSHOT_EVENT];

    /* the engine thread's own */
    struct gb_experiment *experiment;
    struct gb_snapshot shown;
    struct gb_pace pace;
    bool paused, stop;
    double started, idle;           /* clock at the start, time spent paused */
    double packed;                  /* seconds the packing took */
    double published, publish_cost; /* when, and how long filling it took */
};

static double clock_s(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static double elapsed(const struct gb_runner *runner)
{
    return clock_s() - runner->started - runner->idle;
}

static void add_event(struct gb_runner *runner, const char *text)
{
    pthread_mutex_lock(&runner->mutex);
    snprintf(runner->event[runner->events % EVENTS], GB_SNAPSHOT_EVENT, "%s", text);
    runner->events++;
    pthread_mutex_unlock(&runner->mutex);
}

static void take_events(struct gb_runner *runner)
{
    char text[GB_SNAPSHOT_EVENT];
    while (gb_experiment_event(runner->experiment, text, sizeof text)) {
        add_event(runner, text);
    }
}

/* Fills the engine's own copy: the published slots come back with old content. */
static void observe(struct gb_runner *runner)
{
    struct gb_snapshot *shown = &runner->shown;
    const int state = shown->state;
    const struct gb_error error = shown->error;
    if (runner->experiment != NULL) {
        const double before = clock_s();
        take_events(runner);
        gb_experiment_observe(runner->experiment, shown);
        runner->publish_cost = clock_s() - before;
    }
    shown->state = state;
    shown->error = error;
    shown->seconds = elapsed(runner);
    if (shown->now_valid) {
        shown->now.seconds = shown->seconds;
    }
    if (runner->experiment != NULL && state == GB_RUN_RUNNING) {
        const int64_t count = runner->params.count;
        gb_pace_add(&runner->pace, shown->seconds - runner->packed, shown->evaluations,
                    shown->progress);
        shown->evaluations_per_s = gb_pace_rate(&runner->pace);
        shown->particle_evaluations_per_s = shown->evaluations_per_s * (double)count;
    }
    shown->seconds_left = state == GB_RUN_PACKING || state >= GB_RUN_STOPPED
                              ? -1.0
                              : gb_pace_left(&runner->pace);
    pthread_mutex_lock(&runner->mutex);
    shown->events = runner->events;
    if (runner->events > 0) {
        memcpy(shown->event, runner->event[(runner->events - 1) % EVENTS],
               GB_SNAPSHOT_EVENT);
    }
    pthread_mutex_unlock(&runner->mutex);
}

static void publish(struct gb_runner *runner)
{
    observe(runner);
    *gb_publish_back(&runner->publish) = runner->shown;
    gb_publish_swap(&runner->publish);
    runner->published = clock_s();
}

static void publish_if_due(struct gb_runner *runner)
{
    double every = runner->publish_cost / publish_share;
    if (every < publish_every_s) {
        every = publish_every_s;
    }
    if (clock_s() - runner->published >= every) {
        publish(runner);
    }
}

static void change_state(struct gb_runner *runner, enum gb_run_state state)
{
    runner->shown.state = (int)state;
    publish(runner);
}

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
    }
}

static void drain(struct gb_runner *runner)
{
    struct gb_command command;
    while (gb_command_ring_pop(&runner->ring, &command)) {
        obey(runner, command);
    }
    pthread_mutex_lock(&runner->mutex);
    runner->stop = runner->stop || runner->quit;
    pthread_mutex_unlock(&runner->mutex);
}

/* Polled while the packing grows, which can take a while. */
static bool cancelled(void *data)
{
    struct gb_runner *runner = data;
    drain(runner);
    publish_if_due(runner);
    return runner->stop;
}

static void sleep_paused(struct gb_runner *runner)
{
    add_event(runner, "paused");
    change_state(runner, GB_RUN_PAUSED);
    const double from = clock_s();
    pthread_mutex_lock(&runner->mutex);
    while (runner->paused && !runner->stop) {
        struct gb_command command;
        if (runner->quit) {
            runner->stop = true;
        } else if (gb_command_ring_pop(&runner->ring, &command)) {
            obey(runner, command);
        } else {
            pthread_cond_wait(&runner->wake, &runner->mutex);
        }
    }
    pthread_mutex_unlock(&runner->mutex);
    runner->idle += clock_s() - from;
    if (!runner->stop) {
        add_event(runner, "resumed");
        change_state(runner, GB_RUN_RUNNING);
    }
}

static void end_with(struct gb_runner *runner, const struct gb_error *err)
{
    const bool failed = err->code == GB_ERR_MEMORY || err->code == GB_ERR_MACHINE ||
                        err->code == GB_ERR_INPUT;
    runner->shown.error = *err;
    change_state(runner, failed ? GB_RUN_FAILED : GB_RUN_STOPPED);
}

/* One slice; false when it was the last. */
static bool slice(struct gb_runner *runner)
{
    struct gb_error err = {0};
    const double from = clock_s();
    const enum gb_advance how =
        gb_experiment_advance(runner->experiment, gb_pace_slice(&runner->pace), &err);
    gb_pace_sliced(&runner->pace, clock_s() - from, how == GB_ADVANCE_MORE);
    switch (how) {
    case GB_ADVANCE_MORE:
        return true;
    case GB_ADVANCE_POINT: {
        struct gb_point point = *gb_experiment_point(runner->experiment);
        point.seconds = elapsed(runner);
        if (!gb_curve_append(runner->curve, &point, &err)) {
            end_with(runner, &err);
            return false;
        }
        return true;
    }
    case GB_ADVANCE_DONE:
        change_state(runner, GB_RUN_DONE);
        return false;
    case GB_ADVANCE_STOPPED:
        end_with(runner, &err);
        return false;
    }
    return false;
}

static void advance_all(struct gb_runner *runner)
{
    change_state(runner, GB_RUN_RUNNING);
    for (;;) {
        drain(runner);
        if (runner->paused && !runner->stop) {
            sleep_paused(runner);
        }
        if (runner->stop) {
            struct gb_error err = {0};
            gb_error_set(&err, GB_ERR_CANCELLED, "stopped on request");
            end_with(runner, &err);
            return;
        }
        if (!slice(runner)) {
            return;
        }
        publish_if_due(runner);
    }
}

static void *engine(void *data)
{
    struct gb_runner *runner = data;
    struct gb_error err = {0};
    if (!gb_experiment_create(&runner->experiment, &runner->params, cancelled, runner,
                              &err)) {
        runner->experiment = NULL;
        end_with(runner, &err);
        return NULL;
    }
    runner->packed = elapsed(runner);
    advance_all(runner);
    gb_experiment_destroy(runner->experiment);
    runner->experiment = NULL;
    return NULL;
}

/* The thread inherits the mask it is created under: signals belong to the screen. */
static bool start(struct gb_runner *runner, struct gb_error *err)
{
    sigset_t all;
    sigset_t old;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &old);
    const int failure = pthread_create(&runner->thread, NULL, engine, runner);
    pthread_sigmask(SIG_SETMASK, &old, NULL);
    if (failure != 0) {
        return gb_error_set(err, GB_ERR_MACHINE, "cannot start the engine thread: %s",
                            strerror(failure));
    }
    return true;
}

bool gb_runner_create(struct gb_runner **out, const struct gb_params *params,
                      struct gb_error *err)
{
    struct gb_model model;
    if (!gb_params_check(params, err) || !gb_model_init(&model, params, err)) {
        return false;
    }
    struct gb_runner *runner = gb_alloc_array(1, sizeof *runner, err);
    if (runner == NULL) {
        return false;
    }
    if (!gb_curve_create(&runner->curve, err)) {
        gb_alloc_free(runner);
        return false;
    }
    runner->params = *params;
    gb_publish_init(&runner->publish);
    gb_command_ring_init(&runner->ring);
    gb_pace_init(&runner->pace);
    pthread_mutex_init(&runner->mutex, NULL);
    pthread_cond_init(&runner->wake, NULL);
    runner->started = clock_s();
    change_state(runner, GB_RUN_PACKING);
    if (!start(runner, err)) {
        pthread_cond_destroy(&runner->wake);
        pthread_mutex_destroy(&runner->mutex);
        gb_curve_destroy(runner->curve);
        gb_alloc_free(runner);
        return false;
    }
    *out = runner;
    return true;
}

void gb_runner_destroy(struct gb_runner *runner)
{
    if (runner == NULL) {
        return;
    }
    pthread_mutex_lock(&runner->mutex);
    runner->quit = true;
    pthread_cond_signal(&runner->wake);
    pthread_mutex_unlock(&runner->mutex);
    pthread_join(runner->thread, NULL);
    pthread_cond_destroy(&runner->wake);
    pthread_mutex_destroy(&runner->mutex);
    gb_curve_destroy(runner->curve);
    gb_alloc_free(runner);
}

bool gb_runner_send(struct gb_runner *runner, enum gb_command_kind kind)
{
    if (!gb_command_ring_push(&runner->ring, (struct gb_command){kind})) {
        return false;
    }
    /* under the mutex, or the engine could miss it between looking and sleeping */
    pthread_mutex_lock(&runner->mutex);
    pthread_cond_signal(&runner->wake);
    pthread_mutex_unlock(&runner->mutex);
    return true;
}

const struct gb_snapshot *gb_runner_snapshot(struct gb_runner *runner, bool *changed)
{
    const bool fresh = gb_publish_take(&runner->publish);
    if (changed != NULL) {
        *changed = fresh;
    }
    return gb_publish_front(&runner->publish);
}

const struct gb_curve *gb_runner_curve(const struct gb_runner *runner)
{
    return runner->curve;
}

const struct gb_params *gb_runner_params(const struct gb_runner *runner)
{
    return &runner->params;
}

bool gb_runner_event(struct gb_runner *runner, int64_t index, char *text, size_t size)
{
    pthread_mutex_lock(&runner->mutex);
    const bool kept =
        index >= 0 && index < runner->events && runner->events - index <= EVENTS;
    if (kept) {
        snprintf(text, size, "%s", runner->event[index % EVENTS]);
    }
    pthread_mutex_unlock(&runner->mutex);
    return kept;
}
