#ifndef GB_MANY_SWEEP_PARAM_SWEEP_H
#define GB_MANY_SWEEP_PARAM_SWEEP_H

#include "many/ensemble.h"
#include "many/sweep/axes.h"
#include "many/sweep/sweep_table.h"
#include "many/sweep/sweep_target.h"

/* A grid of parameters with replicas, a directory for each run, and its tables. */
struct gb_param_sweep {
    struct gb_axes axes;
    struct gb_sweep_table_pressures at;
    struct gb_sweep_target target;
    struct gb_ensemble ensemble;
};

/* Makes the list of runs in directory, from axes, target and the scene of params; marks
 * those that are done.  Errors: GB_ERR_INPUT, GB_ERR_MEMORY.  gb_param_sweep_finish is due in
 * any case. */
bool gb_param_sweep_fill(struct gb_param_sweep *sweep, const struct gb_params *params,
                         size_t replicas, const char *directory, struct gb_error *err);
void gb_param_sweep_finish(struct gb_param_sweep *sweep); /* zeroed is fine */

/* Writes sweep.csv and runs.csv, whatever state the runs are in. */
bool gb_param_sweep_write(struct gb_param_sweep *sweep, const char *directory,
                          struct gb_error *err);

/* Writes a further table of the sweep, and frees its text. */
bool gb_param_sweep_put(const char *directory, const char *name, GString *text,
                        struct gb_error *err);

#endif
