#include "run/warmup.h"

#include <string.h>

#include "run/checkpoint.h"
#include "run/cost.h"
#include "run/pace.h"

static double seconds_since(gint64 start)
{
    return 1e-6 * (double)(g_get_monotonic_time() - start);
}

bool gb_warmup_ended(const struct gb_warmup *warmup)
{
    return warmup->how == GB_STEP_DONE || warmup->how == GB_STEP_STOPPED;
}

static void slice(struct gb_warmup *warmup, struct gb_experiment *experiment,
                  struct gb_pace *pace, struct gb_error *stopped)
{
    const gint64 start = g_get_monotonic_time();
    warmup->how = gb_experiment_advance(experiment, gb_pace_slice(pace), stopped);
    gb_pace_sliced(pace, seconds_since(start), warmup->how == GB_STEP_MORE);
}

void gb_warmup_run(struct gb_warmup *warmup, struct gb_experiment *experiment,
                   double seconds, double gone, const volatile sig_atomic_t *caught,
                   struct gb_error *stopped)
{
    const int64_t before = gb_experiment_evaluations(experiment);
    const gint64 start = g_get_monotonic_time();
    struct gb_pace pace;
    gb_pace_init(&pace);
    warmup->points = g_array_new(FALSE, FALSE, sizeof(struct gb_point));
    while (*caught == 0 && !gb_warmup_ended(warmup) && seconds_since(start) < seconds) {
        slice(warmup, experiment, &pace, stopped);
        if (warmup->how == GB_STEP_POINT) {
            struct gb_point point = *gb_experiment_point(experiment);
            point.seconds = gone + seconds_since(start);
            g_array_append_val(warmup->points, point);
            (void)gb_checkpoint_take(experiment, &warmup->record, NULL);
        }
    }
    warmup->particle_steps_per_s =
        gb_cost_rate_measured(experiment, before, seconds_since(start));
}

void gb_warmup_finish(struct gb_warmup *warmup)
{
    if (warmup->points != NULL) {
        g_array_unref(warmup->points);
    }
    gb_record_finish(&warmup->record);
    memset(warmup, 0, sizeof *warmup);
}
