#include <glib.h>

#include "base/clock.h"
#include "run/experiment.h"
#include "study/bench/bench.h"

/* Densities that it is timed between. */
static const double from = 0.89, to = 0.91;

static bool planar_params(struct gb_params *params, struct gb_error *err)
{
    static const char *const assignment[] = {
        "scene.kind=dynamic",         "scene.dimension=2",
        "particles.count=1000",       "contact.mu=0.5",
        "loading.geometry=isotropic", "loading.until=density = 0.91",
        "loading.relax=0.5 ns",       "loading.hold=0 ns",
        "loading.rate=6.8e8 1/s",     "numerics.time_step=0.04 T",
    };
    gb_params_init(params);
    for (size_t i = 0; i < G_N_ELEMENTS(assignment); i++) {
        if (!gb_params_assign(params, assignment[i], err)) {
            return false;
        }
    }
    return true;
}

/* The points between the two densities, a part of them for each round. */
struct timing {
    double seconds[GB_BENCH_ROUNDS];
    int64_t steps[GB_BENCH_ROUNDS];
};

static int round_of(double density)
{
    const double part = (density - from) / (to - from);
    const int round = (int)(part * GB_BENCH_ROUNDS);
    return round < 0 ? 0 : round < GB_BENCH_ROUNDS ? round : GB_BENCH_ROUNDS - 1;
}

static double now(int threads)
{
    return threads == 1 ? gb_clock_process_s() : gb_clock_s();
}

static bool compress(struct gb_experiment *experiment, int threads, struct timing *timing,
                     struct gb_error *err)
{
    enum gb_step_outcome how = GB_STEP_MORE;
    while (how == GB_STEP_MORE || how == GB_STEP_POINT) {
        const struct gb_point *point = gb_experiment_point(experiment);
        const bool timed = point->branch == GB_BRANCH_LOAD && point->density >= from;
        const int round = round_of(point->density);
        const double start = now(threads);
        how = gb_experiment_advance(experiment, 1000, err);
        if (timed && how == GB_STEP_POINT) {
            timing->seconds[round] += now(threads) - start;
            timing->steps[round] += point->evaluations;
        }
    }
    return how == GB_STEP_DONE;
}

bool gb_bench_planar(int threads, struct gb_bench_figure *particle_steps_per_s,
                     struct gb_error *err)
{
    struct gb_params params;
    struct gb_experiment *experiment = NULL;
    struct timing timing = {0};
    double rate[GB_BENCH_ROUNDS];
    if (!planar_params(&params, err)) {
        return false;
    }
    params.threads = threads;
    const bool done = gb_experiment_create(&experiment, &params, NULL, NULL, err) &&
                      compress(experiment, threads, &timing, err);
    gb_experiment_destroy(experiment);
    for (int r = 0; r < GB_BENCH_ROUNDS; r++) {
        rate[r] = (double)(timing.steps[r] * params.count) / timing.seconds[r];
    }
    *particle_steps_per_s = gb_bench_figure_of(rate, GB_BENCH_ROUNDS);
    return done;
}
