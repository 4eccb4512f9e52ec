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

/* The half width of an interval is that of Student's t.  Where the misfit, with the other
 * variables fitted again, does not rise as such an interval expects, it ends where the
 * misfit has risen by that much (profile of the likelihood).  Outside of the box, where
 * the surrogates do not hold, it ends as expected.  It never leaves least and most.
 *
 * fitted[data], fitted_error[data]: mean over the seeds at the best fit and its standard
 * error.  Errors: GB_ERR_INPUT (fewer data than variables, or as many without
 * errors), GB_ERR_MEMORY. */
bool gb_estimate_fit(const struct gb_estimate_problem *problem,
                     struct gb_estimate *estimate, double *fitted, double *fitted_error,
                     struct gb_error *err);

#endif
