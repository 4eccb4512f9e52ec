#ifndef GB_MEASURE_FIT_WEIBULL_H
#define GB_MEASURE_FIT_WEIBULL_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"

/* Strengths by Weibull's law of the weakest link, 1 - exp(-(x/scale)^modulus): maximum
 * likelihood.  The interval of the modulus holds 95 %: where the profile likelihood falls by
 * half of the chi-squared quantile of one degree of freedom. */
struct gb_weibull {
    double modulus, modulus_low, modulus_high;
    double scale; /* strength of which 63 % of the bodies fail; unit of the strengths */
};

/* value: count strengths above 0, not all equal, 3 or more.  Errors: GB_ERR_INPUT,
 * GB_ERR_NOT_CONVERGED. */
bool gb_weibull_fit(struct gb_weibull *law, const double *value, size_t count,
                    struct gb_error *err);

#endif
