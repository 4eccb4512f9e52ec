#ifndef GB_MEASURE_OBSERVE_H
#define GB_MEASURE_OBSERVE_H

#include <stdint.h>

#include "pack/cell/world.h"

/* Measures of a world right after an evaluation; reduced units. */

/* rho = N (pi/6) d^3 / V; 2D: (pi/4) N d^2 / A. */
double gb_observe_density(const struct gb_world *world);

/* P_ij = (1/V) sum over pairs of f_i r_j, f the whole force on the first particle, r from
 * the second to it: minus the stress tensor of P1 (16).  E. */
void gb_observe_pressure(const struct gb_world *world, double pressure[3][3]);

/* Recoverable energy of contacts and attraction along their present branches: rod
 * law or line of the bridge, springs, dispersion (0 beyond the cutoff).  E d^3. */
double gb_observe_elastic(const struct gb_world *world);

struct gb_contact_counts {
    int64_t contacts; /* pairs with r < d */
    int64_t bridged;
    int64_t rattlers;    /* particles with fewer than two contacts */
    double coordination; /* 2 contacts / N */
};

/* share: of particles with 0, 1, ..., bins-1 (or more) contacts; NULL is fine.
 * each: contacts of every particle (count values); NULL is fine. */
void gb_observe_contacts(const struct gb_world *world, struct gb_contact_counts *counts,
                         double *share, int bins, int32_t *each);

/* Mean f_n of contacts (r < d) in bins of the angle between contact axis and z, 0..90
 * degrees; NaN in empty bins.  P1 Fig. 14. */
void gb_observe_rose(const struct gb_world *world, int bins, double *mean);

#endif
