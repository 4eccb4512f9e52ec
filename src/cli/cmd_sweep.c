/* `greenbody sweep`: runs of a preset over a grid or a design of parameters, with
 * replicas (many/param_sweep.h).  The command checks and estimates the sweep, computes
 * the runs of its part, and writes the tables when all runs are known.  Several
 * processes may share a sweep. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <glib.h>

#include "base/visible.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "many/param_sweep.h"
#include "run/cost.h"
#include "study/sensitivity.h"

enum { REPLICAS_MAX = 100000 };

/* Characters that need no quotes in a shell. */
static const char plain_signs[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                  "0123456789_./:=,@%+-";

/* The options of the command line. */
struct request {
    char **sets, **vary;
    char *out, *at, *target, *design, *part;
    gint replicas, jobs;
    gboolean quiet, yes, tasks, collect;
    int argc; /* the words as typed, for --tasks */
    char **argv;
};

struct command {
    const struct request *request;
    struct gb_preset *preset;
    struct gb_param_sweep sweep;
    struct gb_batch_progress batch;
    char estimate[160]; /* line for stderr; empty without an estimate */
};

static bool check_request(const struct request *request, struct gb_error *err)
{
    if (request->out == NULL || request->out[0] == '\0') {
        return gb_error_set(err, GB_ERR_INPUT, "sweep needs --out DIR");
    }
    if (request->tasks + request->collect + (request->part != NULL) > 1) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--tasks, --part and --collect: expected one of them");
    }
    if ((request->tasks || request->part != NULL) && request->target != NULL) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%s: expected without --until-se, which decides during the "
                            "sweep how many replicas it needs",
                            request->tasks ? "--tasks" : "--part");
    }
    return (request->replicas >= 1 && request->replicas <= REPLICAS_MAX) ||
           gb_error_set(err, GB_ERR_INPUT, "--replicas %d: must be between 1 and %d",
                        request->replicas, REPLICAS_MAX);
}

/* Reads "3/8" as part 2 of 8, counted from 0. */
static bool set_part(struct command *command, struct gb_error *err)
{
    const char *text = command->request->part;
    unsigned long part = 0, parts = 0;
    char rest = '\0';
    if (text == NULL) {
        return true;
    }
    if (strspn(text, "0123456789/") != strlen(text) || strlen(text) > 20 ||
        sscanf(text, "%lu/%lu%c", &part, &parts, &rest) != 2 || part < 1 ||
        part > parts) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--part %.80s: expected I/N with I from 1 to N, as in 3/8",
                            text);
    }
    command->sweep.ensemble.part = part - 1;
    command->sweep.ensemble.parts = parts;
    return true;
}

static bool add_axes(struct command *command, struct gb_error *err)
{
    char **vary = command->request->vary;
    const char *design = command->request->design;
    if (design != NULL && vary == NULL) {
        return gb_error_set(err, GB_ERR_INPUT, "--design %.80s needs --vary KEY=FROM:TO",
                            design);
    }
    if (design != NULL && !gb_param_sweep_design(&command->sweep.axes, design, err)) {
        return false;
    }
    for (size_t i = 0; vary != NULL && vary[i] != NULL; i++) {
        if (!gb_param_sweep_add_axis(&command->sweep.axes, vary[i], err)) {
            return false;
        }
    }
    return true;
}

/* Without --yes refuses a sweep that is estimated to take longer than an hour, unless a
 * launcher started it. */
static bool estimate(struct command *command, struct gb_error *err)
{
    const struct request *request = command->request;
    size_t runs = 0;
    char total[48], each[48];
    const double all_s = gb_ensemble_remaining_s(&command->sweep.ensemble, &runs);
    const size_t workers = gb_progress_all_workers(&command->batch, request->jobs);
    const double wait_s = all_s / (double)MAX(MIN(workers, runs), 1);
    if (runs == 0 || isnan(all_s) || command->batch.launch.launched || request->tasks ||
        request->collect || request->part != NULL) {
        return true;
    }
    gb_cost_duration(wait_s, total, sizeof total);
    gb_cost_duration(all_s / (double)runs, each, sizeof each);
    if (!request->yes && !gb_cost_within_limit(wait_s)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "the sweep will take about %s: %zu runs of about %s, %zu at "
                            "once; repeat with --yes to start it",
                            total, runs, each, workers);
    }
    g_snprintf(command->estimate, sizeof command->estimate,
               "estimated: about %s, %zu runs of about %s", total, runs, each);
    return true;
}

/* Makes all checks that are possible before anything is written. */
static bool prepare(struct command *command, char **words, struct gb_error *err)
{
    const struct request *request = command->request;
    struct gb_param_sweep *sweep = &command->sweep;
    if (!check_request(request, err) ||
        !gb_options_scene(&command->preset, words, request->sets,
                          GB_OPTIONS_PRESET_NEEDED, err) ||
        !add_axes(command, err) ||
        (request->design != NULL && !gb_sensitivity_check(&sweep->axes, err))) {
        return false;
    }
    const struct gb_params *params = gb_preset_params(command->preset);
    gb_param_sweep_default_pressures(&sweep->at, params);
    return (!request->at || gb_param_sweep_pressures(&sweep->at, request->at, err)) &&
           (!request->target ||
            gb_param_sweep_target(&sweep->target, request->target, err)) &&
           gb_param_sweep_fill(sweep, params, (size_t)request->replicas, request->out,
                               err) &&
           set_part(command, err) && estimate(command, err) &&
           (request->tasks || gb_ensemble_make_directory(request->out, err));
}

/* Writes sensitivity.csv of a design and prints the sensitivities of the last
 * densities. */
static bool write_sensitivities(struct command *command, struct gb_error *err)
{
    struct gb_sensitivity sensitivity = {0};
    bool good = gb_sensitivity_init(&sensitivity, &command->sweep, err);
    if (good) {
        GString *text = gb_sensitivity_lines(&sensitivity, &command->sweep);
        good =
            gb_param_sweep_put(command->request->out, "sensitivity.csv",
                               gb_sensitivity_table(&sensitivity, &command->sweep), err);
        gb_visible_put(stdout, text->str);
        g_string_free(text, TRUE);
    }
    gb_sensitivity_finish(&sensitivity);
    return good;
}

static void print_missed(const struct command *command)
{
    const struct gb_param_sweep *sweep = &command->sweep;
    const size_t shortfalls = gb_param_sweep_shortfalls(&sweep->ensemble);
    if (shortfalls > 0 && !command->request->quiet) {
        gb_visible_line(stderr,
                        "runs that missed a goal or have points that are not in "
                        "equilibrium: %zu (%s/runs.csv)",
                        shortfalls, command->request->out);
    }
    const size_t missed = gb_param_sweep_missed(&sweep->target, &sweep->ensemble);
    if (missed > 0 && !command->request->quiet) {
        gb_visible_line(stderr,
                        "%zu of %zu points: the standard error is still above %g; more "
                        "--replicas reduce it",
                        missed, sweep->ensemble.points, sweep->target.standard_error);
    }
}

static bool check_runs(const struct command *command, struct gb_error *err)
{
    char *list = g_build_filename(command->request->out, "runs.csv", NULL);
    const bool good = gb_ensemble_check(&command->sweep.ensemble, list, err);
    g_free(list);
    return good;
}

/* Writes the tables, unless other processes still compute runs; then the last process
 * does it.
 * collected   set to true if all runs are known here, so that conclusions can be printed
 */
static bool write_tables(struct command *command, bool *collected, struct gb_error *err)
{
    const struct request *request = command->request;
    struct gb_param_sweep *sweep = &command->sweep;
    struct gb_lock lock;
    if (!gb_progress_batch_lock(&lock, request->out, request->quiet, err)) {
        return false;
    }
    *collected = gb_ensemble_refresh(&sweep->ensemble) == 0;
    const bool good = !*collected || gb_param_sweep_write(sweep, request->out, err);
    gb_lock_release(&lock);
    return good;
}

static void print_left(const struct command *command)
{
    if (!command->request->quiet) {
        char *runs = gb_progress_batch_elsewhere(&command->sweep.ensemble);
        gb_visible_line(stderr,
                        "nothing left to do here; under way in other processes: %s; the "
                        "last one writes the tables",
                        runs);
        g_free(runs);
    }
}

/* Prints the command with --part instead of --tasks for each run that is not done. */
static void print_tasks(const struct command *command)
{
    const struct request *request = command->request;
    const struct gb_ensemble *ensemble = &command->sweep.ensemble;
    const size_t runs = ensemble->points * ensemble->replicas;
    GString *text = g_string_new("greenbody sweep");
    for (int i = 1; i < request->argc; i++) {
        if (strcmp(request->argv[i], "--tasks") != 0) {
            char *word = g_shell_quote(request->argv[i]);
            const bool plain =
                strspn(request->argv[i], plain_signs) == strlen(request->argv[i]);
            g_string_append_printf(text, " %s", plain ? request->argv[i] : word);
            g_free(word);
        }
    }
    for (size_t i = 0; i < runs; i++) {
        if (!ensemble->run[i].ended) {
            gb_visible_print(stdout, "%s --part %zu/%zu\n", text->str, i + 1, runs);
        }
    }
    g_string_free(text, TRUE);
}

static bool report_missing(const struct command *command, struct gb_error *err)
{
    const struct gb_ensemble *ensemble = &command->sweep.ensemble;
    size_t missing = 0;
    for (size_t i = 0; i < ensemble->points * ensemble->replicas; i++) {
        const struct gb_ensemble_run *run = &ensemble->run[i];
        missing += !run->ended && run->replica < gb_ensemble_used(ensemble, run->point);
    }
    return missing == 0 ||
           gb_error_set(err, GB_ERR_GUARD,
                        "%zu of %zu runs are missing, listed in %.200s/runs.csv", missing,
                        ensemble->points * ensemble->replicas, command->request->out);
}

/* Prints the conclusions once all runs are known. */
static bool conclude(struct command *command, struct gb_error *err)
{
    if (command->sweep.axes.design > 0 && !write_sensitivities(command, err)) {
        return false;
    }
    print_missed(command);
    return check_runs(command, err);
}

static bool collect(struct command *command, struct gb_error *err)
{
    const struct request *request = command->request;
    struct gb_lock lock;
    if (!gb_progress_batch_lock(&lock, request->out, request->quiet, err)) {
        return false;
    }
    (void)gb_ensemble_refresh(&command->sweep.ensemble);
    const bool good = gb_param_sweep_write(&command->sweep, request->out, err);
    gb_lock_release(&lock);
    return good && report_missing(command, err) && conclude(command, err);
}

/* Computes the runs and writes the tables, even after an interrupt.  A launcher ends
 * all processes if one fails, so the last process reports the failures of this one. */
static bool work(struct command *command, struct gb_error *err)
{
    const struct request *request = command->request;
    struct gb_ensemble *ensemble = &command->sweep.ensemble;
    struct gb_error stopped = {0};
    bool collected = false;
    ensemble->leaves = request->target == NULL && request->part == NULL;
    const bool worked =
        gb_progress_batch_work(&command->batch, ensemble, request->jobs, &stopped);
    if (request->part == NULL && !write_tables(command, &collected, err)) {
        return false;
    }
    if (!worked) {
        return gb_error_set(err, stopped.code, "%s", stopped.text);
    }
    if (request->part != NULL) {
        return check_runs(command, err);
    }
    if (!collected) {
        print_left(command);
        return true;
    }
    return conclude(command, err);
}

static bool perform(struct command *command, char **words, struct gb_error *err)
{
    const struct request *request = command->request;
    if (!gb_progress_batch_init(&command->batch, request->jobs, request->quiet, err) ||
        !prepare(command, words, err)) {
        return false;
    }
    if (request->tasks) {
        print_tasks(command);
        return true;
    }
    if (request->collect) {
        return collect(command, err);
    }
    if (command->batch.output == GB_BATCH_PROGRESS_ALL && command->estimate[0] != '\0') {
        gb_visible_line(stderr, "%s", command->estimate);
    }
    return work(command, err);
}

static void free_request(struct request *request)
{
    g_strfreev(request->sets);
    g_strfreev(request->vary);
    g_free(request->out);
    g_free(request->at);
    g_free(request->target);
    g_free(request->design);
    g_free(request->part);
}

static const struct gb_options_page page = {
    "PRESET [group.key=value]...",
    "Many runs at once: a grid of varied keys, each point with replicas that differ by\n"
    "their seed.  Every run gets a directory in DIR; DIR/sweep.csv holds means with\n"
    "standard errors, DIR/runs.csv the state of every run.",
    "The same command again does the missing and the failed runs; a larger grid or\n"
    "more replicas add to the runs that exist.  A run that fails does not stop the\n"
    "others.  Each run uses one thread unless numerics.threads is given.\n"
    "Several such commands with the same DIR, on one machine or many, divide its runs;\n"
    "the last to end writes the tables (docs/many-runs.md has Slurm scripts).\n\n"
    "Size effect (P1 Figs. 5 and 6), with bridges, then with friction alone:\n"
    "  greenbody sweep p1-set2-9.7nm --vary 'particles.diameter=9.7;16;21;38 nm' \\\n"
    "    --replicas 10 --at '100 MPa' --out sizes\n"
    "  greenbody sweep p1-nobridge-9.7nm --vary 'particles.diameter=9.7;16;21;38 nm' \\\n"
    "    --replicas 10 --set 'loading.until=105 MPa' \\\n"
    "    --set 'loading.unload_from=100 MPa' --out nobridge\n"
    "  greenbody plot sizes --figure densification -o fig5.png\n"
    "  greenbody plot sizes nobridge --figure size-effect -o fig6.png\n"
    "Geometry of loading (P1 Figs. 11-14: figures unloading, continuum, lateral,\n"
    "force-angle):\n"
    "  greenbody sweep p1-set1-uniaxial \\\n"
    "    --vary 'loading.geometry=uniaxial;biaxial;isotropic' \\\n"
    "    --replicas 10 --out geometry\n"
    "  greenbody plot geometry --figure force-angle -o fig14.png"};

int gb_cmd_sweep(int argc, char **argv)
{
    struct request request = {.replicas = 1};
    char **typed = g_new0(char *, (gsize)argc + 1); /* parsing removes words */
    struct command command = {.request = &request};
    struct gb_error err = {0};
    char **words = NULL;
    int status = 0;
    const GOptionEntry entries[] = {
        gb_options_set(&request.sets),
        {"vary", 0, 0, G_OPTION_ARG_STRING_ARRAY, &request.vary,
         "key=FROM:TO:COUNT[:log] or key=VALUE,VALUE... (or with ';'); may be repeated",
         "KEY=VALUES"},
        {"design", 0, 0, G_OPTION_ARG_STRING, &request.design,
         "points of a Sobol sequence in the ranges key=FROM:TO[:log] of --vary in place of "
         "a grid; sensitivities go to DIR/sensitivity.csv",
         "sobol:N"},
        {"replicas", 0, 0, G_OPTION_ARG_INT, &request.replicas,
         "runs per point (default: 1); seeds count up from structure.seed", "N"},
        {"until-se", 0, 0, G_OPTION_ARG_STRING, &request.target,
         "add replicas to a point, 4 at least, until the standard error of its density "
         "at PRESSURE is at most SE",
         "SE@PRESSURE"},
        {"at", 0, 0, G_OPTION_ARG_STRING, &request.at,
         "pressures of the table, as in '50;100;200 MPa'", "PRESSURES"},
        {"out", 'o', 0, G_OPTION_ARG_FILENAME, &request.out, "directory of the sweep",
         "DIR"},
        {"jobs", 'j', 0, G_OPTION_ARG_INT, &request.jobs,
         "runs at once (one per processor)", "N"},
        {"yes", 'y', 0, G_OPTION_ARG_NONE, &request.yes,
         "begin a sweep estimated to take more than an hour", NULL},
        {"tasks", 0, 0, G_OPTION_ARG_NONE, &request.tasks,
         "print a command for each run that is not done, for GNU parallel, HyperQueue, "
         "Snakemake or a Slurm array; run --collect afterwards",
         NULL},
        {"part", 0, 0, G_OPTION_ARG_STRING, &request.part,
         "run only every N-th run, from the I-th on; write no tables", "I/N"},
        {"collect", 0, 0, G_OPTION_ARG_NONE, &request.collect,
         "start no run; write the tables from the finished ones", NULL},
        gb_options_quiet(&request.quiet),
        {0}};
    memcpy(typed, argv, (size_t)argc * sizeof *argv);
    request.argc = argc;
    request.argv = typed;
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        status = perform(&command, words, &err) ? 0 : gb_progress_exit(&err);
    }
    gb_param_sweep_finish(&command.sweep);
    gb_preset_destroy(command.preset);
    g_strfreev(words);
    g_free(typed);
    free_request(&request);
    return status;
}
