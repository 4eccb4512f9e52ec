#ifndef GB_RUN_RUNNER_H
#define GB_RUN_RUNNER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "greenbody/curve.h"
#include "greenbody/params.h"
#include "greenbody/snapshot.h"
#include "run/publish.h"
#include "run/state.h"

/* One experiment in a background thread: the only place that creates threads.  The thread
 * blocks all signals. */
struct gb_runner;

/* Freezes params and starts the engine thread, which first builds the packing.  A bad
 * parameter is told at once (GB_ERR_INPUT); later failures are in the snapshot. */
bool gb_runner_create(struct gb_runner **out, const struct gb_params *params,
                      struct gb_error *err);
/* Asks the engine to stop, waits for it (at most one slice), frees all.  NULL is fine. */
void gb_runner_destroy(struct gb_runner *runner);

/* Queues a command; false when the ring is full. */
bool gb_runner_send(struct gb_runner *runner, enum gb_command_kind kind);

/* Newest snapshot; *changed (may be NULL) tells whether it is new since the last call. */
const struct gb_snapshot *gb_runner_snapshot(struct gb_runner *runner, bool *changed);

/* The growing curve; readable from the screen's thread at any time. */
const struct gb_curve *gb_runner_curve(const struct gb_runner *runner);

/* Copies event `index` (0 is the first of the run); false when there is none, or when it
 * is so old that it was dropped (the last 256 are kept).  The snapshot carries only the
 * last one and can miss events that come together. */
bool gb_runner_event(struct gb_runner *runner, int64_t index, char *text, size_t size);

/* The parameters as run. */
const struct gb_params *gb_runner_params(const struct gb_runner *runner);

#endif
