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

/* One run: parameters to recorded points.  Any number of them may exist in a process, each
 * used by one thread at a time; gb_simulation_cancel, gb_simulation_points and
 * gb_simulation_point may be called by any thread at any time.
 *
 * Same parameters, same seed: same bits as `greenbody run`, for any number of threads and
 * for any division into advances. */
struct gb_simulation;

/* Checks the parameters, which are copied; the packing is built by the first advance.
 * Errors: GB_ERR_INPUT naming the keys, GB_ERR_MEMORY. */
bool gb_simulation_create(struct gb_simulation **out,
                          const struct gb_parameters *parameters, struct gb_error *err);

/* Continues the run in a directory from its last checkpoint, recorded there.  Errors:
 * GB_ERR_INPUT (no run, a run under way, a preset that was changed since), GB_ERR_MACHINE. */
bool gb_simulation_resume(struct gb_simulation **out, const char *directory,
                          struct gb_error *err);
/* The same from the checkpoint before the last one, where that is damaged; the points
 * after it are computed again. */
bool gb_simulation_resume_before(struct gb_simulation **out, const char *directory,
                                 struct gb_error *err);

/* Continues from a state that gb_simulation_save or a run of the same parameters has
 * written; its curve begins there.  Errors: GB_ERR_INPUT naming the item that does not
 * fit, GB_ERR_MACHINE. */
bool gb_simulation_load(struct gb_simulation **out,
                        const struct gb_parameters *parameters, const char *path,
                        struct gb_error *err);

/* Writes the last files of a recorded run and unlocks its directory, which can be resumed;
 * points and arrays stay, and no advance follows. */
void gb_simulation_leave(struct gb_simulation *simulation);

/* A recorded run that is left before its end can be resumed from its directory.  NULL is
 * fine.
 *
 * A child that inherits a simulation by fork has neither its threads nor its files.  There
 * points and parameters may be read; this function frees the memory and changes no file, and
 * the others fail (GB_ERR_INPUT). */
void gb_simulation_destroy(struct gb_simulation *simulation);

/* Records the run in a directory, as `greenbody run --out` does; before the first advance.
 *
 * replace   an old run in the directory is removed; false: it is an error
 * Errors: GB_ERR_INPUT (a file, an existing run, foreign files, too late), GB_ERR_MACHINE. */
bool gb_simulation_record(struct gb_simulation *simulation, const char *directory,
                          bool replace, struct gb_error *err);

/* Callbacks of gb_simulation_advance, by its thread; NULL: none.  In them arrays may be read
 * and gb_simulation_cancel called, and nothing else changed.
 *
 * on_point      after each recorded point
 * on_event      guards, beginning of an unloading, ...: one line, and the step
 * on_progress   at least `interval` seconds after the last call, also while the packing is
 *               built (share 0); share: of the loading that is done, 0 to 1 */
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

/* Advances by at most so many recorded points; INT64_MAX: to the end.  Negative points, a
 * second advance at the same time and a simulation of another process are
 * GB_RUN_OUTCOME_FAILED with GB_ERR_INPUT and leave the simulation as it is.
 *
 * GB_RUN_OUTCOME_NONE: the points are recorded and the run has not ended.  After
 * GB_RUN_OUTCOME_CANCELLED, too, it may be advanced further, with the same bits.  err says why
 * a run was stopped, cancelled or failed; after an end the same outcome is returned again. */
enum gb_run_outcome gb_simulation_advance(struct gb_simulation *simulation,
                                          int64_t points, struct gb_error *err);

/* Ends the advance under way, or the next one, between two slices of 5 to 20 ms.
 *
 * reason   one line, which must outlive the simulation; NULL: "cancelled" */
void gb_simulation_cancel(struct gb_simulation *simulation, const char *reason);

/* Recorded points so far, and point 0 <= index < points, which lives as long as the
 * simulation; NULL for another index.  Points of a run that is resumed are those of its curve.csv. */
size_t gb_simulation_points(const struct gb_simulation *simulation);
const struct gb_point *gb_simulation_point(const struct gb_simulation *simulation,
                                           size_t index);

/* Share of the loading that is done, 0 to 1. */
double gb_simulation_progress(const struct gb_simulation *simulation);

/* Copies of the parameters, which the caller destroys. */
bool gb_simulation_parameters(const struct gb_simulation *simulation,
                              struct gb_parameters **out, struct gb_error *err);

/* An array by its name (gb_array_name), valid until the next advance; one taken in
 * a callback, until it returns.  Particles, forces and the periodic cell are the memory of
 * the engine: positions may lie outside of the cell by any number of edges, and in a die the
 * axis is x = y = 0.  Contacts are listed once per advance.  After the end of an
 * unloading branch the packing is back where that branch began.  Errors: as of
 * gb_saved_state_array; GB_ERR_INPUT before the first advance. */
bool gb_simulation_array(struct gb_simulation *simulation, const char *name,
                         struct gb_array *array, struct gb_error *err);

/* The packing as it is now, as an object of its own that outlives the next advance and the
 * simulation.  Errors: GB_ERR_INPUT before the first advance, GB_ERR_MEMORY. */
bool gb_simulation_state(struct gb_simulation *simulation, struct gb_saved_state **out,
                         struct gb_error *err);

/* Writes the state of the last recorded point, HDF5, replaced as a whole.  Errors:
 * GB_ERR_INPUT where the packing is between two points, GB_ERR_MACHINE. */
bool gb_simulation_save(struct gb_simulation *simulation, const char *path,
                        struct gb_error *err);

#ifdef __cplusplus
}
#endif

#endif
