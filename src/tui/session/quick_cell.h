#ifndef GB_TUI_SESSION_QUICK_CELL_H
#define GB_TUI_SESSION_QUICK_CELL_H

#include "runner/runner.h"

/* The quick cell of the edited parameters: a second engine that computes a whole loading
 * curve in about two seconds (run/quick.h), before or beside the full run. */
struct gb_quick_cell {
    struct gb_params full_params; /* the full scene that it stands for */
    struct gb_runner *runner;     /* NULL: no quick cell */
    struct gb_snapshot now;
    size_t points;
    const struct gb_view_sample *sample;
    enum gb_run_state state;
    bool missed; /* updates withheld while the view is frozen */
};

enum gb_quick_cell_start {
    GB_QUICK_CELL_STARTED,
    GB_QUICK_CELL_NONE,  /* scenes of this kind have no quick cell */
    GB_QUICK_CELL_FAILED /* the engine cannot be started: err */
};

/* Starts the quick cell of a scene and destroys the previous one, which stays unless the
 * outcome is GB_QUICK_CELL_STARTED.  Errors: those of gb_runner_create. */
enum gb_quick_cell_start gb_quick_cell_start(struct gb_quick_cell *quick_cell,
                                             const struct gb_params *full_params,
                                             struct gb_error *err);
/* Takes over a quick cell that has finished; there must be none. */
void gb_quick_cell_adopt(struct gb_quick_cell *quick_cell,
                         const struct gb_params *full_params, struct gb_runner *runner);
void gb_quick_cell_drop(struct gb_quick_cell *quick_cell);

enum gb_quick_cell_news {
    GB_QUICK_CELL_SAME,    /* nothing new, or the view is frozen */
    GB_QUICK_CELL_CHANGED, /* the view changes */
    GB_QUICK_CELL_ENDED    /* the quick cell has just finished; frozen views too */
};

/* Takes the published snapshot; the view stays as it is while it is frozen. */
enum gb_quick_cell_news gb_quick_cell_refresh(struct gb_quick_cell *quick_cell,
                                              bool frozen);

bool gb_quick_cell_live(const struct gb_quick_cell *quick_cell);

#endif
