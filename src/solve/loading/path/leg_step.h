#ifndef GB_SOLVE_LOADING_PATH_LEG_STEP_H
#define GB_SOLVE_LOADING_PATH_LEG_STEP_H

#include "solve/loading/path/leg_run.h"

/* Strain increments of a leg: from the tangents to the strain of the components whose
 * stress is held, and the corrections after a relaxation. */

enum gb_leg_step_outcome {
    GB_LEG_STEP_HELD,    /* all held stresses are there */
    GB_LEG_STEP_CORRECT, /* a further strain is needed */
    GB_LEG_STEP_BEYOND,  /* the step went past the end of the leg: a shorter one */
    GB_LEG_STEP_MISSED   /* corrections do not lead there */
};

/* Largest magnitude of six strains. */
double gb_leg_step_largest(const double strain[6]);
/* Strains of one step in which the leading component advances by `lead`, and held stresses
 * by a share of what they are away from their values. */
void gb_leg_step_solve(struct gb_leg_run *run, const struct gb_model *model, double lead,
                       double share, double strain[6]);
/* Fills run->increment: held stresses go towards their values, as far as a step of strain
 * leads. */
void gb_leg_step_approach(struct gb_leg_run *run, const struct gb_model *model);

/* Stress after the relaxation of a step: what is left to correct, in correction. */
enum gb_leg_step_outcome gb_leg_step_check(struct gb_leg_run *run,
                                           const struct gb_model *model,
                                           const double stress[6], double correction[6]);
/* The step again, as long as it takes to the end that it went past. */
void gb_leg_step_shorten(struct gb_leg_run *run, const struct gb_model *model);
/* Half the step, from the last accepted state again. */
void gb_leg_step_halve(struct gb_leg_run *run, const struct gb_model *model);

#endif
