#ifndef GB_RUN_RECORD_RUN_RECORDER_H
#define GB_RUN_RECORD_RUN_RECORDER_H

#include <stdbool.h>

#include "base/record.h"
#include "io/store.h"
#include "run/experiment.h"
#include "scene/model.h"

/* Writes states and status in a thread of its own: the engine fills a record, the thread
 * writes the file and waits for the disk.  There is one record, the largest thing that a
 * run holds besides its packing.  The thread blocks all signals. */
struct gb_writer;

/* store, params and model must outlive the writer. */
bool gb_run_recorder_writer_create(struct gb_writer **out, const struct gb_store *store,
                                   const struct gb_params *params,
                                   const struct gb_model *model, struct gb_error *err);

/* Waits for files under way.  NULL is fine. */
void gb_run_recorder_writer_destroy(struct gb_writer *writer);

/* The record.  It belongs to the engine, except from gb_run_recorder_writer_send until it is
 * written; writing does not change it. */
struct gb_record *gb_run_recorder_writer_record(struct gb_writer *writer);

enum gb_writer_outcome {
    GB_WRITER_SENT,
    GB_WRITER_BUSY,  /* the record is still being written */
    GB_WRITER_FAILED /* writing has failed before: err */
};

/* Hands the record over. */
enum gb_writer_outcome gb_run_recorder_writer_send(struct gb_writer *writer,
                                                   struct gb_error *err);

/* Waits until nothing is being written; false and err when writing has failed. */
bool gb_run_recorder_writer_wait(struct gb_writer *writer, struct gb_error *err);

/* Seconds that the last state took to be written; 0 before the first. */
double gb_run_recorder_writer_seconds(struct gb_writer *writer);

/* Records a run in its directory: rows, events, status, checkpoints.
 *
 * A checkpoint belongs to a recorded point.  The state of the last point, or of one shortly
 * before it, is always held in memory: a run that is stopped between two points is saved at
 * once, or after the points in between are computed again, which gives the same bits and
 * takes less than a second, ten where a record takes half a second. */
struct gb_run_recorder;

/* For a new run; errors as of gb_store_create. */
bool gb_run_recorder_create(struct gb_run_recorder **out, const char *directory,
                            const struct gb_params *params, enum gb_rundir_mode mode,
                            struct gb_error *err);

enum gb_run_recorder_from {
    GB_RUN_RECORDER_LAST,  /* state.h5 */
    GB_RUN_RECORDER_BEFORE /* state-before.h5: the checkpoint before the last */
};

/* For a run that is resumed: locks the directory, reads its preset and its checkpoint,
 * truncates curve.csv and events.log to it and creates the experiment.  *experiment stays
 * NULL when there is no checkpoint yet: the run starts again with
 * gb_run_recorder_params.  Errors: GB_ERR_INPUT (no run, a run under way, a preset that
 * was changed since, a checkpoint of another layout or damaged: with what the one before
 * would do), GB_ERR_MACHINE, GB_ERR_MEMORY.  Temporary files that a killed writer has left
 * are removed. */
bool gb_run_recorder_resume(struct gb_run_recorder **out,
                            struct gb_experiment **experiment, const char *directory,
                            enum gb_run_recorder_from from, struct gb_error *err);

/* For a run that cannot begin: removes its files and the directories made for it. */
void gb_run_recorder_discard(struct gb_run_recorder *recorder);

/* Waits for the last checkpoint.  NULL is fine. */
void gb_run_recorder_destroy(struct gb_run_recorder *recorder);

const struct gb_params *gb_run_recorder_params(const struct gb_run_recorder *recorder);
struct gb_store *gb_run_recorder_store(struct gb_run_recorder *recorder);
/* Number of recorded points and events; seconds of the run at the last record. */
int64_t gb_run_recorder_points(const struct gb_run_recorder *recorder);
int64_t gb_run_recorder_events(const struct gb_run_recorder *recorder);
double gb_run_recorder_seconds(const struct gb_run_recorder *recorder);

/* Records a point: its row, and the state in memory where one is due.  Once per point,
 * after its events. */
bool gb_run_recorder_point(struct gb_run_recorder *recorder,
                           struct gb_experiment *experiment, const struct gb_point *point,
                           struct gb_error *err);
/* A row without a state: of a point before the state that the run begins with. */
bool gb_run_recorder_row(struct gb_run_recorder *recorder, const struct gb_point *point,
                         struct gb_error *err);
bool gb_run_recorder_event(struct gb_run_recorder *recorder, int64_t step,
                           const char *text, struct gb_error *err);

/* An event about a frame that was left out, or states of rows without one, once; false:
 * none. */
bool gb_run_recorder_missed(struct gb_run_recorder *recorder, char *text, size_t size);

enum gb_run_recorder_when {
    GB_RUN_RECORDER_DUE, /* when output.checkpoint_every has passed */
    GB_RUN_RECORDER_NOW
};

/* Writes the state of the last point to state.h5 unless it is there already; returns before
 * it is written.
 *
 * seconds  of the run */
bool gb_run_recorder_tick(struct gb_run_recorder *recorder, double seconds,
                          enum gb_run_recorder_when when, struct gb_error *err);

/* The same now, and waits until it is there. */
bool gb_run_recorder_save(struct gb_run_recorder *recorder, double seconds,
                          struct gb_error *err);

/* Writes the snapshot to status.json; returns before it is written. */
bool gb_run_recorder_status(struct gb_run_recorder *recorder,
                            const struct gb_snapshot *snapshot, struct gb_error *err);

/* For a run whose results can't be recorded any longer: rows and status, as far as they
 * can be written.  state.h5 stays as it is.  NULL is fine. */
void gb_run_recorder_fail(struct gb_run_recorder *recorder,
                          const struct gb_snapshot *snapshot);

/* The end of a run: state, rows and status are on the disk when this returns. */
bool gb_run_recorder_conclude(struct gb_run_recorder *recorder,
                              const struct gb_snapshot *snapshot, struct gb_error *err);

/* Reads preset.ini and the checkpoint `name` ("state.h5") of a run directory; its step is
 * gb_checkpoint_step(record). */
bool gb_run_recorder_read(const char *directory, const char *name,
                          struct gb_params *params, struct gb_record *record,
                          struct gb_error *err);

#endif
