#include "figures/figures_compute.h"

#include <math.h>
#include <string.h>

#include "base/table.h"

/* Tables that differ by styles: of five curves, seven styles. */
enum { TABLES_MAX = 2, CURVES_MAX = 5 };

/* A column of moduli.csv and its label; name NULL: the end. */
struct quantity {
    const char *column, *label;
    bool below; /* in the panel below */
};

/* A table and what it is called in the legend. */
struct source {
    struct gb_table *table;
    char *name; /* NULL: the only one */
};

static void finish(struct source source[TABLES_MAX])
{
    for (int k = 0; k < TABLES_MAX; k++) {
        gb_table_destroy(source[k].table);
        g_free(source[k].name);
    }
}

/* A folder of `greenbody moduli --out`, a run directory, or the table itself. */
static bool read_source(struct source *source, const char *word, bool alone,
                        struct gb_error *err)
{
    const bool folder = g_file_test(word, G_FILE_TEST_IS_DIR);
    char *path = folder ? g_build_filename(word, "moduli.csv", NULL) : g_strdup(word);
    bool good = true;
    if (folder && !g_file_test(path, G_FILE_TEST_EXISTS)) {
        good =
            gb_error_set(err, GB_ERR_INPUT,
                         "%.300s: no moduli.csv; greenbody moduli --out writes it", word);
    }
    good = good && gb_table_read(&source->table, path, NULL, err);
    if (good && gb_table_rows(source->table) == 0) {
        good = gb_error_set(err, GB_ERR_INPUT, "%.300s: no states", path);
    }
    if (good && !alone) {
        char *base = g_path_get_basename(word);
        source->name = g_markup_escape_text(base, -1);
        g_free(base);
    }
    g_free(path);
    return good;
}

static bool read_sources(struct source source[TABLES_MAX],
                         const struct gb_figures_input *input, struct gb_error *err)
{
    const guint count = g_strv_length((char **)input->words);
    if (count < 1 || count > TABLES_MAX) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "figures of moduli take 1 to %d folders with moduli.csv",
                            TABLES_MAX);
    }
    for (guint k = 0; k < count; k++) {
        if (!read_source(&source[k], input->words[k], count == 1, err)) {
            return false;
        }
    }
    return true;
}

static const double *find_error(const struct gb_table *table, const char *column)
{
    char *name = g_strdup_printf("error_%s", column);
    const double *found = gb_table_column(table, name, NULL);
    g_free(name);
    return found;
}

/* A column of the table as one of the series, NaN where there are no errors. */
static const double *copy(struct gb_series *series, const struct gb_table *table,
                          const double *column, const char *name, int number)
{
    double *to = gb_series_column(series, "%s_%d", name, number);
    for (size_t k = 0; k < gb_table_rows(table) && column != NULL; k++) {
        to[k] = column[k];
    }
    return to;
}

static bool has_values(const struct gb_table *table, const double *column)
{
    bool some = false;
    for (size_t k = 0; k < gb_table_rows(table); k++) {
        some = some || isfinite(column[k]);
    }
    return some;
}

/* Curves of one table; *drawn counts them. */
static bool draw_source(struct gb_series *series, const struct source *source, int number,
                        const struct quantity *quantity, int *drawn, struct gb_error *err)
{
    const struct gb_table *table = source->table;
    const double *density = gb_table_column(table, "density", err);
    if (density == NULL) {
        return false;
    }
    const double *x = copy(series, table, density, "density", number);
    (void)copy(series, table, find_error(table, "density"), "error_density", number);
    for (int k = 0; quantity[k].column != NULL; k++) {
        const double *column = gb_table_column(table, quantity[k].column, err);
        if (column == NULL) {
            return false;
        }
        if (!has_values(table, column)) {
            continue;
        }
        char *error = g_strdup_printf("error_%s", quantity[k].column);
        char *label = source->name != NULL
                          ? g_strdup_printf("%s, %s", quantity[k].label, source->name)
                          : g_strdup(quantity[k].label);
        const double *y = copy(series, table, column, quantity[k].column, number);
        const double *y_error =
            copy(series, table, find_error(table, quantity[k].column), error, number);
        struct gb_series_curve *curve =
            gb_series_draw(series, x, y, y_error, GB_FIGURE_BOTH, *drawn,
                           quantity[k].below ? NULL : label);
        curve->x_error = curve->x + 1;
        curve->below = quantity[k].below;
        curve->open = number > 1;
        curve->rows = gb_table_rows(table);
        (*drawn)++;
        g_free(error);
        g_free(label);
    }
    return true;
}

static bool draw(struct gb_series *series, const struct gb_figures_input *input,
                 const struct quantity *quantity, struct gb_error *err)
{
    struct source source[TABLES_MAX] = {{NULL, NULL}};
    size_t rows = 0;
    int drawn = 0;
    bool good = read_sources(source, input, err);
    for (int k = 0; k < TABLES_MAX && good && source[k].table != NULL; k++) {
        rows = MAX(rows, gb_table_rows(source[k].table));
    }
    if (good) {
        gb_series_init(series, rows);
    }
    for (int k = 0; k < TABLES_MAX && good && source[k].table != NULL; k++) {
        good = draw_source(series, &source[k], k + 1, quantity, &drawn, err);
    }
    if (good && drawn == 0) {
        good = gb_error_set(err, GB_ERR_INPUT,
                            "%.300s: planes have no averages over directions: the figure "
                            "moduli-axial draws their constants",
                            gb_table_path(source[0].table));
    }
    finish(source);
    return good;
}

/* Averages of Hill over the density, and below Poisson's ratio. */
bool gb_figures_moduli(struct gb_series *series, const struct gb_figures_input *input,
                       struct gb_error *err)
{
    static const struct quantity averages[] = {
        {"E_GPa", "Young's modulus <i>E</i>", false},
        {"K_GPa", "bulk modulus <i>K</i>", false},
        {"G_GPa", "shear modulus <i>G</i>", false},
        {"nu", "", true},
        {NULL, NULL, false}};
    if (!draw(series, input, averages, err)) {
        return false;
    }
    series->below_y.label = "<i>\xce\xbd</i>";
    series->below_y.name = "nu";
    gb_series_caption(series, "Averages of Hill; bars: one standard error.");
    return true;
}

/* The five constants of an axis along z over the density. */
bool gb_figures_moduli_axial(struct gb_series *series,
                             const struct gb_figures_input *input, struct gb_error *err)
{
    static const struct quantity constants[] = {
        {"axial_C33_GPa", "<i>C</i><sub>33</sub>", false},
        {"axial_C11_GPa", "<i>C</i><sub>11</sub>", false},
        {"axial_C44_GPa", "<i>C</i><sub>44</sub>", false},
        {"axial_C13_GPa", "<i>C</i><sub>13</sub>", false},
        {"axial_C12_GPa", "<i>C</i><sub>12</sub>", false},
        {NULL, NULL, false}};
    if (!draw(series, input, constants, err)) {
        return false;
    }
    gb_series_caption(series, "Axis along <i>z</i>; bars: one standard error.");
    return true;
}
