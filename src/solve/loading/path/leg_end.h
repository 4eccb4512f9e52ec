#ifndef GB_SOLVE_LOADING_PATH_LEG_END_H
#define GB_SOLVE_LOADING_PATH_LEG_END_H

#include <stdbool.h>

#include "scene/path/path.h"

/* What the ends of legs refer to: stress in the order of scene/path/path.h, E. */

/* p = tr/3 and q = sqrt(3/2 s:s); in 2D tr/2 and the difference of the principal
 * stresses. */
double gb_leg_end_mean(const double stress[6], int dimension);
double gb_leg_end_q(const double stress[6], int dimension);

/* A stress, not a strain, a density or a number of points. */
bool gb_leg_end_is_stress(const struct gb_leg_end *end);

/* The quantity of an end: its present value, comparable with gb_leg_end_target.  strain:
 * since the leg began; steps: its recorded points. */
double gb_leg_end_value(const struct gb_leg *leg, const struct gb_leg_end *end,
                        const double stress[6], const double strain[6], double density,
                        int steps, int dimension);
double gb_leg_end_target(const struct gb_leg_end *end);

/* How near to its target an end counts as reached; largest: stress of the leg. */
double gb_leg_end_tolerance(const struct gb_leg_end *end, double largest);

#endif
