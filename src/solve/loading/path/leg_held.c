#include "solve/loading/path/leg_held.h"

#include <math.h>
#include <stdio.h>

#include "scene/tolerances.h"

enum { N = GB_PATH_COMPONENTS };

const struct gb_leg *gb_leg_held_leg(const struct gb_leg_run *run,
                                     const struct gb_model *model)
{
    return &model->path.leg[run->leg];
}

/* The stress of this component is held. */
bool gb_leg_held_component(const struct gb_leg_run *run, const struct gb_model *model,
                           int k)
{
    return gb_path_has_component(model->dimension, k) &&
           gb_leg_held_leg(run, model)->component[k].control != GB_LEG_STRAIN &&
           (run->released >> k & 1) == 0;
}

/* What a held stress should be, beside the present stresses. */
double gb_leg_held_wanted(const struct gb_leg_run *run, const struct gb_leg *leg, int k,
                          const double stress[N])
{
    const struct gb_leg_component *component = &leg->component[k];
    switch (component->control) {
    case GB_LEG_RATIO:
        return run->target[k] * stress[component->of];
    case GB_LEG_FOLLOW:
        return run->start[k] +
               run->target[k] * (stress[component->of] - run->start[component->of]);
    default:
        return run->target[k];
    }
}

static double tolerance(const struct gb_leg_run *run, double want)
{
    return fmax(GB_PATH_STRESS_SHARE * fabs(want), GB_PATH_STRESS_SCALE * run->largest);
}

void gb_leg_held_note_largest(struct gb_leg_run *run, const double stress[N])
{
    for (int k = 0; k < N; k++) {
        run->largest = fmax(run->largest, fabs(stress[k]));
    }
}

/* Largest difference of a held stress from what it should be, over its tolerance. */
double gb_leg_held_distance(const struct gb_leg_run *run, const struct gb_model *model,
                            const double stress[N])
{
    const struct gb_leg *leg = gb_leg_held_leg(run, model);
    double most = 0.0;
    for (int k = 0; k < N; k++) {
        if (gb_leg_held_component(run, model, k)) {
            const double want = gb_leg_held_wanted(run, leg, k, stress);
            most = fmax(most, fabs(want - stress[k]) / tolerance(run, want));
        }
    }
    return most;
}

/* Conditions on the held stresses: from these stresses a share of the way to the wanted
 * ones. */
int gb_leg_held_conditions(const struct gb_leg_run *run, const struct gb_model *model,
                           const double stress[N], double share,
                           struct gb_stress_condition condition[N])
{
    const struct gb_leg *leg = gb_leg_held_leg(run, model);
    int count = 0;
    for (int k = 0; k < N; k++) {
        if (gb_leg_held_component(run, model, k)) {
            const bool ratio = leg->component[k].control != GB_LEG_STRESS;
            condition[count++] = (struct gb_stress_condition){
                .of = k,
                .base = ratio ? leg->component[k].of : k,
                .share = ratio ? run->target[k] : 0.0,
                .change = share * (gb_leg_held_wanted(run, leg, k, stress) - stress[k]),
            };
        }
    }
    return count;
}

char *gb_leg_held_missed(const struct gb_leg_run *run, const struct gb_model *model,
                         char *buffer, size_t size)
{
    const struct gb_leg *leg = gb_leg_held_leg(run, model);
    const double mpa = 1e-6 * model->pascal_per_stress;
    size_t used = (size_t)snprintf(buffer, size, "leg %d (%s): no equilibrium with",
                                   run->leg + 1, leg->text);
    for (int k = 0; k < N && used < size; k++) {
        if (gb_leg_held_component(run, model, k)) {
            used += (size_t)snprintf(buffer + used, size - used, " %s = %.4g MPa",
                                     gb_path_component_name(k),
                                     mpa * gb_leg_held_wanted(run, leg, k, run->stress));
        }
    }
    if (used < size && leg->leading >= 0) {
        snprintf(buffer + used, size - used, " beyond a strain of %.3g %%: collapse",
                 100.0 * run->strain[leg->leading]);
    }
    return buffer;
}
