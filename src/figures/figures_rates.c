/* Figures of P2: pressure against the rate, and how it relaxes after compression.  The rate law
 * is P2 (9). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "figures/figures.h"
#include "figures/series.h"
#include "many/mean_curves.h"
#include "measure/average.h"
#include "measure/fit.h"
#include "measure/power.h"
#include "scene/derived.h"

/* Mean pressures of groups of runs that differ in their rate, at given densities, and the
 * law P2 (9) through them. */

struct rate_points {
    struct gb_power_point *point;  /* rates in 1/s, pressures in MPa; by density */
    struct gb_power_point *fitted; /* the same; error 0 in all unless all have one */
    double *runs;                  /* with a value, of each point */
    size_t count;
    struct gb_power_law law; /* of P2 (9), from the initial density of the runs */
};

/* k_v of P2 (9) as printed, MPa s^(1/4). */
static const double printed_k_v = 21.5;

/* Exponents of P2 (9). */
static const double published_exponent = 0.25;
static const double published_power = 3.0;

/* Default densities. */
static const double rate_density[] = {0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9, 0.925, 0.95};

/* Keys that may differ between runs of one series of rates: resolution of computation and
 * record, and what follows the compression. */
static const char *const may_differ[] = {"loading.rate",
                                         "loading.record",
                                         "loading.record_time",
                                         "loading.relax",
                                         "loading.hold",
                                         "numerics.",
                                         NULL};

static bool check_one_series(const struct gb_runset *set, const char *figure,
                             struct gb_error *err)
{
    for (size_t g = 1; g < set->groups; g++) {
        const struct gb_field *field = gb_runset_difference(set, 0, g, may_differ);
        if (field != NULL) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "%.200s and %.200s differ in %s.%s; the figure %s "
                                "accepts runs that differ in loading.rate",
                                gb_runset_first(set, 0)->directory,
                                gb_runset_first(set, g)->directory, field->group,
                                field->key, figure);
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

/* A rate with one run takes the standard deviation of the others at its density: one cell
 * scatters alike at all rates. */
static void estimate_errors(struct gb_power_point *points, const double *runs,
                            size_t count)
{
    double squares = 0.0;
    double degrees = 0.0;
    for (size_t i = 0; i < count; i++) {
        if (points[i].error > 0.0) {
            squares += (runs[i] - 1.0) * runs[i] * points[i].error * points[i].error;
            degrees += runs[i] - 1.0;
        }
    }
    for (size_t i = 0; i < count; i++) {
        if (!(points[i].error > 0.0) && degrees > 0.0) {
            points[i].error = sqrt(squares / degrees / runs[i]);
        }
    }
}

/* Whether each of count points has a standard error: fits are then weighted by them. */
static bool have_errors(const struct gb_power_point *points, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (!(points[i].error > 0.0)) {
            return false;
        }
    }
    return true;
}

static void collect_densities(struct rate_points *points, const struct gb_runset *set,
                              const double *density, size_t densities,
                              const double *pressure)
{
    points->point = g_new0(struct gb_power_point, set->groups * densities + 1);
    points->runs = g_new0(double, set->groups *densities + 1);
    for (size_t k = 0; k < densities; k++) {
        struct gb_power_point *point = points->point + points->count;
        double *runs = points->runs + points->count;
        const size_t found =
            collect_points(point, set, pressure + k * set->count, density[k], runs);
        estimate_errors(point, runs, found);
        points->count += found;
    }
    points->fitted = g_memdup2(points->point, points->count * sizeof *points->point);
    const bool given = have_errors(points->point, points->count);
    for (size_t i = 0; i < points->count && !given; i++) {
        points->fitted[i].error = 0.0;
    }
}

static void finish_points(struct rate_points *points)
{
    g_free(points->point);
    g_free(points->fitted);
    g_free(points->runs);
    *points = (struct rate_points){0};
}

/* Points at the densities of the input, or at those of the figure rate: where each run
 * first reaches them.  A rate with one run has the standard deviation of the others at its
 * density as its error, none where no rate has two.  figure names it in messages.  Errors: GB_ERR_INPUT (runs that are not
 * dynamic, that differ in more than the rate, or that reach none of the densities). */
static bool find_points(struct rate_points *points, const struct gb_figures_input *input,
                        const char *figure, struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    const bool given = input->densities > 0;
    const double *density = given ? input->density : rate_density;
    const size_t densities = given ? input->densities : G_N_ELEMENTS(rate_density);
    *points = (struct rate_points){0};
    if (!gb_series_check_dynamic(set, figure, err) ||
        !check_one_series(set, figure, err)) {
        return false;
    }
    double *pressure = gb_alloc_array(densities * set->count, sizeof *pressure, err);
    const bool good =
        pressure != NULL && find_pressures(pressure, set, density, densities, err);
    if (good) {
        points->law =
            (struct gb_power_law){published_exponent, published_power,
                                  gb_derived_structure_density(&set->run[0].params)};
        collect_densities(points, set, density, densities, pressure);
    }
    gb_alloc_free(pressure);
    if (good && points->count == 0) {
        finish_points(points);
        return gb_error_set(err, GB_ERR_INPUT, "%s: no run reaches density %g", figure,
                            density[0]);
    }
    return good;
}

static void note_k_v(struct gb_series *series, const struct gb_power_law *law,
                     const struct gb_power_rate *rate)
{
    gb_series_note(series,
                   "P2 (9): p = p_stat(rho) + k_v v^(1/4) (rho - %g)^3, k_v = %.4g "
                   "(%.4g to %.4g) MPa s^(1/4), chi2 = %.4g with %d degrees of freedom; "
                   "P2 has %g",
                   law->rho0, rate->k_v.value, rate->k_v.low, rate->k_v.high, rate->chi2,
                   rate->degrees, printed_k_v);
}

/* P2 (9) over all densities: k_v with the printed exponent, and the exponent free, as
 * comment lines.  Weighted by the errors where all points have one.  Returns false, with the reason as a comment line, where the points determine no k_v. */
static bool fit_rate(struct gb_power_rate *rate, const struct rate_points *points,
                     struct gb_series *series)
{
    struct gb_fit_value exponent;
    struct gb_error cause = {0};
    const bool good =
        gb_power_rate(rate, &points->law, points->fitted, points->count, &cause);
    if (good) {
        note_k_v(series, &points->law, rate);
    } else {
        gb_series_note(series, "P2 (9): no k_v: %s", cause.text);
    }
    if (gb_power_exponent(&exponent, &points->law, points->fitted, points->count,
                          &cause)) {
        gb_series_note(series,
                       "P2 (9) with a free exponent of the rate: %.4g (%.4g to %.4g)",
                       exponent.value, exponent.low, exponent.high);
    } else {
        gb_series_note(series, "P2 (9) with a free exponent: %s", cause.text);
    }
    gb_series_note(series,
                   "95 %% confidence intervals for independent errors; densities of "
                   "one run are not independent; a rate with one run has the scatter of "
                   "the others as its error");
    return good;
}

/* k_v v^(1/4) (rho - rho0)^3, MPa. */
static double excess(const struct gb_power_law *law, double k_v, double rate,
                     double density)
{
    return k_v * pow(rate, law->exponent) * pow(density - law->rho0, law->power);
}

/* Standard errors of the two means are taken as independent, an upper bound for replicas
 * with the same seeds. */
static void difference_columns(struct gb_series *series, size_t group, const char *label,
                               const double *mean, const double *error,
                               const double *reference, const double *reference_error)
{
    double *difference = gb_series_column(series, "difference_%zu_MPa", group + 1);
    double *column_error = gb_series_column(series, "se_%zu_MPa", group + 1);
    for (size_t i = 0; i < series->rows; i++) {
        difference[i] = mean[i] - reference[i];
        column_error[i] = hypot(error[i], reference_error[i]);
    }
    gb_series_draw(series, g_ptr_array_index(series->columns, 0), difference,
                   column_error, GB_FIGURE_LINE, (int)group, label);
}

/* P2 (9) less its value at the reference rate, with the printed k_v; rate 0: the
 * quasi-static pressure. */
static void law_column(struct gb_series *series, const struct gb_power_law *law,
                       double rate, double reference_rate, double *column)
{
    const double *density = g_ptr_array_index(series->columns, 0);
    for (size_t i = 0; i < series->rows; i++) {
        const double k_v = printed_k_v;
        column[i] = density[i] < law->rho0
                        ? (double)NAN
                        : excess(law, k_v, rate, density[i]) -
                              excess(law, k_v, reference_rate, density[i]);
    }
}

/* P2 (9) of each group and of quasi-static pressing, where the runs differ in their rate
 * alone; the k_v of these runs as a comment and in the caption. */
static void draw_law(struct gb_series *series, const struct gb_figures_input *input)
{
    const struct gb_runset *set = input->set;
    const double *density = g_ptr_array_index(series->columns, 0);
    const double reference_rate =
        gb_runset_first(set, input->reference)->params.rate_per_s;
    struct rate_points points;
    struct gb_power_rate rate;
    struct gb_error ignored = {0};
    if (!find_points(&points, input, "difference", &ignored)) {
        return;
    }
    for (size_t g = 0; g < set->groups; g++) {
        if (g != input->reference) {
            double *column = gb_series_column(series, "P2_%zu_MPa", g + 1);
            law_column(series, &points.law, gb_runset_first(set, g)->params.rate_per_s,
                       reference_rate, column);
            gb_series_draw(series, density, column, NULL, GB_FIGURE_FAINT, (int)g, NULL);
        }
    }
    double *still = gb_series_column(series, "P2_quasistatic_MPa");
    law_column(series, &points.law, 0.0, reference_rate, still);
    gb_series_draw(series, density, still, NULL, GB_FIGURE_LINE, (int)set->groups,
                   "quasi-static, P2 (9)");
    gb_series_caption(series,
                      "Thin: P2 (9), <i>k<sub>v</sub></i> = %g MPa s<sup>1/4</sup>.",
                      printed_k_v);
    if (fit_rate(&rate, &points, series)) {
        gb_series_caption(series, "These runs: <i>k<sub>v</sub></i> = %.3g.",
                          rate.k_v.value);
    }
    finish_points(&points);
}

/* P2 Fig. 3. */
static bool compute_difference(struct gb_series *series,
                               const struct gb_figures_input *input, struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    struct gb_series_sample sample;
    const size_t reference = input->reference;
    if (set->groups < 2) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "difference: all runs have equal presets; expected runs of "
                            "two groups at least");
    }
    if (!gb_series_sample(&sample, set, "load", "density", "p_MPa", err)) {
        return false;
    }
    gb_series_init(series, sample.size);
    gb_series_note_groups(series, set);
    gb_series_note(series, "reference: group %zu", reference + 1);
    gb_series_sample_grid(series, &sample, "density");
    double *buffer = g_new(double, 4 * sample.size + 1);
    double *const at[4] = {buffer, buffer + sample.size, buffer + 2 * sample.size,
                           buffer + 3 * sample.size};
    bool good = gb_series_mean(&sample, set, reference, at[0], at[1], err);
    for (size_t g = 0; g < set->groups && good; g++) {
        if (g != reference) {
            good = gb_series_mean(&sample, set, g, at[2], at[3], err);
            char *label = gb_series_group_label(set, g, NULL);
            difference_columns(series, g, label, at[2], at[3], at[0], at[1]);
            g_free(label);
        }
    }
    if (good) {
        draw_law(series, input);
    }
    g_free(buffer);
    gb_series_sample_finish(&sample);
    return good;
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
    if (gb_power_fit(&fit, v, p, have_errors(points, count) ? error : NULL, count,
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
        snprintf(label, sizeof label, "<i>ρ</i> = %g", density[from]);
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
static double *fit_densities(struct gb_series *series, const struct rate_points *points)
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
static bool compute_rate(struct gb_series *series, const struct gb_figures_input *input,
                         struct gb_error *err)
{
    struct rate_points points;
    struct gb_power_rate rate;
    if (!find_points(&points, input, "rate", err)) {
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
    fit_rate(&rate, &points, series);
    g_free(fitted);
    finish_points(&points);
    return true;
}

enum { LINE_POINTS = 101 };

/* Rates of P2 Fig. 4, 1/s; rates of runs beyond them extend the lines. */
static const double published_rates[2] = {1e4, 1e9};

/* Default densities: fewer than those of the figure rate, whose points do not overlap. */
static const double difference_density[] = {0.6, 0.7, 0.8, 0.9, 0.95};

/* Columns of the points: what is left of p beyond the static pressure of its density. */
static void point_columns(struct gb_series *series, const struct rate_points *points,
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
static double *line_rates(struct gb_series *series, const struct rate_points *points)
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
        fitted[k] = excess(law, k_v, rate[k], density);
        printed[k] = excess(law, printed_k_v, rate[k], density);
    }
    gb_series_draw(series, rate, fitted, NULL, GB_FIGURE_LINE, style % GB_FIGURE_STYLES,
                   NULL); /* a repeated colour would have markers, as the points */
    gb_series_draw(series, rate, printed, NULL, GB_FIGURE_FAINT, style, NULL);
}

static void draw_difference_densities(struct gb_series *series,
                                      const struct rate_points *points, double k_v)
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
        char *label = g_strdup_printf("<i>ρ</i> = %g", density);
        struct gb_series_curve *curve = gb_series_draw(series, rate, difference, error,
                                                       GB_FIGURE_POINTS, style, label);
        curve->from = from;
        curve->rows = to - from;
        draw_lines(series, &points->law, k_v, density, line_rate, style);
        g_free(label);
    }
}

/* P2 Fig. 4. */
static bool compute_rate_difference(struct gb_series *series,
                                    const struct gb_figures_input *input,
                                    struct gb_error *err)
{
    struct rate_points points;
    struct gb_power_rate rate;
    struct gb_figures_input at = *input;
    if (at.densities == 0) {
        at.densities = G_N_ELEMENTS(difference_density);
        memcpy(at.density, difference_density, sizeof difference_density);
    }
    if (!find_points(&points, &at, "rate-difference", err)) {
        return false;
    }
    gb_series_init(series, MAX(points.count, LINE_POINTS));
    gb_series_note(series, "p_stat: at each density the weighted mean of p - k_v v^(1/4) "
                           "(rho - rho0)^3 with the fitted k_v; se: of p");
    const bool good =
        fit_rate(&rate, &points, series) ||
        gb_error_set(err, GB_ERR_INPUT,
                     "rate-difference: %zu points of mean pressure give no k_v; it takes "
                     "two rates at one density",
                     points.count);
    if (good) {
        point_columns(series, &points, rate.k_v.value);
        draw_difference_densities(series, &points, rate.k_v.value);
        gb_series_caption(
            series,
            "Bars: standard error. Lines: P2 (9), <i>k<sub>v</sub></i> = %.3g MPa "
            "s<sup>1/4</sup>, fitted; thin: %g, printed.",
            rate.k_v.value, printed_k_v);
    }
    finish_points(&points);
    return good;
}

/* Fit of the mean curve of a group. */
struct group_fit {
    struct gb_fit_decay decay;
    double fall_error, efold_error;
    bool fitted;
};

/* Standard errors by the jackknife: fits without one run each; a fit that fails is left
 * out. */
static void jackknife(struct group_fit *fit, struct gb_average_curve *curves,
                      size_t members)
{
    double *fall = g_new(double, 2 * members);
    double *efold = fall + members;
    for (size_t i = 0; i < members; i++) {
        struct gb_fit_decay without;
        struct gb_error ignored = {0};
        const struct gb_average_curve removed = curves[i];
        curves[i] = curves[members - 1]; /* the order does not affect a mean */
        const bool good =
            members > 1 && gb_mean_curves_decay(&without, curves, members - 1, &ignored);
        curves[i] = removed;
        fall[i] = good ? gb_fit_decay_fall(&without) : (double)NAN;
        efold[i] = good ? gb_fit_decay_efold(&without) : (double)NAN;
    }
    fit->fall_error = gb_average_jackknife(fall, members);
    fit->efold_error = gb_average_jackknife(efold, members);
    g_free(fall);
}

static struct gb_fit_decay unfitted(void)
{
    const struct gb_fit_value none = {NAN, NAN, NAN, NAN};
    return (struct gb_fit_decay){
        .p0 = none, .amplitude = {none, none}, .tau = {none, none}, .scatter = NAN};
}

/* A mean that no fit describes leaves NaN, and the reason in cause. */
static bool fit_group(struct group_fit *fit, const struct gb_runset *set, size_t group,
                      struct gb_error *cause, struct gb_error *err)
{
    struct gb_mean_curves curves;
    if (!gb_mean_curves_relaxation(&curves, set, group, err)) {
        return false;
    }
    fit->fitted = gb_mean_curves_decay(&fit->decay, curves.curve, curves.count, cause);
    if (fit->fitted) {
        jackknife(fit, curves.curve, curves.count);
    } else {
        *fit = (struct group_fit){.decay = unfitted(), NAN, NAN, false};
    }
    gb_mean_curves_finish(&curves);
    return true;
}

/* Columns of one parameter: value and interval. */
static void value_columns(struct gb_series *series, const char *name, const char *unit,
                          const struct group_fit *fits, size_t offset)
{
    double *value = gb_series_column(series, "%s_%s", name, unit);
    double *low = gb_series_column(series, "%s_low_%s", name, unit);
    double *high = gb_series_column(series, "%s_high_%s", name, unit);
    for (size_t g = 0; g < series->rows; g++) {
        const struct gb_fit_value *parameter =
            (const struct gb_fit_value *)(const void *)((const char *)&fits[g].decay +
                                                        offset);
        value[g] = parameter->value;
        low[g] = parameter->low;
        high[g] = parameter->high;
    }
}

static void fall_columns(struct gb_series *series, const struct group_fit *fits)
{
    double *const columns[] = {
        gb_series_column(series, "scatter_MPa"), gb_series_column(series, "fall_MPa"),
        gb_series_column(series, "fall_se_MPa"), gb_series_column(series, "efold_ns"),
        gb_series_column(series, "efold_se_ns")};
    for (size_t g = 0; g < series->rows; g++) {
        const double row[] = {fits[g].decay.scatter, gb_fit_decay_fall(&fits[g].decay),
                              fits[g].fall_error, gb_fit_decay_efold(&fits[g].decay),
                              fits[g].efold_error};
        for (size_t k = 0; k < G_N_ELEMENTS(row); k++) {
            columns[k][g] = row[k];
        }
    }
}

/* What is drawn of both exponentials. */
enum drawn { TIMES, AMPLITUDES };

/* One parameter of both exponentials against the rate; bars: half of the 95 % interval. */
static void draw_parameter(struct gb_series *series, const double *rate,
                           const struct group_fit *fits, enum drawn drawn)
{
    static const char *const names[][GB_FIT_TERMS] = {
        [TIMES] = {"fast, <i>τ</i><sub>1</sub>", "slow, <i>τ</i><sub>2</sub>"},
        [AMPLITUDES] = {"fast, <i>p</i><sub>1</sub>", "slow, <i>p</i><sub>2</sub>"}};
    const char *unit = drawn == TIMES ? "ns" : "MPa";
    for (int k = 0; k < GB_FIT_TERMS; k++) {
        double *value = gb_series_column(series, "drawn_%d_%s", k + 1, unit);
        double *half = gb_series_column(series, "half_%d_%s", k + 1, unit);
        bool shown = false; /* on the logarithmic axis */
        for (size_t g = 0; g < series->rows; g++) {
            const struct gb_fit_decay *decay = &fits[g].decay;
            const struct gb_fit_value *from =
                drawn == TIMES ? &decay->tau[k] : &decay->amplitude[k];
            value[g] = from->value;
            half[g] = 0.5 * (from->high - from->low);
            shown = shown || from->value > 0.0;
        }
        gb_series_draw(series, rate, value, half, GB_FIGURE_POINTS, k,
                       shown ? names[drawn][k] : NULL);
    }
    gb_series_caption(series,
                      "%s of the two exponentials of P2 (4); bars: 95 %% "
                      "confidence intervals.",
                      drawn == TIMES ? "Times" : "Amplitudes");
}

static void relaxation_columns(struct gb_series *series, const struct gb_runset *set,
                               const struct group_fit *fits,
                               const struct gb_error *causes, enum drawn drawn)
{
    static const char *const reasons[] = {
        "the number of P2 (4)", "no more by the F test",
        "the interval of one more contains zero or is unbounded",
        "the fit of one more did not converge"};
    double *group = gb_series_column(series, "group");
    double *rate = gb_series_column(series, "rate_per_s");
    double *runs = gb_series_column(series, "runs");
    double *terms = gb_series_column(series, "exponentials");
    for (size_t g = 0; g < set->groups; g++) {
        char *label = gb_runset_label(set, g);
        group[g] = (double)(g + 1);
        rate[g] = gb_runset_first(set, g)->params.rate_per_s;
        runs[g] = (double)gb_runset_members(set, g);
        terms[g] = fits[g].decay.terms;
        if (fits[g].fitted) {
            gb_series_note(series, "group %zu: %s%s%d exponentials, %s", g + 1, label,
                           *label ? "; " : "", fits[g].decay.terms,
                           reasons[fits[g].decay.reason]);
        } else {
            gb_series_note(series, "group %zu: %s%s%s", g + 1, label, *label ? "; " : "",
                           causes[g].text);
        }
        g_free(label);
    }
    value_columns(series, "p0", "MPa", fits, offsetof(struct gb_fit_decay, p0));
    value_columns(series, "p1", "MPa", fits, offsetof(struct gb_fit_decay, amplitude[0]));
    value_columns(series, "tau1", "ns", fits, offsetof(struct gb_fit_decay, tau[0]));
    value_columns(series, "p2", "MPa", fits, offsetof(struct gb_fit_decay, amplitude[1]));
    value_columns(series, "tau2", "ns", fits, offsetof(struct gb_fit_decay, tau[1]));
    fall_columns(series, fits);
    draw_parameter(series, rate, fits, drawn);
}

static bool fit_groups(struct group_fit *fits, struct gb_error *causes,
                       const struct gb_runset *set, struct gb_error *err)
{
    size_t fitted = 0;
    for (size_t g = 0; g < set->groups; g++) {
        if (!fit_group(&fits[g], set, g, &causes[g], err)) {
            return false;
        }
        fitted += fits[g].fitted;
    }
    return fitted > 0 || gb_error_set(err, causes[0].code, "%.300s: relaxation: %s",
                                      gb_runset_first(set, 0)->directory, causes[0].text);
}

static bool draw_table(struct gb_series *series, const struct gb_runset *set,
                       enum drawn drawn, struct gb_error *err)
{
    struct group_fit *fits = g_new0(struct group_fit, set->groups);
    struct gb_error *causes = g_new0(struct gb_error, set->groups);
    const bool good = fit_groups(fits, causes, set, err);
    if (good) {
        gb_series_init(series, set->groups);
        gb_series_note(series,
                       "p(t) = p0 + p1 exp(-t/tau1) + p2 exp(-t/tau2), P2 (4), fitted to "
                       "the mean of the runs; t from the end of compression");
        gb_series_note(series,
                       "intervals are at 95 %%, for as many points as the correlation of "
                       "the residuals leaves independent");
        gb_series_note(series,
                       "fall: total decrease of p; efold: time after which 1/e of it "
                       "remains; standard errors by the jackknife over the runs");
        relaxation_columns(series, set, fits, causes, drawn);
    }
    g_free(causes);
    g_free(fits);
    return good;
}

/* P2 (4) and table 1: times. */
static bool compute_relaxation(struct gb_series *series,
                               const struct gb_figures_input *input, struct gb_error *err)
{
    return gb_series_check_dynamic(input->set, "relaxation", err) &&
           draw_table(series, input->set, TIMES, err);
}

/* The same table: amplitudes. */
static bool compute_relaxation_amplitude(struct gb_series *series,
                                         const struct gb_figures_input *input,
                                         struct gb_error *err)
{
    return gb_series_check_dynamic(input->set, "relaxation-amplitude", err) &&
           draw_table(series, input->set, AMPLITUDES, err);
}

/* Points of a curve. */
enum { CURVE_POINTS = 600 };

/* Columns of t and p, thinned evenly in log t, and of the fit. */
static void fill_columns(const double *t, const double *p, size_t count,
                         const struct gb_fit_decay *fit, double *const column[3])
{
    size_t filled = 0;
    double next = 0.0;
    for (size_t k = 0; k < count && filled < CURVE_POINTS; k++) {
        if (t[k] > 0.0 && t[k] >= next) {
            next = t[k] * pow(t[count - 1] / fmax(t[k], 1e-300),
                              1.0 / (double)(CURVE_POINTS - filled));
            column[0][filled] = t[k];
            column[1][filled] = p[k];
            column[2][filled++] = fit != NULL ? gb_fit_decay_at(fit, t[k]) : NAN;
        }
    }
}

static void note_value(GString *text, const char *name, const struct gb_fit_value *value,
                       const char *unit)
{
    g_string_append_printf(text, ", %s = %.5g (%.5g to %.5g) %s", name, value->value,
                           value->low, value->high, unit);
}

/* The parameters of a fit with their 95 % intervals. */
static void note_fit(struct gb_series *series, size_t group,
                     const struct gb_fit_decay *fit)
{
    static const char *const names[GB_FIT_TERMS][2] = {{"p1", "tau1"}, {"p2", "tau2"}};
    GString *text = g_string_new(NULL);
    note_value(text, "p0", &fit->p0, "MPa");
    for (int k = 0; k < fit->terms; k++) {
        note_value(text, names[k][0], &fit->amplitude[k], "MPa");
        note_value(text, names[k][1], &fit->tau[k], "ns");
    }
    gb_series_note(series, "group %zu: fit of P2 (4)%s", group + 1, text->str);
    g_string_free(text, TRUE);
}

/* The mean of a group and its fit, where it converges. */
static bool draw_group(struct gb_series *series, const struct gb_runset *set,
                       size_t group, struct gb_error *err)
{
    double *t = NULL;
    double *p = NULL;
    size_t count = 0;
    struct gb_mean_curves curves;
    struct gb_fit_decay fit;
    if (!gb_mean_curves_relaxation(&curves, set, group, err)) {
        gb_mean_curves_finish(&curves);
        return false;
    }
    double *const column[3] = {gb_series_column(series, "t_%zu_ns", group + 1),
                               gb_series_column(series, "p_%zu_MPa", group + 1),
                               gb_series_column(series, "fit_%zu_MPa", group + 1)};
    const bool good =
        gb_mean_curves_mean(curves.curve, curves.count, &t, &p, &count, err);
    if (good) {
        const bool fitted = gb_fit_decay(&fit, t, p, count, NULL);
        fill_columns(t, p, count, fitted ? &fit : NULL, column);
        if (fitted) {
            note_fit(series, group, &fit);
        }
    }
    gb_alloc_free(t);
    gb_alloc_free(p);
    gb_mean_curves_finish(&curves);
    char *label = gb_series_group_label(set, group, NULL);
    gb_series_draw(series, column[0], column[1], NULL, GB_FIGURE_LINE, (int)group, label);
    gb_series_draw(series, column[0], column[2], NULL, GB_FIGURE_FAINT,
                   gb_figure_black(0), NULL);
    g_free(label);
    return good;
}

/* P2 (4). */
static bool compute_decay(struct gb_series *series, const struct gb_figures_input *input,
                          struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    if (!gb_series_check_dynamic(set, "decay", err)) {
        return false;
    }
    gb_series_init(series, CURVE_POINTS);
    const size_t max = gb_series_list_groups(series, set);
    if (max > 1) {
        gb_series_caption(series, "Means of %zu runs.", max);
    }
    gb_series_caption(series, "Thin black: fit of P2 (4).");
    bool good = true;
    for (size_t g = 0; g < set->groups && good; g++) {
        good = draw_group(series, set, g, err);
    }
    return good;
}

#define RATE_AXIS                                                                        \
    {                                                                                    \
        .name = "rate_per_s", .label = "densification rate <i>v</i> (1/s)", .log = true, \
        .several = true                                                                  \
    }

const struct gb_figures_row gb_figures_rates_rows[] = {
    {"difference", "pressure minus the reference, with P2 (9)", "P2 Fig. 3",
     GB_FIGURES_RUNS, GB_FIGURES_ON_REQUEST, GB_FIGURES_REFERENCE,
     .ignored_keys = gb_figures_after_loading, .x = GB_FIGURES_DENSITY_AXIS,
     .y = {.name = "difference_MPa", .label = "pressure difference Δ<i>p</i> (MPa)"},
     .compute = compute_difference},
    {"rate", "pressure at given densities against rate, with power law", "P2 sec. 3",
     GB_FIGURES_RUNS, GB_FIGURES_ON_REQUEST, GB_FIGURES_DENSITY,
     .ignored_keys = gb_figures_after_loading, .x = RATE_AXIS,
     .y = {.name = "p_MPa", .label = "pressure <i>p</i> (MPa)", .log = true},
     .compute = compute_rate},
    {"rate-difference", "pressure above the static one against rate, with P2 (9)",
     "P2 Fig. 4", GB_FIGURES_RUNS, GB_FIGURES_ON_REQUEST, GB_FIGURES_DENSITY,
     .ignored_keys = gb_figures_after_loading, .x = RATE_AXIS,
     .y = {.name = "difference_MPa",
           .label = "pressure above the static one <i>p</i> − "
                    "<i>p</i><sub>stat</sub> (MPa)"},
     .compute = compute_rate_difference},
    {"relaxation", "relaxation times after compression, from the fitted decay",
     "P2 Table 1", GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT, .x = RATE_AXIS,
     .y = {.name = "tau_ns", .label = "relaxation time <i>τ</i> (ns)", .log = true},
     .compute = compute_relaxation},
    {"relaxation-amplitude", "amplitudes of the fitted decay after compression",
     "P2 Table 1", GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT, .x = RATE_AXIS,
     .y = {.name = "amplitude_MPa",
           .label = "amplitude <i>p<sub>i</sub></i> (MPa)",
           .log = true},
     .compute = compute_relaxation_amplitude},
    {"decay", "pressure after compression against time, with its fit", "P2 (4)",
     GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT,
     .x = {.name = "t_ns",
           .label = "time since the end of compression <i>t</i> (ns)",
           .log = true},
     .y = GB_FIGURES_PRESSURE_AXIS, .compute = compute_decay},
    {0},
};
