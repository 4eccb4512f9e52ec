#include "many/lab/labdata.h"

#include <math.h>
#include <string.h>

#include <glib.h>

#include "base/alloc.h"
#include "base/table.h"
#include "base/units.h"
#include "many/reading.h"
#include "many/runset.h"

/* Pressures that differ by less are one. */
static const double same_pressure = 1e-9;

/* "particles.diameter_nm" and 9.7: the assignment "particles.diameter=9.7 nm"; a name
 * without unit is a pure number.  Keys themselves may have '_'. */
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

/* Samples of one scene would be fitted as one curve. */
static bool check_series(const struct gb_table *table, struct gb_error *err)
{
    for (size_t i = 1; i < gb_table_rows(table) && has_series(table); i++) {
        const char *word = gb_table_word(table, i);
        if (strcmp(word, gb_table_word(table, 0)) != 0) {
            return gb_error_set(
                err, GB_ERR_INPUT,
                "%.200s:%d: series %.80s after %.80s; expected one, with "
                "--series, or columns of keys as particles.diameter_nm",
                gb_table_path(table), gb_table_line(table, i), word,
                gb_table_word(table, 0));
        }
    }
    return true;
}

/* Unloads from this pressure, too. */
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

/* The scene with the keys of a row, found or added. */
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

/* Cell of a column that a table may lack, or NaN. */
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

/* What has to be simulated for a row. */
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

/* One quantity of a row of the table, unless the row lacks it. */
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

/* Quantities that have a column, and whether any has errors. */
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
        return gb_error_set(err, GB_ERR_INPUT,
                            "%.200s: %zu rows, which must be between 1 and %d",
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

bool gb_labdata_take(struct gb_labdata *measured, const struct gb_table *table,
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
        gb_labdata_finish(measured);
    }
    return good;
}

double gb_labdata_simulated(const struct gb_labdata_row *row,
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

void gb_labdata_finish(struct gb_labdata *measured)
{
    gb_alloc_free(measured->row);
    gb_alloc_free(measured->value);
    gb_alloc_free(measured->error);
    gb_alloc_free(measured->weight);
    gb_alloc_free(measured->scene);
    *measured = (struct gb_labdata){0};
}
