#include "figures/figures_compute.h"

#include <math.h>
#include <string.h>

#include "figures/runs/rate_points.h"

enum { LINE_POINTS = 101 };

/* Rates of P2 Fig. 4, 1/s; rates of runs beyond them extend the lines. */
static const double published_rates[2] = {1e4, 1e9};

/* Default densities: fewer than those of the figure rate, whose points do not overlap. */
static const double default_density[] = {0.6, 0.7, 0.8, 0.9, 0.95};

/* Columns of the points: what is left of p beyond the static pressure of its density. */
static void point_columns(struct gb_series *series, const struct gb_rate_points *points,
                          double k_v)
{
    double *const columns[] = {gb_series_column(series, "density"),
                               gb_series_column(series, "rate_per_s"),
                               gb_series_column(series, "difference_MPa"),
                               gb_series_column(series, "se_MPa"),
                               gb_series_column(series, "p_MPa"),
                               gb_series_column(series, "p_stat_MPa"),
                               gb_series_column(series, "runs")};
    for (size_t i = 0; i < points->count; i++) {
        const struct gb_power_point *point = &points->point[i];
        const double p_stat =
            gb_power_static(&points->law, k_v, points->fitted, points->count, point->rho);
        const double row[] = {point->rho, point->v, point->p - p_stat, point->error,
                              point->p,   p_stat,   points->runs[i]};
        for (size_t k = 0; k < G_N_ELEMENTS(row); k++) {
            columns[k][i] = row[k];
        }
    }
}

/* Rates of the lines, evenly spaced in their logarithm. */
static double *line_rates(struct gb_series *series, const struct gb_rate_points *points)
{
    double *rate = gb_series_column(series, "line_rate_per_s");
    double from = published_rates[0];
    double to = published_rates[1];
    for (size_t i = 0; i < points->count; i++) {
        from = fmin(from, points->point[i].v);
        to = fmax(to, points->point[i].v);
    }
    for (size_t k = 0; k < LINE_POINTS; k++) {
        rate[k] = from * pow(to / from, (double)k / (LINE_POINTS - 1));
    }
    return rate;
}

/* P2 (9) at one density with the fitted k_v, and with the printed one. */
static void draw_lines(struct gb_series *series, const struct gb_power_law *law,
                       double k_v, double density, const double *rate, int style)
{
    double *fitted = gb_series_column(series, "fit_%g_MPa", density);
    double *printed = gb_series_column(series, "P2_%g_MPa", density);
    for (size_t k = 0; k < LINE_POINTS; k++) {
        fitted[k] = gb_rate_points_excess(law, k_v, rate[k], density);
        printed[k] =
            gb_rate_points_excess(law, gb_rate_points_printed_k_v, rate[k], density);
    }
    gb_series_draw(series, rate, fitted, NULL, GB_FIGURE_LINE, style % GB_FIGURE_STYLES,
                   NULL); /* a repeated colour would have markers, as the points */
    gb_series_draw(series, rate, printed, NULL, GB_FIGURE_FAINT, style, NULL);
}

static void draw_densities(struct gb_series *series, const struct gb_rate_points *points,
                           double k_v)
{
    const double *rate = g_ptr_array_index(series->columns, 1);
    const double *difference = g_ptr_array_index(series->columns, 2);
    const double *error = g_ptr_array_index(series->columns, 3);
    const double *line_rate = line_rates(series, points);
    int style = 0;
    for (size_t from = 0, to = 0; from < points->count; from = to, style++) {
        const double density = points->point[from].rho;
        while (to < points->count && points->point[to].rho == density) {
            to++;
        }
        char *label = g_strdup_printf("<i>\xcf\x81</i> = %g", density);
        struct gb_series_curve *curve = gb_series_draw(series, rate, difference, error,
                                                       GB_FIGURE_POINTS, style, label);
        curve->from = from;
        curve->rows = to - from;
        draw_lines(series, &points->law, k_v, density, line_rate, style);
        g_free(label);
    }
}

/* P2 Fig. 4. */
bool gb_figures_rate_difference(struct gb_series *series,
                                const struct gb_figures_input *input,
                                struct gb_error *err)
{
    struct gb_rate_points points;
    struct gb_power_rate rate;
    struct gb_figures_input at = *input;
    if (at.densities == 0) {
        at.densities = G_N_ELEMENTS(default_density);
        memcpy(at.density, default_density, sizeof default_density);
    }
    if (!gb_rate_points_find(&points, &at, "rate-difference", err)) {
        return false;
    }
    gb_series_init(series, MAX(points.count, LINE_POINTS));
    gb_series_note(series, "p_stat: at each density the weighted mean of p - k_v v^(1/4) "
                           "(rho - rho0)^3 with the fitted k_v; se: of p");
    const bool good =
        gb_rate_points_fit(&rate, &points, series) ||
        gb_error_set(err, GB_ERR_INPUT,
                     "rate-difference: %zu points of mean pressure give no k_v; it takes "
                     "two rates at one density",
                     points.count);
    if (good) {
        point_columns(series, &points, rate.k_v.value);
        draw_densities(series, &points, rate.k_v.value);
        gb_series_caption(
            series,
            "Bars: standard error. Lines: P2 (9), <i>k<sub>v</sub></i> = %.3g MPa "
            "s<sup>1/4</sup>, fitted; thin: %g, printed.",
            rate.k_v.value, gb_rate_points_printed_k_v);
    }
    gb_rate_points_finish(&points);
    return good;
}
