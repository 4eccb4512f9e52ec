#include "run/runner_recorder.h"

#include <stdio.h>

#include <glib.h>

static const double status_every_s = 1.5;

/* The results so far stay as they are. */
static void give_up(struct gb_runner_recorder *kept, const struct gb_error *err)
{
    snprintf(kept->note, sizeof kept->note, "not kept any more: %s", err->text);
    gb_run_recorder_destroy(kept->keep);
    kept->keep = NULL;
}

void gb_runner_recorder_begin(struct gb_runner_recorder *kept,
                              const struct gb_params *params)
{
    struct gb_error err = {0};
    if (kept->directory == NULL) {
        return;
    }
    if (gb_run_recorder_create(&kept->keep, kept->directory, params, false, &err)) {
        snprintf(kept->note, sizeof kept->note, "kept in %s", kept->directory);
    } else {
        snprintf(kept->note, sizeof kept->note, "not kept: %s", err.text);
    }
}

bool gb_runner_recorder_resume(struct gb_runner_recorder *kept,
                               struct gb_experiment **experiment, struct gb_error *err)
{
    return gb_run_recorder_resume(&kept->keep, experiment, kept->directory, err);
}

void gb_runner_recorder_row(struct gb_runner_recorder *kept, const struct gb_point *point)
{
    struct gb_error err = {0};
    if (kept->keep != NULL &&
        !gb_store_point(gb_run_recorder_store(kept->keep), point, &err)) {
        give_up(kept, &err);
    }
}

void gb_runner_recorder_point(struct gb_runner_recorder *kept,
                              struct gb_experiment *experiment,
                              const struct gb_point *point)
{
    struct gb_error err = {0};
    if (kept->keep != NULL &&
        !gb_run_recorder_point(kept->keep, experiment, point, &err)) {
        give_up(kept, &err);
    }
}

void gb_runner_recorder_event(struct gb_runner_recorder *kept, int64_t step,
                              const char *text)
{
    struct gb_error err = {0};
    if (kept->keep != NULL && !gb_run_recorder_event(kept->keep, step, text, &err)) {
        give_up(kept, &err);
    }
}

void gb_runner_recorder_tick(struct gb_runner_recorder *kept,
                             const struct gb_snapshot *snapshot, bool now)
{
    struct gb_error err = {0};
    if (kept->keep == NULL) {
        return;
    }
    bool good = gb_run_recorder_tick(kept->keep, snapshot->seconds, now, &err);
    if (good && (now || snapshot->seconds - kept->status_at >= status_every_s)) {
        kept->status_at = snapshot->seconds;
        good = gb_run_recorder_status(kept->keep, snapshot, &err);
    }
    if (!good) {
        give_up(kept, &err);
    }
}

void gb_runner_recorder_conclude(struct gb_runner_recorder *kept,
                                 const struct gb_snapshot *snapshot)
{
    struct gb_error err = {0};
    if (kept->keep != NULL && !gb_run_recorder_conclude(kept->keep, snapshot, &err)) {
        give_up(kept, &err);
    }
    gb_run_recorder_destroy(kept->keep); /* the lock goes with it */
    kept->keep = NULL;
}

void gb_runner_recorder_finish(struct gb_runner_recorder *kept)
{
    gb_run_recorder_destroy(kept->keep);
    g_free(kept->directory);
    *kept = (struct gb_runner_recorder){0};
}
