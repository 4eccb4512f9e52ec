#ifndef GB_MEASURE_HARDENING_H
#define GB_MEASURE_HARDENING_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"

/* Continuum theory of a plastically hardening porous body, P1 (18)-(23).  A curve of
 * pressing in one geometry gives the hardening law of the solid phase, yield strength
 * against accumulated shear; the law gives the curves of all geometries.  Porosity is
 * theta = 1 - density. */

/* phi and Psi at a density in (0, 1), P1 (20). */
double gb_hardening_phi(double density);
double gb_hardening_psi(double density);

/* p / (sqrt(1 - theta) tau_0) = sqrt(Psi + c phi): c = 2/3 uniaxial, 1/6 biaxial, 0
 * isotropic.  geometry is an enum gb_geometry.  P1 (21)-(23). */
double gb_hardening_resistance(int geometry, double density);

/* gamma_0 accumulated from one density to another, P1 (21)-(23); both in (0, 1). */
double gb_hardening_shear(int geometry, double from, double to);

/* tau_0 over gamma_0, piecewise linear. */
struct gb_hardening {
    double start; /* density where gamma_0 is 0 */
    double *shear, *yield_pa;
    size_t count;
};

/* The law from a curve of pressing: densities that rise, pressures in Pa; points whose
 * pressure is not positive carry no law and are left out, but the first density is where
 * shear begins.  gb_hardening_finish is due.
 *
 * Errors: GB_ERR_INPUT (densities that do not rise or lie outside (0, 1), fewer than two
 * points), GB_ERR_MEMORY. */
bool gb_hardening_init(struct gb_hardening *law, int geometry, const double *density,
                       const double *pressure_pa, size_t count, struct gb_error *err);
void gb_hardening_finish(struct gb_hardening *law); /* zeroed is fine */

/* Pressure (Pa) at a density in a geometry; NaN outside the range of the law. */
double gb_hardening_pressure(const struct gb_hardening *law, int geometry,
                             double density);

/* The density up to which a geometry can be predicted: there its shear equals the largest
 * shear of the law. */
double gb_hardening_density_max(const struct gb_hardening *law, int geometry);

#endif
