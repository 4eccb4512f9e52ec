#include <math.h>
#include <stdio.h>
#include <string.h>

#include <glib.h>

#include "base/file.h"
#include "base/units.h"
#include "cli/batch_progress.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "many/ensemble.h"
#include "many/labdata.h"
#include "many/reading.h"
#include "study/calibrate.h"
#include "study/free_keys.h"

/* Cells of the first stage: an eighth of the particles, if that leaves enough. */
enum { COARSE_SHARE = 8, COARSE_LEAST = 200, REPLICAS_MOST = 1000 };

/* What the command line said. */
struct request {
    char **sets;
    char *data, *free, *out;
    gint replicas, jobs;
    gboolean quiet;
};

struct calibration {
    const struct request *request;
    struct gb_mpi_pool *ranks;
    struct gb_preset *preset;
    struct gb_free_keys keys;
    struct gb_labdata lab;
    struct gb_calibrate_problem problem;
    struct gb_calibrate_result result;
    GString *rounds;         /* what rounds.csv holds */
    struct gb_error machine; /* the first run that the machine failed; GB_OK: none */
};

static const char *key_name(const struct gb_freekey *key, char *buffer, size_t size)
{
    g_snprintf(buffer, (gulong)size, "%s.%s", key->field->group, key->field->key);
    return buffer;
}

/* A smaller cell of the same shape. */
static bool make_coarse(struct gb_params *params)
{
    const int64_t count = params->count / COARSE_SHARE;
    if (count < COARSE_LEAST) {
        return false;
    }
    params->base.value *= cbrt((double)count / (double)params->count);
    params->count = count;
    return gb_params_check(params, NULL);
}

/* "coarse_1_mu-0.13_alpha-0.37_seed-2": of nothing but what the run is. */
static char *directory_of(const struct calibration *calibration, int stage, size_t scene,
                          const double *at, uint64_t seed)
{
    GString *name = g_string_new(NULL);
    g_string_printf(name, "%s/runs/%s_%zu", calibration->request->out,
                    stage == 0 ? "coarse" : "full", scene + 1);
    for (size_t k = 0; k < calibration->keys.count; k++) {
        g_string_append_printf(name, "_%s-%.10g", calibration->keys.key[k].field->key,
                               at[k]);
    }
    g_string_append_printf(name, "_seed-%" G_GUINT64_FORMAT, seed);
    return g_string_free(name, FALSE);
}

/* A batch of parameters as runs: point p of scene s is p x scenes + s. */
static bool fill(const struct calibration *calibration, const double *parameters,
                 int stage, struct gb_ensemble *ensemble, struct gb_error *err)
{
    const size_t scenes = calibration->lab.scenes;
    for (size_t i = 0; i < ensemble->points * ensemble->replicas; i++) {
        struct gb_ensemble_run *run = &ensemble->run[i];
        const double *at = parameters + run->point / scenes * calibration->keys.count;
        const size_t scene = run->point % scenes;
        run->params = calibration->lab.scene[scene];
        run->params.seed += run->replica;
        run->params.threads = run->params.threads > 0 ? run->params.threads : 1;
        if (!gb_free_keys_apply(&calibration->keys, at, &run->params, err) ||
            (stage == 0 && !make_coarse(&run->params)) ||
            !gb_params_check(&run->params, err)) {
            return false;
        }
        run->directory = directory_of(calibration, stage, scene, at, run->params.seed);
    }
    return true;
}

/* Values of one run for the rows of its scene. */
static void read_values(const struct calibration *calibration,
                        const struct gb_ensemble_run *run, double *out)
{
    const struct gb_labdata *lab = &calibration->lab;
    struct gb_table *curve = NULL;
    const bool good =
        run->error.code == GB_OK && gb_reading_open(&curve, run->directory, NULL);
    for (size_t i = 0; i < lab->count; i++) {
        const struct gb_labdata_row *row = &lab->row[i];
        double values[GB_READING_QUANTITIES] = {NAN};
        if (row->scene != run->point % lab->scenes) {
            continue;
        }
        if (good) {
            (void)(row->unloaded ? gb_reading_unloaded
                                 : gb_reading_loaded)(curve, row->pressure_pa, values);
        }
        out[i] = values[GB_READING_DENSITY];
    }
    gb_table_destroy(curve);
}

static bool simulate(const double *parameters, size_t points, int stage, double *out,
                     void *context, struct gb_error *err)
{
    struct calibration *calibration = context;
    const struct request *request = calibration->request;
    const size_t data = calibration->lab.count;
    const size_t scenes = calibration->lab.scenes;
    const size_t replicas = (size_t)request->replicas;
    struct gb_ensemble ensemble;
    struct gb_batch_progress crowd = {
        .ranks = calibration->ranks, .quiet = request->quiet, .brief = true};
    bool good = gb_ensemble_init(&ensemble, points * scenes, replicas, err) &&
                fill(calibration, parameters, stage, &ensemble, err) &&
                gb_ensemble_find_done(&ensemble, err) &&
                gb_batch_progress_work(&crowd, &ensemble, request->jobs, err);
    for (size_t i = 0; good && i < ensemble.points * replicas; i++) {
        const struct gb_ensemble_run *run = &ensemble.run[i];
        const size_t point = run->point / scenes;
        if (run->error.code == GB_ERR_MACHINE && calibration->machine.code == GB_OK) {
            calibration->machine = run->error;
        }
        read_values(calibration, run, out + (point * replicas + run->replica) * data);
    }
    gb_ensemble_finish(&ensemble);
    return good;
}

static bool write_text(const char *out, const char *name, const GString *text,
                       struct gb_error *err)
{
    char *path = g_build_filename(out, name, NULL);
    const bool good = gb_file_replace(path, text->str, text->len, err);
    g_free(path);
    return good;
}

/* rounds.csv: a row for each, so that others can follow the fit.  Not worth stopping for.
 */
static void keep_round(const struct calibration *calibration, int stage, int round,
                       const double *best, const double *half_width)
{
    GString *text = calibration->rounds;
    char name[96];
    if (text->len == 0) {
        g_string_append(text, "cells,round");
        for (size_t k = 0; k < calibration->keys.count; k++) {
            key_name(&calibration->keys.key[k], name, sizeof name);
            g_string_append_printf(text, ",%s,within_%s", name, name);
        }
        g_string_append_c(text, '\n');
    }
    g_string_append_printf(text, "%s,%d", stage == 0 ? "small" : "full", round);
    for (size_t k = 0; k < calibration->keys.count; k++) {
        g_string_append_printf(text, ",%.5g,%.3g", best[k], half_width[k]);
    }
    g_string_append_c(text, '\n');
    (void)write_text(calibration->request->out, "rounds.csv", text, NULL);
}

static void told(int stage, int round, const double *best, const double *half_width,
                 void *context)
{
    const struct calibration *calibration = context;
    keep_round(calibration, stage, round, best, half_width);
    if (calibration->request->quiet) {
        return;
    }
    fprintf(stderr, "%s, round %d:", stage == 0 ? "small cells" : "full cells", round);
    for (size_t k = 0; k < calibration->keys.count; k++) {
        char name[96];
        fprintf(stderr, "%s %s = %.4g within %.2g", k > 0 ? "," : "",
                key_name(&calibration->keys.key[k], name, sizeof name), best[k],
                half_width[k]);
    }
    fputc('\n', stderr);
}

/* calibration.csv: a row per key. */
static GString *parameter_table(const struct calibration *calibration)
{
    const struct gb_calibrate_result *result = &calibration->result;
    const size_t n = calibration->keys.count;
    char name[96];
    GString *text =
        g_string_new("# best fit, standard error and 95 % interval; SI, or the "
                     "multiple that the preset gives\nkey,unit,value,error,"
                     "low_95,high_95");
    for (size_t k = 0; k < n; k++) {
        g_string_append_printf(text, ",correlation_%s",
                               key_name(&calibration->keys.key[k], name, sizeof name));
    }
    for (size_t k = 0; k < n; k++) {
        const struct gb_freekey *key = &calibration->keys.key[k];
        g_string_append_printf(
            text, "\n%s,%s,%.8g,%.8g,%.8g,%.8g", key_name(key, name, sizeof name),
            key->relative ? key->field->relative : "SI", result->value[k],
            result->error[k], result->low[k], result->high[k]);
        for (size_t l = 0; l < n; l++) {
            g_string_append_printf(text, ",%.4f", result->correlation[k][l]);
        }
    }
    g_string_append_c(text, '\n');
    return text;
}

/* fit.csv: what was measured beside what is simulated with the best fit. */
static GString *fit_table(const struct calibration *calibration)
{
    const struct gb_labdata *lab = &calibration->lab;
    GString *text = g_string_new("scene,branch,p_MPa,density,density_error,simulated,"
                                 "se_simulated\n");
    for (size_t i = 0; i < lab->count; i++) {
        const struct gb_labdata_row *row = &lab->row[i];
        g_string_append_printf(text, "%zu,%s,%.12g,%.12g,", row->scene + 1,
                               row->unloaded ? "unload" : "load", row->pressure_pa / 1e6,
                               row->density);
        if (lab->error != NULL) {
            g_string_append_printf(text, "%.12g", lab->error[i]);
        }
        g_string_append_printf(text, ",%.8g,%.3g\n", calibration->result.fitted[i],
                               calibration->result.fitted_error[i]);
    }
    return text;
}

static bool write_results(struct calibration *calibration, struct gb_error *err)
{
    const char *out = calibration->request->out;
    struct gb_params *params = gb_preset_params(calibration->preset);
    if (!gb_free_keys_apply(&calibration->keys, calibration->result.value, params, err)) {
        return false;
    }
    char *path = g_build_filename(out, "calibrated.ini", NULL);
    const bool saved = gb_preset_save(calibration->preset, path, false, err);
    g_free(path);
    GString *table = parameter_table(calibration);
    GString *fit = fit_table(calibration);
    const bool good = saved && write_text(out, "fit.csv", fit, err) &&
                      write_text(out, "calibration.csv", table, err);
    g_string_free(table, TRUE);
    g_string_free(fit, TRUE);
    return good;
}

static void report_keys(const struct calibration *calibration)
{
    const struct gb_calibrate_result *result = &calibration->result;
    for (size_t k = 0; k < calibration->keys.count; k++) {
        const struct gb_freekey *key = &calibration->keys.key[k];
        char name[96];
        const char *unit = key->relative                          ? key->field->relative
                           : key->field->dimension != GB_DIM_NONE ? "(SI)"
                                                                  : "";
        key_name(key, name, sizeof name);
        if (isinf(result->error[k])) {
            printf("%s: the data do not depend on it\n", name);
            continue;
        }
        printf("%s = %.4g +- %.2g, 95 %%: %.4g to %.4g%s%s\n", name, result->value[k],
               result->error[k], result->low[k], result->high[k], *unit ? " " : "", unit);
        if (result->at_limit[k]) {
            printf("  at the end of its range %.4g to %.4g: the best value may lie "
                   "beyond\n",
                   key->low, key->high);
        }
    }
}

/* What cannot be told apart is said in words. */
static void report_pairs(const struct calibration *calibration)
{
    const struct gb_calibrate_result *result = &calibration->result;
    for (size_t i = 0; i < calibration->keys.count; i++) {
        for (size_t j = i + 1; j < calibration->keys.count; j++) {
            char first[96], second[96];
            key_name(&calibration->keys.key[i], first, sizeof first);
            key_name(&calibration->keys.key[j], second, sizeof second);
            printf("correlation of %s and %s: %.2f\n", first, second,
                   result->correlation[i][j]);
            if (gb_calibrate_confused(result, i, j)) {
                printf("  the data cannot tell %s and %s apart: fix one of them, or add "
                       "data that the two change differently\n",
                       first, second);
            }
        }
    }
}

static void report(const struct calibration *calibration)
{
    const struct gb_calibrate_result *result = &calibration->result;
    report_keys(calibration);
    report_pairs(calibration);
    printf("residuals: rms %.2g in density", result->rms);
    if (isfinite(result->chi_squared) && result->degrees > 0) {
        printf(", chi-squared %.3g for %zu degrees of freedom", result->chi_squared,
               result->degrees);
    }
    printf("\n%zu cells simulated, %zu of them failed\n", result->simulated,
           result->failed);
    if (!result->settled) {
        printf(
            "the region of the fit was still moving or shrinking when the rounds ended: "
            "intervals may be too wide\n");
    }
}

static bool check_request(const struct request *request, struct gb_error *err)
{
    if (!request->data || !request->free || !request->out || !request->out[0]) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "calibrate needs --data FILE.csv, --free KEYS and --out DIR");
    }
    return (request->replicas >= 3 && request->replicas <= REPLICAS_MOST) ||
           gb_error_set(err, GB_ERR_INPUT, "--replicas %d: accepted 3 to %d",
                        request->replicas, REPLICAS_MOST);
}

/* Everything that can be known to be wrong before any work is done. */
static bool prepare(struct calibration *calibration, char **words, struct gb_error *err)
{
    const struct request *request = calibration->request;
    struct gb_calibrate_problem *problem = &calibration->problem;
    if (!check_request(request, err) ||
        !gb_options_scene(&calibration->preset, words, request->sets, true, err) ||
        !gb_free_keys_parse(&calibration->keys, request->free,
                            gb_preset_params(calibration->preset), err) ||
        !gb_labdata_read(&calibration->lab, request->data,
                         gb_preset_params(calibration->preset), err)) {
        return false;
    }
    *problem = (struct gb_calibrate_problem){.free = calibration->keys.count,
                                             .data = calibration->lab.count,
                                             .value = calibration->lab.density,
                                             .error = calibration->lab.error,
                                             .replicas = (size_t)request->replicas,
                                             .coarse = true,
                                             .simulate = simulate,
                                             .told = told,
                                             .context = calibration};
    for (size_t k = 0; k < calibration->keys.count; k++) {
        problem->low[k] = calibration->keys.key[k].low;
        problem->high[k] = calibration->keys.key[k].high;
        problem->from[k] = calibration->keys.key[k].from;
        problem->to[k] = calibration->keys.key[k].to;
    }
    for (size_t s = 0; s < calibration->lab.scenes; s++) {
        struct gb_params smaller = calibration->lab.scene[s];
        problem->coarse = problem->coarse && make_coarse(&smaller);
    }
    return gb_batch_progress_directory(request->out, err);
}

static bool perform(struct calibration *calibration, char **words, struct gb_error *err)
{
    if (!prepare(calibration, words, err)) {
        return false;
    }
    if (!gb_calibrate_fit(&calibration->problem, &calibration->result, err)) {
        /* runs are missing: a full disk is the reason, not the powder */
        if (err->code == GB_ERR_GUARD && calibration->machine.code != GB_OK) {
            *err = calibration->machine;
        }
        return false;
    }
    const bool written = write_results(calibration, err);
    report(calibration);
    return written;
}

static const struct gb_options_page page = {
    "PRESET [group.key=value]...",
    "Fits keys of a preset to measured densities.  Cells of the same seeds are simulated "
    "at "
    "a design of\nvalues; a surrogate of each seed gives the best fit, its 95 % "
    "intervals "
    "(errors of the data and\nscatter of the cells) and correlations.  Small cells come "
    "first, the full ones last.",
    "FILE.csv has the columns p_MPa and density, and may have density_error, branch "
    "(load, "
    "or unload:\nthe density left after unloading from p_MPa) and keys with their unit, "
    "as "
    "particles.diameter_nm,\nwhere powders are fitted together.  The same command again "
    "goes "
    "on where it was stopped.\nDIR gets rounds.csv as it goes, calibration.csv, fit.csv, "
    "calibrated.ini and the "
    "runs.\n\n"
    "  greenbody calibrate p1-set1-uniaxial --data lab.csv --free "
    "contact.mu,contact.alpha --out fit"};

int gb_cmd_calibrate(int argc, char **argv)
{
    struct request request = {.replicas = 4};
    struct calibration calibration = {.request = &request};
    struct gb_batch_progress crowd = {0};
    struct gb_error err = {0};
    char **words = NULL;
    int status = 0;
    const GOptionEntry entries[] = {
        GB_OPTIONS_SET(&request.sets),
        {"data", 0, 0, G_OPTION_ARG_FILENAME, &request.data, "measured densities",
         "FILE.csv"},
        {"free", 0, 0, G_OPTION_ARG_STRING, &request.free,
         "up to 4 keys to be fitted, each with LOW:HIGH if it shall not leave them",
         "KEY[=LOW:HIGH],..."},
        {"replicas", 0, 0, G_OPTION_ARG_INT, &request.replicas,
         "cells at each set of values, 3 or more (4)", "N"},
        {"out", 'o', 0, G_OPTION_ARG_FILENAME, &request.out, "directory of the results",
         "DIR"},
        {"jobs", 'j', 0, G_OPTION_ARG_INT, &request.jobs,
         "runs at once (one per processor)", "N"},
        {"quiet", 'q', 0, G_OPTION_ARG_NONE, &request.quiet, "no progress on stderr",
         NULL},
        {0}};
    if (gb_options_parse(&page, entries, argc, argv, &words, &status) &&
        !gb_batch_progress_serve(&crowd, request.jobs, &status)) {
        calibration.ranks = crowd.ranks;
        calibration.rounds = g_string_new(NULL);
        status = perform(&calibration, words, &err) ? 0 : gb_batch_progress_exit(&err);
        gb_mpi_pool_destroy(crowd.ranks);
        g_string_free(calibration.rounds, TRUE);
    }
    gb_calibrate_finish(&calibration.result);
    gb_labdata_finish(&calibration.lab);
    gb_preset_destroy(calibration.preset);
    g_strfreev(words);
    g_strfreev(request.sets);
    g_free(request.data);
    g_free(request.free);
    g_free(request.out);
    return status;
}
