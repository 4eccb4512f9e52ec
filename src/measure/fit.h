#ifndef GB_MEASURE_FIT_H
#define GB_MEASURE_FIT_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"

/* A fitted parameter with its 95 % interval; all NaN for one that is not there. */
struct gb_fit_value {
    double value, error; /* error: standard error */
    double low, high;
};

enum { GB_FIT_TERMS = 2, GB_FIT_DECAY_POINTS = 8 };

enum { GB_DECAY_PARAMETERS = 1 + 2 * GB_FIT_TERMS, GB_DECAY_ITERATIONS = 100 };

/* Integral of the autocorrelation of n residuals less their mean: points per
 * independent point.  Summed up to the first value near 0; white noise gives 1. */
double gb_fit_correlation(const double *f, size_t n, double mean);

/* Why a relaxation is described by fewer than two exponentials. */
enum gb_fit_reason {
    GB_FIT_FULL,          /* two exponentials */
    GB_FIT_INSIGNIFICANT, /* the F test rejects the next one */
    GB_FIT_UNCERTAIN,     /* an interval of the richer fit contains 0 or is unbounded */
    GB_FIT_NOT_CONVERGED  /* the iteration of the richer fit did not converge */
};

/* p(t) = p0 + sum of amplitude[i] exp(-t / tau[i]), P2 (4), with tau[0] < tau[1]. */
struct gb_fit_decay {
    int terms;  /* 2, 1 or 0: significant exponentials */
    int reason; /* enum gb_fit_reason: why no more */
    struct gb_fit_value p0;
    struct gb_fit_value amplitude[GB_FIT_TERMS];
    struct gb_fit_value tau[GB_FIT_TERMS];
    double scatter;     /* standard deviation of the points about the fit */
    int degrees;        /* of freedom */
    double correlation; /* points per independent point, from the residuals */
    double f, f_most;   /* F of the next exponential and its bound; of the last one when
                       * terms is 2 */
};

/* Least squares fit of count points (t, p), at least GB_FIT_DECAY_POINTS of them at
 * different times; t counts from the end of compression and should ascend.  Intervals
 * from the covariance with the residual variance and Student's t, those of tau in its
 * logarithm, for as many points as the autocorrelation of the residuals leaves
 * independent. Errors: GB_ERR_INPUT (too few points, not finite), GB_ERR_MEMORY,
 * GB_ERR_NOT_CONVERGED (the fit of one exponential does not settle and a constant
 * does not describe the data).
 */
bool gb_fit_decay(struct gb_fit_decay *fit, const double *t, const double *p,
                  size_t count, struct gb_error *err);

/* The fitted p at time t. */
double gb_fit_decay_at(const struct gb_fit_decay *fit, double t);

/* Total fall of p, and the time after which 1/e of it is left: measures that compare
 * relaxations of one and of two stages.  NaN without exponentials
 * or when p does not fall. */
double gb_fit_decay_fall(const struct gb_fit_decay *fit);
double gb_fit_decay_efold(const struct gb_fit_decay *fit);

/* Whether gsl_multifit_nlinear_driver ended at a minimum, by its status and its info.
 * GSL_ENOPROG is one: no step improves on it in double precision.  Where this happens at
 * the start values, the status is that of the limit of iterations. */
bool gb_fit_settled(int status, int info);

#endif
