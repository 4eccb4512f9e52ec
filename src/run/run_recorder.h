#ifndef GB_RUN_RUN_RECORDER_H
#define GB_RUN_RUN_RECORDER_H

#include <stdbool.h>

#include "io/store.h"
#include "run/experiment.h"

/* Keeps a run in its directory while it goes: rows, events, status, checkpoints.  With or
 * without a screen, the engine's loop calls these and nothing else.
 *
 * A checkpoint belongs to a recorded point.  The last point is always at hand in memory,
 * so that a run that is stopped between two points is kept at once. */
struct gb_run_recorder;

/* For a run that begins; errors as of gb_store_create. */
bool gb_run_recorder_create(struct gb_run_recorder **out, const char *directory,
                            const struct gb_params *params, bool force,
                            struct gb_error *err);

/* For a run that goes on: locks the directory, reads its preset and its checkpoint, cuts
 * curve.csv and events.log to it and gives the experiment.  *experiment stays NULL when
 * the run had no checkpoint yet: it begins anew with gb_run_recorder_params.  Errors:
 * GB_ERR_INPUT (no run, a run under way, a preset that was changed since, a checkpoint of
 * another layout or damaged), GB_ERR_MACHINE, GB_ERR_MEMORY. */
bool gb_run_recorder_resume(struct gb_run_recorder **out,
                            struct gb_experiment **experiment, const char *directory,
                            struct gb_error *err);

/* The last checkpoint is written to its end.  NULL is fine. */
void gb_run_recorder_destroy(struct gb_run_recorder *keep);

const struct gb_params *gb_run_recorder_params(const struct gb_run_recorder *keep);
struct gb_store *gb_run_recorder_store(struct gb_run_recorder *keep);
int64_t gb_run_recorder_points(const struct gb_run_recorder *keep);
/* Seconds the run had taken and events it had seen when it was stopped. */
double gb_run_recorder_seconds(const struct gb_run_recorder *keep);
int64_t gb_run_recorder_events(const struct gb_run_recorder *keep);

/* A point was recorded: its row, and the state in memory.  Call once per point, after its
 * events. */
bool gb_run_recorder_point(struct gb_run_recorder *keep, struct gb_experiment *experiment,
                           const struct gb_point *point, struct gb_error *err);
/* Points from before there was a directory: their rows, and the record that was taken at
 * the last one, whose memory is moved.  seconds: of that point. */
bool gb_run_recorder_adopt(struct gb_run_recorder *keep, const struct gb_point *points,
                           int64_t count, struct gb_record *record, struct gb_error *err);
bool gb_run_recorder_event(struct gb_run_recorder *keep, int64_t step, const char *text,
                           struct gb_error *err);

/* Writes the state in memory when it is time (output.checkpoint_every), or now; returns
 * before it is written.  seconds: of the run. */
bool gb_run_recorder_tick(struct gb_run_recorder *keep, double seconds, bool now,
                          struct gb_error *err);

/* Has status.json say what the snapshot says; returns before it is written. */
bool gb_run_recorder_status(struct gb_run_recorder *keep,
                            const struct gb_snapshot *snapshot, struct gb_error *err);

/* Last words of a run whose results cannot be kept any more: rows and status, as far as
 * they can be written.  The state stays the last one that was.  NULL is fine. */
void gb_run_recorder_fail(struct gb_run_recorder *keep,
                          const struct gb_snapshot *snapshot);

/* The end, or a stop: the last state is on the disk when this returns. */
bool gb_run_recorder_conclude(struct gb_run_recorder *keep,
                              const struct gb_snapshot *snapshot, struct gb_error *err);

/* Reads preset.ini and the checkpoint `name` ("state.h5") of a run directory; the step it
 * was taken at is gb_checkpoint_step(record). */
bool gb_run_recorder_read(const char *directory, const char *name,
                          struct gb_params *params, struct gb_record *record,
                          struct gb_error *err);

#endif
