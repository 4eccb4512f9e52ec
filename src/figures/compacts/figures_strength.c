#include "figures/compacts/compact_table.h"
#include "figures/figures_compute.h"

#include <math.h>
#include <string.h>

#include "study/strength/strength.h"

/* Strength of compacts against the pressure of pressing, from the directories of
 * `greenbody strength`; against the density after unloading where a compact was pressed to
 * a density. */

enum { DIRECTORIES = 8 };

enum { PRESSURE, DENSITY, STRENGTH, ERROR, COLUMNS };

static const char *const names[COLUMNS] = {"pressure_MPa", "density", "strength_MPa",
                                           "strength_error_MPa"};

struct tables {
    struct gb_table *table[DIRECTORIES];
    const double *column[DIRECTORIES][COLUMNS];
    size_t count;
};

static bool read_tables(struct tables *tables, const struct gb_figures_input *input,
                        struct gb_error *err)
{
    for (; input->words[tables->count] != NULL; tables->count++) {
        char *const word[] = {input->words[tables->count], NULL};
        const struct gb_figures_input one = {.words = word};
        if (tables->count == DIRECTORIES) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "strength: must be between 1 and %d directories", DIRECTORIES);
        }
        struct gb_table **table = &tables->table[tables->count];
        if (!gb_compact_table_read(table, &one, "strength", "strength.csv", "test",
                                   err) ||
            !gb_compact_table_columns(*table, names, COLUMNS,
                                      tables->column[tables->count], err)) {
            return false;
        }
    }
    return tables->count > 0 ||
           gb_error_set(err, GB_ERR_INPUT,
                        "strength: takes directories of `greenbody strength`");
}

static void free_tables(struct tables *tables)
{
    for (size_t k = 0; k < DIRECTORIES; k++) {
        gb_table_destroy(tables->table[k]);
    }
}

/* All compacts were pressed to pressures. */
static bool have_pressures(const struct tables *tables)
{
    for (size_t k = 0; k < tables->count; k++) {
        for (size_t i = 0; i < gb_table_rows(tables->table[k]); i++) {
            if (!isfinite(tables->column[k][PRESSURE][i])) {
                return false;
            }
        }
    }
    return true;
}

/* "tension", or "directory: tension" where there are several; g_free. */
static char *label_of(const struct tables *tables, char *const *words, size_t k,
                      const char *test)
{
    if (tables->count == 1) {
        return g_strdup(test);
    }
    char *name = g_path_get_basename(words[k]);
    char *label = g_markup_printf_escaped("%s: %s", name, test);
    g_free(name);
    return label;
}

/* Rows of a test in rising x. */
static void draw_test(struct gb_series *series, const struct tables *tables,
                      char *const *words, size_t k, int test, int along)
{
    const struct gb_table *table = tables->table[k];
    const int style = (int)k * GB_STRENGTH_TESTS + test;
    const char *name = gb_strength_tests[test].name;
    char *label = label_of(tables, words, k, name);
    double *x = gb_series_column(series, "%s_%d", names[along], style + 1);
    double *y = gb_series_column(series, "%s_%d_MPa", name, (int)k + 1);
    double *error = gb_series_column(series, "%s_error_%d_MPa", name, (int)k + 1);
    size_t filled = 0;
    for (size_t i = 0; i < gb_table_rows(table); i++) {
        if (strcmp(gb_table_word(table, i), name) != 0) {
            continue;
        }
        size_t at = filled++;
        for (; at > 0 && x[at - 1] > tables->column[k][along][i]; at--) {
            x[at] = x[at - 1];
            y[at] = y[at - 1];
            error[at] = error[at - 1];
        }
        x[at] = tables->column[k][along][i];
        y[at] = tables->column[k][STRENGTH][i];
        error[at] = tables->column[k][ERROR][i];
    }
    gb_series_draw(series, x, y, error, GB_FIGURE_BOTH, style, label);
    g_free(label);
}

static void draw(struct gb_series *series, const struct tables *tables,
                 char *const *words)
{
    const bool by_pressure = have_pressures(tables);
    size_t rows = 0;
    for (size_t k = 0; k < tables->count; k++) {
        rows = MAX(rows, gb_table_rows(tables->table[k]));
    }
    gb_series_init(series, rows);
    gb_series_axes(series, by_pressure ? "pressure_MPa" : "density",
                   by_pressure ? "pressure of pressing <i>p</i> (MPa)"
                               : "relative density after unloading <i>\xcf\x81</i>",
                   NULL, NULL);
    series->y.low = 0.0;
    for (size_t k = 0; k < tables->count; k++) {
        for (int test = 0; test < GB_STRENGTH_TESTS; test++) {
            draw_test(series, tables, words, k, test, by_pressure ? PRESSURE : DENSITY);
        }
    }
    gb_series_caption(series, "Largest stress of each test after unloading; means over "
                              "the cells, bars one standard error.");
}

bool gb_figures_strength(struct gb_series *series, const struct gb_figures_input *input,
                         struct gb_error *err)
{
    struct tables tables = {.count = 0};
    const bool good = read_tables(&tables, input, err);
    if (good) {
        draw(series, &tables, input->words);
    }
    free_tables(&tables);
    return good;
}
