#include "figures/figures_compute.h"

#include <math.h>
#include <stdio.h>

#include "figures/runs/rate_points.h"

static void note_power(struct gb_series *series, double density,
                       const struct gb_power *fit)
{
    gb_series_note(series,
                   "density %g: p = a + k v^n, a = %.6g (%.6g to %.6g) MPa, k = %.4g "
                   "(%.4g to %.4g) MPa s^n, n = %.4g (%.4g to %.4g), chi2 = %.4g with %d "
                   "degrees of freedom",
                   density, fit->a.value, fit->a.low, fit->a.high, fit->k.value,
                   fit->k.low, fit->k.high, fit->n.value, fit->n.low, fit->n.high,
                   fit->chi2, fit->degrees);
}

/* Power law through the points of one density; values at their rates into fitted. */
static void fit_density(struct gb_series *series, const struct gb_power_point *points,
                        size_t count, double *fitted)
{
    double *v = g_new(double, 3 * count);
    double *p = v + count;
    double *error = p + count;
    struct gb_power fit;
    struct gb_error cause = {0};
    for (size_t i = 0; i < count; i++) {
        v[i] = points[i].v;
        p[i] = points[i].p;
        error[i] = points[i].error;
    }
    if (gb_power_fit(&fit, v, p, gb_rate_points_have_errors(points, count) ? error : NULL,
                     count, &cause)) {
        note_power(series, points[0].rho, &fit);
        for (size_t i = 0; i < count; i++) {
            fitted[i] = fit.a.value + fit.k.value * pow(v[i], fit.n.value);
        }
    } else {
        gb_series_note(series, "density %g: no power law: %s", points[0].rho, cause.text);
    }
    g_free(v);
}

/* Points and fit of every density, which are consecutive rows. */
static void draw_densities(struct gb_series *series, const double *density)
{
    const double *rate = g_ptr_array_index(series->columns, 1);
    const double *p = g_ptr_array_index(series->columns, 2);
    const double *error = g_ptr_array_index(series->columns, 3);
    const double *fit = g_ptr_array_index(series->columns, 5);
    int style = 0;
    for (size_t from = 0, to = 0; from < series->rows; from = to, style++) {
        char label[64];
        while (to < series->rows && density[to] == density[from]) {
            to++;
        }
        snprintf(label, sizeof label, "<i>\xcf\x81</i> = %g", density[from]);
        struct gb_series_curve *points =
            gb_series_draw(series, rate, p, error, GB_FIGURE_POINTS, style, label);
        points->from = from;
        points->rows = to - from;
        struct gb_series_curve *line =
            gb_series_draw(series, rate, fit, NULL, GB_FIGURE_LINE, style, NULL);
        line->from = from;
        line->rows = to - from;
    }
    gb_series_caption(series, "Bars: standard error; lines: <i>p</i> = <i>a</i> + "
                              "<i>k v<sup>n</sup></i> fitted at each density.");
}

/* The power law of every density; its values at the rates. */
static double *fit_densities(struct gb_series *series,
                             const struct gb_rate_points *points)
{
    double *fitted = g_new(double, points->count + 1);
    for (size_t from = 0, to = 0; from < points->count; from = to) {
        while (to < points->count && points->point[to].rho == points->point[from].rho) {
            fitted[to++] = NAN;
        }
        fit_density(series, points->point + from, to - from, fitted + from);
    }
    return fitted;
}

/* P2 section 3, before (9). */
bool gb_figures_rate(struct gb_series *series, const struct gb_figures_input *input,
                     struct gb_error *err)
{
    struct gb_rate_points points;
    struct gb_power_rate rate;
    if (!gb_rate_points_find(&points, input, "rate", err)) {
        return false;
    }
    gb_series_init(series, points.count);
    double *fitted = fit_densities(series, &points);
    double *const columns[] = {
        gb_series_column(series, "density"), gb_series_column(series, "rate_per_s"),
        gb_series_column(series, "p_MPa"),   gb_series_column(series, "se_MPa"),
        gb_series_column(series, "runs"),    gb_series_column(series, "fit_MPa")};
    for (size_t i = 0; i < series->rows; i++) {
        const struct gb_power_point *point = &points.point[i];
        const double row[] = {point->rho,   point->v,       point->p,
                              point->error, points.runs[i], fitted[i]};
        for (size_t k = 0; k < G_N_ELEMENTS(row); k++) {
            columns[k][i] = row[k];
        }
    }
    draw_densities(series, columns[0]);
    gb_rate_points_fit(&rate, &points, series);
    g_free(fitted);
    gb_rate_points_finish(&points);
    return true;
}
