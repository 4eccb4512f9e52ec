#ifndef GB_MEASURE_POWER_H
#define GB_MEASURE_POWER_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"
#include "measure/fit.h"

/* A sum of squares as a function of one exponent, the other parameters solved for. */
struct gb_exponent_profile {
    double (*squares)(double exponent, const void *data);
    const void *data;
};

/* Where the sum has risen to level on the way from inside (below it) to outside; outside
 * when it does not. */
double gb_power_crossing(const struct gb_exponent_profile *profile, double level,
                         double inside, double outside);

/* Pressure against the rate of compression: P2 (9).  Pressures and rates in any unit; k
 * follows from them. */

/* p = a + k v^n */
struct gb_power {
    struct gb_fit_value a, k, n; /* intervals NaN where the points determine none */
    double chi2; /* sum of squares over the squared errors; plain squares without them */
    int degrees; /* of freedom; 0 for three points */
};

/* Weighted fit with free exponent.
 *
 * v, p    count points, at least three different rates above 0
 * error   standard errors of p, above 0; NULL: unknown and equal, then the intervals come
 *         from the residuals and need a fourth point
 * With errors the intervals are at least those that the errors give, and wider by
 * sqrt(chi2 / degrees) where the points scatter more.
 * Errors: GB_ERR_INPUT; GB_ERR_NOT_CONVERGED when no exponent in (0, 4) is best: the
 * pressures show no power law. */
bool gb_power_fit(struct gb_power *fit, const double *v, const double *p,
                  const double *error, size_t count, struct gb_error *err);

/* One measured pressure. */
struct gb_power_point {
    double v, rho, p; /* v = 0: quasi-static, only for P2 (9) */
    double error;     /* of p; 0 everywhere: unknown and equal */
};

/* p = p_stat(rho) + k_v v^exponent (rho - rho0)^power, P2 (9) with 1/4 and 3; each
 * density has a p_stat of its own.  At least two rates at some density. */
struct gb_power_law {
    double exponent, power, rho0;
};

struct gb_power_rate {
    struct gb_fit_value k_v;
    double chi2;
    int degrees; /* points less densities less 1 */
};

/* The points of equal rho belong together.  Errors: GB_ERR_INPUT, GB_ERR_MEMORY. */
bool gb_power_rate(struct gb_power_rate *fit, const struct gb_power_law *law,
                   const struct gb_power_point *points, size_t count,
                   struct gb_error *err);

/* p_stat of a density for a given k_v: the mean of p - k_v v^exponent (rho - rho0)^power
 * over its points, weighted by their errors where the first has one.  NaN: no point. */
double gb_power_static(const struct gb_power_law *law, double k_v,
                       const struct gb_power_point *points, size_t count, double rho);

/* As gb_power_rate with the exponent free in (0, 4), too: its 95 % interval is where chi2 stays
 * below its least value by the F (or chi2) quantile of one parameter. */
bool gb_power_exponent(struct gb_fit_value *exponent, const struct gb_power_law *law,
                       const struct gb_power_point *points, size_t count,
                       struct gb_error *err);

#endif
