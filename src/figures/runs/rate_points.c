#include "figures/runs/rate_points.h"

#include <math.h>

#include "base/alloc.h"
#include "figures/runs/runs_check.h"
#include "measure/fit/average.h"
#include "scene/derived.h"

const double gb_rate_points_printed_k_v = 21.5;

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

bool gb_rate_points_have_errors(const struct gb_power_point *points, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (!(points[i].error > 0.0)) {
            return false;
        }
    }
    return true;
}

static void collect_densities(struct gb_rate_points *points, const struct gb_runset *set,
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
    const bool given = gb_rate_points_have_errors(points->point, points->count);
    for (size_t i = 0; i < points->count && !given; i++) {
        points->fitted[i].error = 0.0;
    }
}

bool gb_rate_points_find(struct gb_rate_points *points,
                         const struct gb_figures_input *input, const char *figure,
                         struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    const bool given = input->densities > 0;
    const double *density = given ? input->density : default_density;
    const size_t densities = given ? input->densities : G_N_ELEMENTS(default_density);
    *points = (struct gb_rate_points){0};
    if (!gb_runs_check_dynamic(set, figure, err) || !check_one_series(set, figure, err)) {
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
        gb_rate_points_finish(points);
        return gb_error_set(err, GB_ERR_INPUT, "%s: no run reaches density %g", figure,
                            density[0]);
    }
    return good;
}

void gb_rate_points_finish(struct gb_rate_points *points)
{
    g_free(points->point);
    g_free(points->fitted);
    g_free(points->runs);
    *points = (struct gb_rate_points){0};
}

static void note_k_v(struct gb_series *series, const struct gb_power_law *law,
                     const struct gb_power_rate *rate)
{
    gb_series_note(series,
                   "P2 (9): p = p_stat(rho) + k_v v^(1/4) (rho - %g)^3, k_v = %.4g "
                   "(%.4g to %.4g) MPa s^(1/4), chi2 = %.4g with %d degrees of freedom; "
                   "P2 has %g",
                   law->rho0, rate->k_v.value, rate->k_v.low, rate->k_v.high, rate->chi2,
                   rate->degrees, gb_rate_points_printed_k_v);
}

bool gb_rate_points_fit(struct gb_power_rate *rate, const struct gb_rate_points *points,
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

double gb_rate_points_excess(const struct gb_power_law *law, double k_v, double rate,
                             double density)
{
    return k_v * pow(rate, law->exponent) * pow(density - law->rho0, law->power);
}
