#include "tui/session/cost_confirm.h"

#include <math.h>
#include <stdio.h>

#include "base/units.h"
#include "run/cost.h"
#include "scene/derived.h"
#include "scene/loading_kind.h"

/* Cheaper parameters for the stage that takes most.  A longer time step shortens every
 * stage, and auto may be longer than a given one. */
static void write_advice(const struct gb_params *params, const struct gb_cost *cost,
                         char *text, size_t size)
{
    const bool compression = cost->compress_steps >= cost->relax_steps + cost->hold_steps;
    snprintf(text, size, "%s%s or fewer particles.count",
             compression ? "a higher loading.rate" : "a shorter loading.relax or hold",
             isnan(gb_derived_time_step_s(params)) ? "" : ", numerics.time_step = auto");
}

bool gb_cost_confirm_question(const struct gb_params *params, double particle_steps_per_s,
                              char *text, size_t size)
{
    struct gb_cost cost;
    struct gb_error err = {0};
    const bool measured = particle_steps_per_s > 0.0;
    const double rate = measured ? particle_steps_per_s : gb_cost_rate_assumed(params);
    if (!gb_loading_kind_of(params)->given_rate ||
        !gb_cost_estimate(params, rate, &cost, &err) ||
        gb_cost_check_limit(&cost, &err)) {
        return false;
    }
    char duration[48], step[48], advice[128];
    gb_cost_duration(cost.seconds, duration, sizeof duration);
    gb_units_format_short(cost.time_step_s, GB_DIM_TIME, 3, step, sizeof step);
    write_advice(params, &cost, advice, sizeof advice);
    snprintf(text, size,
             "This run will take about %s: %.3g steps of %s%s for %lld particles at "
             "%.3g million particle-steps/s (%s). Cheaper: %s.",
             duration, cost.steps, step, cost.step_assumed ? " (assumed)" : "",
             (long long)params->count, cost.particle_steps_per_s / 1e6,
             measured ? "as the last run" : "assumed", advice);
    return true;
}

bool gb_cost_confirm_after_quick(const struct gb_params *full,
                                 const struct gb_params *quick, double quick_s,
                                 double *seconds, char *text, size_t size)
{
    char duration[48];
    struct gb_error err = {0};
    const struct gb_cost cost = {.seconds = gb_cost_from_quick(full, quick, quick_s)};
    *seconds = cost.seconds;
    if (!isfinite(cost.seconds) || gb_cost_check_limit(&cost, &err)) {
        return false;
    }
    gb_cost_duration(cost.seconds, duration, sizeof duration);
    snprintf(
        text, size,
        "This run will take about %s: %lld particles, estimated from the %.1f s of its "
        "quick cell. Cheaper: fewer particles.count%s.",
        duration, (long long)full->count, quick_s,
        full->fidelity == GB_FIDELITY_FAST ? "" : " or numerics.fidelity = fast");
    return true;
}
