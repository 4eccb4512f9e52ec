#include "solve/leapfrog.h"

#include <math.h>
#include <string.h>

#include "base/portable.h"
#include "law/critical_step.h"
#include "scene/tolerances.h"

void gb_leapfrog_init(struct gb_leapfrog *leapfrog, double safety, double given)
{
    *leapfrog = (struct gb_leapfrog){.safety = safety, .given = given, .limit = INFINITY};
}

double gb_leapfrog_critical(const struct gb_bed *bed)
{
    const double stiffest = bed->tally.stiffest;
    const bool friction = bed->law.mu > 0.0 || bed->law.mu_wall > 0.0;
    /* k_t (1/m + R^2/I) */
    const double rotational =
        friction ? bed->law.shear * (1.0 + 2.5 / bed->inertia_scale) : 0.0;
    return fmin(gb_critical_step(sqrt(stiffest), bed->law.damping),
                gb_critical_step(sqrt(rotational * stiffest), 0.0));
}

/* T = 2.868 (m^2/(R E*^2 v))^(1/5); a spring of that half period has the critical step 2
 * T/pi. */
double gb_leapfrog_impact(const struct gb_bed *bed, double speed)
{
    const double d = 2.0 * bed->smallest, modulus = bed->law.normal.hertz.modulus;
    const double mass = d * d * d, xi = bed->law.damping;
    if (!(speed > 0.0)) {
        return INFINITY;
    }
    const double duration =
        2.868 *
        gb_portable_pow(mass * mass / (bed->smallest * modulus * modulus * speed), 0.2);
    return M_2_PI * duration * gb_critical_step_share(xi);
}

static double next_step(const struct gb_leapfrog *leapfrog, const struct gb_bed *bed)
{
    if (leapfrog->given > 0.0) {
        return fmin(leapfrog->given, leapfrog->limit);
    }
    /* a particle at rest may fall by its size before it meets another */
    const double fast =
        fmax(leapfrog->fastest, sqrt(2.0 * leapfrog->gravity * bed->smallest));
    const double allowed =
        leapfrog->safety * fmin(gb_leapfrog_critical(bed), gb_leapfrog_impact(bed, fast));
    const double most =
        leapfrog->step > 0.0 ? GB_STEP_GROWTH_MAX * leapfrog->step : GB_FREE_STEP_MAX;
    return fmin(fmin(allowed, most), leapfrog->limit);
}

/* Largest components of the displacements since the lists were made, squared and added: a
 * bound that needs no square of every particle. */
static double drift(struct gb_bed *bed, double step)
{
    double most[4] = {0.0};
    for (int64_t i = 0; i < bed->count; i++) {
        double *x = bed->position[i];
        const double *v = bed->velocity[i], *from = bed->listed_position[i];
        for (int c = 0; c < 4; c++) {
            x[c] += step * v[c];
            const double moved = fabs(x[c] - from[c]);
            most[c] = moved > most[c] ? moved : most[c];
        }
    }
    return most[0] * most[0] + most[1] * most[1] + most[2] * most[2];
}

/* Returns the bound of the fastest particle. */
static double kick(struct gb_bed *bed, double step, double gravity, double drag)
{
    const double fall[4] = {0.0, 0.0, -gravity * step, 0.0};
    const double slow = fmax(1.0 - step * drag, 0.0);
    double most[4] = {0.0};
    for (int64_t i = 0; i < bed->count; i++) {
        double *v = bed->velocity[i], *w = bed->spin[i];
        const double *f = bed->force[i], *m = bed->torque[i];
        const double speed_factor = step * bed->inverse_mass[i],
                     spin_factor = step * bed->inverse_inertia[i];
        for (int c = 0; c < 4; c++) {
            v[c] = slow * v[c] + (speed_factor * f[c] + fall[c]);
            w[c] = slow * w[c] + spin_factor * m[c];
            const double fast = fabs(v[c]);
            most[c] = fast > most[c] ? fast : most[c];
        }
    }
    return sqrt(most[0] * most[0] + most[1] * most[1] + most[2] * most[2]);
}

bool gb_leapfrog_step(struct gb_leapfrog *leapfrog, struct gb_bed *bed,
                      struct gb_error *err)
{
    if (!(leapfrog->step > 0.0)) { /* the first: forces are not known yet */
        if (!gb_bed_evaluate(bed, 0.0, 0.0, err)) {
            return false;
        }
        leapfrog->step = next_step(leapfrog, bed);
    }
    leapfrog->moved2 = drift(bed, leapfrog->step);
    bed->die.punch_position += leapfrog->step * bed->die.punch_velocity;
    bed->die.top += leapfrog->step * bed->die.side_velocity;
    if (!gb_bed_evaluate(bed, leapfrog->step, leapfrog->moved2, err)) {
        return false;
    }
    const double next = next_step(leapfrog, bed), half = 0.5 * (leapfrog->step + next);
    leapfrog->fastest = kick(bed, half, leapfrog->gravity, leapfrog->drag);
    if (leapfrog->punch_mass > 0.0) {
        bed->die.punch_velocity +=
            half * (bed->tally.punch - leapfrog->load) / leapfrog->punch_mass;
    }
    leapfrog->step = next;
    return true;
}
