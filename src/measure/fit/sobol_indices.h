#ifndef GB_MEASURE_FIT_SOBOL_INDICES_H
#define GB_MEASURE_FIT_SOBOL_INDICES_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"
#include "measure/fit/surrogate.h"

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
bool gb_sobol_indices_fit(struct gb_sobol_indices *indices, size_t variables,
                          size_t points, size_t seeds, const double *at,
                          const double *value, struct gb_error *err);

#endif
