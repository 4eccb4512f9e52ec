#ifndef GB_MEASURE_FIT_COMPACTION_EQUATION_PROFILE_H
#define GB_MEASURE_FIT_COMPACTION_EQUATION_PROFILE_H

#include "measure/fit/compaction/equation_fit.h"

/* Replaces linear intervals by those of the profile likelihood where both differ: the sum
 * of squares, minimised over the other parameters, has risen by quantile^2 variance.  An
 * end that is never reached is infinite, or 0 for a positive parameter.
 * Errors: GB_ERR_MEMORY. */
bool gb_equation_profile(struct gb_equation_fit *fit,
                         const struct gb_equations_points *points, struct gb_error *err);

#endif
