#ifndef GB_MEASURE_FIT_DECAY_START_H
#define GB_MEASURE_FIT_DECAY_START_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"

enum { GB_DECAY_START_TERMS = 2 };

/* Initial values for the fit of exponentials. */
struct gb_decay_start {
    double p0;
    double amplitude[GB_DECAY_START_TERMS];
    double tau[GB_DECAY_START_TERMS]; /* ascending */
};

/* Best of a grid of time constants for terms exponentials (1 or 2).  The linear
 * parameters are solved for at each point of the grid (variable projection), so no
 * initial value is needed.  t is not negative, has two different values at least, and
 * ends at t_end > 0. */
bool gb_decay_start(struct gb_decay_start *start, int terms, const double *t,
                    const double *p, size_t count, struct gb_error *err);

#endif
