#include "run/quick.h"

#include <math.h>
#include <stdio.h>

#include "run/cost.h"
#include "scene/lattice.h"
#include "scene/loading_kind.h"

/* Strain of a quick step: three times the default.  Smaller steps would take longer than
 * two seconds; the error of larger ones would exceed the scatter between cells. */
static const double quick_step = 0.003;
/* Longest time of a quick dynamic run, s, and the fewest discs that give a curve. */
static const double dynamic_s = 1.5;
static const double count_least = 200.0;

static bool shrink_dynamic(struct gb_params *quick)
{
    struct gb_cost cost;
    quick->relax_s = 0.0;
    quick->hold_s = 0.0;
    if (!gb_cost_estimate(quick, gb_cost_rate_assumed(quick), &cost, NULL)) {
        return false;
    }
    if (cost.seconds > dynamic_s) {
        const double count = floor((double)quick->count * dynamic_s / cost.seconds);
        if (count < count_least) {
            return false;
        }
        quick->count = (int64_t)count;
    }
    return true;
}

bool gb_quick_params(const struct gb_params *full, struct gb_params *quick)
{
    *quick = *full;
    const struct gb_lattice *lattice = gb_lattice_of(full->structure);
    if (quick->count > GB_QUICK_COUNT) {
        quick->count =
            lattice ? gb_lattice_count_below(lattice, GB_QUICK_COUNT) : GB_QUICK_COUNT;
        /* the base of a larger cell would make this one too flat */
        quick->base = (struct gb_relative){0.0, true};
    }
    quick->strain_step = fmax(quick->strain_step, quick_step);
    quick->unload_count = 0;
    quick->changes[0] = '\0'; /* they refer to other steps */
    quick->fidelity = GB_FIDELITY_FAST;
    quick->tolerance = NAN;
    quick->tolerance_scale = GB_TOLERANCE_CONTACT;
    quick->strain_part = NAN;
    quick->precision = GB_PRECISION_AUTO;
    snprintf(quick->relaxer, sizeof quick->relaxer, "auto");
    const struct gb_loading_kind *kind = gb_loading_kind_of(full);
    if (kind->follows_time && !(kind->given_rate && shrink_dynamic(quick))) {
        return false;
    }
    return gb_params_check(quick, NULL);
}

/* The reference takes the work of a small cell 36 times (run/cost.c). */
bool gb_quick_enough(const struct gb_params *full)
{
    struct gb_params quick;
    const bool slow = full->fidelity == GB_FIDELITY_REFERENCE &&
                      !gb_loading_kind_of(full)->follows_time;
    return gb_quick_params(full, &quick) && full->count <= quick.count && !slow;
}
