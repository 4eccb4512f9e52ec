#ifndef GB_LAW_LAW_ROD_H
#define GB_LAW_LAW_ROD_H

/* Elastic repulsion of two equal spheres, "rod model": Hertz law corrected for large
 * overlaps.  Reduced units: overlap h in diameters, force in E d^2, stiffness in E d,
 * energy in E d^3.  Source: P1 eqs. (1), (2) (slope as the derivative of (1)), (9). */
struct gb_law_rod {
    double hertz; /* 1 / (3 (1 - nu^2)) */
    double rod;   /* (pi/4) M, M = (1-nu) / ((1-2nu)(1+nu)) */
    double pivot; /* (pi/3) M, factor of the second term of (9) */
};

/* Sets the factors of P1 (1) and (9).  Poisson's ratio must be below 1/2, where M is
 * infinite. */
void gb_law_rod_init(struct gb_law_rod *law, double poisson);

/* f_e(h) (E d^2): 0 for h <= 0, Hertz' law for small h, unbounded as h -> 1, INFINITY
 * at h >= 1.  Source: P1 (1). */
double gb_law_rod_force(const struct gb_law_rod *law, double h);
/* df_e/dh (E d); 0 for h <= 0, INFINITY at h >= 1.  The derivative of P1 (1): the printed
 * (2) lacks the factor (1 - nu)/(1 + nu) of M. */
double gb_law_rod_stiffness(const struct gb_law_rod *law, double h);
/* Integral of the force from 0 to h (E d^3); 0 for h <= 0, INFINITY at h >= 1. */
double gb_law_rod_energy(const struct gb_law_rod *law, double h);
/* M(a) at a = sqrt(h)/2: first moment of the contact pressure (E d^3); 0 for h <= 0,
 * INFINITY at h >= 1.  Source: P1 (9). */
double gb_law_rod_moment(const struct gb_law_rod *law, double h);

#endif
