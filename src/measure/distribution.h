#ifndef GB_MEASURE_DISTRIBUTION_H
#define GB_MEASURE_DISTRIBUTION_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"

/* The log-normal law of particle sizes, P1 (17), fitted to a histogram. */
struct gb_lognormal {
    double m, sigma; /* of ln x, x in the unit of the middles */
    double m_error,
        sigma_error;    /* standard errors; NaN where the particles are not known */
    double correlation; /* of the two errors */
    /* Pearson's test.  Neighbouring classes are merged until each has 5 expected particles
     * (Cochran, Biometrics 10, 417, 1954); the outer ones include all sizes beyond.  NaN
     * without particles, and where fewer than 4 classes are left. */
    double chi_squared;
    size_t degrees;     /* classes left less 3; 0: no test */
    double probability; /* of such a chi-squared or a larger one if the law is true */
    double distance;    /* largest difference of law and data in the share below a size */
};

/* Below this probability a law does not describe the data. */
#define GB_LOGNORMAL_REJECTED 0.05

/* Share of the particles between two sizes, 0 <= from < to. */
double gb_distribution_share(const struct gb_lognormal *law, double from, double to);

/* Meaning of the weights of a histogram. */
enum gb_lognormal_weight {
    GB_LOGNORMAL_SHARES,   /* proportional to a number: no errors of the fit */
    GB_LOGNORMAL_PARTICLES /* numbers of particles: standard errors and chi^2 */
};

/* Maximum likelihood for classes whose borders lie halfway between the middles (the outer
 * ones as far out as in), no particle beyond.
 *
 * middle     count values above 0, ascending
 * weight     particles in the class, or any number proportional to it
 * kind       which of the two; shares have no errors and no test
 * Errors: GB_ERR_INPUT (middles, weights, fewer than 3 classes with particles),
 * GB_ERR_NOT_CONVERGED, GB_ERR_MEMORY. */
bool gb_distribution_lognormal(struct gb_lognormal *law, const double *middle,
                               const double *weight, size_t count,
                               enum gb_lognormal_weight kind, struct gb_error *err);

/* Strengths by Weibull's law of the weakest link, 1 - exp(-(x/scale)^modulus): maximum
 * likelihood.  The interval of the modulus holds 95 %: where the profile likelihood falls by
 * half of the chi-squared quantile of one degree of freedom. */
struct gb_weibull {
    double modulus, modulus_low, modulus_high;
    double scale; /* strength of which 63 % of the bodies fail; unit of the strengths */
};

/* value: count strengths above 0, not all equal, 3 or more.  Errors: GB_ERR_INPUT,
 * GB_ERR_NOT_CONVERGED. */
bool gb_distribution_weibull(struct gb_weibull *law, const double *value, size_t count,
                             struct gb_error *err);

#endif
