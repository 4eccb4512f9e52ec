#ifndef GB_LAW_LAW_STORAKERS_H
#define GB_LAW_LAW_STORAKERS_H

#include <stdbool.h>

#include "law/law_hertz.h"

/* Plastic contact of two spheres that harden by Hollomon's law sigma = sigma_0 eps^m,
 * with elastic unloading.  Units and signs as in law_hertz.h.
 *
 * Loading follows the smaller of Hertz' force and the plastic force (16).  At small
 * overlaps the contact is still elastic, and (16) alone would be stiffer than elastic
 * spheres.  Unloading and reloading below the deepest overlap follow Hertz from a
 * flattened shape,
 *     F = (4/3) E* sqrt(R*) (h - h0)^1.5,   h0 = h_max - (3 F_max/(4 E* sqrt R*))^(2/3),
 * which is (19) with (20), integrated.  The state of a contact is its deepest overlap.
 *
 * printed: loading follows (16) alone, as P3 prints it.  For overlaps below the
 * crossing of (2) and (16), h0 is then negative: the contact opens with a force left in
 * it and returns more energy than it took.  Source: P3 eqs. (15)-(22); the smaller of
 * the two: P3 section 4. */
struct gb_law_storakers {
    struct gb_law_hertz hertz;
    double exponent; /* m, 0 to below 1 */
    double strength; /* sigma_0*, (18) */
    double factor;   /* 2^(1-m/2) 3^(1-m) pi c^(2+m), (16), (17) */
    double c;        /* a = c sqrt(2 R* h) of a plastic contact, (17) */
    bool printed;
};

/* sigma_0 of a material with yield stress sigma_Y and modulus E such that its curve
 * passes through the yield point (sigma_Y/E, sigma_Y).  Source: P3 section 4. */
double gb_law_storakers_hollomon(double yield, double young, double exponent);

/* sigma_0* of two materials, (18); for m = 0 its limit, the smaller of the two. */
double gb_law_storakers_strength(double strength_i, double strength_j, double exponent);

/* Sets the constants from sigma_0 of both materials and their common exponent. */
void gb_law_storakers_init(struct gb_law_storakers *law, const struct gb_elastic *i,
                           const struct gb_elastic *j, double strength_i,
                           double strength_j, double exponent, bool printed);

/* The plastic force alone and its slope, at effective radius R*; 0 for h <= 0.  Source:
 * P3 (16), (22). */
double gb_law_storakers_plastic(const struct gb_law_storakers *law, double radius,
                                double h);
/* Overlap at which Hertz' force equals the plastic force.  The contact is elastic below
 * it and plastic above it.  Source: P3 (2), (16). */
double gb_law_storakers_transition(const struct gb_law_storakers *law, double radius);

/* Force and tangent stiffness dF/dh of the active branch. */
struct gb_law_branch {
    double force, stiffness;
};

/* The loading curve: the smaller of (2) and (16), or (16) alone if `printed`. */
double gb_law_storakers_load(const struct gb_law_storakers *law, double radius, double h);
struct gb_law_branch gb_law_storakers_loading(const struct gb_law_storakers *law,
                                              double radius, double h);

/* Contact radius a on the loading curve: Hertz' sqrt(R* h), or c sqrt(2 R* h) where the
 * plastic force is active; 0 for h <= 0.  Source: P3 (2), (17). */
double gb_law_storakers_contact(const struct gb_law_storakers *law, double radius,
                                double h);

/* Elastic part of the deepest overlap, h_max - h0, which springs back. */
double gb_law_storakers_recovery(const struct gb_law_storakers *law, double radius,
                                 double deepest);

/* Force and tangent stiffness at overlap h; updates *deepest, the deepest overlap so
 * far.  The contact loads at *deepest and beyond, unloads and reloads below it, and has
 * no force at or below h0.  At h <= 0 the contact has ended and *deepest becomes 0: the
 * next contact is at another place of the surfaces.  Results therefore do not depend on
 * how long a neighbour list keeps the pair. */
struct gb_law_branch gb_law_storakers_update(const struct gb_law_storakers *law,
                                             double radius, double h, double *deepest);

/* Work needed to load a fresh contact to overlap h. */
double gb_law_storakers_loading_work(const struct gb_law_storakers *law, double radius,
                                     double h);

/* Energy that a contact at overlap h <= deepest returns until it opens.  Loading a
 * contact to h and opening it dissipates
 * gb_law_storakers_loading_work(h) - gb_law_storakers_unloading_energy(h, h). */
double gb_law_storakers_unloading_energy(const struct gb_law_storakers *law,
                                         double radius, double deepest, double h);

#endif
