/* Times the planar scene of P2 (1000 discs, set II with mu = 0.5) between densities 0.89 and
 * 0.91, at the paper's step of 0.04 T and the rate v1, on one core and on all of them.
 * Usage: time_discs [group.key=value]... */
#include <glib.h>

#include "bench.h"
#include "run/experiment.h"

/* Densities that it is timed between. */
static const double from = 0.89, to = 0.91;

static bool make_discs(struct gb_params *params, char **assignment, struct gb_error *err)
{
    static const char *const scene[] = {
        "scene.kind=dynamic",         "scene.dimension=2",
        "particles.count=1000",       "contact.mu=0.5",
        "loading.geometry=isotropic", "loading.until=density = 0.91",
        "loading.relax=0.5 ns",       "loading.hold=0 ns",
        "loading.rate=6.8e8 1/s",     "numerics.time_step=0.04 T",
    };
    gb_params_init(params);
    for (size_t i = 0; i < G_N_ELEMENTS(scene); i++) {
        if (!gb_params_assign(params, scene[i], err)) {
            return false;
        }
    }
    for (; *assignment; assignment++) {
        if (!gb_params_assign(params, *assignment, err)) {
            return false;
        }
    }
    return gb_params_check(params, err);
}

/* Particle-steps per second of the points in each fifth of the densities. */
static bool compress(struct gb_experiment *experiment, const struct gb_params *params,
                     double rate[ROUNDS], struct gb_error *err)
{
    double seconds[ROUNDS] = {0};
    double steps[ROUNDS] = {0};
    enum gb_step_outcome how = GB_STEP_MORE;
    while (how == GB_STEP_MORE || how == GB_STEP_POINT) {
        const struct gb_point *point = gb_experiment_point(experiment);
        const bool timed = point->branch == GB_BRANCH_LOAD && point->density >= from;
        const int round =
            CLAMP((int)((point->density - from) / (to - from) * ROUNDS), 0, ROUNDS - 1);
        const double start = now_s((int)params->threads);
        how = gb_experiment_advance(experiment, 1000, err);
        if (timed && how == GB_STEP_POINT) {
            seconds[round] += now_s((int)params->threads) - start;
            steps[round] += (double)point->evaluations;
        }
    }
    for (int r = 0; r < ROUNDS; r++) {
        rate[r] = steps[r] * (double)params->count / seconds[r];
    }
    return how == GB_STEP_DONE;
}

static bool time_on(int threads, struct gb_params *params, const char *name,
                    struct gb_error *err)
{
    struct gb_experiment *experiment = NULL;
    double rate[ROUNDS];
    params->threads = threads;
    const bool good = gb_experiment_create(&experiment, params, NULL, NULL, err) &&
                      compress(experiment, params, rate, err);
    gb_experiment_destroy(experiment);
    if (good) {
        print_figure(name, figure_of(rate), 1e-6, "million particle-steps per s");
    }
    return good;
}

int main(int argc, char **argv)
{
    const int cores = (int)g_get_num_processors();
    struct gb_error err = {0};
    struct gb_params params;
    (void)argc;
    g_set_prgname("time_discs");
    return finish(make_discs(&params, argv + 1, &err) &&
                      time_on(1, &params, "discs on one core", &err) &&
                      (cores < 2 || time_on(cores, &params, "discs on all cores", &err)),
                  &err);
}
