#include "run/runner.h"

#include <glib.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/clock.h"
#include "io/follow.h"
#include "io/rundir.h"
#include "run/checkpoint.h"
#include "run/experiment.h"
#include "run/pace.h"
#include "run/runner_recorder.h"
#include "run/view_sample.h"
#include "scene/changes.h"

/* The screen cannot use more than this, and each one costs a sweep over the contacts. */
static const double publish_every_s = 0.05;
/* Share of the engine's time that filling snapshots may take: a large packing is looked
 * at less often. */
static const double publish_share = 0.1;

/* The same for pictures of the packing, which move slowly and cost more. */
static const double picture_every_s = 0.25;
static const double picture_share = 0.03;

/* How often the directory of a run that is followed is looked at, and how long its status
 * may stay as it is before its lock is asked whether there is an engine at all. */
static const double follow_every_s = 0.4, silence_s = 5.0;

enum { EVENTS = 256 };

struct gb_runner {
    /* const once the thread runs */
    struct gb_params params;
    struct gb_curve *curve;
    pthread_t thread;

    /* shared without a lock: see publish.h */
    struct gb_publish publish;
    struct gb_publish_turn turn;
    struct gb_view_sample picture[3];
    struct gb_command_ring ring;

    /* guarded by the mutex: the paused engine sleeps on wake */
    pthread_mutex_t mutex;
    pthread_cond_t wake;
    bool quit;
    bool forked;             /* record holds the state that was asked for */
    size_t forked_points;    /* of the curve, at that state */
    struct gb_record record; /* the engine's while it is not forked, then the screen's */
    int64_t events;          /* how many there were; the last EVENTS are kept */
    char event[EVENTS][GB_SNAPSHOT_EVENT];

    /* the engine thread's own */
    struct gb_runner_recorder kept;
    bool resumed; /* goes on in its directory */
    struct gb_experiment *experiment;
    struct gb_snapshot shown;
    struct gb_pace pace;
    bool paused, stop;
    bool aside;   /* waits for another engine */
    bool watched; /* pictures are wanted */
    bool fork_wanted;
    struct gb_record *origin;       /* state to go on from; NULL: from the start */
    double started, idle;           /* clock at the start, time spent paused */
    double packed;                  /* seconds the packing took */
    double published, publish_cost; /* when, and how long filling it took */
    double pictured, picture_cost;
};

static double elapsed(const struct gb_runner *runner)
{
    return gb_clock_s() - runner->started - runner->idle;
}

static void add_event(struct gb_runner *runner, const char *text)
{
    pthread_mutex_lock(&runner->mutex);
    g_strlcpy(runner->event[runner->events % EVENTS], text, GB_SNAPSHOT_EVENT);
    runner->events++;
    pthread_mutex_unlock(&runner->mutex);
}

static void take_note(struct gb_runner *runner)
{
    if (runner->kept.note[0] != '\0') {
        add_event(runner, runner->kept.note);
        runner->kept.note[0] = '\0';
    }
}

static void take_events(struct gb_runner *runner)
{
    char text[GB_SNAPSHOT_EVENT];
    while (gb_experiment_event(runner->experiment, text, sizeof text)) {
        add_event(runner, text);
        gb_runner_recorder_event(&runner->kept,
                                 gb_experiment_point(runner->experiment)->step, text);
    }
    take_note(runner);
}

/* Fills the engine's own copy: the published slots come back with old content. */
static void observe(struct gb_runner *runner)
{
    struct gb_snapshot *shown = &runner->shown;
    const int state = shown->state;
    const struct gb_error error = shown->error;
    if (runner->experiment != NULL) {
        const double before = gb_clock_s();
        take_events(runner);
        gb_experiment_observe(runner->experiment, shown);
        runner->publish_cost = gb_clock_s() - before;
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
    runner->published = gb_clock_s();
}

static void show_packing(struct gb_runner *runner)
{
    const double before = gb_clock_s();
    if (runner->experiment == NULL || !runner->watched) {
        return;
    }
    gb_view_sample_take(runner->experiment, &runner->picture[runner->turn.back]);
    gb_publish_turn_swap(&runner->turn);
    runner->pictured = gb_clock_s();
    runner->picture_cost = runner->pictured - before;
}

static void picture_if_due(struct gb_runner *runner)
{
    double every = runner->picture_cost / picture_share;
    if (every < picture_every_s) {
        every = picture_every_s;
    }
    if (gb_clock_s() - runner->pictured >= every) {
        show_packing(runner);
    }
}

static void publish_if_due(struct gb_runner *runner)
{
    double every = runner->publish_cost / publish_share;
    if (every < publish_every_s) {
        every = publish_every_s;
    }
    if (gb_clock_s() - runner->published >= every) {
        publish(runner);
    }
}

static void change_state(struct gb_runner *runner, enum gb_run_state state)
{
    runner->shown.state = (int)state;
    if (state != GB_RUN_PACKING) {
        show_packing(runner); /* first, so that it is there with the state */
    }
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
    case GB_COMMAND_WATCH:
        runner->watched = true;
        break;
    case GB_COMMAND_FORK:
        runner->fork_wanted = true;
        break;
    case GB_COMMAND_YIELD:
        runner->aside = true;
        break;
    case GB_COMMAND_TAKE_UP:
        runner->aside = false;
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

/* Until a command ends the wait. */
static void sleep_while(struct gb_runner *runner, const bool *reason)
{
    const double from = gb_clock_s();
    pthread_mutex_lock(&runner->mutex);
    while (*reason && !runner->stop) {
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
    runner->idle += gb_clock_s() - from;
}

static void sleep_paused(struct gb_runner *runner)
{
    add_event(runner, "paused");
    change_state(runner, GB_RUN_PAUSED);
    gb_runner_recorder_tick(&runner->kept, &runner->shown, true);
    sleep_while(runner, &runner->paused);
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

/* The state at a point of the loading branch, once it is wanted. */
static void hand_over(struct gb_runner *runner, const struct gb_point *point)
{
    struct gb_error err = {0};
    pthread_mutex_lock(&runner->mutex);
    const bool free_now = !runner->forked;
    pthread_mutex_unlock(&runner->mutex);
    if (!runner->fork_wanted || point->branch > 0 || !free_now) {
        return;
    }
    runner->fork_wanted = false;
    if (!gb_checkpoint_take(runner->experiment, &runner->record, &err)) {
        add_event(runner, err.text);
        return;
    }
    const struct gb_record_item *branch = gb_record_find(&runner->record, "load/branch");
    if (branch != NULL && *(const int32_t *)branch->data > 0) {
        runner->fork_wanted = true; /* an unloading begins here: at the next point */
        return;
    }
    pthread_mutex_lock(&runner->mutex);
    runner->forked = true;
    runner->forked_points = gb_curve_count(runner->curve);
    pthread_mutex_unlock(&runner->mutex);
}

/* One slice; false when it was the last. */
static bool slice(struct gb_runner *runner)
{
    struct gb_error err = {0};
    const double from = gb_clock_s();
    const enum gb_step_outcome how =
        gb_experiment_advance(runner->experiment, gb_pace_slice(&runner->pace), &err);
    gb_pace_sliced(&runner->pace, gb_clock_s() - from, how == GB_STEP_MORE);
    switch (how) {
    case GB_STEP_MORE:
        return true;
    case GB_STEP_POINT: {
        struct gb_point point = *gb_experiment_point(runner->experiment);
        point.seconds = elapsed(runner);
        if (!gb_curve_append(runner->curve, &point, &err)) {
            end_with(runner, &err);
            return false;
        }
        take_events(runner);
        gb_runner_recorder_point(&runner->kept, runner->experiment, &point);
        hand_over(runner, &point);
        return true;
    }
    case GB_STEP_DONE:
        change_state(runner, GB_RUN_DONE);
        return false;
    case GB_STEP_STOPPED:
        end_with(runner, &err);
        return false;
    }
    return false;
}

static void advance_all(struct gb_runner *runner)
{
    change_state(runner, GB_RUN_RUNNING);
    gb_runner_recorder_tick(&runner->kept, &runner->shown, true); /* who works here */
    for (;;) {
        drain(runner);
        if (runner->aside && !runner->stop) {
            sleep_while(runner, &runner->aside);
        }
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
        picture_if_due(runner);
        publish_if_due(runner);
        gb_runner_recorder_tick(&runner->kept, &runner->shown, false);
    }
}

static bool open_experiment(struct gb_runner *runner, struct gb_error *err)
{
    if (runner->origin == NULL) {
        return gb_experiment_create(&runner->experiment, &runner->params, cancelled,
                                    runner, err);
    }
    const bool good =
        gb_experiment_resume(&runner->experiment, &runner->params, runner->origin, err);
    gb_record_finish(runner->origin);
    return good;
}

/* The engine that holds the lock is on its way out. */
static bool wait_for_lock(struct gb_runner *runner, struct gb_error *err)
{
    while (gb_rundir_busy(runner->kept.directory)) {
        if (cancelled(runner)) {
            return gb_error_set(err, GB_ERR_CANCELLED, "stopped on request");
        }
        g_usleep(50000);
    }
    return true;
}

/* From the checkpoint; without one from the beginning. */
static bool go_on(struct gb_runner *runner, struct gb_error *err)
{
    char text[96];
    if (!wait_for_lock(runner, err) ||
        !gb_runner_recorder_resume(&runner->kept, &runner->experiment, err) ||
        !gb_follow_curve(runner->kept.directory, &runner->params, runner->curve, err)) {
        return false;
    }
    if (runner->experiment == NULL) {
        return gb_experiment_create(&runner->experiment, &runner->params, cancelled,
                                    runner, err);
    }
    runner->started =
        gb_clock_s() - runner->idle - gb_run_recorder_seconds(runner->kept.keep);
    const long long step = gb_experiment_point(runner->experiment)->step;
    snprintf(text, sizeof text, "resumed from the checkpoint of step %lld", step);
    add_event(runner, text);
    gb_runner_recorder_event(&runner->kept, step, text);
    return true;
}

/* A run that goes on from another's state begins with its points. */
static void keep_inherited(struct gb_runner *runner)
{
    const size_t points = gb_curve_count(runner->curve);
    for (size_t i = 0; i + 1 < points; i++) {
        gb_runner_recorder_row(&runner->kept, gb_curve_at(runner->curve, i));
    }
    if (points > 0) {
        gb_runner_recorder_point(&runner->kept, runner->experiment,
                                 gb_curve_at(runner->curve, points - 1));
    }
}

static bool begin(struct gb_runner *runner, struct gb_error *err)
{
    if (runner->resumed) {
        return go_on(runner, err);
    }
    if (!open_experiment(runner, err)) {
        return false;
    }
    gb_runner_recorder_begin(&runner->kept, &runner->params);
    take_note(runner);
    keep_inherited(runner);
    return true;
}

static void *engine(void *data)
{
    struct gb_runner *runner = data;
    struct gb_error err = {0};
    if (!begin(runner, &err)) {
        gb_experiment_destroy(runner->experiment);
        runner->experiment = NULL;
        end_with(runner, &err);
        return NULL;
    }
    runner->packed = elapsed(runner);
    advance_all(runner);
    gb_runner_recorder_conclude(&runner->kept, &runner->shown);
    if (runner->kept.note[0] != '\0') {
        take_note(runner);
        publish(runner);
    }
    gb_experiment_destroy(runner->experiment);
    runner->experiment = NULL;
    return NULL;
}

/* What the directory says now; false when no engine works there any more. */
static bool look(struct gb_runner *runner, double *changed)
{
    struct gb_snapshot *shown = &runner->shown;
    const struct gb_snapshot before = *shown;
    struct gb_follow_engine engine;
    struct gb_error err = {0};
    const char *directory = runner->kept.directory;
    if (!g_file_test(directory, G_FILE_TEST_IS_DIR)) {
        gb_error_set(&shown->error, GB_ERR_MACHINE,
                     "%s: was moved or removed while it was shown", directory);
        add_event(runner, shown->error.text);
        shown->state = GB_RUN_FAILED;
        return false;
    }
    if (!gb_follow_status(directory, shown, &engine, &err) ||
        !gb_follow_curve(directory, &runner->params, runner->curve, &err)) {
        if (shown->error.code == GB_OK) {
            add_event(runner, err.text);
        }
        shown->error = err;
    }
    const size_t points = gb_curve_count(runner->curve);
    shown->now_valid = points > 0;
    if (points > 0) {
        shown->now = *gb_curve_at(runner->curve, points - 1);
    }
    if (shown->events > before.events && shown->event[0] != '\0') {
        add_event(runner, shown->event);
    }
    if (shown->seconds != before.seconds || shown->state != before.state) {
        *changed = gb_clock_s();
    }
    if (shown->state <= GB_RUN_PAUSED && gb_clock_s() - *changed > silence_s &&
        !gb_rundir_busy(directory)) {
        add_event(runner, "its engine is gone; t goes on from the last checkpoint");
        shown->state = GB_RUN_STOPPED;
    }
    return shown->state <= GB_RUN_PAUSED;
}

static void publish_followed(struct gb_runner *runner)
{
    pthread_mutex_lock(&runner->mutex);
    runner->shown.events = runner->events;
    pthread_mutex_unlock(&runner->mutex);
    *gb_publish_back(&runner->publish) = runner->shown;
    gb_publish_swap(&runner->publish);
}

/* Instead of the engine: another process is it. */
static void *follow(void *data)
{
    struct gb_runner *runner = data;
    double changed = gb_clock_s();
    int64_t told = 0; /* events in the status, which counts its own */
    bool more = true;
    while (more) {
        runner->shown.events = told;
        more = look(runner, &changed);
        told = runner->shown.events;
        publish_followed(runner);
        const double until = gb_clock_s() + follow_every_s;
        while (more && !runner->stop && gb_clock_s() < until) {
            drain(runner);
            g_usleep(100000);
        }
        more = more && !runner->stop;
    }
    return NULL;
}

/* The thread inherits the mask it is created under: signals belong to the screen. */
static bool start(struct gb_runner *runner, void *(*work)(void *data),
                  struct gb_error *err)
{
    sigset_t all;
    sigset_t old;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &old);
    const int failure = pthread_create(&runner->thread, NULL, work, runner);
    pthread_sigmask(SIG_SETMASK, &old, NULL);
    if (failure != 0) {
        return gb_error_set(err, GB_ERR_MACHINE, "cannot start the engine thread: %s",
                            strerror(failure));
    }
    return true;
}

static void drop(struct gb_runner *runner)
{
    gb_record_finish(&runner->record);
    if (runner->origin != NULL) {
        gb_record_finish(runner->origin);
        gb_alloc_free(runner->origin);
    }
    gb_runner_recorder_finish(&runner->kept);
    gb_curve_destroy(runner->curve);
    gb_alloc_free(runner);
}

static struct gb_runner *make(const struct gb_params *params, const char *directory,
                              struct gb_error *err)
{
    struct gb_model model;
    if (!gb_params_check(params, err) || !gb_model_init(&model, params, err)) {
        return NULL;
    }
    struct gb_runner *runner = gb_alloc_array(1, sizeof *runner, err);
    if (runner == NULL) {
        return NULL;
    }
    if (!gb_curve_create(&runner->curve, err)) {
        gb_alloc_free(runner);
        return NULL;
    }
    runner->params = *params;
    runner->kept.directory = g_strdup(directory);
    gb_publish_init(&runner->publish);
    gb_publish_turn_init(&runner->turn);
    gb_command_ring_init(&runner->ring);
    gb_pace_init(&runner->pace);
    runner->started = gb_clock_s();
    return runner;
}

static bool launch(struct gb_runner **out, struct gb_runner *runner,
                   void *(*work)(void *data), struct gb_error *err)
{
    pthread_mutex_init(&runner->mutex, NULL);
    pthread_cond_init(&runner->wake, NULL);
    change_state(runner, GB_RUN_PACKING);
    if (!start(runner, work, err)) {
        pthread_cond_destroy(&runner->wake);
        pthread_mutex_destroy(&runner->mutex);
        drop(runner);
        return false;
    }
    *out = runner;
    return true;
}

bool gb_runner_create(struct gb_runner **out, const struct gb_params *params,
                      struct gb_error *err)
{
    return gb_runner_create_in(out, params, NULL, err);
}

bool gb_runner_forked(struct gb_runner *runner, int64_t *step)
{
    pthread_mutex_lock(&runner->mutex);
    const bool forked = runner->forked;
    pthread_mutex_unlock(&runner->mutex);
    if (forked && step != NULL) {
        *step = gb_checkpoint_step(&runner->record) - 1;
    }
    return forked;
}

bool gb_runner_create_fork(struct gb_runner **out, const char *changes,
                           struct gb_runner *parent, const char *directory,
                           struct gb_error *err)
{
    struct gb_params changed = parent->params;
    int64_t step = 0;
    if (!gb_runner_forked(parent, &step)) {
        return gb_error_set(err, GB_ERR_INPUT, "the run has not handed over its state");
    }
    if (!gb_changes_add(&changed, step, changes, err)) {
        return false;
    }
    struct gb_runner *runner = make(&changed, directory, err);
    if (runner == NULL) {
        return false;
    }
    bool good = true;
    for (size_t i = 0; good && i < parent->forked_points; i++) {
        good = gb_curve_append(runner->curve, gb_curve_at(parent->curve, i), err);
    }
    runner->origin = good ? gb_alloc_array(1, sizeof *runner->origin, err) : NULL;
    if (runner->origin == NULL) {
        drop(runner);
        return false;
    }
    *runner->origin = parent->record;
    pthread_mutex_lock(&parent->mutex);
    memset(&parent->record, 0, sizeof parent->record);
    parent->forked = false;
    pthread_mutex_unlock(&parent->mutex);
    return launch(out, runner, engine, err);
}

bool gb_runner_create_in(struct gb_runner **out, const struct gb_params *params,
                         const char *directory, struct gb_error *err)
{
    struct gb_runner *runner = make(params, directory, err);
    return runner != NULL && launch(out, runner, engine, err);
}

bool gb_runner_resume(struct gb_runner **out, const char *directory, struct gb_error *err)
{
    struct gb_params params;
    struct gb_runner *runner = NULL;
    if (!gb_follow_params(directory, &params, err) ||
        (gb_rundir_busy(directory) && !gb_follow_ask_to_stop(directory, err))) {
        return false;
    }
    runner = make(&params, directory, err);
    if (runner == NULL) {
        return false;
    }
    runner->resumed = true;
    return launch(out, runner, engine, err);
}

bool gb_runner_follow(struct gb_runner **out, const char *directory, struct gb_error *err)
{
    struct gb_params params;
    struct gb_runner *runner =
        gb_follow_params(directory, &params, err) ? make(&params, directory, err) : NULL;
    return runner != NULL && launch(out, runner, follow, err);
}

const char *gb_runner_directory(const struct gb_runner *runner)
{
    return runner->kept.directory;
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
    drop(runner);
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

const struct gb_view_sample *gb_runner_picture(struct gb_runner *runner, bool *changed)
{
    const bool fresh = gb_publish_turn_take(&runner->turn);
    if (changed != NULL) {
        *changed = fresh;
    }
    return &runner->picture[runner->turn.front];
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
