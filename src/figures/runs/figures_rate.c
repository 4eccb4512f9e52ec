#include "figures/figures_compute.h"

#include <math.h>
#include <stdio.h>

#include "base/alloc.h"
#include "figures/runs/runs_check.h"
#include "measure/fit/average.h"
#include "measure/fit/power.h"
#include "scene/derived.h"

/* Exponents of P2 (9). */
static const double published_exponent = 0.25;
static const double published_power = 3.0;

/* Default densities. */
static const double default_density[] = {0.6,  0.65, 0.7,   0.75, 0.8,
                                         0.85, 0.9,  0.925, 0.95};

/* Keys that may differ between runs of one series of rates: resolution of computation and
 * record, and what follows the compression. */
static const char *const may_differ[] = {"loading.rate",
                                         "loading.record",
                                         "loading.record_time",
                                         "loading.relax",
                                         "loading.hold",
                                         "numerics.",
                                         NULL};

static bool check_one_series(const struct gb_runset *set, struct gb_error *err)
{
    for (size_t g = 1; g < set->groups; g++) {
        const struct gb_field *field = gb_runset_difference(set, 0, g, may_differ);
        if (field != NULL) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "%.200s and %.200s differ in %s.%s; the figure rate "
                                "accepts runs that differ in loading.rate",
                                gb_runset_first(set, 0)->directory,
                                gb_runset_first(set, g)->directory, field->group,
                                field->key);
        }
    }
    return true;
}

/* The end of a run may miss its last density by rounding. */
static double pressure_at(const struct gb_average_curve *curve, double density)
{
    const double last = curve->x[curve->count - 1];
    const bool end = fabs(last - density) < 1e-9 * density;
    return gb_average_crossing(curve, end ? fmin(last, density) : density, NULL);
}

/* Pressure of every run where it first reaches each density; densities x runs. */
static bool find_pressures(double *pressure, const struct gb_runset *set,
                           const double *density, size_t densities, struct gb_error *err)
{
    for (size_t i = 0; i < set->count; i++) {
        double *x = NULL;
        double *y = NULL;
        size_t count = 0;
        if (!gb_runset_points(&set->run[i], "load", "density", "p_MPa", &x, &y, &count,
                              err)) {
            return false;
        }
        const struct gb_average_curve curve = {x, y, count};
        for (size_t k = 0; k < densities; k++) {
            pressure[k * set->count + i] = pressure_at(&curve, density[k]);
        }
        gb_alloc_free(x);
        gb_alloc_free(y);
    }
    return true;
}

/* Mean pressures at one density, one point per group that reaches it. */
static size_t collect_points(struct gb_power_point *points, const struct gb_runset *set,
                             const double *pressure, double density, double *runs)
{
    double *values = g_new(double, set->count);
    size_t found = 0;
    for (size_t g = 0; g < set->groups; g++) {
        size_t members = 0;
        double mean = NAN;
        double error = NAN;
        for (size_t i = 0; i < set->count; i++) {
            if (set->run[i].group == g) {
                values[members++] = pressure[i];
            }
        }
        const size_t used = gb_average_values(values, members, &mean, &error);
        if (used > 0) {
            points[found] = (struct gb_power_point){
                gb_runset_first(set, g)->params.rate_per_s, density, mean, error};
            runs[found++] = (double)used;
        }
    }
    g_free(values);
    return found;
}

/* Fits are weighted by the standard errors when every point has one. */
static bool all_have_errors(const struct gb_power_point *points, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (!(points[i].error > 0.0)) {
            return false;
        }
    }
    return true;
}

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
    if (gb_power_fit(&fit, v, p, all_have_errors(points, count) ? error : NULL, count,
                     &cause)) {
        note_power(series, points[0].rho, &fit);
        for (size_t i = 0; i < count; i++) {
            fitted[i] = fit.a.value + fit.k.value * pow(v[i], fit.n.value);
        }
    } else {
        gb_series_note(series, "density %g: no power law: %s", points[0].rho, cause.text);
    }
    g_free(v);
}

/* P2 (9) over all densities: k_v with the published exponent, and the exponent free. */
static void note_common(struct gb_series *series, struct gb_power_point *points,
                        size_t count, double rho0)
{
    const struct gb_power_law law = {published_exponent, published_power, rho0};
    struct gb_power_rate rate;
    struct gb_fit_value exponent;
    struct gb_error cause = {0};
    const bool given = all_have_errors(points, count);
    for (size_t i = 0; i < count && !given; i++) {
        points[i].error = 0.0;
    }
    if (gb_power_rate(&rate, &law, points, count, &cause)) {
        gb_series_note(
            series,
            "P2 (9): p = p_stat(rho) + k_v v^(1/4) (rho - %g)^3, k_v = %.4g "
            "(%.4g to %.4g) MPa s^(1/4), chi2 = %.4g with %d degrees of freedom",
            rho0, rate.k_v.value, rate.k_v.low, rate.k_v.high, rate.chi2, rate.degrees);
    } else {
        gb_series_note(series, "P2 (9): no k_v: %s", cause.text);
    }
    if (gb_power_exponent(&exponent, &law, points, count, &cause)) {
        gb_series_note(series,
                       "P2 (9) with a free exponent of the rate: %.4g (%.4g to %.4g)",
                       exponent.value, exponent.low, exponent.high);
    } else {
        gb_series_note(series, "P2 (9) with a free exponent: %s", cause.text);
    }
    gb_series_note(series,
                   "95 %% confidence intervals for independent errors; densities of "
                   "one run are not independent");
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

static void fill_rows(struct gb_series *series, const struct gb_runset *set,
                      const double *density, size_t densities, const double *pressure)
{
    gb_series_init(series, 0);
    struct gb_power_point *points =
        g_new0(struct gb_power_point, set->groups * densities + 1);
    double *runs = g_new0(double, set->groups *densities + 1);
    double *fitted = g_new0(double, set->groups *densities + 1);
    for (size_t k = 0; k < densities; k++) {
        const size_t from = series->rows;
        const size_t count = collect_points(points + from, set, pressure + k * set->count,
                                            density[k], runs + from);
        for (size_t i = 0; i < count; i++) {
            fitted[from + i] = NAN;
        }
        if (count > 0) {
            fit_density(series, points + from, count, fitted + from);
        }
        series->rows += count;
    }
    double *const columns[] = {
        gb_series_column(series, "density"), gb_series_column(series, "rate_per_s"),
        gb_series_column(series, "p_MPa"),   gb_series_column(series, "se_MPa"),
        gb_series_column(series, "runs"),    gb_series_column(series, "fit_MPa")};
    for (size_t i = 0; i < series->rows; i++) {
        const double row[] = {points[i].rho,   points[i].v, points[i].p,
                              points[i].error, runs[i],     fitted[i]};
        for (size_t k = 0; k < G_N_ELEMENTS(row); k++) {
            columns[k][i] = row[k];
        }
    }
    draw_densities(series, columns[0]);
    note_common(series, points, series->rows,
                gb_derived_structure_density(&set->run[0].params));
    g_free(points);
    g_free(runs);
    g_free(fitted);
}

/* P2 Fig. 4. */
bool gb_figures_rate(struct gb_series *series, const struct gb_figures_input *input,
                     struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    const bool given = input->densities > 0;
    const double *density = given ? input->density : default_density;
    const size_t densities = given ? input->densities : G_N_ELEMENTS(default_density);
    if (!gb_runs_check_dynamic(set, "rate", err) || !check_one_series(set, err)) {
        return false;
    }
    double *pressure = gb_alloc_array(densities * set->count, sizeof *pressure, err);
    if (pressure == NULL || !find_pressures(pressure, set, density, densities, err)) {
        gb_alloc_free(pressure);
        return false;
    }
    fill_rows(series, set, density, densities, pressure);
    gb_alloc_free(pressure);
    return series->rows > 0 ||
           gb_error_set(err, GB_ERR_INPUT, "rate: no run reaches density %g", density[0]);
}
