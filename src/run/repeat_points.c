#include "run/repeat_points.h"

#include "run/checkpoint.h"

/* Force evaluations between two calls of cancelled. */
enum { SLICE = 200 };

bool gb_repeat_points(struct gb_experiment *experiment, int64_t from, int64_t to,
                      bool (*cancelled)(void *data), void *data, struct gb_error *err)
{
    int64_t step = from;
    char text[GB_EVENT_TEXT];
    while (step < to) {
        const enum gb_step_outcome how = gb_experiment_advance(experiment, SLICE, err);
        while (gb_experiment_event(experiment, NULL, text, sizeof text)) {
        }
        if (cancelled != NULL && cancelled(data)) {
            return gb_error_set(err, GB_ERR_CANCELLED, "stopped on request");
        }
        if (how == GB_STEP_STOPPED) {
            return false;
        }
        if (how == GB_STEP_DONE) {
            return gb_error_set(err, GB_ERR_GUARD,
                                "the repeated run ends at step %lld, before the "
                                "checkpoint of step %lld",
                                (long long)step, (long long)to);
        }
        step += how == GB_STEP_POINT;
    }
    return true;
}

bool gb_repeat_points_record(struct gb_record *record, const struct gb_params *params,
                             int64_t to, struct gb_error *err)
{
    struct gb_experiment *experiment = NULL;
    const int64_t from = gb_checkpoint_step(record);
    const bool there = gb_experiment_resume(&experiment, params, record, err) &&
                       gb_repeat_points(experiment, from, to, NULL, NULL, err);
    record->loading = false;
    const bool done = there && gb_checkpoint_take(experiment, record, err);
    if (there && !done) {
        gb_record_clear(record);
    }
    gb_experiment_destroy(experiment);
    return done;
}
