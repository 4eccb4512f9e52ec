#ifndef GB_SOLVE_LEAPFROG_H
#define GB_SOLVE_LEAPFROG_H

#include <stdbool.h>

#include "pack/die/bed.h"

/* Newton's equations of a bed by central differences (leapfrog): velocities are half a step
 * before the positions, and the dashpots take them there.  Source: P3 3.1, 3.4. */
struct gb_leapfrog {
    double safety;  /* share of the critical step, (26); 0.1 in P3 */
    double given;   /* step that the preset fixes; 0: automatic */
    double limit;   /* longest step that a guard leaves */
    double gravity; /* along -z */
    double drag;    /* of a gas that lets powder come to rest: speed lost per time */
    /* The punch: a mass that the powder pushes up and `load` pushes down; 0: it keeps
     * its speed. */
    double punch_mass, load;
    double step;    /* last one taken */
    double fastest; /* bound of the speed of a particle */
};

void gb_leapfrog_init(struct gb_leapfrog *leapfrog, double safety, double given);

/* Positions after one step of the automatic length, forces there, velocities half a step
 * beyond.
 * Errors: as of gb_bed_evaluate. */
bool gb_leapfrog_step(struct gb_leapfrog *leapfrog, struct gb_bed *bed,
                      struct gb_error *err);

/* Critical time step sqrt(2/stiffest), stiffest that of gb_bed_tally: no mode grows, whatever the
 * damping.  Central differences need dt^2 omega^2 + 2 dt (rate of damping) < 4; of these 4
 * gb_law_hertz_damping_borne leaves 3 to a straight chain, whose omega^2 is 1.5 stiffest.
 * Friction and welds add undamped springs across the normal, which spin the particles too, and
 * shorten it: dt^2 omega^2 of heaps is 2 without and 1.3 with them.  INFINITY without contacts.
 * Not P3 (23)-(29), by the stiffest contact on its lighter particle: at half of that step a sphere
 * that several contacts hold vibrates without end. */
double gb_leapfrog_critical(const struct gb_bed *bed);

/* Time step that resolves every collision of listed contacts: a share of the critical step 2 T/pi
 * of a spring that pushes back in Hertz' duration T = 3.218 (m*^2/(H^2 v))^(1/5) of a collision at
 * the speed v under the force H h^1.5; INFINITY while nothing closes. */
double gb_leapfrog_impact(const struct gb_bed *bed);

#endif
