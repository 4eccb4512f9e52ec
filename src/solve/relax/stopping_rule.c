#include "solve/relax/stopping_rule.h"

#include <math.h>

#include "base/alloc.h"
#include "greenbody/params.h"
#include "scene/normal_law.h"
#include "scene/tolerances.h"

bool gb_stopping_rule_init(struct gb_relax *relax, const struct gb_model *model,
                           struct gb_error *err)
{
    if (relax->scale != GB_TOLERANCE_DISPLACEMENT) {
        return true;
    }
    relax->sum = gb_alloc_array((size_t)model->count, sizeof *relax->sum, err);
    return relax->sum != NULL;
}

/* Residual in mean contact forces at which a relaxation is done.  Under light loads it is
 * relative to the attraction, which does not bound the error of the pressure. */
static double allowed(const struct gb_relax *relax, const struct gb_world *world)
{
    const struct gb_tally *tally = gb_world_tally(world);
    const double carried = tally->normal_sum / (fmax(1.0, (double)tally->contacts) *
                                                gb_world_model(world)->force_floor);
    const double share = GB_PREDICT_TOLERANCE_SLOPE * carried;
    return relax->tolerance * fmin(1.0, fmax(relax->method->light, share));
}

/* Displacement over d - r_eq. */
static double displacement(const struct gb_relax *relax, const struct gb_world *world)
{
    double force, torque;
    gb_world_largest(world, &force, &torque);
    const double rotation = 0.5 * torque / GB_RELAX_INERTIA;
    return fmax(force, rotation) / (relax->stiffness * gb_world_model(world)->h_eq);
}

/* At least that of one pair at r_eq: a packing may have no contact. */
static void renew_stiffness(struct gb_relax *relax, const struct gb_world *world)
{
    const struct gb_model *model = gb_world_model(world);
    relax->stiffness = fmax(gb_relax_steepest_stiffest(world, relax->sum),
                            gb_normal_law_stiffness(model, model->h_eq));
}

/* The stiffness is that of GB_STEEPEST_STIFFNESS_MOVES evaluations at most before, as in
 * (15), and that of this evaluation where the relaxation ends. */
static bool still(struct gb_relax *relax, const struct gb_world *world)
{
    const bool due = relax->evaluations % GB_STEEPEST_STIFFNESS_MOVES == 1;
    if (due) {
        renew_stiffness(relax, world);
    }
    relax->residual = displacement(relax, world);
    if (relax->residual <= relax->tolerance && !due) {
        renew_stiffness(relax, world);
        relax->residual = displacement(relax, world);
    }
    return relax->residual <= relax->tolerance;
}

bool gb_stopping_rule_met(struct gb_relax *relax, struct gb_world *world)
{
    relax->allowed = relax->tolerance;
    switch (relax->scale) {
    case GB_TOLERANCE_ATTRACTION:
        relax->residual = gb_world_imbalance(world) / gb_world_model(world)->adhesion;
        return relax->residual <= relax->tolerance;
    case GB_TOLERANCE_DISPLACEMENT:
        return still(relax, world);
    default:
        relax->residual = gb_world_residual(world);
        relax->allowed = allowed(relax, world);
        return relax->residual <= relax->allowed;
    }
}
