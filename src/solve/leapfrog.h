#ifndef GB_SOLVE_LEAPFROG_H
#define GB_SOLVE_LEAPFROG_H

#include <stdbool.h>

#include "pack/die/bed.h"

/* Newton's equations of a bed by central differences (leapfrog): velocities are half a step
 * before the positions, and the dashpots take them there.  Source: P3 3.1, 3.4. */
struct gb_leapfrog {
    double safety;  /* of the automatic step, (26); 0.1 in P3 */
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

/* Critical time step, (23)-(29): the stiffest contact on the lighter particle, with
 * damping; with friction also the mode in which shear and rotation go together, which is
 * not damped.  INFINITY without contacts. */
double gb_leapfrog_critical(const struct gb_bed *bed);

/* Time step that resolves the impact of a particle of this speed, from Hertz' duration of
 * a collision of the smallest one with a wall; INFINITY at rest. */
double gb_leapfrog_impact(const struct gb_bed *bed, double speed);

#endif
