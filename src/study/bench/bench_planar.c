#include <glib.h>

#include "base/clock.h"
#include "run/experiment.h"
#include "study/bench/bench.h"

static bool planar_params(struct gb_params *params, struct gb_error *err)
{
    static const char *const assignment[] = {
        "scene.kind=dynamic",         "scene.dimension=2",
        "particles.count=1000",       "contact.mu=0.5",
        "loading.geometry=isotropic", "loading.until=density = 0.91",
        "loading.relax=0.5 ns",       "loading.hold=0 ns",
        "loading.rate=6.8e8 1/s",     "numerics.time_step=0.04 T",
        "numerics.threads=1",
    };
    gb_params_init(params);
    for (size_t i = 0; i < G_N_ELEMENTS(assignment); i++) {
        if (!gb_params_assign(params, assignment[i], err)) {
            return false;
        }
    }
    return true;
}

bool gb_bench_planar(double *particle_steps_per_s, struct gb_error *err)
{
    const double from = 0.89;
    struct gb_params params;
    struct gb_experiment *experiment = NULL;
    if (!planar_params(&params, err) ||
        !gb_experiment_create(&experiment, &params, NULL, NULL, err)) {
        return false;
    }
    double seconds = 0.0;
    int64_t steps = 0;
    enum gb_step_outcome how = GB_STEP_MORE;
    while (how == GB_STEP_MORE || how == GB_STEP_POINT) {
        const struct gb_point *point = gb_experiment_point(experiment);
        const bool timed = point->branch == GB_BRANCH_LOAD && point->density >= from;
        const double start = gb_clock_process_s();
        how = gb_experiment_advance(experiment, 1000, err);
        if (timed && how == GB_STEP_POINT) {
            seconds += gb_clock_process_s() - start;
            steps += point->evaluations;
        }
    }
    gb_experiment_destroy(experiment);
    *particle_steps_per_s = (double)(steps * params.count) / seconds;
    return how == GB_STEP_DONE;
}
