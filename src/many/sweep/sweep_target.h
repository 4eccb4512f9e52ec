#ifndef GB_MANY_SWEEP_SWEEP_TARGET_H
#define GB_MANY_SWEEP_SWEEP_TARGET_H

#include <stdbool.h>
#include <stddef.h>

#include "many/ensemble.h"

/* Ends the replicas of a point when the standard error of their mean density at a pressure
 * is small enough. */
struct gb_sweep_target {
    double standard_error; /* of the density; 0: all replicas are done */
    double pressure_pa;
    double *density; /* of each run at the pressure, NaN where it failed ... */
    bool *is_read;   /* ... once its curve.csv was read */
};

/* Reads "0.002@100MPa".  Errors: GB_ERR_INPUT. */
bool gb_sweep_target_parse(struct gb_sweep_target *target, const char *text,
                           struct gb_error *err);

/* Makes it the convergence test of the ensemble; target must outlive the work.  Errors:
 * GB_ERR_MEMORY.  gb_sweep_target_finish is due. */
bool gb_sweep_target_apply(struct gb_sweep_target *target, struct gb_ensemble *ensemble,
                           struct gb_error *err);
void gb_sweep_target_finish(struct gb_sweep_target *target); /* zeroed is fine */

/* Points whose replicas were all done before the standard error was small enough. */
size_t gb_sweep_target_missed(const struct gb_sweep_target *target,
                              const struct gb_ensemble *ensemble);

#endif
