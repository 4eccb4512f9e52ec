#ifndef GB_RUN_WARMUP_H
#define GB_RUN_WARMUP_H

#include <signal.h>

#include <glib.h>

#include "run/experiment.h"

/* The first moments of a run, before it has a directory: they tell how fast it goes.  The
 * work is not lost, the run goes on from there. */
struct gb_warmup {
    GArray *points;              /* struct gb_point, recorded meanwhile */
    struct gb_record record;     /* of the last one */
    enum gb_step_outcome how;    /* what the last slice ended with */
    double particle_steps_per_s; /* 0: nothing was evaluated */
};

/* Advances the experiment for that long, to its end, or until *caught.
 *
 * gone     seconds of the run before the warm-up, for the seconds of the points
 * stopped  filled when a guard stops the experiment
 * gb_warmup_finish is due. */
void gb_warmup_run(struct gb_warmup *warmup, struct gb_experiment *experiment,
                   double seconds, double gone, const volatile sig_atomic_t *caught,
                   struct gb_error *stopped);

/* No slice is left after these. */
bool gb_warmup_ended(const struct gb_warmup *warmup);

void gb_warmup_finish(struct gb_warmup *warmup); /* a zeroed one is fine */

#endif
