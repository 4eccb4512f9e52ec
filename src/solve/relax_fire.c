/* FIRE: inertia that is stopped whenever it runs uphill.  Bitzek et al., PRL 97, 170201
 * (2006), with the half step back and the semi-implicit Euler of Guenole et al., Comput.
 * Mater. Sci. 175, 109584 (2020).
 *
 * Rotations ride along as lengths: angle * sqrt(inertia), so that all six motions of a
 * particle have unit mass. */
#include <math.h>
#include <string.h>

#include "base/vec.h"
#include "solve/relax_fire.h"

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
/* No particle moves farther than this in one step (d): overlaps are a few per cent. */
static const double move_most = 0.01;

void gb_relax_fire_rest(struct gb_relax *relax, struct gb_relax_fire_state *fire,
                        const struct gb_relax_fire_tuning *tuning,
                        const struct gb_world *world)
{
    const size_t bytes = 3 * (size_t)gb_world_model(world)->count * sizeof(double);
    memset(relax->vector[0], 0, bytes);
    memset(relax->vector[1], 0, bytes);
    *fire = (struct gb_relax_fire_state){tuning->step_first, tuning->mixing_first, 0};
}

struct sums {
    double power, speed2, force2;
};

/* Sums over all six motions, in a fixed order. */
static struct sums sum_up(const struct gb_relax *relax, const struct gb_bodies *b)
{
    const double *v = relax->vector[0], *w = relax->vector[1];
    struct sums t = {0}, r = {0};
    for (int64_t i = 0; i < 3 * b->count; i++) {
        t.power += b->force[i] * v[i];
        t.speed2 += v[i] * v[i];
        t.force2 += b->force[i] * b->force[i];
        r.power += b->torque[i] * w[i];
        r.speed2 += w[i] * w[i];
        r.force2 += b->torque[i] * b->torque[i];
    }
    return (struct sums){t.power + r.power, t.speed2 + inertia * r.speed2,
                         t.force2 + r.force2 / inertia};
}

static void step_back(const struct gb_relax *relax, const struct gb_bodies *b,
                      double half)
{
    const double *v = relax->vector[0], *w = relax->vector[1];
    for (int64_t i = 0; i < 3 * b->count; i++) {
        b->position[i] -= half * v[i];
        b->turn[i] -= half * w[i];
    }
}

static void adapt(struct gb_relax *relax, struct gb_relax_fire_state *fire,
                  const struct gb_relax_fire_tuning *tuning, const struct gb_bodies *b,
                  double power)
{
    if (power > 0.0) {
        if (++fire->downhill > tuning->delay) {
            fire->step = fmin(fire->step * grow, tuning->step_most);
            fire->mixing *= tuning->mixing_decay;
        }
        return;
    }
    if (fire->downhill > 0) {
        step_back(relax, b, 0.5 * fire->step);
    }
    /* also uphill right from a standstill: a step beyond sqrt(2)/omega would otherwise
     * stay as it is and blow the packing up */
    if (power < 0.0) {
        fire->step *= tuning->shrink;
    }
    fire->downhill = 0;
    fire->mixing = tuning->mixing_first;
    const size_t bytes = 3 * (size_t)b->count * sizeof(double);
    memset(relax->vector[0], 0, bytes);
    memset(relax->vector[1], 0, bytes);
}

static double speed_most(const double *v, int64_t count)
{
    double most = 0.0;
    for (int64_t i = 0; i < count; i++) {
        most = fmax(most, gb_vec_dot(v + 3 * i, v + 3 * i));
    }
    return sqrt(most);
}

void gb_relax_fire_move(struct gb_relax *relax, struct gb_relax_fire_state *fire,
                        const struct gb_relax_fire_tuning *tuning, struct gb_world *world)
{
    const struct gb_bodies b = gb_world_bodies(world);
    double *v = relax->vector[0], *w = relax->vector[1];
    const struct sums sums = sum_up(relax, &b);
    adapt(relax, fire, tuning, &b, sums.power);
    const double step = fire->step;
    /* mixing needs the speed after the kick; the speed before differs by one step only
     * and saves a pass over the arrays */
    const bool rolling = fire->downhill > 0;
    const double keep = rolling ? 1.0 - fire->mixing : 1.0;
    const double steer = rolling && sums.force2 > 0.0
                             ? fire->mixing * sqrt(sums.speed2 / sums.force2)
                             : 0.0;
    const double kick = step + steer;
    for (int64_t i = 0; i < 3 * b.count; i++) {
        v[i] = keep * v[i] + kick * b.force[i];
        w[i] = keep * w[i] + kick / inertia * b.torque[i];
    }
    const double farthest = step * speed_most(v, b.count);
    const double scale = farthest > move_most ? move_most / farthest : 1.0;
    for (int64_t i = 0; i < 3 * b.count; i++) {
        v[i] *= scale;
        w[i] *= scale;
        b.position[i] += step * v[i];
        b.turn[i] += step * w[i];
    }
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
    .start = start,
    .move = move,
};
