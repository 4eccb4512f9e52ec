#include "solve/loading/path/leg_step.h"

#include <math.h>
#include <string.h>

#include "scene/tolerances.h"
#include "solve/loading/path/leg_goal.h"
#include "solve/loading/path/leg_held.h"

enum { N = GB_PATH_COMPONENTS };

double gb_leg_step_largest(const double strain[N])
{
    double most = 0.0;
    for (int k = 0; k < N; k++) {
        most = fmax(most, fabs(strain[k]));
    }
    return most;
}

/* Strains of one step in which the leading component advances by `lead`; the affine
 * tangent takes over where the learned one gives no sensible answer. */
void gb_leg_step_solve(struct gb_leg_run *run, const struct gb_model *model, double lead,
                       double share, double strain[N])
{
    const struct gb_leg *leg = gb_leg_held_leg(run, model);
    const struct gb_strain_tangent *tangents[] = {&run->tangent, &run->affine};
    struct gb_stress_condition condition[N];
    const int count = gb_leg_held_conditions(run, model, run->stress, share, condition);
    const double limit = GB_PATH_STRAIN_RATIO_MAX * run->step;
    for (int t = 0; t < 2; t++) {
        for (int k = 0; k < N; k++) {
            strain[k] = leg->component[k].control == GB_LEG_STRAIN
                            ? lead * leg->component[k].value
                            : 0.0;
        }
        if (gb_strain_tangent_solve(tangents[t], condition, count, strain) &&
            gb_leg_step_largest(strain) <= limit) {
            return;
        }
    }
    const double most = gb_leg_step_largest(strain);
    for (int k = 0; k < N && most > limit; k++) {
        strain[k] *= limit / most;
    }
}

/* Held stresses on the way to their values: as far as a step of strain leads. */
void gb_leg_step_approach(struct gb_leg_run *run, const struct gb_model *model)
{
    double strain[N];
    gb_leg_step_solve(run, model, 0.0, 1.0, strain);
    const double most = gb_leg_step_largest(strain);
    run->last_approach = most <= run->step;
    if (!run->last_approach) {
        gb_leg_step_solve(run, model, 0.0, run->step / most, strain);
    }
    memcpy(run->increment, strain, sizeof strain);
}

/* Held stresses are where they should be; those on the way need not be. */
static bool all_held(const struct gb_leg_run *run, const struct gb_model *model,
                     const double stress[N])
{
    return (run->approaching && !run->last_approach) ||
           gb_leg_held_distance(run, model, stress) <= 1.0;
}

/* The tangent of small strains learns from the last correction. */
static void learn_small(struct gb_leg_run *run, const double stress[N])
{
    double change[N];
    if (run->corrections == 0 ||
        gb_leg_step_largest(run->corrected) < GB_PATH_LEARN_STRAIN_MIN) {
        return;
    }
    for (int k = 0; k < N; k++) {
        change[k] = stress[k] - run->before[k];
    }
    gb_strain_tangent_learn(&run->small, run->corrected, change);
}

/* Strain that brings the held stresses to their values; false: none in sight. */
static bool find_correction(struct gb_leg_run *run, const struct gb_model *model,
                            const double stress[N], double correction[N])
{
    struct gb_stress_condition condition[N];
    const int count = gb_leg_held_conditions(run, model, stress, 1.0, condition);
    for (int attempt = 0; attempt < 2; attempt++) {
        memset(correction, 0, N * sizeof *correction);
        if (gb_strain_tangent_solve(&run->small, condition, count, correction) &&
            gb_leg_step_largest(correction) <=
                fmax(run->step_most, GB_PATH_CORRECTION_STRAIN)) {
            return true;
        }
        run->small = run->affine;
    }
    return false;
}

enum gb_leg_step_outcome gb_leg_step_check(struct gb_leg_run *run,
                                           const struct gb_model *model,
                                           const double stress[N], double correction[N])
{
    if (run->leg >= model->path.count || run->begun == 0) {
        return GB_LEG_STEP_HELD;
    }
    if (all_held(run, model, stress)) {
        return gb_leg_goal_beyond(run, model, stress) ? GB_LEG_STEP_BEYOND
                                                      : GB_LEG_STEP_HELD;
    }
    learn_small(run, stress);
    if (run->corrections++ >= GB_PATH_CORRECTIONS_MAX ||
        !find_correction(run, model, stress, correction)) {
        return GB_LEG_STEP_MISSED;
    }
    for (int k = 0; k < N; k++) {
        run->increment[k] += correction[k];
        run->corrected[k] = correction[k];
        run->before[k] = stress[k];
    }
    return GB_LEG_STEP_CORRECT;
}

void gb_leg_step_shorten(struct gb_leg_run *run, const struct gb_model *model)
{
    const int leading = gb_leg_held_leg(run, model)->leading;
    const double share = fmax(run->shorter, GB_UNLOADING_SHARE_MIN);
    run->shortened++;
    run->corrections = 0;
    gb_leg_step_solve(run, model, share * run->increment[leading], 1.0, run->increment);
}

/* Without its corrections the halved step is found anew. */
void gb_leg_step_halve(struct gb_leg_run *run, const struct gb_model *model)
{
    const struct gb_leg *leg = gb_leg_held_leg(run, model);
    double lead = leg->leading >= 0 ? 0.5 * run->increment[leg->leading] : 0.0;
    run->step *= 0.5;
    run->corrections = 0;
    run->small = run->affine;
    if (run->approaching) {
        gb_leg_step_approach(run, model);
    } else {
        gb_leg_step_solve(run, model, lead, 1.0, run->increment);
    }
}
