#ifndef GB_RUN_WARMUP_H
#define GB_RUN_WARMUP_H

#include <glib.h>

#include "run/run_loop.h"

/* The first seconds of a run, before it has a directory: its speed is measured for the
 * cost estimate.  The run continues from there: nothing is computed twice. */
struct gb_warmup {
    GArray *points;              /* of struct gb_point, recorded meanwhile */
    struct gb_record record;     /* of the last one */
    double particle_steps_per_s; /* 0: nothing was evaluated */
};

/* Advances the loop's experiment for `seconds`, to its end, or until the loop's hook
 * may_continue returns false.  gb_warmup_finish is due. */
void gb_warmup_run(struct gb_warmup *warmup, struct gb_run_loop *loop, double seconds);

/* Records the points of the warm-up, if there was one. */
bool gb_warmup_record(struct gb_warmup *warmup, struct gb_run_recorder *recorder,
                      struct gb_error *err);

void gb_warmup_finish(struct gb_warmup *warmup); /* a zeroed one is fine */

#endif
