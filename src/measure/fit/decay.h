#ifndef GB_MEASURE_FIT_DECAY_H
#define GB_MEASURE_FIT_DECAY_H

#include <stdbool.h>
#include <stddef.h>

#include "measure/fit/fit.h"

/* One fit of a given number of exponentials; fit.h selects the number. */

enum { GB_DECAY_PARAMETERS = 1 + 2 * GB_FIT_TERMS, GB_DECAY_ITERATIONS = 100 };

/* Time constants beyond this multiple of the span cannot be determined. */
#define GB_DECAY_TAU_LONGEST 100.0

/* Points in units in which time span and range of pressures are 1. */
struct gb_decay_points {
    double *t, *p;
    size_t count;
    double t_unit, p_unit, p_shift;
    double spacing; /* least difference of two times */
    double floor;   /* sum of squares of rounding alone */
};

/* Copies and checks.  Errors: GB_ERR_INPUT, GB_ERR_MEMORY; nothing is left to finish. */
bool gb_decay_points_init(struct gb_decay_points *points, const double *t,
                          const double *p, size_t count, struct gb_error *err);
void gb_decay_points_finish(struct gb_decay_points *points);

/* Parameters p0, then (amplitude, ln tau) per term with tau ascending. */
struct gb_decay {
    int terms;
    bool converged; /* converged, to time constants within the range of the data */
    double x[GB_DECAY_PARAMETERS];
    double covariance[GB_DECAY_PARAMETERS][GB_DECAY_PARAMETERS]; /* of unit variance */
    double squares;
    double correlation; /* points per independent point, 1 for independent residuals */
};

/* Integral of the autocorrelation of n residuals less their mean: points per
 * independent point.  Summed up to the first value near 0; white noise gives 1. */
double gb_decay_correlation(const double *f, size_t n, double mean);

void gb_decay_constant(struct gb_decay *found, const struct gb_decay_points *points);
/* terms 1 or 2.  Errors: GB_ERR_MEMORY; a fit that does not settle is no error. */
bool gb_decay_terms(struct gb_decay *found, int terms,
                    const struct gb_decay_points *points, struct gb_error *err);

#endif
