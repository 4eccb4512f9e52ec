/* A calibration in a directory: which keys are free, the runs at each point, and its tables. */
#include "study/calibrate/calibration.h"

#include <glib.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include "base/file.h"
#include "base/listing.h"
#include "base/number.h"
#include "base/units.h"
#include "greenbody/params.h"
#include "io/preset.h"
#include "many/compaction_data.h"
#include "many/ensemble.h"
#include "many/reading.h"
#include "many/runset.h"
#include "study/calibrate/calibrate.h"

/* --- free keys ------------------------------------------------------------------------ */

enum { DIGITS = 10 };

/* Without a range the fit begins between the value over this and the value times it. */
static const double first_factor = 2.0;

/* The number of a field in params. */
static double number_of(const struct gb_params *params, const struct gb_field *field,
                        bool *relative)
{
    const void *at = (const char *)params + field->offset;
    *relative = false;
    if (field->type == GB_FIELD_RELATIVE) {
        const struct gb_relative *both = at;
        *relative = both->relative;
        return both->value;
    }
    return *(const double *)at;
}

/* One end of a range; takes the unit behind the whole when it has none. */
static bool read_end(struct gb_free_key *key, const char *text, const char *unit,
                     double *value, struct gb_error *err)
{
    struct gb_params params;
    const char *end = text;
    double number = 0.0;
    gb_params_init(&params);
    const bool bare = gb_units_number(text, &end, &number) && *end == '\0';
    char *whole = g_strconcat(text, bare && *unit ? " " : "", bare ? unit : "", NULL);
    const bool good = gb_params_set(&params, key->field, whole, err);
    g_free(whole);
    *value = number_of(&params, key->field, &key->relative);
    return good;
}

static bool read_range(struct gb_free_key *key, const char *text, struct gb_error *err)
{
    char **ends = g_strsplit(text, ":", 3);
    bool good = g_strv_length(ends) == 2;
    if (good) {
        const char *unit = "";
        double number = 0.0;
        g_strstrip(ends[0]);
        if (gb_units_number(g_strstrip(ends[1]), &unit, &number)) {
            unit += strspn(unit, " \t");
        }
        bool relative = false;
        good = read_end(key, ends[0], unit, &key->low, err);
        relative = key->relative;
        good = good && read_end(key, ends[1], unit, &key->high, err);
        good = good && relative == key->relative && key->low < key->high;
    }
    g_strfreev(ends);
    key->from = key->low;
    key->to = key->high;
    return good || gb_error_set(err, GB_ERR_INPUT,
                                "--free %s.%s=%.80s: expected two values that the key "
                                "takes, LOW:HIGH",
                                key->field->group, key->field->key, text);
}

static bool take_around(struct gb_free_key *key, const struct gb_params *params,
                        struct gb_error *err)
{
    const double value = number_of(params, key->field, &key->relative);
    if (!(value > 0.0)) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "--free %s.%s: the preset has no value above 0 to begin with; "
            "expected %s.%s=LOW:HIGH",
            key->field->group, key->field->key, key->field->group, key->field->key);
    }
    key->low = fmax(key->field->min, value / 100.0);
    key->high = fmin(key->field->max, value * 100.0);
    key->from = fmax(key->low, value / first_factor);
    key->to = fmin(key->high, value * first_factor);
    return true;
}

static bool find_field(const struct gb_free_keys *keys, struct gb_free_key *key,
                       const char *name, struct gb_error *err)
{
    key->field = gb_params_find_name(name, err);
    if (key->field == NULL) {
        return false;
    }
    const bool fit =
        !gb_runset_bookkeeping(key->field) &&
        (key->field->type == GB_FIELD_NUMBER || key->field->type == GB_FIELD_RELATIVE);
    bool twice = false;
    for (size_t i = 0; i < keys->count; i++) {
        twice = twice || keys->key[i].field == key->field;
    }
    return (fit && !twice) ||
           gb_error_set(
               err, GB_ERR_INPUT,
               "--free %.80s: expected keys that are numbers, as contact.mu, each "
               "once; see greenbody params",
               name);
}

bool gb_calibration_keys(struct gb_free_keys *keys, const char *text,
                         const struct gb_params *params, struct gb_error *err)
{
    char **parts = g_strsplit(text, ",", GB_CALIBRATE_FREE + 2);
    bool good = parts[0] != NULL;
    keys->count = 0;
    if (!good || g_strv_length(parts) > GB_CALIBRATE_FREE) {
        good =
            gb_error_set(err, GB_ERR_INPUT, "--free %.80s: must be between 1 and %d keys",
                         text, GB_CALIBRATE_FREE);
    }
    for (size_t i = 0; good && parts[i] != NULL; i++) {
        struct gb_free_key *key = &keys->key[keys->count];
        char **sides = g_strsplit(g_strstrip(parts[i]), "=", 2);
        *key = (struct gb_free_key){0};
        good = sides[0] != NULL
                   ? find_field(keys, key, g_strstrip(sides[0]), err)
                   : gb_error_set(err, GB_ERR_INPUT, "--free: a key is empty");
        good = good && (sides[1] ? read_range(key, sides[1], err)
                                 : take_around(key, params, err));
        keys->count += good;
        g_strfreev(sides);
    }
    g_strfreev(parts);
    return good;
}

/* The value of a key as a preset would write it, ten digits.  Returns buffer. */
static char *free_keys_text(const struct gb_free_key *key, double value, char *buffer,
                            size_t size)
{
    if (key->relative) {
        g_snprintf(buffer, (gulong)size, "%.*g %s", DIGITS, value, key->field->relative);
        return buffer;
    }
    return gb_units_format_short(value, (enum gb_dimension)key->field->dimension, DIGITS,
                                 buffer, size);
}

/* Gives params the values. */
static bool calibration_apply(const struct gb_free_keys *keys, const double *value,
                              struct gb_params *params, struct gb_error *err)
{
    for (size_t k = 0; k < keys->count; k++) {
        char text[96];
        free_keys_text(&keys->key[k], value[k], text, sizeof text);
        if (!gb_params_set(params, keys->key[k].field, text, err)) {
            return false;
        }
    }
    return true;
}

/* --- runs and fit --------------------------------------------------------------------- */

/* Cells of the coarse stage: this fraction of the particles, but not fewer. */
enum { COARSE_FRACTION = 8, COARSE_MIN = 200 };

const char *gb_calibration_key_name(const struct gb_free_key *key, char *buffer,
                                    size_t size)
{
    g_snprintf(buffer, (gulong)size, "%s.%s", key->field->group, key->field->key);
    return buffer;
}

/* A smaller cell of the same shape.  Errors: GB_ERR_INPUT for too few particles. */
static bool make_coarse(struct gb_params *params, struct gb_error *err)
{
    const int64_t count = params->count / COARSE_FRACTION;
    if (count < COARSE_MIN) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "a coarse cell of %lld particles: expected %d at least",
                            (long long)count, (int)COARSE_MIN);
    }
    params->base.value *= cbrt((double)count / (double)params->count);
    params->count = count;
    return gb_params_check(params, err);
}

/* "coarse_1_mu-0.13_alpha-0.37_seed-2": depends on the parameters of the run only. */
static char *directory_of(const struct gb_calibration *calibration,
                          enum gb_calibrate_stage stage, size_t scene, const double *at,
                          uint64_t seed)
{
    GString *name = g_string_new(NULL);
    g_string_printf(name, "%s/runs/%s_%zu", calibration->directory,
                    stage == GB_CALIBRATE_COARSE ? "coarse" : "full", scene + 1);
    for (size_t k = 0; k < calibration->keys.count; k++) {
        g_string_append_printf(name, "_%s-%.10g", calibration->keys.key[k].field->key,
                               at[k]);
    }
    g_string_append_printf(name, "_seed-%" G_GUINT64_FORMAT, seed);
    return g_string_free(name, FALSE);
}

/* A batch of parameters as runs: point p of scene s is p x scenes + s. */
static bool fill(const struct gb_calibration *calibration, const double *parameters,
                 enum gb_calibrate_stage stage, struct gb_ensemble *ensemble,
                 struct gb_error *err)
{
    const size_t scenes = calibration->lab.scenes;
    for (size_t i = 0; i < ensemble->points * ensemble->replicas; i++) {
        struct gb_ensemble_run *run = &ensemble->run[i];
        const double *at = parameters + run->point / scenes * calibration->keys.count;
        const size_t scene = run->point % scenes;
        run->params = calibration->lab.scene[scene];
        run->params.seed += run->replica;
        run->params.threads = run->params.threads > 0 ? run->params.threads : 1;
        if (!calibration_apply(&calibration->keys, at, &run->params, err) ||
            (stage == GB_CALIBRATE_COARSE && !make_coarse(&run->params, err)) ||
            !gb_params_check(&run->params, err)) {
            return false;
        }
        run->directory = directory_of(calibration, stage, scene, at, run->params.seed);
    }
    return true;
}

/* Values of one run for the rows of its scene; NaN where it failed. */
static void read_values(const struct gb_calibration *calibration,
                        const struct gb_ensemble_run *run, double *out)
{
    const struct gb_labdata *lab = &calibration->lab;
    struct gb_table *curve = NULL;
    const bool good =
        run->error.code == GB_OK && gb_reading_open(&curve, run->directory, NULL);
    for (size_t i = 0; i < lab->count; i++) {
        const struct gb_labdata_row *row = &lab->row[i];
        if (row->scene != run->point % lab->scenes) {
            continue;
        }
        out[i] = good ? gb_compaction_data_simulated(row, curve) : (double)NAN;
    }
    gb_table_destroy(curve);
}

static bool simulate(const double *parameters, size_t points,
                     enum gb_calibrate_stage stage, double *out, void *context,
                     struct gb_error *err)
{
    struct gb_calibration *calibration = context;
    const size_t data = calibration->lab.count;
    const size_t scenes = calibration->lab.scenes;
    const size_t replicas = calibration->replicas;
    struct gb_ensemble ensemble;
    const bool good = gb_ensemble_init(&ensemble, points * scenes, replicas, err) &&
                      fill(calibration, parameters, stage, &ensemble, err) &&
                      gb_ensemble_find_done(&ensemble, err) &&
                      calibration->work(&ensemble, calibration->data, err);
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

static bool write_table(const struct gb_calibration *calibration, const char *name,
                        GString *text, struct gb_error *err)
{
    char *path = g_build_filename(calibration->directory, name, NULL);
    const bool good = gb_file_replace(path, text->str, text->len, err);
    g_free(path);
    g_string_free(text, TRUE);
    return good;
}

static struct gb_listing *new_rounds(const struct gb_calibration *calibration)
{
    struct gb_listing *listing = gb_listing_new();
    char name[96];
    gb_listing_columns(listing, "%s", "cells");
    gb_listing_columns(listing, "%.0f", "round");
    for (size_t k = 0; k < calibration->keys.count; k++) {
        gb_calibration_key_name(&calibration->keys.key[k], name, sizeof name);
        gb_listing_column(listing, "%.5g", "%s", name);
        gb_listing_column(listing, "%.3g", "within_%s", name);
    }
    return listing;
}

/* A row of rounds.csv, for other programs that follow the fit; the fit continues when it
 * cannot be written. */
static void add_round(enum gb_calibrate_stage stage, int round, const double *best,
                      const double *half_width, void *context)
{
    struct gb_calibration *calibration = context;
    struct gb_listing *listing = calibration->rounds;
    gb_listing_text(listing, stage == GB_CALIBRATE_COARSE ? "small" : "full");
    gb_listing_number(listing, round);
    for (size_t k = 0; k < calibration->keys.count; k++) {
        gb_listing_number(listing, best[k]);
        gb_listing_number(listing, half_width[k]);
    }
    (void)write_table(calibration, "rounds.csv",
                      gb_listing_print(listing, GB_LISTING_CSV), NULL);
    if (calibration->progress != NULL) {
        calibration->progress(calibration, stage, round, best, half_width,
                              calibration->data);
    }
}

static struct gb_calibrate_problem problem_of(struct gb_calibration *calibration)
{
    struct gb_calibrate_problem problem = {.free = calibration->keys.count,
                                           .data = calibration->lab.count,
                                           .value = calibration->lab.value,
                                           .error = calibration->lab.error,
                                           .weight = calibration->lab.weight,
                                           .replicas = calibration->replicas,
                                           .coarse_stage = true,
                                           .simulate = simulate,
                                           .progress = add_round,
                                           .context = calibration};
    for (size_t k = 0; k < calibration->keys.count; k++) {
        problem.low[k] = calibration->keys.key[k].low;
        problem.high[k] = calibration->keys.key[k].high;
        problem.from[k] = calibration->keys.key[k].from;
        problem.to[k] = calibration->keys.key[k].to;
    }
    for (size_t s = 0; s < calibration->lab.scenes; s++) {
        struct gb_params smaller = calibration->lab.scene[s];
        problem.coarse_stage = problem.coarse_stage && make_coarse(&smaller, NULL);
    }
    return problem;
}

bool gb_calibration_fit(struct gb_calibration *calibration, struct gb_error *err)
{
    const struct gb_calibrate_problem problem = problem_of(calibration);
    calibration->rounds = new_rounds(calibration);
    if (gb_calibrate_fit(&problem, &calibration->result, err)) {
        return true;
    }
    /* where runs are missing because of a full disk, that is the error */
    if (err->code == GB_ERR_GUARD && calibration->machine.code != GB_OK) {
        *err = calibration->machine;
    }
    return false;
}

void gb_calibration_finish(struct gb_calibration *calibration)
{
    gb_calibrate_finish(&calibration->result);
    gb_compaction_data_targets_finish(&calibration->lab);
    gb_listing_free(calibration->rounds);
    calibration->rounds = NULL;
}

/* --- tables and text ------------------------------------------------------------------ */

enum { NAME_MAX_BYTES = 96 };

static const char no_influence[] = ": the data do not depend on it";

static const char *name_of(const struct gb_calibration *calibration, size_t k,
                           char *buffer)
{
    return gb_calibration_key_name(&calibration->keys.key[k], buffer, NAME_MAX_BYTES);
}

/* calibration.csv: a row per parameter. */
static GString *parameter_table(const struct gb_calibration *calibration)
{
    const struct gb_calibrate_result *result = &calibration->result;
    const size_t n = calibration->keys.count;
    char name[NAME_MAX_BYTES];
    struct gb_listing *listing = gb_listing_new();
    gb_listing_comment(listing,
                       "best fit, standard error and 95 % interval; SI, or the "
                       "multiple that the preset gives; open (1): the interval ends "
                       "at that limit of the range");
    gb_listing_columns(listing, "%s", "key,unit");
    gb_listing_columns(listing, "%.8g", "value,error,low_95,high_95");
    for (size_t k = 0; k < n; k++) {
        gb_listing_column(listing, "%.4f", "correlation_%s",
                          name_of(calibration, k, name));
    }
    gb_listing_columns(listing, "%.0f", "low_open,high_open");
    for (size_t k = 0; k < n; k++) {
        const struct gb_free_key *key = &calibration->keys.key[k];
        gb_listing_text(listing, name_of(calibration, k, name));
        gb_listing_text(listing, key->relative ? key->field->relative : "SI");
        gb_listing_number(listing, result->value[k]);
        gb_listing_number(listing, result->error[k]);
        gb_listing_number(listing, result->low[k]);
        gb_listing_number(listing, result->high[k]);
        gb_listing_numbers(listing, result->correlation[k], n);
        gb_listing_number(listing, result->low_open[k]);
        gb_listing_number(listing, result->high_open[k]);
    }
    return gb_listing_end(listing, GB_LISTING_CSV);
}

/* fit.csv: measured values beside those simulated with the best fit. */
static GString *fit_table(const struct gb_calibration *calibration)
{
    const struct gb_labdata *lab = &calibration->lab;
    struct gb_listing *listing = gb_listing_new();
    gb_listing_columns(listing, "%.0f", "scene");
    gb_listing_columns(listing, "%s", "branch");
    gb_listing_columns(listing, "%.12g", "p_MPa,measured,measured_error");
    gb_listing_columns(listing, "%.8g", "simulated");
    gb_listing_columns(listing, "%.3g", "se_simulated");
    gb_listing_columns(listing, "%s", "quantity");
    gb_listing_columns(listing, "%.12g", "weight");
    for (size_t i = 0; i < lab->count; i++) {
        const struct gb_labdata_row *row = &lab->row[i];
        gb_listing_whole(listing, row->scene + 1);
        gb_listing_text(listing, row->unloaded ? "unload" : "load");
        gb_listing_number(listing, row->pressure_pa / 1e6);
        gb_listing_number(listing, lab->value[i]);
        gb_listing_number(listing, lab->error != NULL ? lab->error[i] : (double)NAN);
        gb_listing_number(listing, calibration->result.fitted[i]);
        gb_listing_number(listing, calibration->result.fitted_error[i]);
        gb_listing_text(listing, gb_lab_quantity_rows[row->quantity].name);
        gb_listing_number(listing, lab->weight != NULL ? lab->weight[i] : 1.0);
    }
    return gb_listing_end(listing, GB_LISTING_CSV);
}

/* Root mean square of the residuals of each quantity. */
static void add_residuals(GString *text, const struct gb_calibration *calibration)
{
    const struct gb_labdata *lab = &calibration->lab;
    const char *between = "residuals: rms";
    for (int q = 0; q < GB_LAB_QUANTITIES; q++) {
        double squares = 0.0;
        size_t count = 0;
        for (size_t i = 0; i < lab->count; i++) {
            const double off = calibration->result.fitted[i] - lab->value[i];
            const bool is_own = lab->row[i].quantity == (enum gb_lab_quantity)q;
            squares += is_own ? off * off : 0.0;
            count += is_own;
        }
        if (count > 0) {
            g_string_append_printf(text, "%s %.2g in %s", between,
                                   sqrt(squares / (double)count),
                                   gb_lab_quantity_rows[q].label);
            between = ",";
        }
    }
}

static const char not_converged[] = "the fit has not converged";

bool gb_calibration_warns(const char *line)
{
    return line[0] == ' ' || g_str_has_prefix(line, not_converged) ||
           g_str_has_suffix(line, no_influence);
}

bool gb_calibration_write(const struct gb_calibration *calibration,
                          struct gb_preset *preset, struct gb_error *err)
{
    struct gb_params *params = gb_preset_params(preset);
    if (!calibration_apply(&calibration->keys, calibration->result.value, params, err)) {
        return false;
    }
    char *path = g_build_filename(calibration->directory, "calibrated.ini", NULL);
    const bool saved = gb_preset_save(preset, path, GB_PRESET_CHANGED_KEYS, err);
    g_free(path);
    return saved && write_table(calibration, "fit.csv", fit_table(calibration), err) &&
           write_table(calibration, GB_CALIBRATION_TABLE_TEXT,
                       gb_calibration_text(calibration), err) &&
           write_table(calibration, "calibration.csv", parameter_table(calibration), err);
}

static const char *unit_of(const struct gb_free_key *key)
{
    if (key->relative) {
        return key->field->relative;
    }
    return key->field->dimension != GB_DIM_NONE ? "(SI)" : "";
}

/* The value to the decimal place of its error; where the error is the larger one that
 * would be zero, outside of the range of most keys. */
static char *write_value(double value, double error, char number[GB_NUMBER_ERROR_MAX])
{
    if (error > fabs(value)) {
        g_snprintf(number, GB_NUMBER_ERROR_MAX, "%.2g +- %.2g", value, error);
        return number;
    }
    return gb_number_error(value, error, 2, " +- ", number);
}

static void add_parameter(GString *text, const struct gb_calibration *calibration,
                          size_t k)
{
    const struct gb_calibrate_result *result = &calibration->result;
    const struct gb_free_key *key = &calibration->keys.key[k];
    const char *unit = unit_of(key);
    char name[NAME_MAX_BYTES];
    name_of(calibration, k, name);
    if (isinf(result->error[k])) {
        g_string_append_printf(text, "%s%s\n", name, no_influence);
        return;
    }
    char number[GB_NUMBER_ERROR_MAX];
    g_string_append_printf(text, "%s = %s, 95 %%: %.4g to %.4g%s%s\n", name,
                           write_value(result->value[k], result->error[k], number),
                           result->low[k], result->high[k], *unit ? " " : "", unit);
    if (result->low_open[k] || result->high_open[k]) {
        const char *end = result->low_open[k] ? "lower limit" : "upper limit";
        g_string_append_printf(text,
                               "  the data leave the interval open: it ends at the %s of "
                               "the range %.4g to %.4g\n",
                               result->low_open[k] && result->high_open[k] ? "limits"
                                                                           : end,
                               key->low, key->high);
    }
    if (result->at_limit[k]) {
        g_string_append_printf(text,
                               "  at the limit of its range %.4g to %.4g: the best value "
                               "may lie beyond\n",
                               key->low, key->high);
    }
}

static void add_correlation(GString *text, const struct gb_calibration *calibration,
                            size_t i, size_t j)
{
    const struct gb_calibrate_result *result = &calibration->result;
    char first[NAME_MAX_BYTES], second[NAME_MAX_BYTES];
    name_of(calibration, i, first);
    name_of(calibration, j, second);
    g_string_append_printf(text, "correlation of %s and %s: %.2f\n", first, second,
                           result->correlation[i][j]);
    if (gb_calibrate_confounded(result, i, j)) {
        g_string_append_printf(text,
                               "  the data cannot separate %s and %s: fix one of them, "
                               "or add data that depend on them differently\n",
                               first, second);
    }
}

GString *gb_calibration_text(const struct gb_calibration *calibration)
{
    const struct gb_calibrate_result *result = &calibration->result;
    const size_t n = calibration->keys.count;
    GString *text = g_string_new(NULL);
    for (size_t k = 0; k < n; k++) {
        add_parameter(text, calibration, k);
    }
    for (size_t i = 0; i < n; i++) {
        for (size_t j = i + 1; j < n; j++) {
            add_correlation(text, calibration, i, j);
        }
    }
    add_residuals(text, calibration);
    if (isfinite(result->chi_squared) && result->degrees > 0) {
        g_string_append_printf(text, ", chi-squared %.3g for %zu degrees of freedom",
                               result->chi_squared, result->degrees);
    }
    g_string_append_printf(text, "\n%zu cells simulated, %zu of them failed\n",
                           result->simulated, result->failed);
    if (!result->converged) {
        g_string_append_printf(text, "%s within its rounds: intervals may be too wide\n",
                               not_converged);
    }
    return text;
}
