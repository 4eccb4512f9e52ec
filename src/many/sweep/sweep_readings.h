#ifndef GB_MANY_SWEEP_SWEEP_READINGS_H
#define GB_MANY_SWEEP_SWEEP_READINGS_H

#include "many/ensemble.h"
#include "many/reading.h"
#include "many/sweep/sweep_table.h"

/* Branches of a curve on which a sweep reads its figures: loading, and unloading from a
 * pressure. */
enum { GB_SWEEP_BRANCHES = 2 };
const char *gb_sweep_readings_branch(size_t branch); /* "load", "unload" */

/* The figures of the runs of one point that count, at all pressures. */
struct gb_sweep_readings {
    double *value; /* [branch][pressure][quantity][run]; NaN: not reached, or failed */
    size_t pressures, runs;
};

/* Reads the curves.  A run that cannot be read counts as failed; its error goes to the run.
 * gb_sweep_readings_finish is due. */
void gb_sweep_readings_init(struct gb_sweep_readings *readings,
                            struct gb_ensemble *ensemble, size_t point,
                            const struct gb_sweep_table_pressures *at);
void gb_sweep_readings_finish(struct gb_sweep_readings *readings); /* zeroed is fine */

/* The values of one figure over the runs. */
const double *gb_sweep_readings_at(const struct gb_sweep_readings *readings,
                                   size_t branch, size_t pressure, size_t quantity);

#endif
