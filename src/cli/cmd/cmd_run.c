#include <stdio.h>

#include <glib.h>

#include "base/alloc.h"
#include "cli/commands.h"
#include "cli/foreground.h"
#include "cli/options.h"
#include "io/preset.h"
#include "run/cost.h"
#include "scene/loading_kind.h"

/* A packing that takes longer than this (s) is announced before it is built. */
static const double patience_s = 2.0;
/* Seconds that a copy of a dynamic run is timed for the estimate of its cost. */
static const double copy_s = 0.3;

struct run {
    char *directory;
    bool replace, yes;
    struct gb_preset *preset;
    struct gb_model model;
    bool announced;
    struct gb_foreground foreground;
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

/* All checks that are possible before any work. */
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
    gb_foreground_attach(&run->foreground, simulation);
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

/* While the packing is built. */
static void on_packing(void *data)
{
    struct run *run = data;
    if (!run->announced && gb_run_loop_seconds(loop_of(run)) > patience_s) {
        announce(run);
        gb_progress_say(&run->foreground.progress, "  building the packing");
    }
}

/* Fills the line with the estimated cost of a dynamic run.  Refuses one that takes longer
 * than an hour without --yes, before its directory is created. */
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
    struct gb_foreground *foreground = &run->foreground;
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
        return gb_foreground_fail(&run->foreground, &err);
    }
    return gb_foreground_run(&run->foreground);
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
        gb_foreground_init(&run.foreground, quiet);
        run.foreground.json = json;
        if (from != NULL) {
            words = put_first(words, from);
            from = NULL;
        }
        status = perform(&run, words, sets);
    }
    g_free(from);
    gb_foreground_finish(&run.foreground);
    gb_preset_destroy(run.preset);
    g_free(run.directory);
    g_strfreev(words);
    g_strfreev(sets);
    return status;
}
