/* Data for fits of compaction equations.  The first part reads measured quantities and
 * the scenes that simulate them (gb_compaction_data_take), for calibration.  The second
 * part turns the curves of runs or a laboratory table into points of pressure and
 * density, at which equations are fitted. */

#include "many/compaction_data.h"

#include <glib.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/table.h"
#include "base/units.h"
#include "greenbody/params.h"
#include "io/lab/lab_quantity.h"
#include "io/measured.h"
#include "many/reading.h"
#include "many/runset.h"

enum { GB_LABDATA_ROWS = 4096, GB_LABDATA_SCENES = 64 };

/* Relative difference below which two pressures are equal. */
static const double same_pressure = 1e-9;

/* Sets a key from a column: "particles.diameter_nm" and 9.7 become
 * "particles.diameter=9.7 nm".  A column without a unit is a pure number.  Keys may
 * contain '_' themselves. */
static bool assign(struct gb_params *params, const char *column, double value,
                   struct gb_error *err)
{
    char number[G_ASCII_DTOSTR_BUF_SIZE];
    char **words = g_strsplit(column, ".", 2);
    char *key = words[1];
    const char *unit = "";
    g_ascii_formatd(number, sizeof number, "%.15g", value);
    if (gb_params_find(words[0], key) == NULL && strrchr(key, '_') != NULL) {
        char *low = strrchr(key, '_');
        *low = '\0';
        unit = low + 1;
    }
    const struct gb_field *field = gb_params_find(words[0], key);
    char *text = g_strconcat(number, *unit ? " " : "", unit, NULL);
    const bool good =
        field != NULL ? gb_params_set(params, field, text, err)
                      : gb_error_set(err, GB_ERR_INPUT,
                                     "column %.80s: no such key, or key_unit", column);
    g_free(text);
    g_strfreev(words);
    return good;
}

static bool is_known(const char *name)
{
    static const char *const known[] = {"p_MPa",         "density", "p_MPa_error",
                                        "density_error", "branch",  "series"};
    if (gb_lab_quantity_is_further(name)) {
        return true;
    }
    for (size_t i = 0; i < G_N_ELEMENTS(known); i++) {
        if (strcmp(name, known[i]) == 0) {
            return true;
        }
    }
    return strchr(name, '.') != NULL;
}

static bool check_columns(const struct gb_table *table, struct gb_error *err)
{
    for (size_t k = 0; gb_table_name(table, k) != NULL; k++) {
        if (!is_known(gb_table_name(table, k))) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "%.200s: column %.80s; expected p_MPa, density, "
                                "lateral_ratio, coordination, unloading_modulus_GPa, "
                                "their _error, weight, branch, series and keys as "
                                "particles.diameter_nm",
                                gb_table_path(table), gb_table_name(table, k));
        }
    }
    return true;
}

static bool has_series(const struct gb_table *table)
{
    const char *words = gb_table_words(table);
    return words != NULL && strcmp(words, "series") == 0;
}

/* Rejects tables with several samples in one scene, which would be fitted as one curve.
 */
static bool check_series(const struct gb_table *table, struct gb_error *err)
{
    for (size_t i = 1; i < gb_table_rows(table) && has_series(table); i++) {
        const char *word = gb_table_word(table, i);
        if (strcmp(word, gb_table_word(table, 0)) != 0) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "%.200s:%d: series %.80s after %.80s; expected one, with "
                                "--series, or columns of keys as particles.diameter_nm",
                                gb_table_path(table), gb_table_line(table, i), word,
                                gb_table_word(table, 0));
        }
    }
    return true;
}

/* Adds unloading from this pressure to the scene. */
static bool add_unloading(struct gb_params *scene, double pressure_pa)
{
    int at = 0;
    while (at < scene->unload_count &&
           scene->unload_from_pa[at] < pressure_pa * (1.0 - same_pressure)) {
        at++;
    }
    if (at < scene->unload_count &&
        scene->unload_from_pa[at] <= pressure_pa * (1.0 + same_pressure)) {
        return true;
    }
    if (scene->unload_count == GB_UNLOAD_MAX) {
        return false;
    }
    for (int i = scene->unload_count++; i > at; i--) {
        scene->unload_from_pa[i] = scene->unload_from_pa[i - 1];
    }
    scene->unload_from_pa[at] = pressure_pa;
    return true;
}

/* Finds or adds the scene with the keys of a row. */
static bool find_scene(struct gb_labdata *measured, const struct gb_table *table,
                       size_t row, const struct gb_params *base, size_t *scene,
                       struct gb_error *err)
{
    struct gb_params params = *base;
    for (size_t k = 0; gb_table_name(table, k) != NULL; k++) {
        const char *name = gb_table_name(table, k);
        const double *column =
            strchr(name, '.') ? gb_table_column(table, name, err) : NULL;
        if (column != NULL && !isnan(column[row]) &&
            !assign(&params, name, column[row], err)) {
            return false;
        }
    }
    params.unload_count = 0;
    params.until_density = NAN;
    params.until_pressure_pa = 0.0;
    for (*scene = 0; *scene < measured->scenes; (*scene)++) {
        struct gb_params other = measured->scene[*scene];
        other.unload_count = 0;
        other.until_pressure_pa = 0.0;
        memset(other.unload_from_pa, 0, sizeof other.unload_from_pa);
        memset(params.unload_from_pa, 0, sizeof params.unload_from_pa);
        if (gb_runset_same(&params, &other)) {
            return true;
        }
    }
    if (measured->scenes == GB_LABDATA_SCENES) {
        return gb_error_set(err, GB_ERR_INPUT, "%.200s: more than %d different scenes",
                            gb_table_path(table), GB_LABDATA_SCENES);
    }
    measured->scene[measured->scenes++] = params;
    return true;
}

static bool refuse_row(const struct gb_table *table, size_t row, const char *what,
                       struct gb_error *err)
{
    return gb_error_set(err, GB_ERR_INPUT, "%.200s:%d: %s", gb_table_path(table),
                        gb_table_line(table, row), what);
}

/* Cell of an optional column; NaN if the table lacks it. */
static double cell(const struct gb_table *table, const char *column, size_t row)
{
    const double *values = gb_table_column(table, column, NULL);
    return values != NULL ? values[row] : (double)NAN;
}

static bool refuse_value(const struct gb_table *table, size_t row,
                         const struct gb_lab_quantity_row *quantity, struct gb_error *err)
{
    char what[200];
    g_snprintf(what, sizeof what,
               isfinite(quantity->most) ? "%s must be between %g and %g"
                                        : "%s must be above %g",
               quantity->name, quantity->least, quantity->most);
    return refuse_row(table, row, what, err);
}

/* Extends the scene of a row so that its simulation reaches the row. */
static bool extend_scene(struct gb_labdata *measured, const struct gb_table *table,
                         const struct gb_labdata_row *row, struct gb_error *err)
{
    struct gb_params *scene = &measured->scene[row->scene];
    const bool unloads =
        row->unloaded || row->quantity == GB_LAB_QUANTITY_UNLOADING_MODULUS;
    scene->until_pressure_pa = fmax(scene->until_pressure_pa, row->pressure_pa);
    return !unloads || add_unloading(scene, row->pressure_pa) ||
           gb_error_set(err, GB_ERR_INPUT,
                        "%.200s: more than %d pressures of unloading in one scene",
                        gb_table_path(table), GB_UNLOAD_MAX);
}

/* Takes one quantity of a row of the table, unless the cell is empty. */
static bool take_quantity(struct gb_labdata *measured, const struct gb_table *table,
                          size_t at, struct gb_labdata_row row, struct gb_error *err)
{
    const struct gb_lab_quantity_row *quantity = &gb_lab_quantity_rows[row.quantity];
    const double value = cell(table, quantity->name, at);
    const double error = cell(table, quantity->error, at);
    if (isnan(value)) {
        return true;
    }
    if (!(value > quantity->least && value < quantity->most)) {
        return refuse_value(table, at, quantity, err);
    }
    if (measured->error != NULL && !(error > 0.0)) {
        return refuse_row(table, at,
                          "expected an error above 0 for each value (of several "
                          "quantities, or where one row has an error)",
                          err);
    }
    if (row.unloaded && row.quantity == GB_LAB_QUANTITY_LATERAL_RATIO) {
        return refuse_row(table, at, "a lateral ratio: expected on branch load", err);
    }
    const double weight = cell(table, "weight", at);
    if (measured->weight != NULL && weight <= 0.0) {
        return refuse_row(table, at, "weight must be above 0", err);
    }
    measured->row[measured->count] = row;
    measured->value[measured->count] = value;
    if (measured->error != NULL) {
        measured->error[measured->count] = error;
    }
    if (measured->weight != NULL) {
        measured->weight[measured->count] = isnan(weight) ? 1.0 : weight;
    }
    measured->count++;
    return extend_scene(measured, table, &row, err);
}

static bool take_row(struct gb_labdata *measured, const struct gb_table *table, size_t at,
                     const struct gb_params *base, struct gb_error *err)
{
    const double *pressure = gb_table_column(table, "p_MPa", NULL);
    const char *word = has_series(table) ? "" : gb_table_word(table, at);
    const size_t before = measured->count;
    struct gb_labdata_row row = {.unloaded = strcmp(word, "unload") == 0};
    if (!(pressure[at] > 0.0)) {
        return refuse_row(table, at, "p_MPa: expected a pressure above 0", err);
    }
    if (!(row.unloaded || *word == '\0' || strcmp(word, "load") == 0)) {
        return refuse_row(table, at, "branch: expected load or unload", err);
    }
    if (!find_scene(measured, table, at, base, &row.scene, err)) {
        return false;
    }
    row.pressure_pa = 1e6 * pressure[at];
    for (int q = 0; q < GB_LAB_QUANTITIES; q++) {
        row.quantity = (enum gb_lab_quantity)q;
        if (!take_quantity(measured, table, at, row, err)) {
            return false;
        }
    }
    return measured->count > before ||
           refuse_row(table, at, "expected one measured value at least", err);
}

/* Counts the quantities that have a column, and checks whether any has errors. */
static size_t count_quantities(const struct gb_table *table, bool *errors)
{
    size_t count = 0;
    *errors = false;
    for (int q = 0; q < GB_LAB_QUANTITIES; q++) {
        const struct gb_lab_quantity_row *row = &gb_lab_quantity_rows[q];
        count += gb_table_column(table, row->name, NULL) != NULL;
        *errors = *errors || gb_table_column(table, row->error, NULL) != NULL;
    }
    return count;
}

static bool alloc_rows(struct gb_labdata *measured, const struct gb_table *table,
                       struct gb_error *err)
{
    bool errors = false;
    const size_t rows = gb_table_rows(table);
    const size_t quantities = count_quantities(table, &errors);
    const bool weights = gb_table_column(table, "weight", NULL) != NULL;
    if (rows == 0 || rows > GB_LABDATA_ROWS) {
        return gb_error_set(err, GB_ERR_INPUT, "%.200s: has %zu rows; expected 1 to %d",
                            gb_table_path(table), rows, GB_LABDATA_ROWS);
    }
    if (quantities == 0) {
        return gb_table_column(table, gb_lab_quantity_rows[0].name, err) != NULL;
    }
    errors = errors || quantities > 1;
    const size_t most = rows * quantities;
    measured->row = gb_alloc_array(most, sizeof *measured->row, err);
    measured->value = gb_alloc_array(most, sizeof(double), err);
    measured->error = errors ? gb_alloc_array(most, sizeof(double), err) : NULL;
    measured->weight = weights ? gb_alloc_array(most, sizeof(double), err) : NULL;
    measured->scene = gb_alloc_array(GB_LABDATA_SCENES, sizeof *measured->scene, err);
    return measured->row && measured->value && measured->scene &&
           (measured->error || !errors) && (measured->weight || !weights);
}

bool gb_compaction_data_take(struct gb_labdata *measured, const struct gb_table *table,
                             const struct gb_params *params, struct gb_error *err)
{
    *measured = (struct gb_labdata){0};
    bool good = check_columns(table, err) && check_series(table, err) &&
                gb_table_column(table, "p_MPa", err) != NULL &&
                alloc_rows(measured, table, err);
    for (size_t i = 0; i < gb_table_rows(table) && good; i++) {
        good = take_row(measured, table, i, params, err);
    }
    for (size_t s = 0; s < measured->scenes && good; s++) {
        good = gb_params_check(&measured->scene[s], err);
    }
    if (!good) {
        gb_compaction_data_targets_finish(measured);
    }
    return good;
}

double gb_compaction_data_simulated(const struct gb_labdata_row *row,
                                    const struct gb_table *curve)
{
    double values[GB_READING_QUANTITIES] = {NAN};
    if (row->quantity == GB_LAB_QUANTITY_UNLOADING_MODULUS) {
        return gb_reading_unloading_modulus(curve, row->pressure_pa) / 1e9;
    }
    if (!(row->unloaded ? gb_reading_unloaded
                        : gb_reading_loaded)(curve, row->pressure_pa, values)) {
        return NAN;
    }
    switch (row->quantity) {
    case GB_LAB_QUANTITY_LATERAL_RATIO:
        return values[GB_READING_PX] / values[GB_READING_PZ];
    case GB_LAB_QUANTITY_COORDINATION:
        return values[GB_READING_COORDINATION];
    default:
        return values[GB_READING_DENSITY];
    }
}

void gb_compaction_data_targets_finish(struct gb_labdata *measured)
{
    gb_alloc_free(measured->row);
    gb_alloc_free(measured->value);
    gb_alloc_free(measured->error);
    gb_alloc_free(measured->weight);
    gb_alloc_free(measured->scene);
    *measured = (struct gb_labdata){0};
}

/* --- curves of runs ----------------------------------------------------------------- */

/* Default start of the window for runs, as a fraction of the highest pressure. */
static const double first_share = 0.01;

/* Relative tolerance at the ends of the window, for rounding. */
static const double slack = 1e-9;

/* Standard errors are smoothed over this fraction of all points on either side, because
 * few replicas give an uncertain error at a single point. */
static const double smoothing_share = 1.0 / 8.0;

/* Least standard error, over the mean of all errors.  A smaller one is due to chance. */
static const double least_error = 0.1;

/* The highest pressure that all curves reach. */
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

/* Running root mean square of the errors. */
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

/* Drops the first levels, at which a curve that comes from above has no density. */
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

/* Density of the last row before loading; NaN if there is none. */
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

/* --- a table of a laboratory -------------------------------------------------------- */

enum { ROWS_MAX = 100000 }; /* the search for Heckel's linear range tests all pairs */

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

/* Rejects rows of several powders in one file, which would be fitted as one curve. */
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

/* Has an earlier row the same word as this row? */
static bool is_repeated(const struct gb_table *table, size_t row)
{
    for (size_t i = 0; i < row; i++) {
        if (strcmp(gb_table_word(table, i), gb_table_word(table, row)) == 0) {
            return true;
        }
    }
    return false;
}

/* Name of the series to be fitted; NULL after an error. */
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

/* Checks that a row's branch is a known word of curve.csv or of laboratory files. */
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

/* Selects the marked points within the window, in ascending order, and returns their
 * number.  Rows at pressure 0 describe the powder before loading: initial receives
 * their mean density, NaN if there are none. */
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
