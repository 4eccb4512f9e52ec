#include "figures/compacts/compact_table.h"
#include "figures/figures_compute.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "measure/fit/average.h"
#include "scene/field/keep_points.h"
#include "study/strength/strength.h"

/* Stress against strain of the tests of `greenbody strength`: each cell, and the mean as
 * far as all cells go. */

enum { CELLS = 64, MARKS = 64 };

enum { PRESSURE, PRESSED_DENSITY, CELL, STRAIN, STRESS, COLUMNS };

static const char *const names[COLUMNS] = {"pressure_MPa", "pressed_density", "cell",
                                           "strain_percent", "stress_MPa"};

/* The compact whose tests are drawn: the column that names it and its value there. */
struct chosen {
    const struct gb_table *table;
    const double *column[COLUMNS];
    int by; /* PRESSURE or PRESSED_DENSITY */
    double value;
};

/* The compact of --at; errors: GB_ERR_INPUT. */
static bool read_at(struct chosen *chosen, const char *at, double *wanted,
                    struct gb_error *err)
{
    struct gb_keep_points points;
    struct gb_error why = {0};
    if (!gb_keep_points_parse(at, &points, &why) || points.count != 1) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--at %.100s: accepted one compact, as '100 MPa' or 'density "
                            "= 0.5'",
                            at);
    }
    chosen->by = points.point[0].by_density ? PRESSED_DENSITY : PRESSURE;
    *wanted = points.point[0].value * (points.point[0].by_density ? 1.0 : 1e-6);
    return true;
}

/* Takes the value nearest to the wanted one if it is that, or the largest; lists all. */
static bool take_value(struct chosen *chosen, double wanted, GString *all)
{
    double value[MARKS];
    bool found = false;
    const size_t count = gb_compact_table_distinct(
        chosen->table, chosen->column[chosen->by], NULL, 0.0, value, MARKS);
    for (size_t k = 0; k < count; k++) {
        g_string_append_printf(all, "%s%g", k > 0 ? ", " : "", value[k]);
        if (isfinite(wanted) ? fabs(value[k] - wanted) <= 1e-6 * wanted
                             : !found || value[k] > chosen->value) {
            chosen->value = value[k];
            found = true;
        }
    }
    return found;
}

/* The compact of --at, or that of the largest pressure, or of the largest density. */
static bool choose(struct chosen *chosen, const char *at, struct gb_error *err)
{
    double wanted = NAN;
    chosen->by = PRESSURE;
    if (at != NULL && !read_at(chosen, at, &wanted, err)) {
        return false;
    }
    GString *all = g_string_new(NULL);
    bool found = take_value(chosen, wanted, all);
    if (!found && at == NULL) {
        chosen->by = PRESSED_DENSITY;
        found = take_value(chosen, wanted, all);
    }
    if (!found) {
        gb_error_set(err, GB_ERR_INPUT, "%.300s: no compact of %s %g; accepted %s",
                     gb_table_path(chosen->table), names[chosen->by], wanted,
                     all->len > 0 ? all->str : "none of these");
    }
    g_string_free(all, TRUE);
    return found;
}

static bool is_row(const struct chosen *chosen, size_t row, const char *test, double cell)
{
    return chosen->column[chosen->by][row] == chosen->value &&
           chosen->column[CELL][row] == cell &&
           strcmp(gb_table_word(chosen->table, row), test) == 0;
}

/* One cell as columns; a strain that does not grow leaves its row out. */
static void draw_cell(struct gb_series *series, const struct chosen *chosen,
                      const char *test, double cell, int style,
                      struct gb_average_curve *curve)
{
    double *x = gb_series_column(series, "%s_%g_strain_percent", test, cell);
    double *y = gb_series_column(series, "%s_%g_MPa", test, cell);
    size_t filled = 0;
    for (size_t i = 0; i < gb_table_rows(chosen->table); i++) {
        if (is_row(chosen, i, test, cell) &&
            (filled == 0 || chosen->column[STRAIN][i] > x[filled - 1])) {
            x[filled] = chosen->column[STRAIN][i];
            y[filled++] = chosen->column[STRESS][i];
        }
    }
    gb_series_draw(series, x, y, NULL, GB_FIGURE_FAINT, style, NULL);
    *curve = (struct gb_average_curve){x, y, filled};
}

static bool draw_mean(struct gb_series *series, const struct gb_average_curve *curves,
                      size_t count, const char *test, int style, struct gb_error *err)
{
    double *grid = NULL;
    size_t size = 0;
    if (!gb_average_grid(curves, count, series->rows, &grid, &size, err)) {
        return false;
    }
    double *rows = g_new(double, count *size);
    double *x = gb_series_column(series, "%s_strain_percent", test);
    double *y = gb_series_column(series, "%s_MPa", test);
    double *error = gb_series_column(series, "%s_error_MPa", test);
    bool good = true;
    for (size_t c = 0; c < count && good; c++) {
        good = gb_average_resample(&curves[c], grid, size, rows + c * size, err);
    }
    if (good) {
        memcpy(x, grid, size * sizeof *x);
        gb_average_rows(rows, count, size, GB_AVERAGE_ALL, y, error);
        gb_series_draw(series, x, y, error, GB_FIGURE_LINE, style, test);
    }
    g_free(rows);
    gb_alloc_free(grid);
    return good;
}

static bool draw_test(struct gb_series *series, const struct chosen *chosen, int style,
                      struct gb_error *err)
{
    double cell[CELLS];
    struct gb_average_curve curves[CELLS];
    const char *test = gb_strength_tests[style].name;
    const size_t count =
        gb_compact_table_distinct(chosen->table, chosen->column[CELL],
                                  chosen->column[chosen->by], chosen->value, cell, CELLS);
    size_t drawn = 0;
    for (size_t c = 0; c < count; c++) {
        draw_cell(series, chosen, test, cell[c], style, &curves[drawn]);
        drawn += curves[drawn].count > 0;
    }
    return drawn == 0 || draw_mean(series, curves, drawn, test, style, err);
}

static bool draw(struct gb_series *series, const struct chosen *chosen,
                 struct gb_error *err)
{
    gb_series_init(series, gb_table_rows(chosen->table));
    for (int test = 0; test < GB_STRENGTH_TESTS; test++) {
        if (!draw_test(series, chosen, test, err)) {
            return false;
        }
    }
    gb_series_caption(series,
                      chosen->by == PRESSURE ? "Pressed to %g MPa."
                                             : "Pressed to the "
                                               "density %g.",
                      chosen->value);
    gb_series_caption(series,
                      "Pale: each cell; lines: their mean as far as all cells go, "
                      "with one standard error.");
    return true;
}

bool gb_figures_strength_curves(struct gb_series *series,
                                const struct gb_figures_input *input,
                                struct gb_error *err)
{
    struct gb_table *table = NULL;
    struct chosen chosen = {.value = NAN};
    bool good = gb_compact_table_read(&table, input, "strength", "strength_curves.csv",
                                      "test", err) &&
                gb_compact_table_columns(table, names, COLUMNS, chosen.column, err);
    chosen.table = table;
    good = good && choose(&chosen, input->at, err) && draw(series, &chosen, err);
    gb_table_destroy(table);
    return good;
}
