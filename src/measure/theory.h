#ifndef GB_MEASURE_THEORY_H
#define GB_MEASURE_THEORY_H

#include <stdbool.h>

#include "scene/model.h"

/* Asymptote of planar pressing at high pressure, P2 (5)-(8): friction prevents
 * rearrangement, all pairs have the same overlap. */

/* Density of a regular packing of discs with k contacts each, P2 (5); k > 2. */
double gb_theory_regular_density(double k);
/* Mean coordination number at a density, P2 (8). */
double gb_theory_coordination(double density);
/* Overlap h (d) of all pairs at a density, P2 (6); below 0 where they do not touch. */
double gb_theory_overlap(double density);

/* p(rho), P2 (7), Pa, with f_n = rod law less the adhesion of touching particles.  Holds
 * where gb_theory_overlap is positive; NaN elsewhere and for densities not above 0. */
double gb_theory_pressure(const struct gb_model *model, double density);

/* The density at which the asymptote reaches pressure_pa >= 0.  Errors: GB_ERR_INPUT for
 * a pressure out of reach, GB_ERR_NOT_CONVERGED. */
bool gb_theory_density(const struct gb_model *model, double pressure_pa, double *density,
                       struct gb_error *err);

#endif
