#ifndef GB_MEASURE_FIT_ESTIMATE_H
#define GB_MEASURE_FIT_ESTIMATE_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"
#include "measure/fit/surrogate.h"

/* The best fit of a noisy model to data, with errors.  The model is known as surrogates,
 * one for each seed; their mean is fitted, and what they differ by at the best fit is the
 * model's own noise. */
struct gb_estimate_problem {
    size_t variables, data, seeds;
    const double *value, *error; /* of the data; error NULL: from the scatter */
    const double *weight;        /* beside the errors; NULL: 1.  The fit follows it, the
                                        errors of the variables contain what it costs */
    const struct gb_surrogate *seed; /* seeds of them, 2 or more */
    double low[GB_SURROGATE_VARIABLES], high[GB_SURROGATE_VARIABLES]; /* box of the fit */
};

struct gb_estimate {
    double at[GB_SURROGATE_VARIABLES];
    double error[GB_SURROGATE_VARIABLES];   /* standard error; infinite: no effect */
    double half_95[GB_SURROGATE_VARIABLES]; /* half of the 95 % interval (Student's t) */
    double correlation[GB_SURROGATE_VARIABLES][GB_SURROGATE_VARIABLES];
    double chi_squared, rms;
};

/* fitted[data], fitted_error[data]: mean over the seeds at the best fit and its standard
 * error.  Errors: GB_ERR_INPUT (fewer data than variables, or as many without
 * errors), GB_ERR_MEMORY. */
bool gb_estimate_fit(const struct gb_estimate_problem *problem,
                     struct gb_estimate *estimate, double *fitted, double *fitted_error,
                     struct gb_error *err);

#endif
