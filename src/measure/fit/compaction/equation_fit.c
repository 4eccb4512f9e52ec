#include "measure/fit/compaction/equation_fit.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "measure/fit/average.h"
#include "measure/fit/compaction/equation_iterate.h"
#include "measure/fit/compaction/equation_starts.h"
#include "measure/fit/decay.h"

static const double interval_level = 0.975; /* two-sided 95 % */

/* Residuals below this are rounding. */
static const double rounding = 1e-12;

/* Fewer replicas tell nothing about their scatter. */
enum { REPLICAS_LEAST = 3 };

/* Unknown initial densities that the iteration starts from, over the lowest density. */
static const double initial_shares[] = {0.99, 0.95, 0.85, 0.7, 0.45};

double gb_equation_fit_at(const struct gb_equation_fit *fit, double pressure)
{
    return fit->equation->density(fit->x, pressure);
}

static double lowest_density(const struct gb_equations_points *points)
{
    double low = points->density[0];
    for (size_t i = 1; i < points->count; i++) {
        low = fmin(low, points->density[i]);
    }
    return low;
}

/* k1 < k2: the terms of Cooper and Eaton have no order of their own. */
static void order_terms(const struct gb_equation *equation, double *x, double *covariance)
{
    if (equation->start != gb_equation_starts_cooper_eaton || x[2] <= x[3]) {
        return;
    }
    for (int k = 0; k <= 2; k += 2) {
        const double kept = x[k];
        const double kept_covariance = covariance[k];
        x[k] = x[k + 1];
        covariance[k] = covariance[k + 1];
        x[k + 1] = kept;
        covariance[k + 1] = kept_covariance;
    }
}

/* Why the points leave an equation without a best fit. */
static bool refuse(const struct gb_equation *equation,
                   const struct gb_equations_points *points, int undetermined,
                   struct gb_error *err)
{
    const double *p = points->pressure;
    const double *rho = points->density;
    double low = rho[0];
    double high = rho[0];
    double middle = 0.0;
    double rise = 0.0; /* sign of the slope of rho over P */
    for (size_t i = 0; i < points->count; i++) {
        low = fmin(low, rho[i]);
        high = fmax(high, rho[i]);
        middle += p[i] / (double)points->count;
    }
    for (size_t i = 0; i < points->count; i++) {
        rise += (p[i] - middle) * (rho[i] - low);
    }
    const char *name = "its parameters";
    if (undetermined != GB_EQUATION_ITERATE_ALL) {
        name = gb_equations_parameter(equation, (size_t)undetermined)->name;
    }
    if (high - low <= rounding * high) {
        return gb_error_set(err, GB_ERR_NOT_CONVERGED,
                            "%s: all densities are %.6g: the points do not determine %s",
                            equation->name, low, name);
    }
    if (!(rise > 0.0)) {
        return gb_error_set(err, GB_ERR_NOT_CONVERGED,
                            "%s: the density falls with the pressure, from %.6g to %.6g: "
                            "the points do not determine %s",
                            equation->name, rho[0], rho[points->count - 1], name);
    }
    return gb_error_set(err, GB_ERR_NOT_CONVERGED,
                        "%s: the points do not determine %s: other values describe them "
                        "as well",
                        equation->name, name);
}

/* The best of the iterations from all start values. */
static bool minimise(struct gb_equation_fit *fit,
                     const struct gb_equations_points *points, double *covariance,
                     struct gb_error *err)
{
    const struct gb_equation *equation = fit->equation;
    const bool unknown = gb_equations_fits_initial(equation, points);
    const size_t starts = unknown ? sizeof initial_shares / sizeof initial_shares[0] : 1;
    int undetermined = GB_EQUATION_ITERATE_ALL;
    fit->squares = INFINITY;
    for (size_t s = 0; s < starts; s++) {
        double x[GB_EQUATIONS_PARAMETERS] = {0.0};
        struct gb_equation_iterate iterate = {.equation = equation,
                                              .points = points,
                                              .fixed = GB_EQUATION_ITERATE_ALL,
                                              .x = x};
        if ((equation->domain & GB_EQUATIONS_ABOVE_INITIAL) != 0) {
            x[equation->count] =
                unknown ? initial_shares[s] * lowest_density(points) : points->initial;
        }
        equation->start(points, x);
        if (!gb_equation_iterate(&iterate, err)) {
            return false;
        }
        if (iterate.undetermined != GB_EQUATION_ITERATE_ALL) {
            undetermined = iterate.undetermined;
        } else if (iterate.converged && iterate.squares < fit->squares) {
            order_terms(equation, x, iterate.covariance);
            fit->squares = iterate.squares;
            memcpy(fit->x, x, sizeof x);
            memcpy(covariance, iterate.covariance, sizeof iterate.covariance);
        }
    }
    return isfinite(fit->squares) || refuse(equation, points, undetermined, err);
}

/* rms, correlation and what follows from them. */
static bool set_scatter(struct gb_equation_fit *fit,
                        const struct gb_equations_points *points, struct gb_error *err)
{
    const double n = (double)points->count;
    const double degrees = n - (double)fit->size;
    const double k = (double)fit->size + 1.0;
    double *residual = gb_alloc_array(points->count, sizeof *residual, err);
    double sum = 0.0;
    if (residual == NULL) {
        return false;
    }
    for (size_t i = 0; i < points->count; i++) {
        const double off =
            gb_equation_fit_at(fit, points->pressure[i]) - points->density[i];
        sum += off * off;
        residual[i] = off * sqrt(gb_equation_starts_weight(points, i));
    }
    fit->rms = sqrt(sum / n);
    fit->correlation = gb_decay_correlation(residual, points->count, 0.0);
    gb_alloc_free(residual);
    const double least = points->error != NULL ? 1.0 : rounding * rounding;
    fit->variance = fmax(fit->squares / degrees, least) * fit->correlation;
    fit->quantile = gsl_cdf_tdist_Pinv(
        interval_level, fmax(n / fit->correlation - (double)fit->size, 1.0));
    fit->aicc = n * log(fmax(fit->squares / n, rounding * rounding)) + 2.0 * k +
                2.0 * k * (k + 1.0) / (n - k - 1.0);
    return true;
}

/* An interval of half width `half` in the coordinate of the fit. */
static void set_interval(struct gb_equation_fit *fit, size_t k, double half)
{
    const double at = gb_equation_iterate_coordinate(fit->equation, k, fit->x[k]);
    fit->value[k].low = gb_equation_iterate_value(fit->equation, k, at - half);
    fit->value[k].high = gb_equation_iterate_value(fit->equation, k, at + half);
}

static void set_values(struct gb_equation_fit *fit, const double *covariance)
{
    for (size_t k = 0; k < fit->size; k++) {
        const double error = sqrt(covariance[k] * fit->variance);
        const bool positive = gb_equations_parameter(fit->equation, k)->positive;
        fit->value[k].value = fit->x[k];
        fit->value[k].error = positive ? fit->x[k] * error : error;
        set_interval(fit, k, fit->quantile * error);
    }
}

bool gb_equation_fit(struct gb_equation_fit *fit, const struct gb_equation *equation,
                     const struct gb_equations_points *points, struct gb_error *err)
{
    double covariance[GB_EQUATIONS_PARAMETERS] = {0.0};
    *fit = (struct gb_equation_fit){.equation = equation, .points = points->count};
    if (!gb_equations_check(equation, points, err)) {
        return false;
    }
    fit->size = gb_equations_size(equation, points);
    if (!minimise(fit, points, covariance, err) || !set_scatter(fit, points, err)) {
        return false;
    }
    set_values(fit, covariance);
    return true;
}

/* Mean over the replicas but one. */
static void mean_without(const struct gb_equations_points *points, size_t without,
                         double *mean)
{
    for (size_t i = 0; i < points->count; i++) {
        double sum = 0.0;
        for (size_t r = 0; r < points->replicas; r++) {
            sum += r != without ? points->rows[r * points->stride + i] : 0.0;
        }
        mean[i] = sum / (double)(points->replicas - 1);
    }
}

/* found: replicas x size, in the coordinates of the fit; NaN where one does not settle. */
static bool fit_without(const struct gb_equation_fit *fit,
                        const struct gb_equations_points *points, size_t without,
                        double *mean, double *found, struct gb_error *err)
{
    double x[GB_EQUATIONS_PARAMETERS];
    struct gb_equations_points some = *points;
    struct gb_equation_iterate iterate = {.equation = fit->equation,
                                          .points = &some,
                                          .fixed = GB_EQUATION_ITERATE_ALL,
                                          .x = x};
    memcpy(x, fit->x, sizeof x);
    mean_without(points, without, mean);
    some.density = mean;
    if (!gb_equation_iterate(&iterate, err)) {
        return false;
    }
    for (size_t k = 0; k < fit->size; k++) {
        found[k * points->replicas + without] =
            iterate.converged ? gb_equation_iterate_coordinate(fit->equation, k, x[k])
                              : (double)NAN;
    }
    return true;
}

static void widen(struct gb_equation_fit *fit, size_t k, double error, double quantile)
{
    const struct gb_fit_value before = fit->value[k];
    const bool positive = gb_equations_parameter(fit->equation, k)->positive;
    if (!isfinite(error)) {
        return;
    }
    set_interval(fit, k, quantile * error);
    fit->value[k].low = fmin(fit->value[k].low, before.low);
    fit->value[k].high = fmax(fit->value[k].high, before.high);
    fit->value[k].error = fmax(before.error, positive ? fit->x[k] * error : error);
}

bool gb_equation_fit_jackknife(struct gb_equation_fit *fit,
                               const struct gb_equations_points *points,
                               struct gb_error *err)
{
    const size_t replicas = points->replicas;
    if (points->rows == NULL || replicas < REPLICAS_LEAST) {
        return true;
    }
    double *mean =
        gb_alloc_array(points->count + fit->size * replicas, sizeof *mean, err);
    bool good = mean != NULL;
    double *found = good ? mean + points->count : NULL;
    for (size_t r = 0; r < replicas && good; r++) {
        good = fit_without(fit, points, r, mean, found, err);
    }
    for (size_t k = 0; k < fit->size && good; k++) {
        widen(fit, k, gb_average_jackknife(found + k * replicas, replicas),
              gsl_cdf_tdist_Pinv(interval_level, (double)(replicas - 1)));
    }
    gb_alloc_free(mean);
    return good;
}
