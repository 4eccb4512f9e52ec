#ifndef GB_RUN_RUNNER_RECORDER_H
#define GB_RUN_RUNNER_RECORDER_H

#include "run/run_recorder.h"

enum { GB_RUNNER_RECORDER_NOTE = 512 };

/* How a run behind a screen is kept in its directory.  A disk that fails does not end it:
 * the run goes on without, and note says so once.  The engine thread's own. */
struct gb_runner_recorder {
    char *directory; /* NULL: the run is not kept */
    struct gb_run_recorder *keep;
    double status_at;
    char note[GB_RUNNER_RECORDER_NOTE]; /* "": nothing to tell; the caller takes it */
};

/* The engine begins: makes the directory. */
void gb_runner_recorder_begin(struct gb_runner_recorder *kept,
                              const struct gb_params *params);
/* Or goes on in it; *experiment is NULL when there is no checkpoint yet.  Here an error
 * is one. */
bool gb_runner_recorder_resume(struct gb_runner_recorder *kept,
                               struct gb_experiment **experiment, struct gb_error *err);

/* A row without a state: of a point before the state the run begins with. */
void gb_runner_recorder_row(struct gb_runner_recorder *kept,
                            const struct gb_point *point);
void gb_runner_recorder_point(struct gb_runner_recorder *kept,
                              struct gb_experiment *experiment,
                              const struct gb_point *point);
void gb_runner_recorder_event(struct gb_runner_recorder *kept, int64_t step,
                              const char *text);
/* Status and checkpoint when they are due; now: both at once. */
void gb_runner_recorder_tick(struct gb_runner_recorder *kept,
                             const struct gb_snapshot *snapshot, bool now);
/* The end: all of it is on the disk. */
void gb_runner_recorder_conclude(struct gb_runner_recorder *kept,
                                 const struct gb_snapshot *snapshot);
void gb_runner_recorder_finish(struct gb_runner_recorder *kept);

#endif
