#ifndef GB_LAW_LAW_BRIDGE_H
#define GB_LAW_LAW_BRIDGE_H

#include <stdbool.h>

#include "law/law_rod.h"

/* Solid bridge between two equal particles, P1 section II.A and eq. (2), Fig. 1.
 *
 * It forms when the overlap h exceeds `length` (drch); h_min = 1 - r_min is the deepest
 * overlap since then.  Loading beyond h_min follows the rod law.  Below h_min the force
 * follows the tangent at h_min.  When h falls below h_min - length, the bridge breaks
 * partly and h_min becomes h + length.  At h <= 0 the bridge is gone. */
struct gb_law_bridge {
    double length;       /* drch, d; 1 or more: no bridges */
    double strength;     /* sigma_b, E */
    bool radius_current; /* a_ch from the printed form at the current r, not from r_min */
};

/* Returns the new h_min (d) after a contact moves to overlap h (d): 0 without a bridge
 * and for h <= 0.  The argument h_min is the old value.  Source: P1 section II.A. */
double gb_law_bridge_deepest(const struct gb_law_bridge *law, double h_min, double h);

/* Elastic force f_e (E d^2) at overlap h <= h_min of a bridged contact (d): the tangent
 * of (1) at h_min.  Negative in tension.  Source: P1 (2), with the derivative of (1) as
 * slope. */
double gb_law_bridge_force(const struct gb_law_rod *rod, double h_min, double h);

/* Contact radius a_ch = sqrt(h_min)/2 (d), or the printed form at the current r; h_min
 * must be above 0.  Source: P1 section II.A. */
double gb_law_bridge_radius(const struct gb_law_bridge *law, double h_min, double h);

/* Mean normal stress that breaks the bridge (partly) at overlap h, in E; P1 Fig. 2. */
double gb_law_bridge_peel_stress(const struct gb_law_bridge *law,
                                 const struct gb_law_rod *rod, double h);

#endif
