#include "cli/foreground.h"

#include <stdio.h>
#include <string.h>

#include <glib.h>

#include "base/clock.h"
#include "cli/options.h"
#include "run/experiment.h"

/* Others look at status.json at most this much later than it happened. */
static const double status_every_s = 1.5;

enum { EVENT_MAX = 640 };

/* Set by the handlers, looked at between slices. */
static volatile sig_atomic_t caught, hung;

static void on_signal(int number)
{
    caught = number;
}

static void on_hangup(int number)
{
    (void)number;
    hung = 1;
}

void gb_foreground_catch_signals(void)
{
    struct sigaction before;
    struct sigaction action = {.sa_handler = on_signal, .sa_flags = (int)SA_RESETHAND};
    const struct sigaction hangup = {.sa_handler = on_hangup, .sa_flags = SA_RESTART};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    sigaction(SIGHUP, NULL, &before);
    if (before.sa_handler != SIG_IGN) {
        sigaction(SIGHUP, &hangup, NULL);
    }
    /* a file that may not grow, or a reader of stderr that is gone, is an error of a
     * write */
    signal(SIGXFSZ, SIG_IGN);
    signal(SIGPIPE, SIG_IGN);
}

const volatile sig_atomic_t *gb_foreground_caught(void)
{
    return &caught;
}

void gb_foreground_begin(struct gb_foreground *run, double gone)
{
    run->started = gb_clock_s() - gone;
}

double gb_foreground_elapsed(const struct gb_foreground *run)
{
    return gb_clock_s() - run->started;
}

static const struct gb_params *params_of(const struct gb_foreground *run)
{
    return gb_run_recorder_params(run->keep);
}

static const char *directory_of(const struct gb_foreground *run)
{
    return gb_store_directory(gb_run_recorder_store(run->keep));
}

static void observe(struct gb_foreground *run, enum gb_run_state state)
{
    struct gb_snapshot *shot = &run->shot;
    const double progress = shot->progress;
    gb_experiment_observe(run->experiment, shot);
    if (state == GB_RUN_STOPPED) {
        shot->progress = progress;
    }
    shot->state = (int)state;
    shot->seconds = gb_foreground_elapsed(run);
    shot->events = gb_run_recorder_events(run->keep);
    gb_pace_add(&run->pace, shot->seconds - run->packed, shot->evaluations,
                shot->progress);
    shot->evaluations_per_s = gb_pace_rate(&run->pace);
    shot->particle_evaluations_per_s =
        shot->evaluations_per_s * (double)params_of(run)->count;
    shot->seconds_left = state == GB_RUN_RUNNING ? gb_pace_left(&run->pace) : -1.0;
    if (state == GB_RUN_DONE) {
        shot->seconds_left = 0.0;
    }
}

bool gb_foreground_open(struct gb_foreground *run, struct gb_error *err)
{
    gb_pace_init(&run->pace);
    observe(run, GB_RUN_RUNNING);
    run->status_at = gb_foreground_elapsed(run);
    return gb_store_status(gb_run_recorder_store(run->keep), &run->shot, err);
}

bool gb_foreground_event(struct gb_foreground *run, const char *text,
                         struct gb_error *err)
{
    g_strlcpy(run->shot.event, text, sizeof run->shot.event);
    gb_progress_say(&run->progress, "step %" G_GINT64_FORMAT ": %s", run->shot.now.step,
                    text);
    return gb_run_recorder_event(run->keep, run->shot.now.step, text, err);
}

static bool keep_events(struct gb_foreground *run, struct gb_error *err)
{
    char text[EVENT_MAX];
    while (gb_experiment_event(run->experiment, text, sizeof text)) {
        observe(run, GB_RUN_RUNNING); /* for the step */
        if (!gb_foreground_event(run, text, err)) {
            return false;
        }
    }
    return true;
}

/* What the warm-up recorded while there was no directory. */
static bool keep_warmup(struct gb_foreground *run, struct gb_error *err)
{
    const GArray *points = run->warmup.points;
    return points == NULL ||
           gb_run_recorder_adopt(run->keep, (const struct gb_point *)points->data,
                                 points->len, &run->warmup.record, err);
}

static bool keep_point(struct gb_foreground *run, struct gb_error *err)
{
    struct gb_point point = *gb_experiment_point(run->experiment);
    point.seconds = gb_foreground_elapsed(run);
    return gb_run_recorder_point(run->keep, run->experiment, &point, err);
}

/* The terminal is gone: what is told from now on stands in the directory only. */
static bool obey_hangup(struct gb_foreground *run, struct gb_error *err)
{
    hung = 0;
    if (params_of(run)->on_hangup == GB_ON_HANGUP_STOP) {
        caught = SIGHUP;
        return true;
    }
    run->progress.quiet = true;
    return gb_run_recorder_tick(run->keep, gb_foreground_elapsed(run), true, err) &&
           gb_foreground_event(run, "the terminal is gone; the run goes on", err);
}

/* Tells others and the terminal, when it is time. */
static bool report(struct gb_foreground *run, struct gb_error *err)
{
    const double now = gb_foreground_elapsed(run);
    const bool status = now - run->status_at >= status_every_s;
    const bool show = gb_progress_due(&run->progress, now);
    if (!status && !show) {
        return true;
    }
    observe(run, GB_RUN_RUNNING);
    if (show) {
        gb_progress_show(&run->progress, &run->shot);
    }
    if (status) {
        run->status_at = now;
        return gb_run_recorder_status(run->keep, &run->shot, err);
    }
    return true;
}

static enum gb_step_outcome advance(struct gb_foreground *run, int64_t evaluations)
{
    if (gb_warmup_ended(&run->warmup)) {
        return run->warmup.how;
    }
    const double from = gb_foreground_elapsed(run);
    const enum gb_step_outcome how =
        gb_experiment_advance(run->experiment, evaluations, &run->stopped);
    gb_pace_sliced(&run->pace, gb_foreground_elapsed(run) - from, how == GB_STEP_MORE);
    return how;
}

/* Presses to the end of the programme, a guard or a signal.  False only when the results
 * cannot be kept. */
static bool press(struct gb_foreground *run, enum gb_run_state *state,
                  struct gb_error *err)
{
    *state = GB_RUN_STOPPED;
    if (!keep_warmup(run, err)) {
        return false;
    }
    while (caught == 0) {
        const enum gb_step_outcome how = advance(run, gb_pace_slice(&run->pace));
        if (!keep_events(run, err) || (how == GB_STEP_POINT && !keep_point(run, err))) {
            return false;
        }
        if (how == GB_STEP_DONE || how == GB_STEP_STOPPED) {
            *state = how == GB_STEP_DONE ? GB_RUN_DONE : GB_RUN_STOPPED;
            return true;
        }
        if ((hung && !obey_hangup(run, err)) ||
            !gb_run_recorder_tick(run->keep, gb_foreground_elapsed(run), false, err) ||
            !report(run, err)) {
            return false;
        }
    }
    return true;
}

/* Last words in the run directory. */
static bool conclude(struct gb_foreground *run, enum gb_run_state state,
                     struct gb_error *err)
{
    if (caught != 0) {
        gb_error_set(&run->stopped, GB_ERR_CANCELLED, "stopped by signal %d (%s)",
                     (int)caught, strsignal((int)caught));
    }
    observe(run, state);
    run->shot.error = run->stopped;
    /* guards have put themselves among the events already */
    if (gb_status_exit_code(run->stopped.code) > 1 &&
        !gb_foreground_event(run, run->stopped.text, err)) {
        return false;
    }
    run->shot.events = gb_run_recorder_events(run->keep);
    return gb_run_recorder_conclude(run->keep, &run->shot, err);
}

static void summarise(struct gb_foreground *run, enum gb_run_state state)
{
    const struct gb_point *now = &run->shot.now;
    gb_progress_say(&run->progress,
                    "%s after %.1f s: density %.4f, p %.4g MPa, %" G_GINT64_FORMAT
                    " points in %s",
                    state == GB_RUN_DONE ? "done" : "stopped", gb_foreground_elapsed(run),
                    now->density, now->p_pa / 1e6, gb_run_recorder_points(run->keep),
                    directory_of(run));
}

static int exit_status(const struct gb_error *err)
{
    return err->code == GB_ERR_CANCELLED && caught != 0 ? 128 + (int)caught
                                                        : gb_status_exit_code(err->code);
}

int gb_foreground_fail(struct gb_foreground *run, const struct gb_error *err)
{
    run->shot.state = GB_RUN_FAILED;
    run->shot.error = *err;
    gb_run_recorder_fail(run->keep, &run->shot);
    gb_progress_clear(&run->progress);
    (void)gb_options_fail(err);
    return exit_status(err);
}

int gb_foreground_perform(struct gb_foreground *run)
{
    struct gb_error err = {0};
    enum gb_run_state state = GB_RUN_FAILED;
    if (!press(run, &state, &err) || !conclude(run, state, &err)) {
        return gb_foreground_fail(run, &err);
    }
    summarise(run, state);
    if (run->stopped.code != GB_OK && run->progress.quiet) {
        (void)gb_options_fail(&run->stopped);
    }
    return exit_status(&run->stopped);
}

void gb_foreground_finish(struct gb_foreground *run)
{
    gb_run_recorder_destroy(run->keep);
    gb_warmup_finish(&run->warmup);
    gb_experiment_destroy(run->experiment);
}
