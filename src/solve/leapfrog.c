#include "solve/leapfrog.h"

#include <math.h>
#include <string.h>

#include "base/portable.h"
#include "pack/die/bed_sweep.h"
#include "scene/tolerances.h"

void gb_leapfrog_init(struct gb_leapfrog *leapfrog, double safety, double given)
{
    *leapfrog = (struct gb_leapfrog){.safety = safety, .given = given, .limit = INFINITY};
}

double gb_leapfrog_critical(const struct gb_bed *bed)
{
    const double smooth = bed->tally.stiffest;
    /* k_t (1/m + R^2/I) of a spring; two across each normal, one of a lone wall's along a mode */
    const double across = bed->law.shear * (1.0 + 1.0 / bed->inertia);
    const int rubbed = bed->law.mu > 0.0 ? 2 : bed->law.mu_wall > 0.0 ? 1 : 0;
    const int springs = rubbed + (bed->welds ? 2 : 0);
    const double rough = smooth * (1.0 + springs * across);
    return sqrt(fmin(2.0 / smooth, 3.0 / rough));
}

double gb_leapfrog_impact(const struct gb_bed *bed)
{
    const double impact = bed->tally.impact;
    return impact > 0.0
               ? GB_IMPACT_SHARE * M_2_PI * 3.218 * gb_portable_pow(1.0 / impact, 0.2)
               : INFINITY;
}

/* The longest step for what no listed contact bounds. */
static double free_step(const struct gb_leapfrog *leapfrog, const struct gb_bed *bed)
{
    if (!(leapfrog->step > 0.0)) {
        return GB_FREE_STEP_MAX;
    }
    /* a particle at rest may fall by its size before it meets another */
    const double fast =
        fmax(leapfrog->fastest, sqrt(2.0 * leapfrog->gravity * bed->smallest));
    return fmin(GB_STEP_GROWTH_MAX * leapfrog->step,
                GB_STEP_TRAVEL_MAX * bed->smallest / fast);
}

static double next_step(const struct gb_leapfrog *leapfrog, const struct gb_bed *bed)
{
    if (leapfrog->given > 0.0) {
        return fmin(leapfrog->given, leapfrog->limit);
    }
    const double allowed =
        leapfrog->safety * fmin(gb_leapfrog_critical(bed), gb_leapfrog_impact(bed));
    return fmin(fmin(allowed, free_step(leapfrog, bed)), leapfrog->limit);
}

/* Velocities by a step, and what holds each particle; returns a bound of the speeds. */
static double kick(const struct gb_leapfrog *leapfrog, struct gb_bed *bed, double step)
{
    const struct gb_bed_motion_kick by = {.force = (const gb_bed_row *)bed->force,
                                          .moment = (const gb_bed_row *)bed->moment,
                                          .inverse_mass = bed->inverse_mass,
                                          .inertia = bed->inertia,
                                          .step = step,
                                          .gravity = leapfrog->gravity,
                                          .drag = leapfrog->drag};
    return gb_bed_sweep_kick(bed, &by);
}

/* The first step: neither forces are known yet nor what holds the particles, which the second
 * evaluation sums over the two of each contact. */
static bool begin(struct gb_leapfrog *leapfrog, struct gb_bed *bed, struct gb_error *err)
{
    if (!gb_bed_evaluate_blocks(bed, 0.0, 0.0, err)) {
        return false;
    }
    (void)kick(leapfrog, bed, 0.0);
    if (!gb_bed_evaluate_blocks(bed, 0.0, 0.0, err)) {
        return false;
    }
    leapfrog->step = next_step(leapfrog, bed);
    return true;
}

bool gb_leapfrog_step(struct gb_leapfrog *leapfrog, struct gb_bed *bed,
                      struct gb_error *err)
{
    if (!(leapfrog->step > 0.0) && !begin(leapfrog, bed, err)) {
        return false;
    }
    const double deviation2 = gb_bed_sweep_drift(bed, leapfrog->step);
    bed->die.punch_position += leapfrog->step * bed->die.punch_velocity;
    bed->die.top += leapfrog->step * bed->die.side_velocity;
    if (!gb_bed_evaluate_blocks(bed, leapfrog->step, deviation2, err)) {
        return false;
    }
    const double next = next_step(leapfrog, bed), half = 0.5 * (leapfrog->step + next);
    leapfrog->fastest = kick(leapfrog, bed, half);
    if (leapfrog->punch_mass > 0.0) {
        bed->die.punch_velocity +=
            half * (bed->tally.punch - leapfrog->load) / leapfrog->punch_mass;
    }
    leapfrog->step = next;
    return true;
}
