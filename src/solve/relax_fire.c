/* FIRE: inertia that is stopped whenever it runs uphill.  Bitzek et al., PRL 97, 170201
 * (2006), with the half step back and the semi-implicit Euler of Guenole et al., Comput.
 * Mater. Sci. 175, 109584 (2020).
 *
 * Rotations ride along as lengths: angle * sqrt(inertia), so that all six motions of a
 * particle have unit mass. */
#include <math.h>
#include <string.h>

#include "base/vec.h"
#include "solve/relax.h"

/* Longest step, in sqrt(m / (E d)).  The stiffest contacts of a dense packing (stiffness
 * 0.2, coordination 7) bound it near 1.4; larger steps are cut by the uphill rule and
 * gain nothing. */
static const double step_most = 1.3;
static const double step_first = 0.6;
static const double grow = 1.1, shrink = 0.5;
static const double mixing_first = 0.2, mixing_decay = 0.98;
enum { DELAY = 8 };
/* Rotational inertia in m d^2.  A sphere has 0.1; 0.4 brings the rotational frequencies
 * down to the translational ones. */
static const double inertia = 0.4;
/* No particle moves farther than this in one step (d): overlaps are a few per cent. */
static const double move_most = 0.01;

struct fire {
    double step, mixing;
    int downhill;
};

static void start(struct gb_relax *relax, struct gb_world *world)
{
    struct fire *fire = relax->state;
    const size_t bytes = 3 * (size_t)gb_world_bodies(world).count * sizeof(double);
    memset(relax->vector[0], 0, bytes);
    memset(relax->vector[1], 0, bytes);
    *fire = (struct fire){step_first, mixing_first, 0};
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

static void adapt(struct gb_relax *relax, const struct gb_bodies *b, double power)
{
    struct fire *fire = relax->state;
    if (power > 0.0) {
        if (++fire->downhill > DELAY) {
            fire->step = fmin(fire->step * grow, step_most);
            fire->mixing *= mixing_decay;
        }
        return;
    }
    if (fire->downhill > 0) {
        step_back(relax, b, 0.5 * fire->step);
        fire->step *= shrink;
    }
    fire->downhill = 0;
    fire->mixing = mixing_first;
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

static void move(struct gb_relax *relax, struct gb_world *world)
{
    const struct fire *fire = relax->state;
    const struct gb_bodies b = gb_world_bodies(world);
    double *v = relax->vector[0], *w = relax->vector[1];
    const struct sums sums = sum_up(relax, &b);
    adapt(relax, &b, sums.power);
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

const struct gb_relaxer gb_relax_fire = {
    .name = "fire",
    .doc = "fast inertial relaxation of translations and rotations",
    .state_size = sizeof(struct fire),
    .vectors = 2,
    .start = start,
    .move = move,
};
