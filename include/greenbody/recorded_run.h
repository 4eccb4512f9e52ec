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

/* A run directory that has been read.  If the run is still going, it has the points
 * written so far. */
struct gb_recorded_run;

/* Reads a run directory.  Errors: GB_ERR_INPUT (no run directory, a damaged file),
 * GB_ERR_MACHINE. */
bool gb_recorded_run_open(struct gb_recorded_run **out, const char *directory,
                          struct gb_error *err);
void gb_recorded_run_destroy(struct gb_recorded_run *run); /* NULL is fine */

/* State ("running", "done", "stopped", "failed", ...) and its reason, or "". */
const char *gb_recorded_run_state(const struct gb_recorded_run *run);
const char *gb_recorded_run_reason(const struct gb_recorded_run *run);

/* Number of rows of curve.csv, and row `index` with the digits of the file.  A row is
 * valid until gb_recorded_run_destroy.  NULL after the last. */
size_t gb_recorded_run_points(const struct gb_recorded_run *run);
const struct gb_point *gb_recorded_run_point(const struct gb_recorded_run *run,
                                             size_t index);

/* Copies the parameters; the caller destroys the copy. */
bool gb_recorded_run_parameters(const struct gb_recorded_run *run,
                                struct gb_parameters **out, struct gb_error *err);

/* Path of kept state `index`, in the order of the run, for gb_saved_state_load.  The last
 * one is the last checkpoint (state.h5).  NULL after it. */
const char *gb_recorded_run_saved(const struct gb_recorded_run *run, size_t index);

#ifdef __cplusplus
}
#endif

#endif
