/* FIRE: damped dynamics, stopped whenever the power is negative.  Bitzek et al., PRL 97, 170201
 * (2006), with the half step back and the semi-implicit Euler of Guenole et al., Comput.
 * Mater. Sci. 175, 109584 (2020).
 *
 * Rotations count as lengths, angle * sqrt(inertia), so all six degrees of freedom of a
 * particle have the same mass.  This mass is its diameter, because the stiffness around a
 * particle grows with its diameter.  P1's sizes of sigma 0.25 and 0.55 take 1.4 and 1.6 times as
 * many evaluations with unit masses, 1.2 and 1.9 with squared diameters.  The mixing takes the
 * norms of unit masses. */
#include <math.h>
#include <string.h>

#include "base/team.h"
#include "base/vec.h"
#include "pack/f32/integrate_f32.h"
#include "pack/kernel/simd.h"
#include "scene/tolerances.h"
#include "solve/relax/relax_fire.h"

/* Growth of the step while the power is positive, f_inc of Bitzek et al. */
static const double grow = 1.1;

/* Longest step, in sqrt(m / (E d)).  The stiffest contacts of a dense packing (stiffness
 * 0.2, coordination 7) bound it near 1.4; larger steps are cut by the uphill rule and
 * gain nothing. */
const struct gb_relax_fire_tuning gb_relax_fire_plain = {
    .step_first = 0.6,
    .step_most = 1.3,
    .shrink = 0.5,
    .mixing_first = 0.2,
    .mixing_decay = 0.98,
    .delay = 8,
};
static const double inertia = GB_RELAX_INERTIA;

void gb_relax_fire_rest(struct gb_relax *relax, struct gb_relax_fire_state *fire,
                        const struct gb_relax_fire_tuning *tuning, struct gb_world *world)
{
    const size_t bytes = 3 * (size_t)gb_world_model(world)->count * sizeof(double);
    if (gb_integrate_f32_in_use(world)) {
        gb_integrate_f32_reset(world);
    } else {
        memset(relax->vector[0], 0, bytes);
        memset(relax->vector[1], 0, bytes);
    }
    *fire = (struct gb_relax_fire_state){.step = tuning->step_first,
                                         .mixing = tuning->mixing_first};
}

/* The arrays are worked through in this many spans, whatever the number of threads, and
 * summed in lanes that the compiler vectorises: the order of the sums is fixed. */
enum { SPANS = 64, LANES = 8 };

/* One pass over all particles, span by span. */
struct pass {
    struct gb_bodies b;
    double *v, *w;           /* velocities */
    double *rotation_sum;    /* sum of the rotation increments; NULL: not kept */
    double keep, kick, back; /* x -= back v, v = keep v + kick F ... */
    double step;             /* ... x += step v */
    double most2;            /* squared speed of the largest allowed displacement */
    const double *diameter;  /* NULL: all are 1 */
    double speed2[SPANS];    /* of v and, with their inertia, of w */
};

/* The first of the numbers (three a particle) of a span. */
static int64_t span_begin(const struct pass *pass, int64_t span)
{
    return 3 * (pass->b.count * span / SPANS);
}

/* Lengthens the step while the power is positive, else shortens it; returns the step
 * back, a time that multiplies the velocities.  Uphill right from a standstill the
 * step shrinks, too: one beyond sqrt(2)/omega would otherwise stay as it is and blow the
 * packing up. */
static double adapt(struct gb_relax_fire_state *fire,
                    const struct gb_relax_fire_tuning *tuning, double power)
{
    if (power > 0.0) {
        if (++fire->downhill > tuning->delay) {
            fire->step = fmin(fire->step * grow, tuning->step_most);
            fire->mixing *= tuning->mixing_decay;
        }
        return 0.0;
    }
    const double back = fire->downhill > 0 ? 0.5 * fire->step : 0.0;
    if (power < 0.0) {
        fire->step *= tuning->shrink;
    }
    fire->downhill = 0;
    fire->mixing = tuning->mixing_first;
    return back;
}

/* The four factors of a pass. */
struct update_factors {
    double keep, kick, back, step;
};

GB_SIMD_LOOP double update_one(double *restrict x, double *restrict v, double force,
                               struct update_factors by)
{
    const double before = *v, speed = by.keep * before + by.kick * force;
    *v = speed;
    *x += by.step * speed - by.back * before;
    return speed * speed;
}

/* Returns in speed2 the sum of the squares of v afterwards. */
GB_SIMD_LOOP void update_loop(double *restrict x, double *restrict v,
                              const double *restrict force, int64_t count,
                              struct update_factors by, double *restrict speed2)
{
    double lane[LANES] = {0};
    int64_t i = 0;
    for (; i + LANES <= count; i += LANES) {
        for (int l = 0; l < LANES; l++) {
            lane[l] += update_one(x + i + l, v + i + l, force[i + l], by);
        }
    }
    for (; i < count; i++) {
        lane[0] += update_one(x + i, v + i, force[i], by);
    }
    *speed2 = ((lane[0] + lane[1]) + (lane[2] + lane[3])) +
              ((lane[4] + lane[5]) + (lane[6] + lane[7]));
}
GB_SIMD_WIDTHS(update,
               (double *x, double *v, const double *force, int64_t count,
                struct update_factors by, double *speed2),
               (x, v, force, count, by, speed2))

/* Numbers of unequal particles whose forces are divided by their diameters at a time. */
enum { DIVIDED = 3 * 64 };

static void divide(const double *force, const double *diameter, int64_t count,
                   double *quotient)
{
    for (int64_t i = 0; i < count; i++) {
        quotient[i] = force[i] / diameter[i / 3];
    }
}

/* update with the diameters as masses; x, v and force of the numbers from begin on. */
static double update_sized(const struct pass *pass, double *x, double *v,
                           const double *force, int64_t begin, int64_t end,
                           struct update_factors by)
{
    double sum = 0.0;
    for (int64_t i = begin; i < end; i += DIVIDED) {
        const int64_t count = end - i < DIVIDED ? end - i : DIVIDED;
        double quotient[DIVIDED], part;
        divide(force + i, pass->diameter + i / 3, count, quotient);
        update(x + i, v + i, quotient, count, by, &part);
        sum += part;
    }
    return sum;
}

/* Moves x and v of the numbers begin .. end - 1; returns the sum of the squares of v. */
static double update_part(const struct pass *pass, double *x, double *v,
                          const double *force, int64_t begin, int64_t end,
                          struct update_factors by)
{
    double sum;
    if (pass->diameter) {
        return update_sized(pass, x, v, force, begin, end, by);
    }
    update(x + begin, v + begin, force + begin, end - begin, by, &sum);
    return sum;
}

/* Largest squared speed of `count` particles. */
GB_SIMD_LOOP void fastest_loop(const double *restrict v, int64_t count,
                               double *restrict most)
{
    double fastest = 0.0;
#pragma omp simd reduction(max : fastest)
    for (int64_t i = 0; i < count; i++) {
        const double x = v[3 * i], y = v[3 * i + 1], z = v[3 * i + 2];
        const double speed2 = x * x + y * y + z * z;
        fastest = speed2 > fastest ? speed2 : fastest;
    }
    *most = fastest;
}
GB_SIMD_WIDTHS(fastest, (const double *v, int64_t count, double *most), (v, count, most))

GB_SIMD_LOOP void add_up_loop(double *restrict sum, const double *restrict more,
                              int64_t count)
{
#pragma omp simd
    for (int64_t i = 0; i < count; i++) {
        sum[i] += more[i];
    }
}
GB_SIMD_WIDTHS(add_up, (double *sum, const double *more, int64_t count),
               (sum, more, count))

/* Scales velocity, angular velocity and displacement of the particles that moved farther
 * than allowed (few).  Returns the decrease of the sum of squared speeds. */
static double limit_displacement(const struct pass *pass, int64_t begin, int64_t end)
{
    double fall = 0.0;
    for (int64_t i = begin; i < end; i += 3) {
        double *v = pass->v + i, *w = pass->w + i;
        const double speed2 = gb_vec_dot(v, v);
        if (speed2 <= pass->most2) {
            continue;
        }
        const double factor = sqrt(pass->most2 / speed2);
        const double back = (1.0 - factor) * pass->step;
        fall += (1.0 - factor * factor) * (speed2 + inertia * gb_vec_dot(w, w));
        for (int c = 0; c < 3; c++) {
            pass->b.position[i + c] -= back * v[c];
            pass->b.rotation[i + c] -= back * w[c];
            v[c] *= factor;
            w[c] *= factor;
        }
    }
    return fall;
}

static void update_span(void *data, int64_t span)
{
    struct pass *pass = data;
    const int64_t begin = span_begin(pass, span), end = span_begin(pass, span + 1);
    const struct update_factors translation = {pass->keep, pass->kick, pass->back,
                                               pass->step};
    const struct update_factors rotation = {pass->keep, pass->kick / inertia, pass->back,
                                            pass->step};
    double most2;
    const double moving = update_part(pass, pass->b.position, pass->v, pass->b.force,
                                      begin, end, translation);
    fastest(pass->v + begin, (end - begin) / 3, &most2);
    const double rotating = update_part(pass, pass->b.rotation, pass->w, pass->b.torque,
                                        begin, end, rotation);
    pass->speed2[span] = moving + inertia * rotating;
    if (most2 > pass->most2) {
        pass->speed2[span] -= limit_displacement(pass, begin, end);
    }
    if (pass->rotation_sum) {
        add_up(pass->rotation_sum + begin, pass->b.rotation + begin, end - begin);
    }
}

/* The motion of a world in double precision; returns the sum of squared speeds. */
static double update_world(struct gb_relax *relax, struct gb_world *world,
                           const struct gb_integrate_f32 *by)
{
    const double bound = by->displacement_max / by->step;
    struct pass pass = {.b = gb_world_bodies(world),
                        .v = relax->vector[0],
                        .w = relax->vector[1],
                        .rotation_sum = relax->method->rotation_sum
                                            ? relax->vector[relax->method->rotation_sum]
                                            : NULL,
                        .keep = by->keep,
                        .kick = by->kick,
                        .back = by->back,
                        .step = by->step,
                        .most2 = bound * bound,
                        .diameter = gb_world_diameters(world)};
    gb_team_run(gb_world_team(world), SPANS, update_span, &pass);
    double speed2 = 0.0;
    for (int s = 0; s < SPANS; s++) {
        speed2 += pass.speed2[s];
    }
    return speed2;
}

void gb_relax_fire_move(struct gb_relax *relax, struct gb_relax_fire_state *fire,
                        const struct gb_relax_fire_tuning *tuning, struct gb_world *world)
{
    const struct gb_force_sums *sums = gb_world_sums(world);
    const double force2 = sums->force2 + sums->torque2 / inertia;
    struct gb_integrate_f32 by = {.inertia = inertia,
                                  .displacement_max = GB_FIRE_DISPLACEMENT_MAX};
    by.back = adapt(fire, tuning, sums->power);
    /* mixing needs the speed after the kick; the speed before differs by one step only
     * and saves a pass over the arrays */
    const bool rolling = fire->downhill > 0;
    const double steer =
        rolling && force2 > 0.0 ? fire->mixing * sqrt(fire->speed2 / force2) : 0.0;
    by.keep = rolling ? 1.0 - fire->mixing : 0.0;
    by.step = fire->step;
    by.kick = fire->step + steer;
    fire->speed2 = gb_integrate_f32_in_use(world)
                       ? gb_integrate_f32_step(world, &by, relax->rotation_sum)
                       : update_world(relax, world, &by);
}

static void start(struct gb_relax *relax, struct gb_world *world)
{
    gb_relax_fire_rest(relax, relax->state, &gb_relax_fire_plain, world);
}

static void move(struct gb_relax *relax, struct gb_world *world)
{
    gb_relax_fire_move(relax, relax->state, &gb_relax_fire_plain, world);
}

const struct gb_relaxer gb_relax_fire = {
    .name = "fire",
    .doc = "fast inertial relaxation of translations and rotations",
    .state_size = sizeof(struct gb_relax_fire_state),
    .vectors = 2,
    .moving = true,
    .light = 1.0,
    .start = start,
    .move = move,
};
