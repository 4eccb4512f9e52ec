#include <stdio.h>

#include <glib.h>

#include "base/alloc.h"
#include "cli/commands.h"
#include "cli/foreground.h"
#include "cli/options.h"
#include "io/preset.h"
#include "io/rundir.h"
#include "run/cost.h"

/* A packing that takes longer than this is announced before it is known to succeed. */
static const double patience_s = 2.0;
/* How long a dynamic run is watched before its cost is foretold. */
static const double warmup_s = 0.3;

struct run {
    char *directory;
    bool force, yes;
    struct gb_preset *preset;
    struct gb_model model;
    bool announced;
    struct gb_foreground pressing;
};

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
    gb_progress_say(&run->pressing.progress,
                    "%s: %" G_GINT64_FORMAT " particles, seed %" G_GUINT64_FORMAT,
                    params->title, params->count, params->seed);
    for (int k = 0; gb_model_note(&run->model, k, note, sizeof note) != NULL; k++) {
        gb_progress_say(&run->pressing.progress, "  %s", note);
    }
}

/* Polled while the packing grows. */
static bool packing_cancelled(void *data)
{
    struct run *run = data;
    if (!run->announced && gb_foreground_elapsed(&run->pressing) > patience_s) {
        announce(run);
        gb_progress_say(&run->pressing.progress, "  building the packing");
    }
    return *gb_foreground_caught() != 0;
}

/* Refuses what would take unexpectedly long, before there is a directory: a rate of
 * loading costs nothing to type. */
static bool foretell(struct run *run, char *line, size_t size, struct gb_error *err)
{
    const struct gb_params *params = params_of(run);
    struct gb_foreground *pressing = &run->pressing;
    struct gb_cost cost;
    line[0] = '\0';
    if (params->kind != GB_KIND_DYNAMIC) {
        return true;
    }
    gb_warmup_run(&pressing->warmup, pressing->experiment, warmup_s, pressing->packed,
                  gb_foreground_caught(), &pressing->stopped);
    const double rate = pressing->warmup.particle_steps_per_s;
    if (!gb_cost_estimate(params, rate > 0.0 ? rate : gb_cost_rate_assumed(params), &cost,
                          err)) {
        return false;
    }
    gb_cost_line(&cost, line, size);
    return run->yes || gb_warmup_ended(&pressing->warmup) || gb_cost_unasked(&cost, err);
}

static bool pack(struct run *run, struct gb_error *err)
{
    char foretold[320];
    struct gb_foreground *pressing = &run->pressing;
    gb_foreground_begin(pressing, 0.0);
    if (!gb_experiment_create(&pressing->experiment, params_of(run), packing_cancelled,
                              run, err)) {
        return false;
    }
    pressing->packed = gb_foreground_elapsed(pressing);
    if (!foretell(run, foretold, sizeof foretold, err) ||
        !gb_run_recorder_create(&pressing->keep, run->directory, params_of(run),
                                run->force, err)) {
        return false;
    }
    if (!run->announced) {
        announce(run);
    }
    gb_progress_say(&pressing->progress,
                    "  packing built in %.1f s, %.1f MB in arrays; "
                    "writing to %s",
                    pressing->packed, (double)gb_alloc_bytes() / 1e6, run->directory);
    if (foretold[0] != '\0') {
        gb_progress_say(&pressing->progress, "  %s", foretold);
    }
    return gb_foreground_open(pressing, err);
}

static int perform(struct run *run, char **words, char **sets)
{
    struct gb_error err = {0};
    if (!prepare(run, words, sets, &err) || !pack(run, &err)) {
        return gb_foreground_fail(&run->pressing, &err);
    }
    return gb_foreground_perform(&run->pressing);
}

/* The words with one more in front of them, which they own then. */
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
        "One run without a screen.  The results go to a directory; progress goes to "
        "stderr.",
        "SIGINT and SIGTERM stop the run in good order: `greenbody resume DIR` goes on "
        "from "
        "there as if it had never stopped.  When the terminal goes away, "
        "output.on_hangup "
        "says what becomes of the run."};
    struct run run = {0};
    char **sets = NULL;
    char *from = NULL;
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
        {"from", 0, 0, G_OPTION_ARG_FILENAME, &from,
         "the run that a picture or figure was made from, once more", "FILE.png"},
        {"yes", 'y', 0, G_OPTION_ARG_NONE, &yes,
         "begin a dynamic run also when it is foretold to take more than an hour", NULL},
        {"quiet", 'q', 0, G_OPTION_ARG_NONE, &quiet, "tell only what went wrong", NULL},
        {0}};
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        run.force = force;
        run.yes = yes;
        gb_progress_init(&run.pressing.progress, quiet);
        gb_foreground_catch_signals();
        if (from != NULL) {
            words = put_first(words, from);
            from = NULL;
        }
        status = perform(&run, words, sets);
    }
    g_free(from);
    gb_foreground_finish(&run.pressing);
    gb_preset_destroy(run.preset);
    g_free(run.directory);
    g_strfreev(words);
    g_strfreev(sets);
    return status;
}
