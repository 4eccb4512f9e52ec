#include "solve/loading/dynamic_step.h"

#include <math.h>
#include <stdio.h>

#include "law/critical_step.h"
#include "scene/tolerances.h"

/* The viscous force of a mode is xi = A omega / 2 of the critical damping. */
static double critical_step(const struct gb_dynamic *motion, double frequency)
{
    return gb_critical_step(frequency, 0.5 * motion->model->dynamics.viscous * frequency);
}

/* The given step, or a fraction of the critical one as soon as the given one exceeds it. */
static double bound_given(struct gb_dynamic *motion, double critical, char *text,
                          size_t size)
{
    const double step = fmin(motion->model->dynamics.time_step, motion->limit);
    if (step <= critical) {
        return step;
    }
    motion->limit = GB_STEP_CRITICAL_FRACTION * critical;
    snprintf(text, size,
             "guard: time step %.3g T above the critical %.3g T: %.3g T is taken", step,
             critical, motion->limit);
    return motion->limit;
}

/* Step at which velocity Verlet has the error unit (omega step)^2 that is allowed. */
static double accurate_step(const struct gb_dynamic *motion, double frequency,
                            double unit)
{
    const double share = sqrt(motion->model->dynamics.step_error / unit);
    return share / fmax(frequency, GB_FREQUENCY_MIN);
}

/* The step that strains the cell as much as the work of pressing allows. */
static double straining_step(const struct gb_dynamic *motion)
{
    return GB_STEP_STRAIN_MAX / motion->model->dynamics.rate;
}

/* The automatic step, of accuracy or of stability.  Strong damping bounds it more. */
static double pick_step(struct gb_dynamic *motion, double frequency, double critical,
                        char *text, size_t size)
{
    const bool loading = motion->stage == GB_DYNAMIC_LOAD;
    const double loaded = accurate_step(motion, frequency, GB_STEP_ERROR_UNIT);
    const double accurate =
        loading ? fmin(loaded, straining_step(motion))
                : accurate_step(motion, frequency, GB_STEP_ERROR_UNIT_FREE);
    const double stable = GB_STEP_CRITICAL_FRACTION * critical;
    if (stable < 0.5 * loaded && !motion->limit_reported) {
        motion->limit_reported = true;
        snprintf(
            text, size,
            "guard: contact.viscosity bounds the time step to %.3g T (accuracy alone: "
            "%.3g T)",
            stable, loaded);
    }
    const double crossing = GB_FREE_STEP_MAX * motion->model->diameter_min;
    return fmin(fmin(fmin(accurate, stable), crossing), motion->limit);
}

double gb_dynamic_step_allowed(struct gb_dynamic *motion, const struct gb_world *world,
                               char *text, size_t size)
{
    const double frequency = gb_verlet_frequency(world, motion->scratch);
    const double critical = critical_step(motion, frequency);
    return motion->model->dynamics.time_step > 0.0
               ? bound_given(motion, critical, text, size)
               : pick_step(motion, frequency, critical, text, size);
}
