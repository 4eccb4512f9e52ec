#ifndef GB_TUI_SESSION_QUICK_CELL_H
#define GB_TUI_SESSION_QUICK_CELL_H

#include "run/runner/runner.h"

/* The quick cell behind a changed number: an engine of its own that computes a whole
 * loading curve in about two seconds (run/quick.h), before or beside the full run. */
struct gb_quick_cell {
    struct gb_params full_params; /* the scene whose quick twin it computes */
    struct gb_runner *runner;     /* NULL: there is none */
    struct gb_snapshot now;
    size_t points;
    const struct gb_view_sample *sample;
    int state;   /* enum gb_run_state */
    bool missed; /* news that came while the view was frozen */
};

/* Starts the quick twin of a scene; the one before it ends.  False: it has none (err has
 * a code then only if something went wrong). */
bool gb_quick_cell_start(struct gb_quick_cell *quick_cell,
                         const struct gb_params *full_params, struct gb_error *err);
void gb_quick_cell_drop(struct gb_quick_cell *quick_cell);

/* Takes what it has published; true when there is news to show: none while the view is
 * frozen.  *ended tells whether it has just come to its end. */
bool gb_quick_cell_refresh(struct gb_quick_cell *quick_cell, bool frozen, bool *ended);

bool gb_quick_cell_live(const struct gb_quick_cell *quick_cell);

#endif
