#ifndef GB_MEASURE_CAP_H
#define GB_MEASURE_CAP_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"

/* The Drucker-Prager cap surface in the form of Abaqus ("Modified Drucker-Prager/Cap
 * model", *CAP PLASTICITY), without the third invariant (K = 1).  p: mean pressure,
 * q = sqrt(3/2 s:s), both in Pa; p_t = p_a - a (d + p_a tan beta) sin beta.
 *
 *   shear failure, p <= p_t   q = d + p tan(beta)
 *   transition, p_t to p_a    (p - p_a)^2 + (q - (1 - a/cos(beta)) D)^2 = (a D)^2
 *   cap, p > p_a              (p - p_a)^2 + (R q/(1 + a - a/cos(beta)))^2 = (R D)^2
 *
 * with D = d + p_a tan(beta).  Cap and transition meet at p_a with a level tangent; the
 * transition touches the shear failure line; p_b = p_a + R D closes the cap at q = 0. */
struct gb_cap {
    double d;    /* cohesion, Pa */
    double beta; /* angle of friction, rad, 0 to below pi/2 */
    double r;    /* cap eccentricity R, above 0 */
    double p_a;  /* Pa */
    double a;    /* radius of the transition over D; 0: none */
};

/* Usual transition: Abaqus names 0.01 to 0.05. */
#define GB_CAP_TRANSITION 0.03

/* D = d + p_a tan(beta), Pa. */
double gb_cap_depth(const struct gb_cap *cap);
/* 1 + a - a/cos(beta). */
double gb_cap_flattening(const struct gb_cap *cap);
/* End of the shear failure line, Pa. */
double gb_cap_tangent(const struct gb_cap *cap);
/* p_b, Pa, and the surface with the same shape whose cap ends at p_b. */
double gb_cap_end(const struct gb_cap *cap);
struct gb_cap gb_cap_with_end(const struct gb_cap *cap, double p_b);
/* p at which the shear failure line meets q = 0, Pa; -infinity for beta = 0. */
double gb_cap_apex(const struct gb_cap *cap);

/* q of the surface at p, Pa.  Beyond its ends negative, falling with the distance, so that
 * q - height is a yield function: below 0 inside. */
double gb_cap_height(const struct gb_cap *cap, double p);

/* Direction of plastic flow at (p, q): rates of volume (compression positive) and of
 * equivalent shear strain, up to a common factor.  Cap: normal to it.  Elsewhere from the
 * potential G = sqrt(((p_a - p) tan beta)^2 + (q/(1 + a - a/cos(beta)))^2) of Abaqus. */
void gb_cap_flow(const struct gb_cap *cap, double p, double q, double *volume,
                 double *shear);

/* The card as a material: a rate law of isotropic elasticity with the Drucker-Prager cap,
 * driven by strains.  Its parameters depend on the relative density, which follows the
 * strain (ln of the density grows by the volumetric strain); p_b depends on the plastic
 * volumetric strain, *CAP HARDENING.  All are linear between the rows and constant beyond
 * them. */
struct gb_cap_row {
    double density;
    double bulk, shear_modulus; /* K and G, Pa */
    struct gb_cap cap;          /* p_a of this row is not used: p_b gives it */
    double p_b;                 /* Pa, ascending */
    double plastic_volume;      /* plastic volumetric strain at p_b, ascending */
};

struct gb_cap_material {
    const struct gb_cap_row *row; /* ascending densities, 1 or more */
    size_t count;
};

/* Components in the order xx, yy, zz, xy, xz, yz.  Pressures, Pa. */
struct gb_cap_state {
    double pressure[6];
    double density;
    double plastic_volume; /* compression positive */
    double plastic_shear;  /* equivalent plastic strain */
};

/* Parameters at a density; the cap ends at the p_b of the plastic volumetric strain. */
struct gb_cap_row gb_cap_at(const struct gb_cap_material *material, double density,
                            double plastic_volume);

/* Errors: GB_ERR_INPUT naming the row: order, moduli, cohesion, R, beta. */
bool gb_cap_check(const struct gb_cap_material *material, struct gb_error *err);

/* Strains the material: elastic prediction, return to the surface along the plastic flow.
 * On the cap the return is implicit in stress and hardening; on the shear failure and
 * transition surfaces p_a is that of the beginning of the sub-step.
 *
 * strain   increments, compression positive; the last three engineering shears with the
 *          sign of the pressures that they cause
 * The increment is taken in equal sub-steps of at most GB_CAP_SUBSTEP (scene/tolerances.h).
 * Errors: GB_ERR_NOT_CONVERGED, GB_ERR_MEMORY. */
bool gb_cap_strain(const struct gb_cap_material *material, struct gb_cap_state *state,
                   const double strain[6], struct gb_error *err);

/* p and q of pressures. */
double gb_cap_mean(const double pressure[6]);

double gb_cap_deviator(const double pressure[6]);

#endif
