#ifndef GB_MEASURE_FIT_VALLEY_H
#define GB_MEASURE_FIT_VALLEY_H

#include <stdbool.h>

#include "greenbody/status.h"

/* A sum of squares as a function of one exponent, the other parameters solved for. */
struct gb_valley {
    double (*squares)(double exponent, const void *data);
    const void *data;
};

/* Exponents that are looked at. */
#define GB_VALLEY_LEAST 0.005
#define GB_VALLEY_MOST  4.0

/* The exponent of the least sum, found on a grid first.  Errors: GB_ERR_NOT_CONVERGED
 * when it is one of the ends, GB_ERR_MEMORY. */
bool gb_valley_find(const struct gb_valley *valley, double *exponent,
                    struct gb_error *err);

/* Where the sum has risen to level on the way from inside (below it) to outside; outside
 * when it does not. */
double gb_valley_level(const struct gb_valley *valley, double level, double inside,
                       double outside);

#endif
