/* FIRE: inertia that is stopped whenever it runs uphill.  Bitzek et al., PRL 97, 170201
 * (2006), with the half step back and the semi-implicit Euler of Guenole et al., Comput.
 * Mater. Sci. 175, 109584 (2020).
 *
 * Rotations ride along as lengths: angle * sqrt(inertia), so that all six motions of a
 * particle have unit mass. */
#include <math.h>
#include <string.h>

#include "base/vec.h"
#include "pack/simd.h"
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

/* The arrays are worked through in this many spans, whatever the number of threads, and
 * summed in lanes that the compiler vectorises: the order of the sums is fixed. */
enum { SPANS = 64, LANES = 8 };

struct sums {
    double power, speed2, force2;
};

/* One pass over all particles, span by span. */
struct pass {
    struct gb_bodies b;
    double *v, *w;     /* velocities */
    double keep, kick; /* v = keep v + kick F */
    double step;       /* x += step v */
    double scale;      /* what is kept of a step that goes too far */
    struct sums sums[SPANS];
    double speed2_most[SPANS];
};

/* The first of the numbers (three a particle) of a span. */
static int64_t span_begin(const struct pass *pass, int span)
{
    return 3 * (pass->b.count * span / SPANS);
}

/* All spans, by the threads of the team that calls it; without one, by the caller. */
static void work_spans(struct pass *pass, void (*work)(struct pass *pass, int span))
{
#pragma omp for schedule(static)
    for (int s = 0; s < SPANS; s++) {
        work(pass, s);
    }
}

static void over_spans(struct pass *pass, int threads,
                       void (*work)(struct pass *pass, int span))
{
    if (threads > 1) {
#pragma omp parallel num_threads(threads)
        work_spans(pass, work);
    } else { /* a team of one would wait for itself */
        work_spans(pass, work);
    }
}

static double lane_sum(const double lane[LANES])
{
    return ((lane[0] + lane[1]) + (lane[2] + lane[3])) +
           ((lane[4] + lane[5]) + (lane[6] + lane[7]));
}

GB_SIMD_LOOP void sum_up_loop(const double *restrict force, const double *restrict v,
                              int64_t count, struct sums *sums)
{
    double power[LANES] = {0}, speed2[LANES] = {0}, force2[LANES] = {0};
    int64_t i = 0;
    for (; i + LANES <= count; i += LANES) {
        for (int l = 0; l < LANES; l++) {
            power[l] += force[i + l] * v[i + l];
            speed2[l] += v[i + l] * v[i + l];
            force2[l] += force[i + l] * force[i + l];
        }
    }
    for (; i < count; i++) {
        power[0] += force[i] * v[i];
        speed2[0] += v[i] * v[i];
        force2[0] += force[i] * force[i];
    }
    *sums = (struct sums){lane_sum(power), lane_sum(speed2), lane_sum(force2)};
}
GB_SIMD_WIDTHS(sum_up,
               (const double *force, const double *v, int64_t count, struct sums *sums),
               (force, v, count, sums))

static void sum_span(struct pass *pass, int span)
{
    const int64_t begin = span_begin(pass, span), end = span_begin(pass, span + 1);
    struct sums t, r;
    sum_up(pass->b.force + begin, pass->v + begin, end - begin, &t);
    sum_up(pass->b.torque + begin, pass->w + begin, end - begin, &r);
    pass->sums[span] = (struct sums){t.power + r.power, t.speed2 + inertia * r.speed2,
                                     t.force2 + r.force2 / inertia};
}

/* Sums over all six motions. */
static struct sums sum_all(struct pass *pass, int threads)
{
    struct sums sums = {0};
    over_spans(pass, threads, sum_span);
    for (int s = 0; s < SPANS; s++) {
        sums.power += pass->sums[s].power;
        sums.speed2 += pass->sums[s].speed2;
        sums.force2 += pass->sums[s].force2;
    }
    return sums;
}

static void step_back(const struct pass *pass, double half)
{
    for (int64_t i = 0; i < 3 * pass->b.count; i++) {
        pass->b.position[i] -= half * pass->v[i];
        pass->b.turn[i] -= half * pass->w[i];
    }
}

static void adapt(struct pass *pass, struct gb_relax_fire_state *fire,
                  const struct gb_relax_fire_tuning *tuning, double power)
{
    if (power > 0.0) {
        if (++fire->downhill > tuning->delay) {
            fire->step = fmin(fire->step * grow, tuning->step_most);
            fire->mixing *= tuning->mixing_decay;
        }
        return;
    }
    if (fire->downhill > 0) {
        step_back(pass, 0.5 * fire->step);
    }
    /* also uphill right from a standstill: a step beyond sqrt(2)/omega would otherwise
     * stay as it is and blow the packing up */
    if (power < 0.0) {
        fire->step *= tuning->shrink;
    }
    fire->downhill = 0;
    fire->mixing = tuning->mixing_first;
    const size_t bytes = 3 * (size_t)pass->b.count * sizeof(double);
    memset(pass->v, 0, bytes);
    memset(pass->w, 0, bytes);
}

/* v = keep v + kick F, x += step v. */
GB_SIMD_LOOP void drive_loop(double *restrict x, double *restrict v,
                             const double *restrict force, int64_t count, double keep,
                             double kick, double step)
{
#pragma omp simd
    for (int64_t i = 0; i < count; i++) {
        const double speed = keep * v[i] + kick * force[i];
        v[i] = speed;
        x[i] += step * speed;
    }
}
GB_SIMD_WIDTHS(drive,
               (double *x, double *v, const double *force, int64_t count, double keep,
                double kick, double step),
               (x, v, force, count, keep, kick, step))

static void drive_span(struct pass *pass, int span)
{
    const int64_t begin = span_begin(pass, span), end = span_begin(pass, span + 1);
    drive(pass->b.position + begin, pass->v + begin, pass->b.force + begin, end - begin,
          pass->keep, pass->kick, pass->step);
    drive(pass->b.turn + begin, pass->w + begin, pass->b.torque + begin, end - begin,
          pass->keep, pass->kick / inertia, pass->step);
    double most = 0.0;
    for (int64_t i = begin; i < end; i += 3) {
        const double speed2 = gb_vec_dot(pass->v + i, pass->v + i);
        most = speed2 > most ? speed2 : most;
    }
    pass->speed2_most[span] = most;
}

/* Takes back what was too far: seldom. */
static void slow_span(struct pass *pass, int span)
{
    const int64_t begin = span_begin(pass, span), end = span_begin(pass, span + 1);
    const double scale = pass->scale, back = (1.0 - scale) * pass->step;
    for (int64_t i = begin; i < end; i++) {
        pass->b.position[i] -= back * pass->v[i];
        pass->b.turn[i] -= back * pass->w[i];
        pass->v[i] *= scale;
        pass->w[i] *= scale;
    }
}

static double speed_most(const struct pass *pass)
{
    double most = 0.0;
    for (int s = 0; s < SPANS; s++) {
        most = fmax(most, pass->speed2_most[s]);
    }
    return sqrt(most);
}

void gb_relax_fire_move(struct gb_relax *relax, struct gb_relax_fire_state *fire,
                        const struct gb_relax_fire_tuning *tuning, struct gb_world *world)
{
    const int threads = gb_world_threads(world);
    struct pass pass = {
        .b = gb_world_bodies(world), .v = relax->vector[0], .w = relax->vector[1]};
    const struct sums sums = sum_all(&pass, threads);
    adapt(&pass, fire, tuning, sums.power);
    /* mixing needs the speed after the kick; the speed before differs by one step only
     * and saves a pass over the arrays */
    const bool rolling = fire->downhill > 0;
    const double steer = rolling && sums.force2 > 0.0
                             ? fire->mixing * sqrt(sums.speed2 / sums.force2)
                             : 0.0;
    pass.keep = rolling ? 1.0 - fire->mixing : 1.0;
    pass.step = fire->step;
    pass.kick = fire->step + steer;
    over_spans(&pass, threads, drive_span);
    const double farthest = pass.step * speed_most(&pass);
    if (farthest > move_most) {
        pass.scale = move_most / farthest;
        over_spans(&pass, threads, slow_span);
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
    .light = 1.0,
    .start = start,
    .move = move,
};
