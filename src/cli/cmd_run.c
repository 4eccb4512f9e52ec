#include <glib.h>
#include <stdio.h>
#include <string.h>

#include "api/simulation_private.h"
#include "base/alloc.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "io/preset.h"
#include "run/cost.h"
#include "scene/loading_kind.h"

/* A run without the screen: a simulation (greenbody/simulation.h) with signal handling,
 * progress on stderr and the exit status of the command. */
struct foreground {
    struct gb_simulation *simulation; /* owned; NULL before foreground_attach */
    struct gb_progress progress;
    bool json; /* print the result as JSON on stdout */
    /* Called while the packing is built; NULL: none. */
    void (*on_packing)(void *data);
    void *data;
    char stopped[64]; /* text about the signal that ends the run */
};

/* --- callbacks of the simulation --------------------------------------------------- */

/* After a hang-up, messages go only to the run directory. */
static void handle_hangup(struct foreground *run)
{
    struct gb_run_loop *loop = &run->simulation->loop;
    if (gb_experiment_params(loop->experiment)->on_hangup == GB_ON_HANGUP_STOP) {
        gb_progress_stop_by_hangup();
        return;
    }
    run->progress.quiet = true;
    gb_run_loop_save(loop);
    gb_run_loop_event(loop, "terminal closed; the run continues");
}

static void handle_signals(struct foreground *run)
{
    if (run->simulation->loop.recorder != NULL && gb_progress_take_hangup()) {
        handle_hangup(run);
    }
    const int signal = gb_progress_caught();
    if (signal != 0) {
        g_snprintf(run->stopped, sizeof run->stopped, "stopped by signal %d (%s)", signal,
                   strsignal(signal));
        gb_simulation_cancel(run->simulation, run->stopped);
    }
}

static void on_event(void *data, struct gb_simulation *simulation, int64_t step,
                     const char *text)
{
    struct foreground *run = data;
    (void)simulation;
    gb_progress_say(&run->progress, "step %" G_GINT64_FORMAT ": %s", step, text);
}

static void on_progress(void *data, struct gb_simulation *simulation, double share)
{
    struct foreground *run = data;
    struct gb_run_loop *loop = &simulation->loop;
    (void)share;
    handle_signals(run);
    if (loop->experiment == NULL) {
        if (run->on_packing != NULL) {
            run->on_packing(run->data);
        }
    } else if (gb_progress_due(&run->progress, gb_run_loop_seconds(loop))) {
        gb_run_loop_observe(loop, GB_RUN_RUNNING);
        gb_progress_show(&run->progress, &loop->snapshot);
    }
}

/* --------------------------------------------------------------------------------- */

/* Installs the signal handlers (cli/progress.h). output.on_hangup defines the effect of
 * HUP. */
static void foreground_init(struct foreground *run, bool quiet)
{
    gb_progress_init(&run->progress, quiet);
    gb_progress_catch_signals(GB_SIGNALS_HANGUP_NOTED);
}

/* Transfers the ownership of the simulation. */
static void foreground_attach(struct foreground *run, struct gb_simulation *simulation)
{
    run->simulation = simulation;
    gb_simulation_on_event(simulation, on_event, run);
    gb_simulation_on_progress(simulation, on_progress, run, 0.0);
}

static void foreground_finish(struct foreground *run)
{
    gb_simulation_destroy(run->simulation);
    run->simulation = NULL;
}

static int fail(struct foreground *run, const struct gb_error *err)
{
    gb_progress_clear(&run->progress);
    (void)gb_options_fail(err);
    return gb_progress_exit_status(err);
}

/* Handles an error before the run begins: prints it, writes it to the status if there
 * is a directory, and returns the exit status. */
static int foreground_fail(struct foreground *run, const struct gb_error *err)
{
    if (run->simulation != NULL) {
        (void)gb_run_loop_fail(&run->simulation->loop, err);
    }
    return fail(run, err);
}

static void summarise(struct foreground *run, enum gb_run_outcome outcome)
{
    const struct gb_run_loop *loop = &run->simulation->loop;
    char where[GB_PROGRESS_POINT];
    gb_progress_point(where, &loop->snapshot.now, ", ");
    gb_progress_say(&run->progress,
                    "%s after %.1f s: %s, %" G_GINT64_FORMAT " points in %s",
                    outcome == GB_RUN_OUTCOME_DONE ? "done" : "stopped",
                    loop->snapshot.seconds, where, gb_run_recorder_points(loop->recorder),
                    gb_store_directory(gb_run_recorder_store(loop->recorder)));
}

/* Runs to the end and returns the exit status.  Prints errors. */
static int foreground_run(struct foreground *run)
{
    struct gb_error error = {0};
    const enum gb_run_outcome outcome =
        gb_simulation_advance(run->simulation, INT64_MAX, &error);
    /* the packing was built only if there is a recorder */
    if (outcome == GB_RUN_OUTCOME_FAILED || run->simulation->loop.recorder == NULL ||
        run->simulation->loop.experiment == NULL) {
        return fail(run, &error);
    }
    summarise(run, outcome);
    if (run->json) {
        gb_options_json_run(&run->simulation->loop);
    }
    if (error.code != GB_OK && run->progress.quiet) {
        (void)gb_options_fail(&error);
    }
    return gb_progress_exit_status(&error);
}

static int cmd_resume_perform(struct foreground *run, const char *directory, bool before)
{
    struct gb_simulation *simulation = NULL;
    struct gb_error err = {0};
    const bool good = before ? gb_simulation_resume_before(&simulation, directory, &err)
                             : gb_simulation_resume(&simulation, directory, &err);
    if (!good) {
        return foreground_fail(run, &err);
    }
    foreground_attach(run, simulation);
    if (simulation->loop.experiment == NULL) { /* no checkpoint yet */
        gb_progress_say(&run->progress,
                        "there is no checkpoint yet: the run starts again");
    }
    return foreground_run(run);
}

int gb_cmd_resume(int argc, char **argv)
{
    static const struct gb_options_page page = {
        "DIR",
        "Continues an interrupted run from its last checkpoint, bit-identical to a run\n"
        "without the interruption.",
        "Rows of curve.csv after the checkpoint are computed again.  preset.ini may\n"
        "have changed in [output], title and threads only."};
    struct foreground run = {0};
    char **words = NULL;
    gboolean quiet = FALSE, before = FALSE, json = FALSE;
    int status = 0;
    const GOptionEntry entries[] = {
        {"before", 0, 0, G_OPTION_ARG_NONE, &before,
         "from state-before.h5, where the last checkpoint is damaged", NULL},
        gb_options_json(&json),
        gb_options_quiet(&quiet),
        {0}};
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        struct gb_error err = {0};
        const char *directory = gb_options_directory(words, "resume", &err);
        if (directory == NULL) {
            status = gb_options_fail(&err);
        } else {
            foreground_init(&run, quiet);
            run.json = json;
            status = cmd_resume_perform(&run, directory, before);
        }
    }
    foreground_finish(&run);
    g_strfreev(words);
    return status;
}

/* A packing that takes longer than this (s) is announced before it is built. */
static const double patience_s = 2.0;
/* Time (s) for which a copy of a dynamic run is computed to estimate the cost. */
static const double copy_s = 0.3;

struct run {
    char *directory;
    bool replace, yes;
    struct gb_preset *preset;
    struct gb_model model;
    bool announced;
    struct foreground foreground;
};

static const struct gb_params *params_of(const struct run *run)
{
    return gb_preset_params(run->preset);
}

static struct gb_run_loop *loop_of(const struct run *run)
{
    return &run->foreground.simulation->loop;
}

static void on_packing(void *data);

/* Makes all checks that are possible before any work. */
static bool prepare(struct run *run, char **words, char **sets, struct gb_error *err)
{
    struct gb_simulation *simulation = NULL;
    if (!gb_options_scene(&run->preset, words, sets, GB_OPTIONS_PRESET_NEEDED, err)) {
        return false;
    }
    if (run->directory == NULL) {
        run->directory = gb_store_default_directory(gb_preset_path(run->preset));
    }
    if (!gb_model_init(&run->model, params_of(run), err) ||
        !gb_simulation_create_from(&simulation, params_of(run), err)) {
        return false;
    }
    run->foreground.on_packing = on_packing;
    run->foreground.data = run;
    foreground_attach(&run->foreground, simulation);
    return gb_simulation_record(simulation, run->directory, run->replace, err);
}

static void announce(struct run *run)
{
    char note[256];
    const struct gb_params *params = params_of(run);
    run->announced = true;
    gb_progress_say(&run->foreground.progress,
                    "%s: %" G_GINT64_FORMAT " particles, seed %" G_GUINT64_FORMAT,
                    params->title, params->count, params->seed);
    for (int k = 0; gb_model_note(&run->model, k, note, sizeof note) != NULL; k++) {
        gb_progress_say(&run->foreground.progress, "  %s", note);
    }
}

/* Called while the packing is built. */
static void on_packing(void *data)
{
    struct run *run = data;
    if (!run->announced && gb_run_loop_seconds(loop_of(run)) > patience_s) {
        announce(run);
        gb_progress_say(&run->foreground.progress, "  building the packing");
    }
}

/* Writes the estimated cost of a dynamic run to the line.  Without --yes a run that
 * takes longer than an hour is refused before its directory is created. */
static bool estimate(struct run *run, char *line, size_t size, struct gb_error *err)
{
    const struct gb_params *params = params_of(run);
    struct gb_run_loop *loop = loop_of(run);
    struct gb_cost cost;
    line[0] = '\0';
    if (!gb_loading_kind_of(params)->given_rate) {
        return true;
    }
    double rate = 0.0;
    bool ended = false;
    const double from = gb_run_loop_seconds(loop);
    if (!gb_cost_rate_try(loop->experiment, copy_s, &rate, &ended, err) ||
        !gb_cost_estimate(params, rate > 0.0 ? rate : gb_cost_rate_assumed(params), &cost,
                          err)) {
        return false;
    }
    gb_run_loop_exclude(loop, gb_run_loop_seconds(loop) - from);
    gb_cost_line(&cost, line, size);
    return run->yes || ended || gb_cost_check_limit(&cost, err);
}

static bool start_record(struct run *run, struct gb_error *err)
{
    return gb_simulation_start_record(run->foreground.simulation, run->directory,
                                      run->replace ? GB_RUNDIR_REPLACE : GB_RUNDIR_KEEP,
                                      err);
}

static bool begin(struct run *run, struct gb_error *err)
{
    char cost[320];
    struct foreground *foreground = &run->foreground;
    if (!gb_simulation_build(foreground->simulation, err) ||
        !estimate(run, cost, sizeof cost, err) || !start_record(run, err)) {
        return false;
    }
    if (!run->announced) {
        announce(run);
    }
    gb_progress_say(&foreground->progress,
                    "  packing built in %.1f s, %.1f MB in arrays; writing to %s",
                    loop_of(run)->packed_s, (double)gb_alloc_bytes() / 1e6,
                    run->directory);
    if (cost[0] != '\0') {
        gb_progress_say(&foreground->progress, "  %s", cost);
    }
    return true;
}

static int perform(struct run *run, char **words, char **sets)
{
    struct gb_error err = {0};
    if (!prepare(run, words, sets, &err) || !begin(run, &err)) {
        return foreground_fail(&run->foreground, &err);
    }
    return foreground_run(&run->foreground);
}

/* Inserts a copy of the words after `word`; owned. */
static char **put_first(char **words, char *word)
{
    const guint count = g_strv_length(words);
    char **longer = g_new0(char *, count + 2);
    longer[0] = word;
    memcpy(longer + 1, words, count * sizeof *words);
    g_free(words);
    return longer;
}

int gb_cmd_run(int argc, char **argv)
{
    static const struct gb_options_page page = {
        "PRESET [group.key=value]...",
        "One run without a screen.  Results go to a directory, progress to stderr.",
        "Ctrl-C (SIGINT) and SIGTERM stop the run with a checkpoint: `greenbody resume DIR`\n"
        "continues it, bit-identical to a run without the interruption.  When the\n"
        "terminal is closed, output.on_hangup decides whether the run continues.\n"
        "material=NAME among the keys sets all keys of [material]; greenbody params\n"
        "--materials lists the names."};
    struct run run = {0};
    char **sets = NULL;
    char *from = NULL;
    char **words = NULL;
    gboolean force = FALSE;
    gboolean quiet = FALSE;
    gboolean yes = FALSE;
    gboolean json = FALSE;
    int status = 0;
    const GOptionEntry entries[] = {
        gb_options_set(&sets),
        {"out", 'o', 0, G_OPTION_ARG_FILENAME, &run.directory,
         "directory of the results (default: runs/PRESET-1, -2, ...)", "DIR"},
        {"force", 'f', 0, G_OPTION_ARG_NONE, &force, "replace an old run in DIR", NULL},
        {"from", 0, 0, G_OPTION_ARG_FILENAME, &from,
         "repeat the run whose preset a picture or figure contains", "FILE.png"},
        {"yes", 'y', 0, G_OPTION_ARG_NONE, &yes,
         "begin a dynamic run estimated to take more than an hour", NULL},
        gb_options_json(&json),
        gb_options_quiet(&quiet),
        {0}};
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        run.replace = force;
        run.yes = yes;
        foreground_init(&run.foreground, quiet);
        run.foreground.json = json;
        if (from != NULL) {
            words = put_first(words, from);
            from = NULL;
        }
        status = perform(&run, words, sets);
    }
    g_free(from);
    foreground_finish(&run.foreground);
    gb_preset_destroy(run.preset);
    g_free(run.directory);
    g_strfreev(words);
    g_strfreev(sets);
    return status;
}
