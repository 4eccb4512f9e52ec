#include "tui/session/trial.h"

#include <string.h>

#include "run/quick.h"

bool gb_trial_start(struct gb_trial *trial, const struct gb_params *asked,
                    struct gb_error *err)
{
    struct gb_params quick;
    struct gb_runner *runner = NULL;
    if (!gb_quick_params(asked, &quick) || !gb_runner_create(&runner, &quick, err)) {
        return false;
    }
    gb_trial_drop(trial);
    trial->asked = *asked;
    trial->runner = runner;
    gb_runner_send(runner, GB_COMMAND_WATCH);
    trial->state = GB_RUN_PACKING;
    trial->now.seconds_left = -1.0;
    return true;
}

void gb_trial_drop(struct gb_trial *trial)
{
    gb_runner_destroy(trial->runner);
    memset(trial, 0, sizeof *trial);
}

bool gb_trial_refresh(struct gb_trial *trial, bool frozen, bool *ended)
{
    bool changed = false;
    *ended = false;
    if (trial->runner == NULL) {
        return false;
    }
    const bool was_live = gb_trial_live(trial);
    const struct gb_snapshot *snapshot = gb_runner_snapshot(trial->runner, &changed);
    trial->state = snapshot->state;
    *ended = was_live && !gb_trial_live(trial);
    trial->missed = trial->missed || changed;
    if (!trial->missed || frozen) {
        return false;
    }
    trial->missed = false;
    trial->now = *snapshot;
    trial->points = gb_curve_count(gb_runner_curve(trial->runner));
    trial->picture = gb_runner_picture(trial->runner, NULL);
    return true;
}

bool gb_trial_live(const struct gb_trial *trial)
{
    return trial->runner != NULL && trial->state <= GB_RUN_PAUSED;
}
