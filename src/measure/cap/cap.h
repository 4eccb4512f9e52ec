#ifndef GB_MEASURE_CAP_CAP_H
#define GB_MEASURE_CAP_CAP_H

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

#endif
