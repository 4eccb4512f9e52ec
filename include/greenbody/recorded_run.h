#ifndef GREENBODY_RECORDED_RUN_H
#define GREENBODY_RECORDED_RUN_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/parameters.h"
#include "greenbody/point.h"
#include "greenbody/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A run directory, read: of a finished run, or of one under way as far as it is written. */
struct gb_recorded_run;

/* Errors: GB_ERR_INPUT (no run directory, a damaged file), GB_ERR_MACHINE. */
bool gb_recorded_run_open(struct gb_recorded_run **out, const char *directory,
                          struct gb_error *err);
void gb_recorded_run_destroy(struct gb_recorded_run *run); /* NULL is fine */

/* "running", "done", "stopped", "failed", ..., and why; "" where there is no reason. */
const char *gb_recorded_run_state(const struct gb_recorded_run *run);
const char *gb_recorded_run_reason(const struct gb_recorded_run *run);

/* Rows of curve.csv, with its digits; a row lives as long as the run.  NULL after the last. */
size_t gb_recorded_run_points(const struct gb_recorded_run *run);
const struct gb_point *gb_recorded_run_point(const struct gb_recorded_run *run,
                                             size_t index);

/* A copy of the parameters, which the caller destroys. */
bool gb_recorded_run_parameters(const struct gb_recorded_run *run,
                                struct gb_parameters **out, struct gb_error *err);

/* Path of kept state `index` in the order of the run, for gb_saved_state_load; NULL behind the
 * last, which is the state of the last checkpoint (state.h5). */
const char *gb_recorded_run_saved(const struct gb_recorded_run *run, size_t index);

#ifdef __cplusplus
}
#endif

#endif
