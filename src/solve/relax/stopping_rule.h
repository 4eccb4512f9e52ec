#ifndef GB_SOLVE_RELAX_STOPPING_RULE_H
#define GB_SOLVE_RELAX_STOPPING_RULE_H

#include "solve/relax/relax.h"

/* Where a relaxation ends, by numerics.tolerance_scale:
 *
 * contact       gb_world_residual, the rms force or torque over the mean contact force or
 *               f_a(d), whichever is larger; where contacts carry less than their
 *               attraction the tolerance falls (struct gb_relaxer, light)
 * attraction    rms force or torque over f_a(d)
 * displacement  largest displacement of P1 (15) over d - r_eq: that of the centre under
 *               the largest force, or of the surface under the largest torque, with the
 *               longest stable step k = 1/K of (15), K the stiffness around the most
 *               strongly held particle
 *
 * The last two are the same for every relaxer and load. */

/* Scratch of the rule.  relax->scale is given. */
bool gb_stopping_rule_init(struct gb_relax *relax, const struct gb_model *model,
                           struct gb_error *err);

/* Right after an evaluation: sets relax->residual, true at or below the tolerance. */
bool gb_stopping_rule_met(struct gb_relax *relax, struct gb_world *world);

#endif
