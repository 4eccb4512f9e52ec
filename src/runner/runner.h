#ifndef GB_RUNNER_RUNNER_H
#define GB_RUNNER_RUNNER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "greenbody/curve.h"
#include "greenbody/params.h"
#include "greenbody/snapshot.h"
#include "io/state.h"
#include "pack/cell/cell.h"
#include "run/experiment.h"
#include "runner/publish.h"

/* Positions at the start, from which a view measures displacements.  A zeroed one is filled
 * by the next sample. */
struct gb_view_start {
    double *position; /* count x 3 */
    int64_t count;
    struct gb_cell cell;
    double half_width; /* of the widest box of a die so far, while it has its funnel */
    double height;
    bool pressed; /* taken when pressing had begun */
};

void gb_runner_view_start_finish(struct gb_view_start *start);

/* The same of a state.  pressed: pressing has begun. */
void gb_runner_view_of_state(const struct gb_state *state, bool pressed,
                             struct gb_view_start *start, struct gb_view_sample *sample);

/* One run in a background thread.  The thread blocks all signals. */
struct gb_runner;

/* Checks params and starts the engine thread, which first builds the packing.  A bad
 * parameter is an error at once (GB_ERR_INPUT); later failures are in the snapshot. */
bool gb_runner_create(struct gb_runner **out, const struct gb_params *params,
                      struct gb_error *err);
/* Continues from the state of another run with changes "mu=0.3; ..." in the form of
 * gb_changes_add.  They are added to loading.changes, so that the parameters alone
 * repeat the run.  The curve begins with the points of the other run up to that state.
 * directory: where to record it (see gb_runner_create_in); NULL: not recorded.  Errors
 * as above; GB_ERR_INPUT if the state does not exist. */
bool gb_runner_create_fork(struct gb_runner **out, const char *changes,
                           struct gb_runner *parent, const char *directory,
                           struct gb_error *err);
/* Has the state requested by GB_COMMAND_FORK arrived? *step (may be NULL) is the step
 * of its point.  It arrives with the next recorded point of the loading branch, or not
 * at all if the run ends before that. */
bool gb_runner_forked(struct gb_runner *runner, int64_t *step);
/* As gb_runner_create, recorded in a directory that must not contain a run.  If the
 * directory cannot be created or a disk fails, this is an event and the run continues. */
bool gb_runner_create_in(struct gb_runner **out, const struct gb_params *params,
                         const char *directory, struct gb_error *err);
/* Continues the run in a directory from its last checkpoint.  An engine that works
 * there is asked to stop, and this call waits for it. */
bool gb_runner_resume(struct gb_runner **out, const char *directory,
                      struct gb_error *err);
/* Shows a run that another process computes and writes nothing.  Commands other than
 * GB_COMMAND_STOP have no effect.  View samples show each new state.h5, without
 * GB_COMMAND_WATCH. */
bool gb_runner_follow(struct gb_runner **out, const char *directory,
                      struct gb_error *err);
/* The directory in which the run is recorded, or which is followed; NULL: none. */
const char *gb_runner_directory(const struct gb_runner *runner);
/* Asks the engine to stop and waits for it (at most one slice).  Curve, snapshot,
 * events and view sample remain; commands have no effect any more. */
void gb_runner_stop(struct gb_runner *runner);
/* gb_runner_stop, and frees all.  NULL is fine. */
void gb_runner_destroy(struct gb_runner *runner);

/* Queues a command; false when the ring is full. */
bool gb_runner_send(struct gb_runner *runner, enum gb_command_kind kind);

/* Number of GB_COMMAND_STORE done.  After each, state.h5 has the state of the last
 * recorded point.  A followed run stores its own states, so its commands count as done
 * at once. */
int64_t gb_runner_stored(struct gb_runner *runner);

/* Newest snapshot; *changed (may be NULL): is it new since the last call? */
const struct gb_snapshot *gb_runner_snapshot(struct gb_runner *runner, bool *changed);

/* Newest view sample; not valid before the first.  After GB_COMMAND_WATCH there are a
 * few samples per second and one at each end or pause.  They cost a few per cent of the
 * engine's time. */
const struct gb_view_sample *gb_runner_view_sample(struct gb_runner *runner,
                                                   bool *changed);

/* The growing curve; the screen's thread may read it at any time. */
const struct gb_curve *gb_runner_curve(const struct gb_runner *runner);

/* Copies event `index` (0 is the first of the run).  False if it does not exist or was
 * dropped (the last 256 are kept).  The snapshot has only the last event and may miss
 * events in quick succession. */
bool gb_runner_event(struct gb_runner *runner, int64_t index, char *text, size_t size);

/* The parameters of the run. */
const struct gb_params *gb_runner_params(const struct gb_runner *runner);

#endif
