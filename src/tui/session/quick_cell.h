#ifndef GB_TUI_SESSION_QUICK_CELL_H
#define GB_TUI_SESSION_QUICK_CELL_H

#include "run/runner/runner.h"

/* The quick cell of the edited parameters: a second engine that computes a whole loading
 * curve in about two seconds (run/quick.h), before or beside the full run. */
struct gb_quick_cell {
    struct gb_params full_params; /* the full scene that it stands for */
    struct gb_runner *runner;     /* NULL: no quick cell */
    struct gb_snapshot now;
    size_t points;
    const struct gb_view_sample *sample;
    int state;   /* enum gb_run_state */
    bool missed; /* updates withheld while the view is frozen */
};

/* Starts the quick cell of a scene and destroys the previous one.  False: no quick cell
 * for the scene (err is set after an error only). */
bool gb_quick_cell_start(struct gb_quick_cell *quick_cell,
                         const struct gb_params *full_params, struct gb_error *err);
void gb_quick_cell_drop(struct gb_quick_cell *quick_cell);

/* Takes the published snapshot; true if the view changes: never while it is frozen.
 * *ended: the quick cell has just finished. */
bool gb_quick_cell_refresh(struct gb_quick_cell *quick_cell, bool frozen, bool *ended);

bool gb_quick_cell_live(const struct gb_quick_cell *quick_cell);

#endif
