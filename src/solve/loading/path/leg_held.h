#ifndef GB_SOLVE_LOADING_PATH_LEG_HELD_H
#define GB_SOLVE_LOADING_PATH_LEG_HELD_H

#include "solve/loading/path/leg_run.h"

/* Components whose stress a leg holds. */

/* The leg under way. */
const struct gb_leg *gb_leg_held_leg(const struct gb_leg_run *run,
                                     const struct gb_model *model);
/* Is the stress of component k held? */
bool gb_leg_held_component(const struct gb_leg_run *run, const struct gb_model *model,
                           int k);
/* What a held stress should be, beside these stresses. */
double gb_leg_held_wanted(const struct gb_leg_run *run, const struct gb_leg *leg, int k,
                          const double stress[6]);
/* Largest difference of a held stress from what it should be, over its tolerance. */
double gb_leg_held_distance(const struct gb_leg_run *run, const struct gb_model *model,
                            const double stress[6]);
void gb_leg_held_note_largest(struct gb_leg_run *run, const double stress[6]);
/* Conditions on the held stresses: from these stresses a share of the way to the wanted
 * ones.  Returns their number. */
int gb_leg_held_conditions(const struct gb_leg_run *run, const struct gb_model *model,
                           const double stress[6], double share,
                           struct gb_stress_condition condition[6]);
/* "leg 2 (shear xz to 20 % at z = 50 MPa): no equilibrium with z = 50 MPa beyond a strain
 * of 4.1 %: collapse".  Returns buffer. */
char *gb_leg_held_missed(const struct gb_leg_run *run, const struct gb_model *model,
                         char *buffer, size_t size);

#endif
