#ifndef GB_MEASURE_FIT_COMPACTION_HECKEL_STRETCH_H
#define GB_MEASURE_FIT_COMPACTION_HECKEL_STRETCH_H

#include "measure/fit/compaction/equations.h"

/* The straightest stretch of a Heckel plot, y = ln(1/(1 - rho)) against P: of all runs of
 * consecutive points, at least a sixth of all and at least five, the longest one (in
 * pressure) whose scatter about its line is not significantly larger than its scatter from
 * point to point (F test at 95 %; weights by the errors of rho).  Where the plot is bent
 * everywhere: the stretch of which a line leaves the least share of the variance.  Points
 * at one pressure count as one, at their mean: a repeated point changes nothing. */
struct gb_heckel_stretch {
    size_t first, count;
    bool straight;        /* by the F test */
    double determination; /* adjusted R^2 of the stretch */
};

/* Points in ascending order of P, densities below 1, five or more of them.  All of them
 * are the stretch where they are at fewer than five pressures.  Errors: GB_ERR_MEMORY. */
bool gb_heckel_stretch(struct gb_heckel_stretch *stretch,
                       const struct gb_equations_points *points, struct gb_error *err);

#endif
