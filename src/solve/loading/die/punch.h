#ifndef GB_SOLVE_LOADING_DIE_PUNCH_H
#define GB_SOLVE_LOADING_DIE_PUNCH_H

#include <stdbool.h>
#include <stdint.h>

#include "pack/die/bed.h"
#include "solve/leapfrog.h"

/* What the pressure of the punch does. */
enum gb_punch_ramp {
    GB_PUNCH_RISES,
    GB_PUNCH_FALLS, /* the same way back */
    GB_PUNCH_OFF    /* no pressure: the punch is on its way out, or out */
};

/* A punch under a given pressure p(t): a body with the force F of the powder,
 * M a = F - p(t) A.  No controller: masses between 0.1 and 1 of the bed's give the same
 * curve; ten lag behind below 5 MPa. */
struct gb_punch {
    double area, length; /* of the die's section; time of the ramp */
    double pressure;     /* at its upper end */
    bool quadratic;      /* p = p_max (t/T)^2, else linear; falling: p_max (1 - t/T)^2 */
    enum gb_punch_ramp ramp;
    double time; /* since the ramp began */
    /* Work done on the powder since pressing began, by the trapezoidal rule over the
     * steps: position and force of the last step are its left side. */
    double work, position, force;
    /* means since the last point, weighted by the steps */
    double weight, carried, wanted, floor, side[2];
    double drag; /* of the side, E d^2: a force */
};

/* Puts the punch at rest on a height; mass in masses of the bed. */
void gb_punch_begin(struct gb_punch *punch, struct gb_leapfrog *leapfrog,
                    struct gb_bed *bed, double height, double mass);

/* Pressure of the ramp after a time. */
double gb_punch_wanted(const struct gb_punch *punch, double time);

/* Adds the last step to the means and sets the load of the next one.
 *
 * height   of the powder against the side */
void gb_punch_follow(struct gb_punch *punch, struct gb_leapfrog *leapfrog,
                     const struct gb_bed *bed, double height);

/* Means begin anew. */
void gb_punch_clear(struct gb_punch *punch);

#endif
