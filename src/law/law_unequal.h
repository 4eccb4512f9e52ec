#ifndef GB_LAW_LAW_UNEQUAL_H
#define GB_LAW_LAW_UNEQUAL_H

#include "law/law_bridge.h"
#include "law/law_dispersion.h"
#include "law/law_rod.h"

/* The contact laws of P1 between two spheres of diameters d_i and d_j.
 *
 * With D = (d_i + d_j)/2, where they touch, and d' = 2 d_i d_j/(d_i + d_j), four times
 * the reduced radius, P1's forms follow from where they come from:
 *
 *   Hertz     f = E/(3 (1-nu^2)) sqrt(d') h^1.5, a = sqrt(h d')/2
 *   rod (1)   a rod of cross-section pi a^2, length r and modulus M E between the
 *             centres: df/dh = M E pi a^2/r, so
 *             f = -(pi/4) M E d' D (h/D + ln(1 - h/D)); (9) alike
 *   (3)       Hamaker's pair of unequal spheres, of which (3) is the case of equal ones:
 *             (pi^2/3) (n d0^3)^2 eps d_i^3 d_j^3 s/((s^2-D^2)^2 (s^2-(d_i-d_j)^2/4)^2),
 *             s = r + alpha d0
 *   bridges   bridge_length in d is in D; a_ch = sqrt(d' (D - r_min))/2
 *
 * In units of D these are the laws of equal spheres with factors of c = d'/D.  
 * law/normal.h has the formulas. */
struct gb_law_unequal {
    double mean_diameter;  /* D, in the model's lengths, as everything without a note */
    double diameter_ratio; /* c */
    double inverse_diameter[2]; /* 1/d_i, 1/d_j */
    struct gb_law_rod rod;      /* of two spheres of the reference diameter */
    double bridge_length;
    double strength, shift; /* of (3), of those two as well */
    double adhesion;        /* f_a where they touch */
};

/* From the laws of two spheres of the reference diameter; diameters in its lengths, above
 * 0.  Below, lengths are in the reference diameter d, forces in E d^2, energies and
 * moments in E d^3. */
void gb_law_unequal_init(struct gb_law_unequal *law, const struct gb_law_rod *rod,
                         const struct gb_law_bridge *bridge,
                         const struct gb_law_dispersion *dispersion, double first,
                         double second);

/* f_e of a contact with overlap h; deepest > 0: of a bridge with that r_min.  *stiffness
 * is its slope and may be NULL. */
double gb_law_unequal_elastic(const struct gb_law_unequal *law, double deepest, double h,
                              double *stiffness);
/* Energy stored by f_e: its integral over h up to this overlap. */
double gb_law_unequal_elastic_energy(const struct gb_law_unequal *law, double deepest,
                                     double h);
/* Contact radius where twice its square over d'/2 is an overlap: sqrt(h d')/2. */
double gb_law_unequal_radius(const struct gb_law_unequal *law, double h);
/* M(a) of (9) at overlap h. */
double gb_law_unequal_moment(const struct gb_law_unequal *law, double h);
/* f_a at centre distance r; constant where they touch. */
double gb_law_unequal_attraction(const struct gb_law_unequal *law, double r);
/* Its energy, 0 at infinity. */
double gb_law_unequal_attraction_energy(const struct gb_law_unequal *law, double r);
/* Overlap at which f_e = f_a, for one of the model's materials; 0 without attraction.
 * Beyond GB_OVERLAP_MAX of D the laws do not hold. */
double gb_law_unequal_equilibrium(const struct gb_law_unequal *law);

#endif
