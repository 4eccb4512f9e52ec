#ifndef GB_TUI_SESSION_PAST_KEPT_RUNS_H
#define GB_TUI_SESSION_PAST_KEPT_RUNS_H

#include "runner/runner.h"
#include "tui/session/overlay/previous_curve.h"

/* Runs and quick cells that were replaced, with their curve, state and packing as they
 * ended, so that their parameters show them again. */

enum { GB_KEPT_RUNS = 12, GB_KEPT_RUN_WHATIFS = 16 };

struct gb_kept_run {
    struct gb_params params;  /* of the full scene */
    struct gb_runner *runner; /* its engine has ended; owned */
    bool quick;               /* a quick cell */
    bool stopped;             /* before its end, by being replaced */
    struct gb_curve_label label; /* of its curve among the previous ones */
    size_t whatif_at[GB_KEPT_RUN_WHATIFS]; /* as in the session */
    int whatifs;
};

struct gb_kept_runs {
    struct gb_kept_run *run[GB_KEPT_RUNS]; /* owned, oldest first */
    int count;
};

/* Stops the engine of a run and keeps it; one of the same parameters is replaced, and the
 * oldest where there are too many.  A run without a curve, and one without memory, is
 * destroyed. */
void gb_kept_runs_add(struct gb_kept_runs *kept, const struct gb_kept_run *run);

/* Hands over the run, or quick cell, of these parameters; false: there is none. */
bool gb_kept_runs_take(struct gb_kept_runs *kept, const struct gb_params *params,
                       bool quick, struct gb_kept_run *out);

void gb_kept_runs_finish(struct gb_kept_runs *kept); /* zeroed is fine */

#endif
