#ifndef GB_MEASURE_FIT_EXPONENT_PROFILE_H
#define GB_MEASURE_FIT_EXPONENT_PROFILE_H

#include <stdbool.h>

#include "greenbody/status.h"

/* A sum of squares as a function of one exponent, the other parameters solved for. */
struct gb_exponent_profile {
    double (*squares)(double exponent, const void *data);
    const void *data;
};

/* Exponents that are looked at. */
#define GB_EXPONENT_PROFILE_MIN 0.005
#define GB_EXPONENT_PROFILE_MAX 4.0

/* The exponent of the least sum, found on a grid first.  Errors: GB_ERR_NOT_CONVERGED
 * when it is one of the ends, GB_ERR_MEMORY. */
bool gb_exponent_profile_minimum(const struct gb_exponent_profile *profile,
                                 double *exponent, struct gb_error *err);

/* Where the sum has risen to level on the way from inside (below it) to outside; outside
 * when it does not. */
double gb_exponent_profile_crossing(const struct gb_exponent_profile *profile,
                                    double level, double inside, double outside);

#endif
