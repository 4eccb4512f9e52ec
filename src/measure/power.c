/* Pressure as a power of the rate of compression.  The exponent is found on a grid and by
 * Brent minimisation; the other parameters follow by linear least squares. */
#include "measure/power.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_min.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "greenbody/status.h"

/* Exponents that are looked at. */
#define EXPONENT_MIN 0.005

#define EXPONENT_MAX 4.0

/* Points of the grid in which the lowest minimum is bracketed. */
enum { GRID_POINTS = 120, ITERATIONS = 200 };

static double squares_at(double exponent, void *data)
{
    const struct gb_exponent_profile *profile = data;
    return profile->squares(exponent, profile->data);
}

static double grid_exponent(int k)
{
    return EXPONENT_MIN * pow(EXPONENT_MAX / EXPONENT_MIN, (double)k / (GRID_POINTS - 1));
}

/* Brent minimisation between the neighbours of the lowest grid point. */
static bool refine(const struct gb_exponent_profile *profile, int best, double *exponent)
{
    gsl_function function = {squares_at, (void *)profile};
    gsl_min_fminimizer *work = gsl_min_fminimizer_alloc(gsl_min_fminimizer_brent);
    if (work == NULL) {
        return false;
    }
    int status = gsl_min_fminimizer_set(work, &function, grid_exponent(best),
                                        grid_exponent(best - 1), grid_exponent(best + 1));
    for (int i = 0; i < ITERATIONS && status == GSL_SUCCESS; i++) {
        status = gsl_min_fminimizer_iterate(work);
        if (status == GSL_SUCCESS &&
            gsl_min_test_interval(gsl_min_fminimizer_x_lower(work),
                                  gsl_min_fminimizer_x_upper(work), 0.0,
                                  1e-10) == GSL_SUCCESS) {
            break;
        }
    }
    *exponent = gsl_min_fminimizer_x_minimum(work);
    gsl_min_fminimizer_free(work);
    return true;
}

/* The exponent of the least sum, found on a grid first.  Errors: GB_ERR_NOT_CONVERGED
 * when it is one of the ends, GB_ERR_MEMORY. */
static bool least_exponent(const struct gb_exponent_profile *profile, double *exponent,
                           struct gb_error *err)
{
    int best = 0;
    double least = INFINITY;
    for (int k = 0; k < GRID_POINTS; k++) {
        const double squares = profile->squares(grid_exponent(k), profile->data);
        if (squares < least) {
            least = squares;
            best = k;
        }
    }
    if (best == 0 || best == GRID_POINTS - 1) {
        return gb_error_set(
            err, GB_ERR_NOT_CONVERGED,
            "the pressures do not follow a power law in the rate: the best "
            "exponent is %s",
            best == 0 ? "0, which means a logarithmic law" : "4 or more");
    }
    return refine(profile, best, exponent) ||
           gb_error_set(err, GB_ERR_MEMORY, "out of memory for a fit");
}

double gb_power_crossing(const struct gb_exponent_profile *profile, double level,
                         double inside, double outside)
{
    if (profile->squares(outside, profile->data) <= level) {
        return outside;
    }
    double low = fmin(inside, outside);
    double high = fmax(inside, outside);
    const bool rising = outside > inside;
    for (int i = 0; i < ITERATIONS && high - low > 1e-12 * fmax(fabs(low), fabs(high));
         i++) {
        const double middle = 0.5 * (low + high);
        const bool beyond = profile->squares(middle, profile->data) > level;
        if (beyond == rising) {
            high = middle;
        } else {
            low = middle;
        }
    }
    return 0.5 * (low + high);
}

enum { UNKNOWNS = 3 };

static const double interval_level = 0.975; /* two-sided 95 % */

/* Points with rates in units of their geometric mean: powers of 1e9 stay near 1. */
struct rates {
    const double *v, *p, *error;
    size_t count;
    double unit;
};

/* Straight line p = a + k u^n for a given exponent. */
static double line_squares(const struct rates *rates, double n, double *a, double *k)
{
    double sum = 0.0, x_mean = 0.0, y_mean = 0.0, xx = 0.0, xy = 0.0, squares = 0.0;
    for (size_t i = 0; i < rates->count; i++) {
        const double w = pow(rates->error ? rates->error[i] : 1.0, -2.0);
        sum += w;
        x_mean += w * pow(rates->v[i] / rates->unit, n);
        y_mean += w * rates->p[i];
    }
    x_mean /= sum;
    y_mean /= sum;
    for (size_t i = 0; i < rates->count; i++) {
        const double w = pow(rates->error ? rates->error[i] : 1.0, -2.0);
        const double x = pow(rates->v[i] / rates->unit, n) - x_mean;
        xx += w * x * x;
        xy += w * x * (rates->p[i] - y_mean);
    }
    *k = xx > 0.0 ? xy / xx : 0.0;
    *a = y_mean - *k * x_mean;
    for (size_t i = 0; i < rates->count; i++) {
        const double error = rates->error ? rates->error[i] : 1.0;
        const double rest = rates->p[i] - *a - *k * pow(rates->v[i] / rates->unit, n);
        squares += rest * rest / (error * error);
    }
    return squares;
}

static double squares_of_rates(double exponent, const void *data)
{
    double a = 0.0;
    double k = 0.0;
    return line_squares(data, exponent, &a, &k);
}

/* Inverse of J^T W J of the three unknowns (a, k in units of the mean rate, n); false
 * when the points do not determine them. */
static bool covariance_of(const struct rates *rates, double k, double n,
                          double covariance[UNKNOWNS * UNKNOWNS])
{
    memset(covariance, 0, UNKNOWNS * UNKNOWNS * sizeof *covariance);
    for (size_t i = 0; i < rates->count; i++) {
        const double w = pow(rates->error ? rates->error[i] : 1.0, -2.0);
        const double u = rates->v[i] / rates->unit;
        const double row[UNKNOWNS] = {1.0, pow(u, n), k * pow(u, n) * log(u)};
        for (int a = 0; a < UNKNOWNS; a++) {
            for (int b = 0; b < UNKNOWNS; b++) {
                covariance[UNKNOWNS * a + b] += w * row[a] * row[b];
            }
        }
    }
    gsl_matrix_view view = gsl_matrix_view_array(covariance, UNKNOWNS, UNKNOWNS);
    gsl_error_handler_t *handler = gsl_set_error_handler_off();
    const bool good = gsl_linalg_cholesky_decomp1(&view.matrix) == GSL_SUCCESS &&
                      gsl_linalg_cholesky_invert(&view.matrix) == GSL_SUCCESS;
    gsl_set_error_handler(handler);
    return good;
}

static struct gb_fit_value value_with(double value, double error, double quantile)
{
    return (struct gb_fit_value){value, error, value - quantile * error,
                                 value + quantile * error};
}

/* Factor of the variance and quantile of the intervals: given errors are a lower
 * bound, missing ones follow from the residuals. */
static double spread(double chi2, int degrees, bool given, double *quantile)
{
    const double ratio = degrees > 0 ? chi2 / degrees : 0.0;
    if (given && ratio <= 1.0) {
        *quantile = gsl_cdf_ugaussian_Pinv(interval_level);
        return 1.0;
    }
    *quantile = degrees > 0 ? gsl_cdf_tdist_Pinv(interval_level, degrees) : (double)NAN;
    return degrees > 0 ? ratio : (double)NAN;
}

static void report(struct gb_power *fit, const struct rates *rates, double a, double k,
                   double n)
{
    double c[UNKNOWNS * UNKNOWNS];
    double quantile = NAN;
    const double factor =
        covariance_of(rates, k, n, c)
            ? spread(fit->chi2, fit->degrees, rates->error != NULL, &quantile)
            : (double)NAN;
    /* k in units of v: K = k / unit^n, dK = (dk - k ln(unit) dn) / unit^n */
    const double shrink = pow(rates->unit, -n);
    const double slope = -k * log(rates->unit);
    const double variance = c[4] + 2.0 * slope * c[5] + slope * slope * c[8];
    fit->a = value_with(a, sqrt(factor * c[0]), quantile);
    fit->k =
        value_with(k * shrink, shrink * sqrt(factor * fmax(variance, 0.0)), quantile);
    fit->n = value_with(n, sqrt(factor * c[8]), quantile);
}

static bool check_rates(struct rates *rates, struct gb_error *err)
{
    double logarithms = 0.0;
    size_t different = 0;
    for (size_t i = 0; i < rates->count; i++) {
        const double error = rates->error ? rates->error[i] : 1.0;
        if (!isfinite(rates->v[i]) || rates->v[i] <= 0.0 || !isfinite(rates->p[i]) ||
            !isfinite(error) || error <= 0.0) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "rate %g, pressure %g, error %g: a fit needs finite "
                                "numbers, rate and error above 0",
                                rates->v[i], rates->p[i], error);
        }
        bool seen = false;
        for (size_t j = 0; j < i; j++) {
            seen = seen || rates->v[j] == rates->v[i];
        }
        different += !seen;
        logarithms += log(rates->v[i]);
    }
    if (different < UNKNOWNS) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%zu different rates; a power law needs three", different);
    }
    rates->unit = exp(logarithms / (double)rates->count);
    return true;
}

bool gb_power_fit(struct gb_power *fit, const double *v, const double *p,
                  const double *error, size_t count, struct gb_error *err)
{
    struct rates rates = {v, p, error, count, 1.0};
    const struct gb_exponent_profile profile = {squares_of_rates, &rates};
    double n = NAN;
    double a = NAN;
    double k = NAN;
    if (!check_rates(&rates, err) || !least_exponent(&profile, &n, err)) {
        return false;
    }
    fit->chi2 = line_squares(&rates, n, &a, &k);
    fit->degrees = (int)count - UNKNOWNS;
    report(fit, &rates, a, k, n);
    return true;
}

/* x = v^n (rho - rho0)^power and p less their means at equal density: the offsets p_stat
 * drop out, and what is left is one straight line through 0. */
struct within {
    const struct gb_power_law *law;
    const struct gb_power_point *points;
    size_t count;
    bool given; /* errors of the points */
};

static double factor_of(const struct gb_power_law *law,
                        const struct gb_power_point *point, double exponent)
{
    return pow(point->v, exponent) * pow(point->rho - law->rho0, law->power);
}

static double weight_of(const struct within *within, size_t i)
{
    return within->given ? pow(within->points[i].error, -2.0) : 1.0;
}

/* Point i less the weighted means of the points of its density. */
static void centre(const struct within *within, size_t i, double exponent, double *x,
                   double *y)
{
    double sum = 0.0, x_mean = 0.0, y_mean = 0.0;
    for (size_t j = 0; j < within->count; j++) {
        if (within->points[j].rho == within->points[i].rho) {
            const double w = weight_of(within, j);
            sum += w;
            x_mean += w * factor_of(within->law, &within->points[j], exponent);
            y_mean += w * within->points[j].p;
        }
    }
    *x = factor_of(within->law, &within->points[i], exponent) - x_mean / sum;
    *y = within->points[i].p - y_mean / sum;
}

/* Returns the sum of squares; xx is the inverse of the slope's variance. */
static double slope_within(const struct within *within, double exponent, double *slope,
                           double *xx)
{
    double xy = 0.0, yy = 0.0;
    *xx = 0.0;
    for (size_t i = 0; i < within->count; i++) {
        const double w = weight_of(within, i);
        double x = 0.0, y = 0.0;
        centre(within, i, exponent, &x, &y);
        *xx += w * x * x;
        xy += w * x * y;
        yy += w * y * y;
    }
    *slope = *xx > 0.0 ? xy / *xx : (double)NAN;
    return *xx > 0.0 ? fmax(yy - xy * xy / *xx, 0.0) : yy;
}

static double squares_within_densities(double exponent, const void *data)
{
    double slope = 0.0;
    double xx = 0.0;
    return slope_within(data, exponent, &slope, &xx);
}

/* Counts the different densities. */
static int count_densities(const struct gb_power_point *points, size_t count)
{
    int different = 0;
    for (size_t i = 0; i < count; i++) {
        bool seen = false;
        for (size_t j = 0; j < i; j++) {
            seen = seen || points[j].rho == points[i].rho;
        }
        different += !seen;
    }
    return different;
}

static bool check_within(struct within *within, struct gb_error *err)
{
    size_t known = 0;
    for (size_t i = 0; i < within->count; i++) {
        const struct gb_power_point *point = &within->points[i];
        if (!isfinite(point->v) || point->v < 0.0 || !isfinite(point->p) ||
            !isfinite(point->rho) || !(point->rho > within->law->rho0) ||
            !isfinite(point->error) || point->error < 0.0) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "rate %g, density %g, pressure %g, error %g: a fit needs "
                                "finite numbers, a rate of 0 or more, a density above %g",
                                point->v, point->rho, point->p, point->error,
                                within->law->rho0);
        }
        known += point->error > 0.0;
    }
    if (known != 0 && known != within->count) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%zu of %zu pressures have an error: all or none is needed",
                            known, within->count);
    }
    within->given = known > 0;
    return true;
}

bool gb_power_rate(struct gb_power_rate *fit, const struct gb_power_law *law,
                   const struct gb_power_point *points, size_t count,
                   struct gb_error *err)
{
    struct within within = {law, points, count, false};
    double slope = NAN;
    double xx = 0.0;
    double quantile = NAN;
    if (!check_within(&within, err)) {
        return false;
    }
    fit->chi2 = slope_within(&within, law->exponent, &slope, &xx);
    if (!(xx > 0.0)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "no density with two rates; k_v needs one at least");
    }
    fit->degrees = (int)count - count_densities(points, count) - 1;
    const double factor = spread(fit->chi2, fit->degrees, within.given, &quantile);
    fit->k_v = value_with(slope, sqrt(factor / xx), quantile);
    return true;
}

double gb_power_static(const struct gb_power_law *law, double k_v,
                       const struct gb_power_point *points, size_t count, double rho)
{
    const struct within within = {law, points, count, count > 0 && points[0].error > 0.0};
    double sum = 0.0;
    double weights = 0.0;
    for (size_t i = 0; i < count; i++) {
        if (points[i].rho == rho) {
            const double w = weight_of(&within, i);
            weights += w;
            sum += w * (points[i].p - k_v * factor_of(law, &points[i], law->exponent));
        }
    }
    return sum / weights;
}

bool gb_power_exponent(struct gb_fit_value *exponent, const struct gb_power_law *law,
                       const struct gb_power_point *points, size_t count,
                       struct gb_error *err)
{
    struct within within = {law, points, count, false};
    const struct gb_exponent_profile profile = {squares_within_densities, &within};
    const int degrees = (int)count - count_densities(points, count) - 2;
    double n = NAN;
    double quantile = NAN;
    if (!check_within(&within, err)) {
        return false;
    }
    if (degrees < 0 || (degrees == 0 && !within.given)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%zu points do not determine exponent and k_v", count);
    }
    if (!least_exponent(&profile, &n, err)) {
        return false;
    }
    const double least = squares_within_densities(n, &within);
    const double factor = spread(least, degrees, within.given, &quantile);
    const double level = least + factor * quantile * quantile;
    *exponent = (struct gb_fit_value){
        .value = n,
        .low = gb_power_crossing(&profile, level, n, EXPONENT_MIN),
        .high = gb_power_crossing(&profile, level, n, EXPONENT_MAX),
    };
    exponent->error = 0.5 * (exponent->high - exponent->low) / quantile;
    return true;
}
