#ifndef GB_LAW_LAW_DISPERSION_H
#define GB_LAW_LAW_DISPERSION_H

/* Dispersion attraction of two equal spheres (van der Waals-Hamaker, modified), P1 (3),
 * in reduced units.  It is constant, f_a(1), for r < 1. */
struct gb_law_dispersion {
    double strength; /* (pi^2/3) (n d0^3)^2 eps / (E d^3) */
    double shift;    /* alpha d0 / d */
    double contact;  /* f_a(1) */
};

/* Sets the constants. n d0^3 and alpha are pure numbers; epsilon is in E d^3, d0 in d.
 * alpha d0 must be above 0, because (3) is infinite at r = d without it.  Source: P1
 * (3). */
void gb_law_dispersion_init(struct gb_law_dispersion *law, double n_d0_cubed,
                            double epsilon, double alpha, double d0);

/* Attraction f_a(r) >= 0 (E d^2); r in d.  It is f_a(1) for r < 1.  Source: P1 (3). */
double gb_law_dispersion_force(const struct gb_law_dispersion *law, double r);
/* df_a/dr <= 0 (E d); 0 for r < 1.  The derivative of (3). */
double gb_law_dispersion_slope(const struct gb_law_dispersion *law, double r);
/* Potential energy (E d^3), 0 at infinity; -dU/dr = -f_a.  The integral of (3). */
double gb_law_dispersion_energy(const struct gb_law_dispersion *law, double r);
/* Distance r >= 1 (d) at which f_a has fallen to the fraction `share` of f_a(1); share
 * is in (0, 1]. */
double gb_law_dispersion_range(const struct gb_law_dispersion *law, double share);

#endif
