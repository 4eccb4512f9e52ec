#include "run/run_loop.h"

#include <string.h>

#include <glib.h>

#include "base/clock.h"

/* Age that status.json may reach while a run is under way, s. */
static const double status_every_s = 1.5;

void gb_run_loop_init(struct gb_run_loop *loop, const struct gb_run_loop_hooks *hooks)
{
    memset(loop, 0, sizeof *loop);
    loop->hooks = *hooks;
    loop->started_s = gb_clock_s();
    gb_cost_pace_init(&loop->pace);
}

void gb_run_loop_finish(struct gb_run_loop *loop)
{
    gb_run_recorder_destroy(loop->recorder);
    gb_experiment_destroy(loop->experiment);
    loop->recorder = NULL;
    loop->experiment = NULL;
}

double gb_run_loop_seconds(const struct gb_run_loop *loop)
{
    return gb_clock_s() - loop->started_s;
}

void gb_run_loop_set_seconds(struct gb_run_loop *loop, double seconds)
{
    loop->started_s = gb_clock_s() - seconds;
}

void gb_run_loop_exclude(struct gb_run_loop *loop, double seconds)
{
    loop->started_s += seconds;
}

void gb_run_loop_attach(struct gb_run_loop *loop, struct gb_experiment *experiment)
{
    loop->experiment = experiment;
    loop->packed_s = gb_run_loop_seconds(loop);
}

/* Handles the result of a write to the run directory. */
static void check_record(struct gb_run_loop *loop, bool good, const struct gb_error *err)
{
    const struct gb_run_loop_hooks *hooks = &loop->hooks;
    if (good) {
        return;
    }
    if (hooks->on_record_error != NULL && hooks->on_record_error(hooks->data, err)) {
        gb_run_recorder_destroy(loop->recorder);
        loop->recorder = NULL;
        return;
    }
    loop->error = *err;
    loop->record_failed = true;
}

static bool records(const struct gb_run_loop *loop)
{
    return loop->recorder != NULL && !loop->record_failed;
}

static double seconds_left(const struct gb_run_loop *loop, enum gb_run_state state)
{
    switch (state) {
    case GB_RUN_RUNNING:
    case GB_RUN_PAUSED:
        return gb_cost_pace_left(&loop->pace);
    case GB_RUN_DONE:
        return 0.0;
    default:
        return -1.0;
    }
}

static void observe_rate(struct gb_run_loop *loop)
{
    struct gb_snapshot *snapshot = &loop->snapshot;
    gb_cost_pace_add(&loop->pace, snapshot->seconds - loop->packed_s,
                     snapshot->evaluations,
                     snapshot->stage.stage != GB_STAGE_NONE ? snapshot->stage.timed
                                                            : snapshot->progress);
    snapshot->evaluations_per_s = gb_cost_pace_rate(&loop->pace);
    snapshot->particle_evaluations_per_s =
        snapshot->evaluations_per_s *
        (double)gb_experiment_params(loop->experiment)->count;
}

void gb_run_loop_observe(struct gb_run_loop *loop, enum gb_run_state state)
{
    struct gb_snapshot *snapshot = &loop->snapshot;
    if (loop->experiment != NULL) {
        gb_experiment_observe(loop->experiment, snapshot);
    }
    if (loop->recorder != NULL) {
        snapshot->events = gb_run_recorder_events(loop->recorder);
    }
    snapshot->state = state;
    snapshot->seconds = gb_run_loop_seconds(loop);
    if (snapshot->now_valid) {
        snapshot->now.seconds = snapshot->seconds;
    }
    if (loop->experiment != NULL && state != GB_RUN_PAUSED) {
        observe_rate(loop);
    }
    snapshot->seconds_left = seconds_left(loop, state);
}

static void publish_event(struct gb_run_loop *loop, int64_t step, const char *text)
{
    const struct gb_run_loop_hooks *hooks = &loop->hooks;
    struct gb_error err = {0};
    loop->snapshot.events++;
    g_strlcpy(loop->snapshot.event, text, sizeof loop->snapshot.event);
    if (records(loop)) {
        check_record(loop, gb_run_recorder_event(loop->recorder, step, text, &err), &err);
    }
    if (hooks->on_event != NULL) {
        hooks->on_event(hooks->data, step, text);
    }
}

/* What the recorder left out. */
static void take_missed(struct gb_run_loop *loop)
{
    char text[GB_EVENT_TEXT];
    while (records(loop) && gb_run_recorder_missed(loop->recorder, text, sizeof text)) {
        publish_event(loop, gb_experiment_point(loop->experiment)->step, text);
    }
}

void gb_run_loop_event(struct gb_run_loop *loop, const char *text)
{
    publish_event(loop, gb_experiment_point(loop->experiment)->step, text);
}

static void take_events(struct gb_run_loop *loop)
{
    int64_t step = 0;
    char text[GB_EVENT_TEXT];
    while (gb_experiment_event(loop->experiment, &step, text, sizeof text)) {
        publish_event(loop, step, text);
    }
}

static void write_status(struct gb_run_loop *loop)
{
    struct gb_error err = {0};
    loop->status_at_s = gb_run_loop_seconds(loop);
    if (records(loop)) {
        check_record(loop, gb_run_recorder_status(loop->recorder, &loop->snapshot, &err),
                     &err);
    }
}

static void write_checkpoint(struct gb_run_loop *loop, enum gb_run_recorder_when when)
{
    struct gb_error err = {0};
    if (records(loop)) {
        check_record(
            loop,
            gb_run_recorder_tick(loop->recorder, gb_run_loop_seconds(loop), when, &err),
            &err);
    }
}

void gb_run_loop_save(struct gb_run_loop *loop)
{
    write_checkpoint(loop, GB_RUN_RECORDER_NOW);
    write_status(loop);
}

void gb_run_loop_store(struct gb_run_loop *loop)
{
    struct gb_error err = {0};
    if (records(loop)) {
        check_record(
            loop, gb_run_recorder_save(loop->recorder, gb_run_loop_seconds(loop), &err),
            &err);
    }
}

void gb_run_loop_inherit(struct gb_run_loop *loop, const struct gb_curve *curve)
{
    const size_t points = gb_curve_count(curve);
    for (size_t i = 0; i < points && records(loop); i++) {
        const struct gb_point *point = gb_curve_at(curve, i);
        struct gb_error err = {0};
        check_record(loop,
                     i + 1 < points ? gb_run_recorder_row(loop->recorder, point, &err)
                                    : gb_run_recorder_point(
                                          loop->recorder, loop->experiment, point, &err),
                     &err);
    }
}

/* After the end it returns the end again. */
static enum gb_step_outcome slice(struct gb_run_loop *loop)
{
    if (loop->last == GB_STEP_DONE || loop->last == GB_STEP_STOPPED) {
        return loop->last;
    }
    const double from = gb_clock_s();
    loop->last = gb_experiment_advance(loop->experiment, gb_cost_pace_slice(&loop->pace),
                                       &loop->error);
    gb_cost_pace_sliced(&loop->pace, gb_clock_s() - from, loop->last == GB_STEP_MORE);
    if (loop->last != GB_STEP_STOPPED) {
        loop->error = (struct gb_error){0}; /* one from which a guard went on */
    }
    return loop->last;
}

static enum gb_run_outcome record_point(struct gb_run_loop *loop)
{
    const struct gb_run_loop_hooks *hooks = &loop->hooks;
    struct gb_point point = *gb_experiment_point(loop->experiment);
    struct gb_error err = {0};
    loop->points_left--;
    point.seconds = gb_run_loop_seconds(loop);
    if (records(loop)) {
        check_record(
            loop, gb_run_recorder_point(loop->recorder, loop->experiment, &point, &err),
            &err);
    }
    take_missed(loop);
    return hooks->on_point == NULL || hooks->on_point(hooks->data, &point, &loop->error)
               ? GB_RUN_OUTCOME_NONE
               : GB_RUN_OUTCOME_FAILED;
}

/* Guards leave results of use; other errors are failures. */
enum gb_run_outcome gb_run_loop_outcome(const struct gb_error *err)
{
    switch (err->code) {
    case GB_OK:
        return GB_RUN_OUTCOME_DONE;
    case GB_ERR_GUARD:
    case GB_ERR_NOT_CONVERGED:
        return GB_RUN_OUTCOME_STOPPED;
    case GB_ERR_CANCELLED:
        return GB_RUN_OUTCOME_CANCELLED;
    case GB_ERR_INPUT:
    case GB_ERR_MACHINE:
    case GB_ERR_MEMORY:
        break;
    }
    return GB_RUN_OUTCOME_FAILED;
}

enum gb_run_state gb_run_loop_state(enum gb_run_outcome outcome)
{
    switch (outcome) {
    case GB_RUN_OUTCOME_NONE:
        return GB_RUN_RUNNING;
    case GB_RUN_OUTCOME_DONE:
        return GB_RUN_DONE;
    case GB_RUN_OUTCOME_STOPPED:
    case GB_RUN_OUTCOME_CANCELLED:
        return GB_RUN_STOPPED;
    case GB_RUN_OUTCOME_FAILED:
        break;
    }
    return GB_RUN_FAILED;
}

static enum gb_run_outcome advance(struct gb_run_loop *loop)
{
    const enum gb_step_outcome how = slice(loop);
    take_events(loop);
    switch (how) {
    case GB_STEP_MORE:
        break;
    case GB_STEP_POINT:
        return record_point(loop);
    case GB_STEP_DONE:
        return GB_RUN_OUTCOME_DONE;
    case GB_STEP_STOPPED:
        return gb_run_loop_outcome(&loop->error);
    }
    return GB_RUN_OUTCOME_NONE;
}

static void tick(struct gb_run_loop *loop)
{
    const struct gb_run_loop_hooks *hooks = &loop->hooks;
    write_checkpoint(loop, GB_RUN_RECORDER_DUE);
    if (hooks->on_tick != NULL) {
        hooks->on_tick(hooks->data);
    }
    if (gb_run_loop_seconds(loop) - loop->status_at_s >= status_every_s) {
        gb_run_loop_observe(loop, GB_RUN_RUNNING);
        write_status(loop);
    }
}

static enum gb_run_outcome step(struct gb_run_loop *loop)
{
    const struct gb_run_loop_hooks *hooks = &loop->hooks;
    if (hooks->may_continue != NULL && !hooks->may_continue(hooks->data, &loop->error)) {
        return GB_RUN_OUTCOME_CANCELLED;
    }
    const enum gb_run_outcome outcome = advance(loop);
    if (outcome == GB_RUN_OUTCOME_NONE) {
        tick(loop);
    }
    return loop->record_failed ? GB_RUN_OUTCOME_FAILED : outcome;
}

enum gb_run_outcome gb_run_loop_fail(struct gb_run_loop *loop, const struct gb_error *err)
{
    loop->error = *err;
    loop->snapshot.state = GB_RUN_FAILED;
    loop->snapshot.error = *err;
    gb_run_recorder_fail(loop->recorder, &loop->snapshot);
    return GB_RUN_OUTCOME_FAILED;
}

/* The final snapshot.  What stopped the experiment has been an event already; a run that is
 * done tells what it has not reached. */
static void observe_end(struct gb_run_loop *loop, enum gb_run_outcome outcome)
{
    char missed[sizeof loop->error.text];
    if (outcome == GB_RUN_OUTCOME_DONE &&
        gb_experiment_missed(loop->experiment, missed, sizeof missed)) {
        (void)gb_error_set(&loop->error, GB_ERR_GUARD, "%s", missed);
        gb_run_loop_event(loop, missed);
    }
    if (outcome == GB_RUN_OUTCOME_CANCELLED ||
        (outcome == GB_RUN_OUTCOME_FAILED && !loop->record_failed &&
         loop->last != GB_STEP_STOPPED)) {
        gb_run_loop_event(loop, loop->error.text);
    }
    gb_run_loop_observe(loop,
                        loop->record_failed ? GB_RUN_FAILED : gb_run_loop_state(outcome));
    loop->snapshot.error = loop->error;
}

static enum gb_run_outcome conclude(struct gb_run_loop *loop, enum gb_run_outcome outcome)
{
    const struct gb_run_loop_hooks *hooks = &loop->hooks;
    struct gb_error err = {0};
    take_missed(loop);
    loop->begun = false;
    observe_end(loop, outcome);
    if (hooks->on_end != NULL) {
        hooks->on_end(hooks->data);
    }
    if (records(loop)) {
        check_record(
            loop, gb_run_recorder_conclude(loop->recorder, &loop->snapshot, &err), &err);
    }
    if (loop->record_failed) {
        err = loop->error;
        return gb_run_loop_fail(loop, &err);
    }
    return outcome;
}

static void begin(struct gb_run_loop *loop)
{
    loop->begun = true;
    if (loop->error.code == GB_ERR_CANCELLED) {
        loop->error = (struct gb_error){0};
        loop->snapshot.error = loop->error;
    }
    gb_run_loop_observe(loop, GB_RUN_RUNNING);
    write_status(loop);
}

enum gb_run_outcome gb_run_loop_advance(struct gb_run_loop *loop, int64_t points)
{
    enum gb_run_outcome outcome = GB_RUN_OUTCOME_NONE;
    if (!loop->begun) {
        begin(loop);
    }
    loop->points_left = points;
    while (outcome == GB_RUN_OUTCOME_NONE && loop->points_left > 0) {
        outcome = loop->record_failed ? GB_RUN_OUTCOME_FAILED : step(loop);
    }
    return outcome == GB_RUN_OUTCOME_NONE ? outcome : conclude(loop, outcome);
}

enum gb_run_outcome gb_run_loop_run(struct gb_run_loop *loop)
{
    return gb_run_loop_advance(loop, INT64_MAX);
}

void gb_run_loop_leave(struct gb_run_loop *loop)
{
    if (loop->begun) {
        gb_error_set(&loop->error, GB_ERR_CANCELLED, "left before its end");
        (void)conclude(loop, GB_RUN_OUTCOME_CANCELLED);
    }
}
