#ifndef GB_LAW_LAW_UNEQUAL_H
#define GB_LAW_LAW_UNEQUAL_H

#include "law/law_bridge.h"
#include "law/law_dispersion.h"
#include "law/law_rod.h"

/* The contact laws of P1 for two spheres of diameters d_i and d_j.
 *
 * They touch at the distance D = (d_i + d_j)/2; d' = 2 d_i d_j/(d_i + d_j) is four
 * times the reduced radius.  The derivations of P1's laws then give:
 *
 *   Hertz     f = E/(3 (1-nu^2)) sqrt(d') h^1.5, a = sqrt(h d')/2
 *   rod (1)   a rod of cross-section pi a^2, length r and modulus M E between the
 *             centres: df/dh = M E pi a^2/r, so
 *             f = -(pi/4) M E d' D (h/D + ln(1 - h/D)); (9) likewise
 *   (3)       Hamaker's pair of unequal spheres; (3) is its case of equal spheres:
 *             (pi^2/3) (n d0^3)^2 eps d_i^3 d_j^3 s/((s^2-D^2)^2 (s^2-(d_i-d_j)^2/4)^2),
 *             s = r + alpha d0
 *   bridges   bridge_length is a multiple of D; a_ch = sqrt(d' (D - r_min))/2
 *
 * In units of D these are the laws of equal spheres with additional factors of c =
 * d'/D. law/normal.h has the formulas. */
struct gb_law_unequal {
    double mean_diameter;       /* D; lengths in the reference diameter unless noted */
    double diameter_ratio;      /* c */
    double inverse_diameter[2]; /* 1/d_i, 1/d_j */
    struct gb_law_rod rod;      /* of two spheres of the reference diameter */
    double bridge_length;
    double strength, shift; /* of (3), also for the reference diameter */
    double adhesion;        /* f_a at contact */
};

/* Sets the laws from those of two spheres of the reference diameter d.  `first` and
 * `second` are the diameters in d, above 0.  In the functions below lengths are in d,
 * forces in E d^2, energies and moments in E d^3. */
void gb_law_unequal_init(struct gb_law_unequal *law, const struct gb_law_rod *rod,
                         const struct gb_law_bridge *bridge,
                         const struct gb_law_dispersion *dispersion, double first,
                         double second);

/* f_e of a contact at overlap h.  `deepest` is h_min of a bridge, 0 without one.
 * *stiffness receives the slope; NULL is fine. */
double gb_law_unequal_elastic(const struct gb_law_unequal *law, double deepest, double h,
                              double *stiffness);
/* Energy stored by f_e: its integral over the overlap, from 0 to h. */
double gb_law_unequal_elastic_energy(const struct gb_law_unequal *law, double deepest,
                                     double h);
/* Contact radius sqrt(h d')/2 at overlap h. */
double gb_law_unequal_radius(const struct gb_law_unequal *law, double h);
/* M(a) of (9) at overlap h. */
double gb_law_unequal_moment(const struct gb_law_unequal *law, double h);
/* f_a at centre distance r; constant below D. */
double gb_law_unequal_attraction(const struct gb_law_unequal *law, double r);
/* Potential energy of f_a, 0 at infinity. */
double gb_law_unequal_attraction_energy(const struct gb_law_unequal *law, double r);
/* Overlap at which f_e = f_a; 0 without attraction.  The laws do not hold beyond
 * GB_OVERLAP_MAX of D. */
double gb_law_unequal_equilibrium(const struct gb_law_unequal *law);

#endif
