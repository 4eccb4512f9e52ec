#ifndef GB_MEASURE_THEORY_H
#define GB_MEASURE_THEORY_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"
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

/* phi and Psi at a density in (0, 1), P1 (20). */
double gb_theory_hardening_phi(double density);

double gb_theory_hardening_psi(double density);

/* p / (sqrt(1 - theta) tau_0) = sqrt(Psi + c phi): c = 2/3 uniaxial, 1/6 biaxial, 0
 * isotropic.  geometry is an enum gb_geometry.  P1 (21)-(23). */
double gb_theory_hardening_resistance(int geometry, double density);

/* gamma_0 accumulated from one density to another, P1 (21)-(23); both in (0, 1). */
double gb_theory_hardening_shear(int geometry, double from, double to);

/* tau_0 over gamma_0, piecewise linear. */
struct gb_hardening {
    double start; /* density where gamma_0 is 0 */
    double *shear, *yield_pa;
    size_t count;
};

/* The law from a curve of pressing: densities that rise, pressures in Pa; points whose
 * pressure is not positive carry no law and are left out, but the first density is where
 * shear begins.  gb_theory_hardening_finish must be called.
 *
 * Errors: GB_ERR_INPUT (densities that do not rise or lie outside (0, 1), fewer than two
 * points), GB_ERR_MEMORY. */
bool gb_theory_hardening_init(struct gb_hardening *law, int geometry,
                              const double *density, const double *pressure_pa,
                              size_t count, struct gb_error *err);

void gb_theory_hardening_finish(struct gb_hardening *law); /* zeroed is fine */

/* Pressure (Pa) at a density in a geometry; NaN outside the range of the law. */
double gb_theory_hardening_pressure(const struct gb_hardening *law, int geometry,
                                    double density);

/* The density up to which a geometry can be predicted: there its shear equals the largest
 * shear of the law. */
double gb_theory_hardening_density_max(const struct gb_hardening *law, int geometry);

#endif
