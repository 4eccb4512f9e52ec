#include "many/lab/compaction_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "io/measured.h"

enum { ROWS_MAX = 100000 }; /* the search for Heckel's stretch goes over all pairs */

/* A measured point. */
struct sample {
    double pressure, density, error;
};

static int compare_samples(const void *a, const void *b)
{
    const struct sample *one = a;
    const struct sample *other = b;
    return (one->pressure > other->pressure) - (one->pressure < other->pressure);
}

/* Rows of several powders in one file would be fitted as one curve. */
static bool check_samples(const struct gb_table *table, struct gb_error *err)
{
    for (size_t k = 0; gb_table_name(table, k) != NULL; k++) {
        const char *name = gb_table_name(table, k);
        const double *column = gb_table_column(table, name, NULL);
        for (size_t i = 1; strchr(name, '.') != NULL && i < gb_table_rows(table); i++) {
            if (column[i] != column[0] && !(isnan(column[i]) && isnan(column[0]))) {
                return gb_error_set(err, GB_ERR_INPUT,
                                    "%.200s:%d: %.80s changes; accepted one powder, the "
                                    "others in files of their own",
                                    gb_table_path(table), gb_table_line(table, i), name);
            }
        }
    }
    return true;
}

/* Whether an earlier row has the word of this one. */
static bool is_repeated(const struct gb_table *table, size_t row)
{
    for (size_t i = 0; i < row; i++) {
        if (strcmp(gb_table_word(table, i), gb_table_word(table, row)) == 0) {
            return true;
        }
    }
    return false;
}

/* The series to be fitted; NULL after an error. */
static const char *choose_series(const struct gb_table *table, const char *series,
                                 struct gb_error *err)
{
    GString *names = g_string_new(NULL);
    const char *chosen = NULL;
    size_t different = 0;
    for (size_t i = 0; i < gb_table_rows(table); i++) {
        const char *word = gb_table_word(table, i);
        if (names->len < 200 && !is_repeated(table, i)) {
            g_string_append_printf(names, "%s%.40s", different++ > 0 ? ", " : "", word);
        }
        chosen = series == NULL || strcmp(word, series) == 0 ? word : chosen;
    }
    if (chosen == NULL || (series == NULL && different > 1)) {
        chosen = NULL;
        gb_error_set(err, GB_ERR_INPUT, "%.200s: accepted one series of %s",
                     gb_table_path(table), names->str);
    }
    g_string_free(names, TRUE);
    return chosen;
}

/* Stages besides loading, of curve.csv and of laboratory files. */
static bool check_branch(const struct gb_table *table, size_t row, struct gb_error *err)
{
    static const char *const known[] = {"load", "unload", "relax", "hold"};
    const char *word = gb_table_word(table, row);
    bool good = *word == '\0';
    for (size_t k = 0; k < G_N_ELEMENTS(known) && !good; k++) {
        good = g_str_has_prefix(word, known[k]);
    }
    return good || gb_error_set(err, GB_ERR_INPUT,
                                "%.200s:%d: branch %.80s: accepted load or unload",
                                gb_table_path(table), gb_table_line(table, row), word);
}

/* Marks the rows to be fitted. */
static bool choose_rows(bool *chosen, const struct gb_table *table, const char *series,
                        struct gb_error *err)
{
    const char *column = gb_table_words(table);
    const bool by_series = column != NULL && strcmp(column, "series") == 0;
    const char *wanted = by_series ? choose_series(table, series, err) : "load";
    bool good = wanted != NULL && check_samples(table, err);
    if (good && series != NULL && !by_series) {
        good = gb_error_set(err, GB_ERR_INPUT, "%.200s: has no column series",
                            gb_table_path(table));
    }
    for (size_t i = 0; i < gb_table_rows(table) && good; i++) {
        const char *word = gb_table_word(table, i);
        good = by_series || check_branch(table, i, err);
        chosen[i] = strcmp(word, wanted) == 0 || (!by_series && *word == '\0');
    }
    return good;
}

static bool inside(const struct gb_compaction_window *window, double pressure)
{
    return !(pressure < window->from) && !(pressure > window->to);
}

/* The chosen points of the window, in ascending order; their number.  Rows at pressure 0
 * are the powder before loading: initial gets their mean density, NaN without any. */
static size_t select_samples(struct sample *samples, const struct gb_measured *measured,
                             const bool *chosen,
                             const struct gb_compaction_window *window, double *initial)
{
    size_t count = 0;
    size_t unloaded = 0;
    double sum = 0.0;
    for (size_t i = 0; i < measured->count; i++) {
        const struct sample sample = {1e-6 * measured->pressure_pa[i],
                                      measured->density[i], measured->density_error[i]};
        if (chosen[i] && sample.pressure == 0.0) {
            sum += sample.density;
            unloaded++;
        } else if (chosen[i] && inside(window, sample.pressure)) {
            samples[count++] = sample;
        }
    }
    *initial = unloaded > 0 ? sum / (double)unloaded : (double)NAN;
    qsort(samples, count, sizeof *samples, compare_samples);
    return count;
}

static bool fill(struct gb_compaction_data *data, const struct sample *samples,
                 size_t count, double initial, const struct gb_compaction_window *window,
                 struct gb_error *err)
{
    double *pressure = gb_alloc_array(3 * count, sizeof *pressure, err);
    if (pressure == NULL) {
        return false;
    }
    double *density = pressure + count;
    double *error = density + count;
    bool known = true;
    for (size_t i = 0; i < count; i++) {
        pressure[i] = samples[i].pressure;
        density[i] = samples[i].density;
        error[i] = samples[i].error;
        known = known && samples[i].error > 0.0;
    }
    data->memory = pressure;
    data->points = (struct gb_equations_points){
        .count = count,
        .pressure = pressure,
        .density = density,
        .error = known ? error : NULL,
        .initial = isnan(window->initial) ? initial : window->initial};
    if (window->fits_initial) {
        data->points.initial = NAN;
    }
    return true;
}

bool gb_compaction_file(struct gb_compaction_data *data, const struct gb_table *table,
                        const char *series, const struct gb_compaction_window *window,
                        struct gb_error *err)
{
    struct gb_measured *measured = NULL;
    const char *path = gb_table_path(table);
    *data = (struct gb_compaction_data){0};
    if (!gb_measured_take(&measured, table, true, err)) {
        return false;
    }
    if (measured->count > ROWS_MAX) {
        gb_error_set(err, GB_ERR_INPUT, "%.200s: %zu rows; accepted up to %d", path,
                     measured->count, ROWS_MAX);
        gb_measured_destroy(measured);
        return false;
    }
    struct sample *samples = gb_alloc_array(measured->count, sizeof *samples, err);
    bool *chosen = gb_alloc_array(measured->count, sizeof *chosen, err);
    bool good =
        samples != NULL && chosen != NULL && choose_rows(chosen, table, series, err);
    if (good) {
        double initial = NAN;
        const size_t count = select_samples(samples, measured, chosen, window, &initial);
        good = count > 0
                   ? fill(data, samples, count, initial, window, err)
                   : gb_error_set(err, GB_ERR_INPUT,
                                  "%.200s: no point of loading in the window", path);
    }
    gb_alloc_free(chosen);
    gb_alloc_free(samples);
    gb_measured_destroy(measured);
    return good;
}
