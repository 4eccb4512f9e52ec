#include "run/warmup.h"

#include <string.h>

#include "base/clock.h"
#include "run/checkpoint.h"
#include "run/cost.h"
#include "run/pace.h"

bool gb_warmup_ended(const struct gb_warmup *warmup)
{
    return warmup->how == GB_STEP_DONE || warmup->how == GB_STEP_STOPPED;
}

static void slice(struct gb_warmup *warmup, struct gb_experiment *experiment,
                  struct gb_pace *pace, struct gb_error *stopped)
{
    const double start = gb_clock_s();
    warmup->how = gb_experiment_advance(experiment, gb_pace_slice(pace), stopped);
    gb_pace_sliced(pace, gb_clock_s() - start, warmup->how == GB_STEP_MORE);
}

void gb_warmup_run(struct gb_warmup *warmup, struct gb_experiment *experiment,
                   double seconds, double gone, const volatile sig_atomic_t *caught,
                   struct gb_error *stopped)
{
    const int64_t before = gb_experiment_evaluations(experiment);
    const double start = gb_clock_s();
    struct gb_pace pace;
    gb_pace_init(&pace);
    warmup->points = g_array_new(FALSE, FALSE, sizeof(struct gb_point));
    while (*caught == 0 && !gb_warmup_ended(warmup) && gb_clock_s() - start < seconds) {
        slice(warmup, experiment, &pace, stopped);
        if (warmup->how == GB_STEP_POINT) {
            struct gb_point point = *gb_experiment_point(experiment);
            point.seconds = gone + gb_clock_s() - start;
            g_array_append_val(warmup->points, point);
            (void)gb_checkpoint_take(experiment, &warmup->record, NULL);
        }
    }
    warmup->particle_steps_per_s =
        gb_cost_rate_measured(experiment, before, gb_clock_s() - start);
}

void gb_warmup_finish(struct gb_warmup *warmup)
{
    if (warmup->points != NULL) {
        g_array_unref(warmup->points);
    }
    gb_record_finish(&warmup->record);
    memset(warmup, 0, sizeof *warmup);
}
