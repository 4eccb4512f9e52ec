#ifndef GB_MEASURE_FIT_SURROGATE_H
#define GB_MEASURE_FIT_SURROGATE_H

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
 * gb_surrogate_finish is due.  Errors: GB_ERR_INPUT (fewer points than terms, or points
 * that do not determine all terms), GB_ERR_MEMORY. */
bool gb_surrogate_fit(struct gb_surrogate *surrogate, size_t variables, size_t outputs,
                      enum gb_surrogate_order order, const double *at,
                      const double *value, size_t points, struct gb_error *err);
void gb_surrogate_finish(struct gb_surrogate *surrogate); /* zeroed is fine */

/* value[outputs] at a point. */
void gb_surrogate_value(const struct gb_surrogate *surrogate, const double *at,
                        double *value);
/* slope[outputs x variables] at a point. */
void gb_surrogate_slope(const struct gb_surrogate *surrogate, const double *at,
                        double *slope);

#endif
