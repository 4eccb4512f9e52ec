#ifndef GB_MEASURE_HARMONICS_H
#define GB_MEASURE_HARMONICS_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"

/* A function of direction that is even (equal along u and -u), as the mean force over the
 * direction of the contact: the even spherical harmonics of orders 0, 2 and 4, written as
 * a form of degree 4 in the components of the direction. */
enum { GB_HARMONICS_TERMS = 15 };

struct gb_harmonics {
    double term[GB_HARMONICS_TERMS];
    double mean; /* over all values, not over directions */
    size_t count;
    int dimension; /* 2: of the plane y = 0 */
};

/* Least squares over count values; axis: count x 3, of any length above 0.  In 2D
 * (dimension 2) terms with y are left out.  Errors: GB_ERR_INPUT with fewer values than
 * terms or axes that do not determine all terms, GB_ERR_MEMORY. */
bool gb_harmonics_fit(struct gb_harmonics *rose, int dimension, const double *axis,
                      const double *value, size_t count, struct gb_error *err);

/* The fitted function in a direction of any length above 0. */
double gb_harmonics_at(const struct gb_harmonics *rose, const double direction[3]);

#endif
