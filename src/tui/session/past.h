#ifndef GB_TUI_SESSION_PAST_H
#define GB_TUI_SESSION_PAST_H

#include <stdbool.h>

#include "io/preset.h"
#include "runner/runner.h"
#include "tui/session/previous.h"

/* Runs and quick cells that were replaced, with their final curve, state and packing.
 * Setting their parameters again shows them. */

enum { GB_KEPT_RUNS = 12, GB_KEPT_RUN_WHATIFS = 16 };

struct gb_kept_run {
    struct gb_params params;               /* of the full scene */
    struct gb_runner *runner;              /* its engine has ended; owned */
    bool quick;                            /* a quick cell */
    bool stopped;                          /* replaced before its end */
    struct gb_curve_label label;           /* label of its previous curve */
    size_t whatif_at[GB_KEPT_RUN_WHATIFS]; /* as in the session */
    int whatifs;
};

struct gb_kept_runs {
    struct gb_kept_run *run[GB_KEPT_RUNS]; /* owned, oldest first */
    int count;
};

/* Stops the engine of a run and keeps the run.  It replaces a run with the same
 * parameters, or the oldest if there are too many.  A run without a curve, or if memory
 * is short, is destroyed. */
void gb_past_runs_add(struct gb_kept_runs *kept, const struct gb_kept_run *run);

/* Takes out the run or quick cell with these parameters; false: there is none. */
bool gb_past_runs_take(struct gb_kept_runs *kept, const struct gb_params *params,
                       bool quick, struct gb_kept_run *out);

void gb_past_runs_finish(struct gb_kept_runs *kept); /* zeroed is fine */

enum { GB_PARAM_STEPS = 100 };

struct gb_param_step {
    struct gb_preset *preset; /* preset of the parameters; not owned */
    struct gb_params params;
};

struct gb_param_steps {
    struct gb_param_step *step[GB_PARAM_STEPS]; /* owned; NULL from count on */
    int count, at;                              /* number of steps; the one on screen */
};

/* Adds a step if preset or parameters differ from the step on screen.  Undone steps are
 * dropped, and the oldest if there are too many.  Out of memory: no step. */
void gb_past_steps_note(struct gb_param_steps *steps, struct gb_preset *preset);

/* Moves to the parameters before (-1) or after (1) and sets them in their preset.
 * NULL: there are none. */
struct gb_preset *gb_past_steps_move(struct gb_param_steps *steps, int direction);

/* Number of steps to undo (-1) or redo (1). */
int gb_past_steps_left(const struct gb_param_steps *steps, int direction);

void gb_past_steps_finish(struct gb_param_steps *steps); /* zeroed is fine */

#endif
