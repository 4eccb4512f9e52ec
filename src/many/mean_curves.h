#ifndef GB_MANY_MEAN_CURVES_H
#define GB_MANY_MEAN_CURVES_H

#include "many/runset.h"
#include "measure/average.h"
#include "measure/fit.h"

/* One branch of the runs of a group. */
struct gb_mean_curves {
    struct gb_average_curve *curve; /* one per run */
    size_t count;
};

/* Reads columns x and y of curve.csv. gb_mean_curves_finish must be called in any case.
 * Errors: see gb_runset_points. */
bool gb_mean_curves_read(struct gb_mean_curves *curves, const struct gb_runset *set,
                         size_t group, const char *branch, const char *x, const char *y,
                         struct gb_error *err);

void gb_mean_curves_finish(struct gb_mean_curves *curves); /* zeroed is fine */

/* Mean of the first `members` curves where all of them have a value, at the x of all
 * curves.  Free the arrays with gb_alloc_free, even after an error.  Errors:
 * GB_ERR_INPUT if x decreases, GB_ERR_MEMORY. */
bool gb_mean_curves_mean(const struct gb_average_curve *curves, size_t members,
                         double **x, double **y, size_t *count, struct gb_error *err);

/* Pressure of the runs of a group while the strain is held: x is the time in ns since
 * the end of compression, y is p in MPa. gb_mean_curves_finish must be called in any
 * case.  Errors: see gb_runset_points. */
bool gb_mean_curves_relaxation(struct gb_mean_curves *curves, const struct gb_runset *set,
                               size_t group, struct gb_error *err);

/* Fits P2 (4) to the mean of the first `members` curves. */
bool gb_mean_curves_decay(struct gb_fit_decay *fit, const struct gb_average_curve *curves,
                          size_t members, struct gb_error *err);

#endif
