#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include <glib.h>

#include "base/alloc.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/warmup.h"
#include "run/cost.h"
#include "run/experiment.h"
#include "run/pace.h"
#include "run/preset.h"
#include "run/rundir.h"
#include "run/store.h"

/* Others look at status.json at most this much later than it happened. */
static const double status_every_s = 1.5;
/* A packing that takes longer than this is announced before it is known to succeed. */
static const double patience_s = 2.0;
/* How long a dynamic run is watched before its cost is foretold. */
static const double warmup_s = 0.3;

enum { EVENT_MAX = 640 };

struct run {
    char *directory;
    bool force, yes;
    struct gb_preset *preset;
    struct gb_model model;
    struct gb_store *store;
    struct gb_experiment *experiment;
    struct gb_warmup warmup; /* of a dynamic run */
    struct gb_pace pace;
    struct gb_progress progress;
    struct gb_snapshot shot;
    struct gb_error stopped; /* by a guard: the run is kept */
    bool announced;
    double started, packed, status_at, state_at;
    int64_t points;
};

/* Set by the handler, looked at between slices. */
static volatile sig_atomic_t caught;

static void on_signal(int number)
{
    caught = number;
}

/* The first signal ends the run in good order, the second at once. */
static void install_handlers(void)
{
    struct sigaction action = {.sa_handler = on_signal, .sa_flags = (int)SA_RESETHAND};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    sigaction(SIGHUP, &action, NULL);
    /* a file that may not grow is an error of a write */
    signal(SIGXFSZ, SIG_IGN);
}

static double clock_s(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static double elapsed(const struct run *run)
{
    return clock_s() - run->started;
}

static const struct gb_params *params_of(const struct run *run)
{
    return gb_preset_params(run->preset);
}

/* Everything that can be known to be wrong before any work is done. */
static bool prepare(struct run *run, char **words, char **sets, struct gb_error *err)
{
    if (!gb_options_scene(&run->preset, words, sets, true, err)) {
        return false;
    }
    if (run->directory == NULL) {
        run->directory = gb_store_default_directory(gb_preset_path(run->preset));
    }
    return gb_model_init(&run->model, params_of(run), err) &&
           gb_rundir_check(run->directory, run->force, err);
}

static void announce(struct run *run)
{
    char note[256];
    const struct gb_params *params = params_of(run);
    run->announced = true;
    gb_progress_say(&run->progress,
                    "%s: %" G_GINT64_FORMAT " particles, seed %" G_GUINT64_FORMAT,
                    params->title, params->count, params->seed);
    for (int k = 0; gb_model_note(&run->model, k, note, sizeof note) != NULL; k++) {
        gb_progress_say(&run->progress, "  %s", note);
    }
}

/* Polled while the packing grows. */
static bool packing_cancelled(void *data)
{
    struct run *run = data;
    if (!run->announced && elapsed(run) > patience_s) {
        announce(run);
        gb_progress_say(&run->progress, "  building the packing");
    }
    return caught != 0;
}

static void observe(struct run *run, enum gb_run_state state)
{
    struct gb_snapshot *shot = &run->shot;
    const double progress = shot->progress;
    gb_experiment_observe(run->experiment, shot);
    if (state == GB_RUN_STOPPED) {
        shot->progress = progress;
    }
    shot->state = (int)state;
    shot->seconds = elapsed(run);
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

static bool keep_event(struct run *run, const char *text, struct gb_error *err)
{
    run->shot.events++;
    g_strlcpy(run->shot.event, text, sizeof run->shot.event);
    gb_progress_say(&run->progress, "step %" G_GINT64_FORMAT ": %s", run->shot.now.step,
                    text);
    return gb_store_event(run->store, run->shot.now.step, text, err);
}

static bool keep_events(struct run *run, struct gb_error *err)
{
    char text[EVENT_MAX];
    while (gb_experiment_event(run->experiment, text, sizeof text)) {
        observe(run, GB_RUN_RUNNING); /* for the step */
        if (!keep_event(run, text, err)) {
            return false;
        }
    }
    return true;
}

/* What the warm-up recorded while there was no directory. */
static bool keep_warmup(struct run *run, struct gb_error *err)
{
    const GArray *points = run->warmup.points;
    for (guint i = 0; points != NULL && i < points->len; i++) {
        run->points++;
        if (!gb_store_point(run->store, &g_array_index(points, struct gb_point, i),
                            err)) {
            return false;
        }
    }
    return true;
}

static bool keep_point(struct run *run, struct gb_error *err)
{
    struct gb_point point = *gb_experiment_point(run->experiment);
    point.seconds = elapsed(run);
    run->points++;
    return gb_store_point(run->store, &point, err);
}

static bool keep_state(struct run *run, struct gb_error *err)
{
    struct gb_state *state = NULL;
    run->state_at = elapsed(run);
    const bool kept = gb_experiment_state(run->experiment, &state, err) &&
                      gb_store_state(run->store, state, err);
    gb_state_destroy(state);
    return kept;
}

static bool state_due(const struct run *run)
{
    return caught != 0 ||
           elapsed(run) - run->state_at >= params_of(run)->checkpoint_every_s;
}

/* Tells others and the terminal, when it is time. */
static bool report(struct run *run, struct gb_error *err)
{
    const double now = elapsed(run);
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
        return gb_store_status(run->store, &run->shot, err);
    }
    return true;
}

/* Refuses what would take unexpectedly long, before there is a directory: a rate of
 * loading costs nothing to type. */
static bool foretell(struct run *run, char *line, size_t size, struct gb_error *err)
{
    const struct gb_params *params = params_of(run);
    struct gb_cost cost;
    line[0] = '\0';
    if (params->kind != GB_KIND_DYNAMIC) {
        return true;
    }
    gb_warmup_run(&run->warmup, run->experiment, warmup_s, run->packed, &caught,
                  &run->stopped);
    const double rate = run->warmup.particle_steps_per_s;
    if (!gb_cost_estimate(params, rate > 0.0 ? rate : gb_cost_rate_assumed(params), &cost,
                          err)) {
        return false;
    }
    gb_cost_line(&cost, line, size);
    return run->yes || gb_warmup_ended(&run->warmup) || gb_cost_unasked(&cost, err);
}

static bool pack(struct run *run, struct gb_error *err)
{
    char foretold[320];
    run->started = clock_s();
    if (!gb_experiment_create(&run->experiment, params_of(run), packing_cancelled, run,
                              err)) {
        return false;
    }
    run->packed = elapsed(run);
    if (!foretell(run, foretold, sizeof foretold, err) ||
        !gb_store_create(&run->store, run->directory, params_of(run), run->force, err)) {
        return false;
    }
    if (!run->announced) {
        announce(run);
    }
    gb_progress_say(&run->progress,
                    "  packing built in %.1f s, %.1f MB in arrays; "
                    "writing to %s",
                    run->packed, (double)gb_alloc_bytes() / 1e6, run->directory);
    if (foretold[0] != '\0') {
        gb_progress_say(&run->progress, "  %s", foretold);
    }
    gb_pace_init(&run->pace);
    observe(run, GB_RUN_RUNNING);
    run->status_at = elapsed(run);
    return gb_store_status(run->store, &run->shot, err);
}

static enum gb_advance advance(struct run *run, int64_t evaluations)
{
    if (gb_warmup_ended(&run->warmup)) {
        return run->warmup.how;
    }
    const double from = elapsed(run);
    const enum gb_advance how =
        gb_experiment_advance(run->experiment, evaluations, &run->stopped);
    gb_pace_sliced(&run->pace, elapsed(run) - from, how == GB_ADVANCE_MORE);
    return how;
}

/* Presses to the end of the programme, a guard or a signal.  False only when the results
 * cannot be kept. */
static bool press(struct run *run, enum gb_run_state *state, struct gb_error *err)
{
    *state = GB_RUN_STOPPED;
    if (!keep_warmup(run, err)) {
        return false;
    }
    while (caught == 0) {
        const enum gb_advance how = advance(run, gb_pace_slice(&run->pace));
        if (!keep_events(run, err) ||
            (how == GB_ADVANCE_POINT && !keep_point(run, err))) {
            return false;
        }
        if (how == GB_ADVANCE_DONE || how == GB_ADVANCE_STOPPED) {
            *state = how == GB_ADVANCE_DONE ? GB_RUN_DONE : GB_RUN_STOPPED;
            return true;
        }
        if ((state_due(run) && !keep_state(run, err)) || !report(run, err)) {
            return false;
        }
    }
    return true;
}

/* Last words in the run directory. */
static bool conclude(struct run *run, enum gb_run_state state, struct gb_error *err)
{
    if (caught != 0) {
        gb_error_set(&run->stopped, GB_ERR_CANCELLED, "stopped by signal %d (%s)",
                     (int)caught, strsignal((int)caught));
    }
    observe(run, state);
    run->shot.error = run->stopped;
    /* guards have put themselves among the events already */
    if (gb_status_exit_code(run->stopped.code) > 1 &&
        !keep_event(run, run->stopped.text, err)) {
        return false;
    }
    return keep_state(run, err) && gb_store_sync(run->store, err) &&
           gb_store_status(run->store, &run->shot, err);
}

static void summarise(struct run *run, enum gb_run_state state)
{
    const struct gb_point *now = &run->shot.now;
    gb_progress_say(&run->progress,
                    "%s after %.1f s: density %.4f, p %.4g MPa, %" G_GINT64_FORMAT
                    " points in %s",
                    state == GB_RUN_DONE ? "done" : "stopped", elapsed(run), now->density,
                    now->p_pa / 1e6, run->points, run->directory);
}

static int exit_status(const struct gb_error *err)
{
    return err->code == GB_ERR_CANCELLED && caught != 0 ? 128 + (int)caught
                                                        : gb_status_exit_code(err->code);
}

/* The run cannot go on keeping its results: say so where it can still be said. */
static void give_up(struct run *run, const struct gb_error *err)
{
    if (run->store != NULL) {
        run->shot.state = GB_RUN_FAILED;
        run->shot.error = *err;
        (void)gb_store_sync(run->store, NULL);
        (void)gb_store_status(run->store, &run->shot, NULL);
    }
}

static int perform(struct run *run, char **words, char **sets)
{
    struct gb_error err = {0};
    enum gb_run_state state = GB_RUN_FAILED;
    if (!prepare(run, words, sets, &err) || !pack(run, &err) ||
        !press(run, &state, &err) || !conclude(run, state, &err)) {
        give_up(run, &err);
        gb_progress_clear(&run->progress);
        (void)gb_options_fail(&err);
        return exit_status(&err);
    }
    summarise(run, state);
    if (run->stopped.code != GB_OK && run->progress.quiet) {
        (void)gb_options_fail(&run->stopped);
    }
    return exit_status(&run->stopped);
}

int gb_cmd_run(int argc, char **argv)
{
    static const struct gb_options_page page = {
        "PRESET [group.key=value]...",
        "One run without a screen.  The results go to a directory; progress goes to "
        "stderr.",
        "SIGINT and SIGTERM stop the run in good order: points and state are kept."};
    struct run run = {0};
    char **sets = NULL;
    char **words = NULL;
    gboolean force = FALSE;
    gboolean quiet = FALSE;
    gboolean yes = FALSE;
    int status = 0;
    const GOptionEntry entries[] = {
        GB_OPTIONS_SET(&sets),
        {"out", 'o', 0, G_OPTION_ARG_FILENAME, &run.directory,
         "directory of the results (default: runs/PRESET-1, -2, ...)", "DIR"},
        {"force", 'f', 0, G_OPTION_ARG_NONE, &force, "replace an old run in DIR", NULL},
        {"yes", 'y', 0, G_OPTION_ARG_NONE, &yes,
         "begin a dynamic run also when it is foretold to take more than an hour", NULL},
        {"quiet", 'q', 0, G_OPTION_ARG_NONE, &quiet, "tell only what went wrong", NULL},
        {0}};
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        run.force = force;
        run.yes = yes;
        gb_progress_init(&run.progress, quiet);
        install_handlers();
        status = perform(&run, words, sets);
    }
    gb_store_destroy(run.store);
    gb_warmup_finish(&run.warmup);
    gb_experiment_destroy(run.experiment);
    gb_preset_destroy(run.preset);
    g_free(run.directory);
    g_strfreev(words);
    g_strfreev(sets);
    return status;
}
