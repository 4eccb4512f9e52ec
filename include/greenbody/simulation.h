#ifndef GREENBODY_SIMULATION_H
#define GREENBODY_SIMULATION_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "greenbody/array.h"
#include "greenbody/outcome.h"
#include "greenbody/parameters.h"
#include "greenbody/point.h"
#include "greenbody/saved_state.h"
#include "greenbody/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One run, from its parameters to recorded points.  A process may have any number of
 * simulations, each used by one thread at a time.  Any thread may call
 * gb_simulation_cancel, gb_simulation_points and gb_simulation_point at any time.
 *
 * The same parameters and seed give results that are bit-identical to `greenbody run`,
 * for any number of threads and any division into advances. */
struct gb_simulation;

/* Checks and copies the parameters.  The first advance builds the packing.
 * Errors: GB_ERR_INPUT naming the keys, GB_ERR_MEMORY. */
bool gb_simulation_create(struct gb_simulation **out,
                          const struct gb_parameters *parameters, struct gb_error *err);

/* Continues the run of a directory from its last checkpoint and records it there.
 * Errors: GB_ERR_INPUT (no run, a run that another process computes, a changed preset),
 * GB_ERR_MACHINE. */
bool gb_simulation_resume(struct gb_simulation **out, const char *directory,
                          struct gb_error *err);
/* The same, but from the checkpoint before the last one, for a damaged last checkpoint.
 * The points after it are computed again. */
bool gb_simulation_resume_before(struct gb_simulation **out, const char *directory,
                                 struct gb_error *err);

/* Continues from a state that gb_simulation_save or a run with the same parameters has
 * written.  The curve begins at this state.
 * Errors: GB_ERR_INPUT naming the item that does not match, GB_ERR_MACHINE. */
bool gb_simulation_load(struct gb_simulation **out,
                        const struct gb_parameters *parameters, const char *path,
                        struct gb_error *err);

/* Writes the last files of a recorded run and unlocks its directory, which can then be
 * resumed.  Points and arrays remain readable; the simulation cannot be advanced
 * again. */
void gb_simulation_leave(struct gb_simulation *simulation);

/* Frees a simulation; NULL is fine.  A recorded run that has not ended can be resumed
 * from its directory.
 *
 * After fork, the child has neither the threads nor the files of the simulation.  It
 * may read points and parameters, and call this function, which then frees memory and
 * changes no file.  All other functions fail there (GB_ERR_INPUT). */
void gb_simulation_destroy(struct gb_simulation *simulation);

/* Records the run in a directory, as `greenbody run --out` does.  Call it before the
 * first advance.
 *
 * replace   true: remove an old run in the directory; false: an old run is an error
 * Errors: GB_ERR_INPUT (the path is a file, the directory has a run or foreign files,
 * the simulation was advanced), GB_ERR_MACHINE. */
bool gb_simulation_record(struct gb_simulation *simulation, const char *directory,
                          bool replace, struct gb_error *err);

/* Callbacks of gb_simulation_advance, called in its thread; NULL: none.  A callback
 * may read arrays and call gb_simulation_cancel.  It must change nothing else.
 *
 * on_point      after each recorded point
 * on_event      a guard, the beginning of an unloading, ...: one line, and the step
 * on_progress   at most once in `interval` seconds; share: fraction of the loading
 *               that is done, 0 to 1, and 0 while the packing is built */
void gb_simulation_on_point(struct gb_simulation *simulation,
                            void (*call)(void *data, struct gb_simulation *simulation,
                                         const struct gb_point *point),
                            void *data);
void gb_simulation_on_event(struct gb_simulation *simulation,
                            void (*call)(void *data, struct gb_simulation *simulation,
                                         int64_t step, const char *text),
                            void *data);
void gb_simulation_on_progress(struct gb_simulation *simulation,
                               void (*call)(void *data, struct gb_simulation *simulation,
                                            double share),
                               void *data, double interval);

/* Advances by at most `points` recorded points; INT64_MAX: to the end.
 *
 * GB_RUN_OUTCOME_NONE means that the points are recorded and the run has not ended.
 * You may advance again after it, and after GB_RUN_OUTCOME_CANCELLED; results are
 * bit-identical. err has the reason why a run was stopped, cancelled or failed.  After
 * the end of a run the function returns the same outcome again.
 *
 * Errors: GB_RUN_OUTCOME_FAILED with GB_ERR_INPUT if points is negative, if another
 * advance is under way, or if another process created the simulation.  The simulation
 * does not change then. */
enum gb_run_outcome gb_simulation_advance(struct gb_simulation *simulation,
                                          int64_t points, struct gb_error *err);

/* Ends the current advance, or else the next one, within 5 to 20 ms.
 *
 * reason   one line, which must outlive the simulation; NULL: "cancelled" */
void gb_simulation_cancel(struct gb_simulation *simulation, const char *reason);

/* Number of points recorded so far, and one of them, valid until
 * gb_simulation_destroy.  NULL for an index out of range.  A resumed run begins with
 * the points of its curve.csv. */
size_t gb_simulation_points(const struct gb_simulation *simulation);
const struct gb_point *gb_simulation_point(const struct gb_simulation *simulation,
                                           size_t index);

/* Fraction of the loading that is done, 0 to 1. */
double gb_simulation_progress(const struct gb_simulation *simulation);

/* Copies the parameters; the caller destroys the copy. */
bool gb_simulation_parameters(const struct gb_simulation *simulation,
                              struct gb_parameters **out, struct gb_error *err);

/* An array by its name (gb_array_name).  It is valid until the next advance, or in a
 * callback until the callback returns.
 *
 * Arrays of particles, forces and the periodic cell are the memory of the engine.
 * Positions may be outside the cell by any number of edges.  In a die the axis is
 * x = y = 0.  Contacts are listed once per advance.  After an unloading branch the
 * packing returns to the state in which the branch began.
 *
 * Errors: see gb_saved_state_array; GB_ERR_INPUT before the first advance. */
bool gb_simulation_array(struct gb_simulation *simulation, const char *name,
                         struct gb_array *array, struct gb_error *err);

/* Copies the present packing.  The copy outlives the next advance and the simulation.
 * Errors: GB_ERR_INPUT before the first advance, GB_ERR_MEMORY. */
bool gb_simulation_state(struct gb_simulation *simulation, struct gb_saved_state **out,
                         struct gb_error *err);

/* Writes the state of the last recorded point to an HDF5 file and replaces an old file
 * as a whole.  Errors: GB_ERR_INPUT if the packing is between two points,
 * GB_ERR_MACHINE. */
bool gb_simulation_save(struct gb_simulation *simulation, const char *path,
                        struct gb_error *err);

#ifdef __cplusplus
}
#endif

#endif
