#ifndef GB_MEASURE_SURROGATE_H
#define GB_MEASURE_SURROGATE_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"

/* A polynomial of first or second order in a few variables for each of many outputs: an
 * approximation of the simulation near a point. */
enum { GB_SURROGATE_VARIABLES = 6, GB_SURROGATE_TERMS = 28 };

enum gb_surrogate_order { GB_SURROGATE_LINEAR, GB_SURROGATE_QUADRATIC };

struct gb_surrogate {
    size_t variables, outputs, terms;
    double *coefficient; /* outputs x terms */
};

/* Terms of a polynomial: 1 + n, or with all squares and products. */
size_t gb_surrogate_terms(size_t variables, enum gb_surrogate_order order);

/* Least squares through points.
 *
 * at      points x variables; values of about -1 to 1 keep it well conditioned
 * value   points x outputs, finite
 * gb_surrogate_finish must be called.  Errors: GB_ERR_INPUT (fewer points than terms, or points
 * that do not determine all terms), GB_ERR_MEMORY. */
bool gb_surrogate_fit(struct gb_surrogate *surrogate, size_t variables, size_t outputs,
                      enum gb_surrogate_order order, const double *at,
                      const double *value, size_t points, struct gb_error *err);
void gb_surrogate_finish(struct gb_surrogate *surrogate); /* zeroed is fine */

/* The best fit of a noisy model to data, with errors.  The model is known as surrogates,
 * one for each seed; their mean is fitted, and what they differ by at the best fit is the
 * model's own noise. */
struct gb_estimate_problem {
    size_t variables, data, seeds;
    const double *value, *error; /* of the data; error NULL: from the scatter */
    const double *weight; /* in addition to the errors; NULL: 1.  The fit follows it, the
                                        errors of the variables contain what it costs */
    const struct gb_surrogate *seed; /* seeds of them, 2 or more */
    double low[GB_SURROGATE_VARIABLES], high[GB_SURROGATE_VARIABLES]; /* box of the fit */
    /* No variable is beyond these, which are at the box or outside of it. */
    double least[GB_SURROGATE_VARIABLES], most[GB_SURROGATE_VARIABLES];
};

struct gb_estimate {
    double at[GB_SURROGATE_VARIABLES];
    double error[GB_SURROGATE_VARIABLES];  /* standard error; infinite: no effect */
    double low_95[GB_SURROGATE_VARIABLES]; /* 95 % interval */
    double high_95[GB_SURROGATE_VARIABLES];
    double correlation[GB_SURROGATE_VARIABLES][GB_SURROGATE_VARIABLES];
    double chi_squared, rms;
};

/* The half width of an interval follows Student's t.  Where the misfit, with the other
 * variables fitted again, does not rise as such an interval expects, it ends where the
 * misfit has risen by that much (profile of the likelihood).  Outside of the box, where
 * the surrogates do not hold, it ends as expected.  It never leaves least and most.
 *
 * fitted[data], fitted_error[data]: mean over the seeds at the best fit and its standard
 * error.  Errors: GB_ERR_INPUT (fewer data than variables, or as many without
 * errors), GB_ERR_MEMORY. */
bool gb_surrogate_estimate(const struct gb_estimate_problem *problem,
                           struct gb_estimate *estimate, double *fitted,
                           double *fitted_error, struct gb_error *err);

/* Which of some variables a noisy model's output depends on: variance-based sensitivities
 * of the mean over its seeds, all variables uniform over their ranges.
 *
 * Each seed gives a quadratic surrogate; the variance of their mean is divided among the
 * variables and their products.  What the coefficients scatter by from seed to seed is
 * subtracted from their squares, so that noise counts as no sensitivity; the errors are of
 * the jackknife over the seeds.
 * Source: Sobol', Math. Comput. Simul. 55, 271 (2001); Sudret, Reliab. Eng. Syst. Saf. 93,
 * 964 (2008) for the variance from the coefficients of a polynomial. */
struct gb_sobol_indices {
    double mean;     /* of the output over the ranges */
    double range_sd; /* standard deviation of the mean over the seeds, by the variables */
    double seed_sd;  /* standard deviation between seeds at one point; NaN: one seed */
    double
        unexplained; /* share of the variance by the variables that a quadratic lacks */
    double first[GB_SURROGATE_VARIABLES]; /* share of a variable alone */
    double total[GB_SURROGATE_VARIABLES]; /* with the products that it is in */
    double first_error[GB_SURROGATE_VARIABLES], total_error[GB_SURROGATE_VARIABLES];
    /* standard errors; NaN with fewer than three seeds */
    size_t seeds; /* with a surrogate */
};

/* at      points x variables, -1 to 1
 * value   points x seeds, NaN where the model failed; the same seeds at all points
 * The indices are NaN where the variables have no effect beyond the scatter.
 * Errors: GB_ERR_INPUT (no seed has as many values as the surrogate has terms, or they do
 * not determine it), GB_ERR_MEMORY. */
bool gb_surrogate_sobol(struct gb_sobol_indices *indices, size_t variables, size_t points,
                        size_t seeds, const double *at, const double *value,
                        struct gb_error *err);

#endif
