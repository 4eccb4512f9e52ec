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

/* Where the particles were: a zeroed one is taken anew. */
struct gb_view_start {
    double *position; /* count x 3 */
    int64_t count;
    struct gb_cell cell;
    double half_width; /* of the widest box of a die so far, while it has its funnel */
    double height;
    bool pressed; /* taken when pressing had begun */
};

void gb_runner_finish(struct gb_view_start *start);

/* The same of a state.  pressed: pressing has begun. */
void gb_runner_take_state(const struct gb_state *state, bool pressed,
                          struct gb_view_start *start, struct gb_view_sample *sample);

/* One experiment in a background thread, which blocks all signals. */
struct gb_runner;

/* Freezes params and starts the engine thread, which first builds the packing.  A bad
 * parameter is told at once (GB_ERR_INPUT); later failures are in the snapshot. */
bool gb_runner_create(struct gb_runner **out, const struct gb_params *params,
                      struct gb_error *err);
/* A run that continues from the state of another with changes: "mu=0.3; ..." as
 * gb_changes_add takes them.  They join its loading.changes, so that its parameters alone
 * repeat it.  Its curve begins with the other's points up to that state.  directory keeps
 * it (gb_runner_create_in); NULL: it is not kept.  Errors as above; GB_ERR_INPUT when the
 * state is not there. */
bool gb_runner_create_fork(struct gb_runner **out, const char *changes,
                           struct gb_runner *parent, const char *directory,
                           struct gb_error *err);
/* Whether the state asked for by GB_COMMAND_FORK is there; *step (may be NULL) is that of
 * its point.  It comes with the next recorded point of the loading branch, and not at all
 * when the run ends before. */
bool gb_runner_forked(struct gb_runner *runner, int64_t *step);
/* The same, kept in a directory of its own, which must not hold a run yet.  A directory
 * that cannot be made, or a disk that fails, is an event of the run and does not end it.
 */
bool gb_runner_create_in(struct gb_runner **out, const struct gb_params *params,
                         const char *directory, struct gb_error *err);
/* Continues the run in a directory, from its last checkpoint.  An engine that works
 * there is asked to stop and waited for. */
bool gb_runner_resume(struct gb_runner **out, const char *directory,
                      struct gb_error *err);
/* Shows a run that another process computes, and writes nothing: commands other than
 * GB_COMMAND_STOP have no effect.  View samples are those of its state.h5, taken without
 * GB_COMMAND_WATCH whenever a new one is there. */
bool gb_runner_follow(struct gb_runner **out, const char *directory,
                      struct gb_error *err);
/* The directory in which the run is recorded, or that is followed; NULL: none. */
const char *gb_runner_directory(const struct gb_runner *runner);
/* Asks the engine to stop and waits for it (at most one slice).  Curve, snapshot, events and
 * view sample stay; commands have no effect any more. */
void gb_runner_stop(struct gb_runner *runner);
/* gb_runner_stop, and frees all.  NULL is fine. */
void gb_runner_destroy(struct gb_runner *runner);

/* Queues a command; false when the ring is full. */
bool gb_runner_send(struct gb_runner *runner, enum gb_command_kind kind);

/* How many GB_COMMAND_STORE are done: the state of the last recorded point is in state.h5.
 * A run that is followed stores its own, and this one counts at once. */
int64_t gb_runner_stored(struct gb_runner *runner);

/* Newest snapshot; *changed (may be NULL) tells whether it is new since the last call. */
const struct gb_snapshot *gb_runner_snapshot(struct gb_runner *runner, bool *changed);

/* Newest view sample; not valid before the first.  Samples are taken once GB_COMMAND_WATCH
 * was sent: a few per second and one at each end or pause, for a few percent of the
 * engine's time. */
const struct gb_view_sample *gb_runner_view_sample(struct gb_runner *runner,
                                                   bool *changed);

/* The growing curve; readable from the screen's thread at any time. */
const struct gb_curve *gb_runner_curve(const struct gb_runner *runner);

/* Copies event `index` (0 is the first of the run); false when there is none, or when it
 * is so old that it was dropped (the last 256 are kept).  The snapshot carries only the
 * last one and can miss events that come together. */
bool gb_runner_event(struct gb_runner *runner, int64_t index, char *text, size_t size);

/* The parameters as run. */
const struct gb_params *gb_runner_params(const struct gb_runner *runner);

#endif
