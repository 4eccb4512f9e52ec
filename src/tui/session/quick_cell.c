#include "tui/session/quick_cell.h"

#include <string.h>

#include "run/quick.h"

enum gb_quick_cell_start gb_quick_cell_start(struct gb_quick_cell *quick_cell,
                                             const struct gb_params *full_params,
                                             struct gb_error *err)
{
    struct gb_params quick;
    struct gb_runner *runner = NULL;
    if (!gb_quick_params(full_params, &quick)) {
        return GB_QUICK_CELL_NONE;
    }
    if (!gb_runner_create(&runner, &quick, err)) {
        return GB_QUICK_CELL_FAILED;
    }
    gb_quick_cell_drop(quick_cell);
    quick_cell->full_params = *full_params;
    quick_cell->runner = runner;
    gb_runner_send(runner, GB_COMMAND_WATCH);
    quick_cell->state = GB_RUN_PACKING;
    quick_cell->now.seconds_left = -1.0;
    return GB_QUICK_CELL_STARTED;
}

void gb_quick_cell_drop(struct gb_quick_cell *quick_cell)
{
    gb_runner_destroy(quick_cell->runner);
    memset(quick_cell, 0, sizeof *quick_cell);
}

static void take(struct gb_quick_cell *quick_cell, const struct gb_snapshot *snapshot)
{
    quick_cell->now = *snapshot;
    quick_cell->points = gb_curve_count(gb_runner_curve(quick_cell->runner));
    quick_cell->sample = gb_runner_view_sample(quick_cell->runner, NULL);
}

void gb_quick_cell_adopt(struct gb_quick_cell *quick_cell,
                         const struct gb_params *full_params, struct gb_runner *runner)
{
    const struct gb_snapshot *snapshot = gb_runner_snapshot(runner, NULL);
    quick_cell->full_params = *full_params;
    quick_cell->runner = runner;
    quick_cell->state = snapshot->state;
    take(quick_cell, snapshot);
}

enum gb_quick_cell_news gb_quick_cell_refresh(struct gb_quick_cell *quick_cell,
                                              bool frozen)
{
    bool changed = false;
    if (quick_cell->runner == NULL) {
        return GB_QUICK_CELL_SAME;
    }
    const bool was_live = gb_quick_cell_live(quick_cell);
    const struct gb_snapshot *snapshot = gb_runner_snapshot(quick_cell->runner, &changed);
    quick_cell->state = snapshot->state;
    quick_cell->missed = quick_cell->missed || changed;
    const bool shown = quick_cell->missed && !frozen;
    if (shown) {
        quick_cell->missed = false;
        take(quick_cell, snapshot);
    }
    if (was_live && !gb_quick_cell_live(quick_cell)) {
        return GB_QUICK_CELL_ENDED;
    }
    return shown ? GB_QUICK_CELL_CHANGED : GB_QUICK_CELL_SAME;
}

bool gb_quick_cell_live(const struct gb_quick_cell *quick_cell)
{
    return quick_cell->runner != NULL && quick_cell->state <= GB_RUN_PAUSED;
}
