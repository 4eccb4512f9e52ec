#include "study/calibrate/calibration_table.h"

#include <math.h>

#include "base/file.h"
#include "base/number.h"
#include "base/units.h"

enum { NAME_MAX_BYTES = 96 };

static const char no_influence[] = ": the data do not depend on it";

static const char *name_of(const struct gb_calibration *calibration, size_t k,
                           char *buffer)
{
    return gb_calibration_name(&calibration->keys.key[k], buffer, NAME_MAX_BYTES);
}

/* calibration.csv: a row per parameter. */
static GString *parameter_table(const struct gb_calibration *calibration)
{
    const struct gb_calibrate_result *result = &calibration->result;
    const size_t n = calibration->keys.count;
    char name[NAME_MAX_BYTES];
    GString *text = g_string_new(
        "# best fit, standard error and 95 % interval; SI, or the "
        "multiple that the preset gives; open (1): the interval ends at that "
        "limit of the range\nkey,unit,value,error,low_95,high_95");
    for (size_t k = 0; k < n; k++) {
        g_string_append_printf(text, ",correlation_%s", name_of(calibration, k, name));
    }
    g_string_append(text, ",low_open,high_open");
    for (size_t k = 0; k < n; k++) {
        const struct gb_free_key *key = &calibration->keys.key[k];
        g_string_append_printf(
            text, "\n%s,%s,%.8g,%.8g,%.8g,%.8g", name_of(calibration, k, name),
            key->relative ? key->field->relative : "SI", result->value[k],
            result->error[k], result->low[k], result->high[k]);
        for (size_t l = 0; l < n; l++) {
            g_string_append_printf(text, ",%.4f", result->correlation[k][l]);
        }
        g_string_append_printf(text, ",%d,%d", result->low_open[k], result->high_open[k]);
    }
    g_string_append_c(text, '\n');
    return text;
}

/* fit.csv: measured values beside those simulated with the best fit. */
static GString *fit_table(const struct gb_calibration *calibration)
{
    const struct gb_labdata *lab = &calibration->lab;
    GString *text = g_string_new("scene,branch,p_MPa,measured,measured_error,simulated,"
                                 "se_simulated,quantity,weight\n");
    for (size_t i = 0; i < lab->count; i++) {
        const struct gb_labdata_row *row = &lab->row[i];
        g_string_append_printf(text, "%zu,%s,%.12g,%.12g,", row->scene + 1,
                               row->unloaded ? "unload" : "load", row->pressure_pa / 1e6,
                               lab->value[i]);
        if (lab->error != NULL) {
            g_string_append_printf(text, "%.12g", lab->error[i]);
        }
        g_string_append_printf(
            text, ",%.8g,%.3g,%s,%.12g\n", calibration->result.fitted[i],
            calibration->result.fitted_error[i], gb_lab_quantity_rows[row->quantity].name,
            lab->weight != NULL ? lab->weight[i] : 1.0);
    }
    return text;
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

static bool write_table(const struct gb_calibration *calibration, const char *name,
                        GString *text, struct gb_error *err)
{
    char *path = g_build_filename(calibration->directory, name, NULL);
    const bool good = gb_file_replace(path, text->str, text->len, err);
    g_free(path);
    g_string_free(text, TRUE);
    return good;
}

static const char not_converged[] = "the fit has not converged";

bool gb_calibration_table_warns(const char *line)
{
    return line[0] == ' ' || g_str_has_prefix(line, not_converged) ||
           g_str_has_suffix(line, no_influence);
}

bool gb_calibration_table_write(const struct gb_calibration *calibration,
                                struct gb_preset *preset, struct gb_error *err)
{
    struct gb_params *params = gb_preset_params(preset);
    if (!gb_free_keys_apply(&calibration->keys, calibration->result.value, params, err)) {
        return false;
    }
    char *path = g_build_filename(calibration->directory, "calibrated.ini", NULL);
    const bool saved = gb_preset_save(preset, path, GB_PRESET_CHANGED_KEYS, err);
    g_free(path);
    return saved && write_table(calibration, "fit.csv", fit_table(calibration), err) &&
           write_table(calibration, GB_CALIBRATION_TABLE_TEXT,
                       gb_calibration_table_text(calibration), err) &&
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

GString *gb_calibration_table_text(const struct gb_calibration *calibration)
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
