#include "run/record/held_record.h"

#include <math.h>

#include "base/clock.h"
#include "run/checkpoint.h"
#include "run/repeat_points.h"

/* How much computing may have to be repeated, s: so long that records cost a twentieth of
 * the time, within these limits. */
static const double age_least_s = 0.1, age_most_s = 10.0, cost_share = 0.05;

void gb_held_record_init(struct gb_held_record *held, const struct gb_params *params,
                         struct gb_writer *writer)
{
    *held = (struct gb_held_record){.params = params, .writer = writer, .missing = -1};
}

bool gb_held_record_due(const struct gb_held_record *held,
                        const struct gb_experiment *experiment)
{
    const double allowed_s =
        fmin(fmax(held->cost_s / cost_share, age_least_s), age_most_s);
    const double age_s = gb_clock_s() - held->taken_s; /* negative: the clock went back */
    return gb_experiment_over(experiment) ||
           ((!held->fresh || age_s < 0.0 || age_s >= allowed_s) &&
            !gb_writer_busy(held->writer));
}

bool gb_held_record_take(struct gb_held_record *held, struct gb_experiment *experiment,
                         struct gb_error *err)
{
    if (!gb_writer_wait(held->writer, err)) {
        return false;
    }
    const double from_s = gb_clock_s();
    const bool good = gb_checkpoint_take(experiment, gb_writer_record(held->writer), err);
    held->taken_s = gb_clock_s();
    held->cost_s = held->taken_s - from_s;
    return good;
}

void gb_held_record_skip(struct gb_held_record *held, const struct gb_point *point)
{
    held->missing = point->step + 1;
}

bool gb_held_record_complete(struct gb_held_record *held, struct gb_error *err)
{
    held->fresh =
        gb_run_journal_record(&held->journal, gb_writer_record(held->writer), err);
    held->missing = -1;
    return held->fresh;
}

bool gb_held_record_catch_up(struct gb_held_record *held, struct gb_error *err)
{
    struct gb_record *record = gb_writer_record(held->writer);
    struct gb_error why = {0};
    if (held->missing < 0 || gb_writer_busy(held->writer)) {
        return true;
    }
    if (gb_repeat_points_record(record, held->params, held->missing, &why)) {
        return gb_held_record_complete(held, err);
    }
    held->missing = -1;
    held->fresh = held->fresh && record->count > 0;
    return why.code != GB_ERR_MEMORY || gb_error_set(err, why.code, "%s", why.text);
}

bool gb_held_record_ready(const struct gb_held_record *held)
{
    return held->fresh && held->missing < 0;
}
