#include <stdio.h>

#include <glib.h>

#include "base/visible.h"
#include "cli/commands.h"
#include "cli/lab_input.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "study/calibration.h"

enum { REPLICAS_MIN = 3, REPLICAS_MAX = 1000 };

/* The options of the command line. */
struct request {
    char **sets;
    char *data, *free, *out;
    gint replicas, jobs;
    gboolean quiet;
    struct gb_lab_input lab;
};

struct command {
    const struct request *request;
    struct gb_batch_progress batch;
    struct gb_preset *preset;
    struct gb_calibration calibration;
};

static bool work(struct gb_ensemble *ensemble, void *data, struct gb_error *err)
{
    struct command *command = data;
    return gb_progress_batch_work(&command->batch, ensemble, command->request->jobs, err);
}

static void print_round(const struct gb_calibration *calibration,
                        enum gb_calibrate_stage stage, int round, const double *best,
                        const double *half_width, void *data)
{
    const struct command *command = data;
    if (command->batch.output != GB_BATCH_PROGRESS_RUNNING) {
        return;
    }
    gb_visible_print(stderr, "%s, round %d:",
                     stage == GB_CALIBRATE_COARSE ? "small cells" : "full cells", round);
    for (size_t k = 0; k < calibration->keys.count; k++) {
        char name[96];
        gb_calibration_key_name(&calibration->keys.key[k], name, sizeof name);
        gb_visible_print(stderr, "%s %s = %.4g within %.2g", k > 0 ? "," : "", name,
                         best[k], half_width[k]);
    }
    gb_visible_put(stderr, "\n");
}

static bool check_request(const struct request *request, struct gb_error *err)
{
    if (!request->data || !request->free || !request->out || !request->out[0]) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "calibrate needs --data FILE.csv, --free KEYS and --out DIR");
    }
    return (request->replicas >= REPLICAS_MIN && request->replicas <= REPLICAS_MAX) ||
           gb_error_set(err, GB_ERR_INPUT, "--replicas %d: must be between %d and %d",
                        request->replicas, REPLICAS_MIN, REPLICAS_MAX);
}

static bool read_lab(struct gb_labdata *lab, const struct request *request,
                     const struct gb_params *params, struct gb_error *err)
{
    struct gb_table *table = NULL;
    const bool good = gb_lab_input_read(&table, &request->lab, request->data,
                                        gb_lab_quantity_columns, err) &&
                      gb_compaction_data_take(lab, table, params, err);
    gb_table_destroy(table);
    return good;
}

/* Makes all checks that are possible before anything is written. */
static bool prepare(struct command *command, char **words, struct gb_error *err)
{
    const struct request *request = command->request;
    struct gb_calibration *calibration = &command->calibration;
    if (!check_request(request, err) ||
        !gb_options_scene(&command->preset, words, request->sets,
                          GB_OPTIONS_PRESET_NEEDED, err)) {
        return false;
    }
    const struct gb_params *params = gb_preset_params(command->preset);
    calibration->replicas = (size_t)request->replicas;
    calibration->directory = request->out;
    calibration->work = work;
    calibration->progress = print_round;
    calibration->data = command;
    return gb_calibration_keys(&calibration->keys, request->free, params, err) &&
           read_lab(&calibration->lab, request, params, err) &&
           gb_ensemble_make_directory(request->out, err);
}

static bool perform(struct command *command, char **words, struct gb_error *err)
{
    const struct request *request = command->request;
    if (!gb_progress_batch_init(&command->batch, request->jobs, request->quiet, err)) {
        return false;
    }
    const bool first = command->batch.launch.rank == 0;
    if (command->batch.output == GB_BATCH_PROGRESS_ALL) {
        command->batch.output = GB_BATCH_PROGRESS_RUNNING;
    }
    if (!prepare(command, words, err) ||
        !gb_calibration_fit(&command->calibration, err)) {
        return false;
    }
    struct gb_lock lock;
    if (!gb_progress_batch_lock(&lock, request->out, request->quiet, err)) {
        return false;
    }
    const bool written =
        gb_calibration_write(&command->calibration, command->preset, err);
    gb_lock_release(&lock);
    GString *text = gb_calibration_text(&command->calibration);
    gb_visible_put(stdout, first ? text->str : "");
    g_string_free(text, TRUE);
    return written;
}

static const char usage[] = "PRESET [group.key=value]...";
static const char summary[] =
    "Fits parameters of a preset to measured densities, pressure ratios, coordination\n"
    "and moduli of unloading.  Cells with the same seeds are simulated at a set of\n"
    "parameter values.  A quadratic function fitted for each seed gives the best fit,\n"
    "its 95 % intervals (errors of the data and scatter of the cells) and correlations.\n"
    "Small cells come first, the full ones last.";
static const char about_file[] =
    "FILE.csv has the columns p_MPa and density, and may have density_error, branch\n"
    "(load, or unload: the density left after unloading from p_MPa) and keys with\n"
    "their unit, such as particles.diameter_nm, to fit several powders together.\n"
    "Instead of density, or together with it: lateral_ratio (px/pz), coordination and\n"
    "unloading_modulus_GPa (secant from p to p/2).  With several quantities, give their\n"
    "errors (lateral_ratio_error and so on).  The column weight makes a row count more or\n"
    "less.  The same command again continues an interrupted fit.  DIR receives rounds.csv\n"
    "during the fit, then calibration.csv, calibration.txt (the text printed), fit.csv,\n"
    "calibrated.ini and the runs.\n\n";
static const char example[] =
    "\n\n  greenbody calibrate p1-set1-uniaxial --data lab.csv \\\n"
    "    --free contact.mu,contact.alpha --out fit";

int gb_cmd_calibrate(int argc, char **argv)
{
    struct request request = {.replicas = 4};
    struct command command = {.request = &request};
    struct gb_error err = {0};
    char **words = NULL;
    int status = 0;
    const GOptionEntry own[] = {
        gb_options_set(&request.sets),
        {"data", 0, 0, G_OPTION_ARG_FILENAME, &request.data, "measured values",
         "FILE.csv"},
        {"free", 0, 0, G_OPTION_ARG_STRING, &request.free,
         "up to 4 parameters to fit; limits LOW:HIGH are optional", "KEY[=LOW:HIGH],..."},
        {"replicas", 0, 0, G_OPTION_ARG_INT, &request.replicas,
         "cells for each set of values, 3 or more (default: 4)", "N"},
        {"out", 'o', 0, G_OPTION_ARG_FILENAME, &request.out, "directory of the results",
         "DIR"},
        {"jobs", 'j', 0, G_OPTION_ARG_INT, &request.jobs,
         "runs at once (one per processor)", "N"},
        gb_options_quiet(&request.quiet),
        {0}};
    GOptionEntry *entries = gb_lab_input_entries(&request.lab, own);
    char *description = g_strconcat(about_file, gb_lab_input_help, example, NULL);
    const struct gb_options_page page = {usage, summary, description};
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        status = perform(&command, words, &err) ? 0 : gb_progress_exit(&err);
    }
    gb_calibration_finish(&command.calibration);
    gb_preset_destroy(command.preset);
    g_strfreev(words);
    g_strfreev(request.sets);
    g_free(request.data);
    g_free(request.free);
    g_free(request.out);
    gb_lab_input_finish(&request.lab);
    g_free(entries);
    g_free(description);
    return status;
}
