/* Points for the equations of compaction, from runs or from a laboratory. */
#include "many/lab/compaction_data.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/table.h"
#include "io/measured.h"

/* --- curves of runs ------------------------------------------------------------------- */

/* Default beginning of the window of runs, over the highest pressure. */
static const double first_share = 0.01;

/* Window ends take points that differ by rounding. */
static const double slack = 1e-9;

/* Standard errors are smoothed over the points within this share of all on either side:
 * few replicas know the error of one point badly. */
static const double smoothing_share = 1.0 / 8.0;

/* Least standard error, over the mean of all: an error of 0 is chance. */
static const double least_error = 0.1;

/* Highest pressure that all curves reach. */
static double common_pressure(const struct gb_average_curve *curves, size_t count)
{
    double common = INFINITY;
    for (size_t c = 0; c < count; c++) {
        double most = -INFINITY;
        for (size_t i = 0; i < curves[c].count; i++) {
            most = fmax(most, curves[c].x[i]);
        }
        common = fmin(common, most);
    }
    return common;
}

static size_t fewest_points(const struct gb_average_curve *curves, size_t count,
                            double from, double to)
{
    size_t fewest = GB_COMPACTION_DATA_LEVELS;
    for (size_t c = 0; c < count; c++) {
        size_t inside = 0;
        for (size_t i = 0; i < curves[c].count; i++) {
            inside += curves[c].x[i] >= from && curves[c].x[i] <= to;
        }
        fewest = MIN(fewest, inside);
    }
    return fewest;
}

static bool reserve(struct gb_compaction_data *data, size_t count, size_t replicas,
                    struct gb_error *err)
{
    data->memory = gb_alloc_array((4 + replicas) * count, sizeof *data->memory, err);
    data->points.count = count;
    data->points.stride = count;
    return data->memory != NULL;
}

/* Root mean square of the errors around each point. */
static void smooth_errors(const double *raw, size_t count, double *smooth)
{
    const size_t reach = (size_t)ceil(smoothing_share * (double)count);
    double all = 0.0;
    for (size_t i = 0; i < count; i++) {
        all += raw[i] * raw[i] / (double)count;
    }
    for (size_t i = 0; i < count; i++) {
        const size_t from = i > reach ? i - reach : 0;
        const size_t to = MIN(i + reach, count - 1);
        double sum = 0.0;
        for (size_t k = from; k <= to; k++) {
            sum += raw[k] * raw[k];
        }
        smooth[i] = fmax(sqrt(sum / (double)(to - from + 1)), least_error * sqrt(all));
    }
}

static void fill_levels(struct gb_compaction_data *data,
                        const struct gb_average_curve *curves, size_t count, double from,
                        double to)
{
    const size_t size = data->points.count;
    double *pressure = data->memory;
    double *mean = pressure + size;
    double *raw = mean + size;
    double *error = raw + size;
    double *rows = error + size;
    for (size_t k = 0; k < size; k++) {
        const double share = size > 1 ? (double)k / (double)(size - 1) : 1.0;
        pressure[k] = k + 1 == size ? to : from * pow(to / from, share);
        for (size_t c = 0; c < count; c++) {
            rows[c * size + k] = gb_average_crossing(&curves[c], pressure[k], NULL);
        }
    }
    gb_average_rows(rows, count, size, GB_AVERAGE_ALL, mean, raw);
    data->points.pressure = pressure;
    data->points.density = mean;
    data->points.rows = rows;
    data->points.replicas = count;
    if (count > 1) {
        smooth_errors(raw, size, error);
        data->points.error = error[0] > 0.0 ? error : NULL;
    }
}

/* Levels that a curve only touches from above have no density: they are left out. */
static void drop_missing(struct gb_equations_points *points, double *memory)
{
    size_t first = 0;
    while (first < points->count && !isfinite(memory[points->stride + first])) {
        first++;
    }
    points->pressure += first;
    points->density += first;
    points->error = points->error != NULL ? points->error + first : NULL;
    points->rows += first;
    points->count -= first;
}

static void set_initial(struct gb_equations_points *points, double initial,
                        const struct gb_compaction_window *window)
{
    points->initial = isnan(window->initial) ? initial : window->initial;
    if (window->fits_initial) {
        points->initial = NAN;
    }
}

bool gb_compaction_data_curves(struct gb_compaction_data *data,
                               const struct gb_average_curve *curves, size_t count,
                               double initial, const struct gb_compaction_window *window,
                               struct gb_error *err)
{
    const double most = common_pressure(curves, count);
    const double to = isnan(window->to) ? most : fmin(window->to, most);
    const double from = isnan(window->from) ? first_share * most : window->from;
    *data = (struct gb_compaction_data){.curves = count};
    const size_t levels =
        from > 0.0 && from < to
            ? fewest_points(curves, count, from * (1.0 - slack), to * (1.0 + slack))
            : 0;
    if (levels < 2) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "loading has no two points between %g and %g MPa", from, to);
    }
    if (!reserve(data, levels, count, err)) {
        return false;
    }
    fill_levels(data, curves, count, from, to);
    drop_missing(&data->points, data->memory);
    set_initial(&data->points, initial, window);
    return true;
}

/* Density of the last row before loading; NaN: there is none. */
static double density_before(const struct gb_runset_run *run)
{
    const double *density = gb_table_column(run->table, "density", NULL);
    double before = NAN;
    for (size_t i = 0; density != NULL && i < gb_table_rows(run->table); i++) {
        if (strcmp(gb_table_word(run->table, i), "load") == 0) {
            break;
        }
        before = isfinite(density[i]) ? density[i] : before;
    }
    return before;
}

bool gb_compaction_data_runs(struct gb_compaction_data *data, const struct gb_runset *set,
                             size_t group, const struct gb_compaction_window *window,
                             struct gb_error *err)
{
    struct gb_average_curve *curves = g_new0(struct gb_average_curve, set->count + 1);
    double **arrays = g_new0(double *, 2 * set->count + 1);
    double initial = 0.0;
    size_t members = 0;
    bool good = true;
    *data = (struct gb_compaction_data){0};
    for (size_t i = 0; i < set->count && good; i++) {
        const struct gb_runset_run *run = &set->run[i];
        if (run->group == group) {
            struct gb_average_curve *curve = &curves[members];
            double **x = &arrays[2 * members];
            good = gb_runset_points(run, "load", "p_MPa", "density", &x[0], &x[1],
                                    &curve->count, err);
            curve->x = x[0];
            curve->y = x[1];
            initial += good ? density_before(run) : 0.0;
            members += good;
        }
    }
    struct gb_error cause = {0};
    if (good && !gb_compaction_data_curves(data, curves, members,
                                           initial / (double)members, window, &cause)) {
        good = gb_error_set(err, cause.code, "%.300s: %s",
                            gb_runset_first(set, group)->directory, cause.text);
    }
    for (size_t i = 0; i < 2 * set->count; i++) {
        gb_alloc_free(arrays[i]);
    }
    g_free(arrays);
    g_free(curves);
    if (!good) {
        gb_compaction_data_finish(data);
    }
    return good;
}

/* --- a table of a laboratory ---------------------------------------------------------- */

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
                                    "%.200s:%d: %.80s changes; expected one powder, the "
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
        gb_error_set(err, GB_ERR_INPUT, "%.200s: expected one series of %s",
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
                                "%.200s:%d: branch %.80s: expected load or unload",
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

bool gb_compaction_data_file(struct gb_compaction_data *data,
                             const struct gb_table *table, const char *series,
                             const struct gb_compaction_window *window,
                             struct gb_error *err)
{
    struct gb_measured *measured = NULL;
    const char *path = gb_table_path(table);
    *data = (struct gb_compaction_data){0};
    if (!gb_measured_take(&measured, table, true, err)) {
        return false;
    }
    if (measured->count > ROWS_MAX) {
        gb_error_set(err, GB_ERR_INPUT, "%.200s: %zu rows; expected up to %d", path,
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

void gb_compaction_data_finish(struct gb_compaction_data *data)
{
    gb_alloc_free(data->memory);
    *data = (struct gb_compaction_data){0};
}
