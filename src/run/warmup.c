#include "run/warmup.h"

#include <string.h>

#include "run/checkpoint.h"
#include "run/cost.h"

static bool may_continue(const struct gb_run_loop *loop)
{
    const struct gb_run_loop_hooks *hooks = &loop->hooks;
    return hooks->may_continue == NULL || hooks->may_continue(hooks->data, NULL);
}

static void add_point(struct gb_warmup *warmup, struct gb_run_loop *loop)
{
    struct gb_point point = *gb_experiment_point(loop->experiment);
    point.seconds = gb_run_loop_seconds(loop);
    g_array_append_val(warmup->points, point);
    (void)gb_checkpoint_take(loop->experiment, &warmup->record, NULL);
}

void gb_warmup_run(struct gb_warmup *warmup, struct gb_run_loop *loop, double seconds)
{
    const int64_t before = gb_experiment_evaluations(loop->experiment);
    const double start = gb_run_loop_seconds(loop);
    warmup->points = g_array_new(FALSE, FALSE, sizeof(struct gb_point));
    while (may_continue(loop) && !gb_run_loop_ended(loop) &&
           gb_run_loop_seconds(loop) - start < seconds) {
        if (gb_run_loop_slice(loop) == GB_STEP_POINT) {
            add_point(warmup, loop);
        }
    }
    warmup->particle_steps_per_s = gb_cost_rate_measured(
        loop->experiment, before, gb_run_loop_seconds(loop) - start);
}

bool gb_warmup_record(struct gb_warmup *warmup, struct gb_run_recorder *recorder,
                      struct gb_error *err)
{
    const GArray *points = warmup->points;
    return points == NULL ||
           gb_run_recorder_adopt(recorder, (const struct gb_point *)points->data,
                                 points->len, &warmup->record, err);
}

void gb_warmup_finish(struct gb_warmup *warmup)
{
    if (warmup->points != NULL) {
        g_array_unref(warmup->points);
    }
    gb_record_finish(&warmup->record);
    memset(warmup, 0, sizeof *warmup);
}
