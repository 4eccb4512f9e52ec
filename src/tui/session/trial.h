#ifndef GB_TUI_SESSION_TRIAL_H
#define GB_TUI_SESSION_TRIAL_H

#include "run/runner.h"

/* The quick cell behind a changed number: an engine of its own that computes a whole
 * loading curve in about two seconds (run/quick.h), before or beside the full run. */
struct gb_trial {
    struct gb_params asked;   /* the scene whose quick twin it computes */
    struct gb_runner *runner; /* NULL: there is none */
    struct gb_snapshot now;
    size_t points;
    const struct gb_view_sample *picture;
    int state;   /* enum gb_run_state */
    bool missed; /* news that came while the view was frozen */
};

/* Starts the quick twin of a scene; the one before it ends.  False: it has none (err has
 * a code then only if something went wrong). */
bool gb_trial_start(struct gb_trial *trial, const struct gb_params *asked,
                    struct gb_error *err);
void gb_trial_drop(struct gb_trial *trial);

/* Takes what it has published; true when there is news to show: none while the view is
 * frozen.  *ended tells whether it has just come to its end. */
bool gb_trial_refresh(struct gb_trial *trial, bool frozen, bool *ended);

bool gb_trial_live(const struct gb_trial *trial);

#endif
