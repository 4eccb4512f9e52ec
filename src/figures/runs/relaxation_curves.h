#ifndef GB_FIGURES_RUNS_RELAXATION_CURVES_H
#define GB_FIGURES_RUNS_RELAXATION_CURVES_H

#include "figures/series.h"
#include "measure/fit/average.h"

/* Pressure of the runs of a group while the strain is held: t in ns from the end of
 * compression, p in MPa. */
struct gb_relaxation_curves {
    struct gb_average_curve *curve; /* one per run */
    size_t count;
};

bool gb_relaxation_curves_read(struct gb_relaxation_curves *curves,
                               const struct gb_runset *set, size_t group,
                               struct gb_error *err);
void gb_relaxation_curves_finish(
    struct gb_relaxation_curves *curves); /* zeroed is fine */

/* Mean of the first `members` curves where all have a value.  Arrays for gb_alloc_free,
 * also on error. */
bool gb_relaxation_curves_mean(const struct gb_average_curve *curves, size_t members,
                               double **t, double **p, size_t *count,
                               struct gb_error *err);

#endif
