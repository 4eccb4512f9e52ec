#ifndef GB_MANY_RELAXATION_CURVES_H
#define GB_MANY_RELAXATION_CURVES_H

#include "many/mean_curves.h"
#include "measure/fit/fit.h"

/* Pressure of the runs of a group while the strain is held: x is t in ns from the end of
 * compression, y is p in MPa.  gb_mean_curves_finish is due in any case.  Errors: those of
 * gb_runset_points. */
bool gb_relaxation_curves_read(struct gb_mean_curves *curves, const struct gb_runset *set,
                               size_t group, struct gb_error *err);

/* P2 (4) fitted to the mean of the first `members` curves. */
bool gb_relaxation_curves_fit(struct gb_fit_decay *fit,
                              const struct gb_average_curve *curves, size_t members,
                              struct gb_error *err);

#endif
