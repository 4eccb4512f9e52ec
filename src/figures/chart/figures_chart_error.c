#include "figures/figures_compute.h"

#include <math.h>
#include <string.h>

#include "figures/chart/chart_columns.h"

/* Pressure in the name of an error column, "5MPa"; NULL: another column. */
static const char *pressure_of(const char *column)
{
    static const char *const head = "error_";
    if (!g_str_has_prefix(column, head) || !g_str_has_suffix(column, "MPa")) {
        return NULL;
    }
    const char *text = column + strlen(head);
    return g_ascii_isdigit(*text) ? text : NULL; /* else error_se_... */
}

/* The pressure as the columns write it, 0: the last one; NULL: not in the table. */
static const char *find_pressure(const struct gb_chart_columns *chart, double wanted_pa)
{
    const char *found = NULL, *name;
    for (size_t k = 0; (name = gb_table_name(chart->table, k)) != NULL; k++) {
        const char *text = pressure_of(name);
        const double pa = text ? 1e6 * g_ascii_strtod(text, NULL) : (double)NAN;
        if (text && (wanted_pa == 0.0 || fabs(pa - wanted_pa) <= 1e-5 * wanted_pa)) {
            found = text;
        }
    }
    return found;
}

static bool refuse_pressure(const struct gb_chart_columns *chart, double wanted_pa,
                            struct gb_error *err)
{
    GString *known = g_string_new(NULL);
    const char *name;
    for (size_t k = 0; (name = gb_table_name(chart->table, k)) != NULL; k++) {
        const char *text = pressure_of(name);
        if (text) {
            g_string_append_printf(known, "%s%.*s MPa", known->len > 0 ? ", " : "",
                                   (int)(strlen(text) - strlen("MPa")), text);
        }
    }
    if (known->len == 0) {
        gb_error_set(err, GB_ERR_INPUT,
                     "%s: no error at a pressure; accepted a table of `greenbody chart`",
                     gb_table_path(chart->table));
    } else {
        gb_error_set(err, GB_ERR_INPUT, "--pressure %g MPa: the chart has %s",
                     wanted_pa / 1e6, known->str);
    }
    g_string_free(known, TRUE);
    return false;
}

/* Standard deviation between seeds of one cell with the reference's particle number,
 * pooled over all rows with such cells. */
static double pooled_scatter(const struct gb_chart_columns *chart)
{
    const size_t rows = gb_table_rows(chart->table);
    double count = NAN, sum = 0.0, weight = 0.0;
    for (size_t k = 0; k < rows; k++) {
        count = chart->reference[k] == 1.0 ? chart->particles[k] : count;
    }
    for (size_t k = 0; k < rows; k++) {
        if (chart->particles[k] == count && chart->seeds[k] > 1.0 &&
            isfinite(chart->scatter[k])) {
            sum += (chart->seeds[k] - 1.0) * chart->scatter[k] * chart->scatter[k];
            weight += chart->seeds[k] - 1.0;
        }
    }
    return weight > 0.0 ? sqrt(sum / weight) : (double)NAN;
}

/* Band of this deviation around 0 over all costs. */
static void draw_scatter(struct gb_series *series, const struct gb_chart_columns *chart)
{
    double *cost = gb_series_column(series, "scatter_evaluations");
    double *zero = gb_series_column(series, "scatter_middle");
    double *scatter = gb_series_column(series, "scatter_points");
    double ends[2] = {INFINITY, -INFINITY};
    for (size_t k = 0; k < gb_table_rows(chart->table); k++) {
        if (isfinite(chart->error[k])) {
            ends[0] = fmin(ends[0], chart->evaluations[k]);
            ends[1] = fmax(ends[1], chart->evaluations[k]);
        }
    }
    const double deviation = 100.0 * pooled_scatter(chart);
    if (!isfinite(deviation) || !(ends[1] > ends[0])) {
        return;
    }
    for (int end = 0; end < 2; end++) {
        cost[end] = ends[end];
        zero[end] = 0.0;
        scatter[end] = deviation;
    }
    gb_series_draw(series, cost, zero, scatter, GB_FIGURE_FAINT,
                   gb_figure_black(0), NULL);
    gb_series_caption(series,
                      "Band: standard deviation between seeds of one cell, %.2g %%.",
                      deviation);
}

static void draw_errors(struct gb_series *series, const struct gb_chart_columns *chart,
                        size_t first, int style)
{
    char label[GB_CHART_COLUMNS_NAME];
    double *cost = gb_series_column(series, "evaluations_%d", style + 1);
    double *error = gb_series_column(series, "error_%d_points", style + 1);
    double *error_se = gb_series_column(series, "error_%d_se_points", style + 1);
    size_t filled = 0;
    for (size_t k = first; k < gb_table_rows(chart->table); k++) {
        if (gb_chart_columns_same_kind(chart, first, k) && isfinite(chart->error[k]) &&
            chart->reference[k] != 1.0) {
            cost[filled] = chart->evaluations[k];
            error_se[filled] = 100.0 * chart->error_se[k];
            error[filled++] = 100.0 * chart->error[k];
        }
    }
    if (filled > 0) {
        gb_chart_columns_name(chart, first, label);
        gb_series_draw(series, cost, error, error_se, GB_FIGURE_POINTS, style, label);
    }
}

/* Columns at one pressure, "5MPa". */
static bool find_errors(struct gb_chart_columns *chart, const char *pressure,
                        struct gb_error *err)
{
    char *error = g_strconcat("error_", pressure, NULL);
    char *error_se = g_strconcat("error_se_", pressure, NULL);
    char *scatter = g_strconcat("scatter_", pressure, NULL);
    const struct gb_chart_columns_request request[] = {
        {"evaluations", &chart->evaluations},
        {"reference", &chart->reference},
        {"seeds", &chart->seeds},
        {error, &chart->error},
        {error_se, &chart->error_se},
        {scatter, &chart->scatter}};
    const bool good = gb_chart_columns_find(chart, request, G_N_ELEMENTS(request), err);
    g_free(error);
    g_free(error_se);
    g_free(scatter);
    return good;
}

static void fill_errors(struct gb_series *series, const struct gb_chart_columns *chart,
                        double pressure_mpa)
{
    gb_series_caption(
        series,
        "At %g MPa, against the reference with the same seeds; bars: standard "
        "error.",
        pressure_mpa);
    draw_scatter(series, chart);
    gb_chart_columns_each(series, chart, draw_errors);
}

/* Density error at one pressure against the force evaluations of one cell. */
bool gb_figures_chart_error(struct gb_series *series,
                            const struct gb_figures_input *input, struct gb_error *err)
{
    struct gb_chart_columns chart = {0};
    bool good = gb_chart_columns_read(&chart, input, err);
    const char *pressure = good ? find_pressure(&chart, input->pressure_pa) : NULL;
    if (good && !pressure) {
        good = refuse_pressure(&chart, input->pressure_pa, err);
    }
    good = good && find_errors(&chart, pressure, err);
    if (good) {
        gb_series_init(series, gb_table_rows(chart.table));
        fill_errors(series, &chart, g_ascii_strtod(pressure, NULL));
    }
    gb_table_destroy(chart.table);
    return good;
}
