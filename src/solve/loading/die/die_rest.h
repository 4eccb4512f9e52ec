#ifndef GB_SOLVE_LOADING_DIE_DIE_REST_H
#define GB_SOLVE_LOADING_DIE_DIE_REST_H

#include "solve/loading/die/die_state.h"

/* Whether the powder in a die is at rest.  Limits: GB_REST_... and GB_POURED_... of
 * scene/tolerances.h. */

/* Fails with GB_ERR_GUARD when the powder has moved for GB_REST_FALLS_MAX falls through the
 * die in a stage that ends at rest: its steps are unstable, say. */
bool gb_die_rest_check_time(const struct gb_die_stages *stages, const struct gb_bed *bed,
                            struct gb_error *err);

/* Translational kinetic energy (E d^3) and the limit of that of a small fall, resultant over
 * contact forces and its limit: powder at rest is below both, and its highest particle is
 * supported.  Rotation is left out: nothing damps the spin of a smooth sphere. */
struct gb_die_rest_state {
    double kinetic, kinetic_limit, unbalanced, unbalanced_limit;
};
struct gb_die_rest_state gb_die_rest_state(const struct gb_die_stages *stages,
                                           const struct gb_bed *bed);

/* Particles above the die. */
int64_t gb_die_rest_in_funnel(const struct gb_bed *bed);

/* Checks every GB_REST_CHECK_STEPS steps; true when the last GB_REST_CHECKS checks have
 * found the powder at rest. */
bool gb_die_rest_lasts(struct gb_die_stages *stages, const struct gb_bed *bed);

/* Checks that all particles at rest lie in the die.  Errors: GB_ERR_GUARD naming how many are
 * left in the funnel. */
bool gb_die_rest_check_funnel(const struct gb_bed *bed, struct gb_error *err);

#endif
