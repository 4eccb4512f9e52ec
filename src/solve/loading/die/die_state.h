#ifndef GB_SOLVE_LOADING_DIE_DIE_STATE_H
#define GB_SOLVE_LOADING_DIE_DIE_STATE_H

#include <stdbool.h>
#include <stdint.h>

#include "base/record.h"
#include "pack/die/bed.h"
#include "pack/die/bed_record.h"
#include "scene/model.h"
#include "solve/loading/die/die_stages.h"

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

void gb_die_state_leapfrog_init(struct gb_leapfrog *leapfrog, double safety,
                                double given);

/* Positions after one step of the automatic length, forces there, velocities half a step
 * beyond.
 * Errors: as of gb_bed_evaluate. */
bool gb_die_state_leapfrog_step(struct gb_leapfrog *leapfrog, struct gb_bed *bed,
                                struct gb_error *err);

/* Critical time step sqrt(2/stiffest), stiffest that of gb_bed_tally: no mode grows, whatever the
 * damping.  Central differences need dt^2 omega^2 + 2 dt (rate of damping) < 4; of these 4
 * gb_law_hertz_damping_borne leaves 3 to a straight chain, whose omega^2 is 1.5 stiffest.
 * Friction and welds add undamped springs across the normal, which spin the particles too, and
 * shorten it: dt^2 omega^2 of heaps is 2 without and 1.3 with them.  INFINITY without contacts.
 * Not P3 (23)-(29), by the stiffest contact on its lighter particle: at half of that step a sphere
 * that several contacts hold vibrates without end. */
double gb_die_state_leapfrog_critical(const struct gb_bed *bed);

/* Time step that resolves every collision of listed contacts: a share of the critical step 2 T/pi
 * of a spring that pushes back in Hertz' duration T = 3.218 (m*^2/(H^2 v))^(1/5) of a collision at
 * the speed v under the force H h^1.5; INFINITY while nothing closes. */
double gb_die_state_leapfrog_impact(const struct gb_bed *bed);

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
void gb_die_state_punch_begin(struct gb_punch *punch, struct gb_leapfrog *leapfrog,
                              struct gb_bed *bed, double height, double mass);

/* Pressure of the ramp after a time. */
double gb_die_state_punch_wanted(const struct gb_punch *punch, double time);

/* Adds the last step to the means and sets the load of the next one.
 *
 * height   of the powder against the side */
void gb_die_state_punch_follow(struct gb_punch *punch, struct gb_leapfrog *leapfrog,
                               const struct gb_bed *bed, double height);

/* Resets the means. */
void gb_die_state_punch_clear(struct gb_punch *punch);

/* A surface of the compact: the particles that touched a wall under the full pressure.  The
 * median over them stands for its position: a few particles that come off move the mean by
 * any amount.  A zeroed surface is empty. */
struct gb_die_surface {
    int64_t count;
    int32_t *particle;
    double *value; /* room for the median */
};

/* The particles that touch a wall, right after an evaluation; replaces what it held.
 * Errors: GB_ERR_MEMORY. */
bool gb_die_state_surface_take(struct gb_die_surface *surface, const struct gb_bed *bed,
                               enum gb_die_wall wall, struct gb_error *err);

void gb_die_state_surface_finish(struct gb_die_surface *surface);

/* Median height of the upper, or distance from the axis of the outer points of its
 * particles; NaN for an empty one. */
double gb_die_state_surface_height(const struct gb_die_surface *surface,
                                   const struct gb_bed *bed);

double gb_die_state_surface_radius(const struct gb_die_surface *surface,
                                   const struct gb_bed *bed);

/* Into a record, or back; loading, a record without the item leaves it empty.
 * particles: of the bed.  Errors: GB_ERR_INPUT, GB_ERR_MEMORY. */
bool gb_die_state_surface_record(struct gb_die_surface *surface, const char *name,
                                 int64_t particles, struct gb_record *record,
                                 struct gb_error *err);

/* The pressing of a bed under way: internal to the die_*.c files.  Reduced units. */

/* The part of the state that a guard restores. */
struct gb_die_progress {
    enum gb_die_stages_stage stage;
    struct gb_leapfrog leapfrog;
    struct gb_punch punch;
    double time, stage_time;
    int64_t steps; /* of the stage */
    int64_t since_point;
    int checks_at_rest; /* checks in a row that found the powder at rest */
    /* For the display alone: the highest kinetic energy of the checks over its limit, and the
     * share of the way from there to rest. */
    double most_kinetic, rest_share;
    bool flattened;    /* flattening has begun */
    int64_t rest_from; /* since_point when the punch had been lifted */
    double punch_from; /* position of the punch when flattening began */
    double height0, next_record;
    bool at_point; /* the last step ended in a point */
    double peak;   /* height of the punch under the full pressure; 0: not reached yet */
    double height; /* of the powder without a punch, at the last point */
};

struct gb_die_stages {
    struct gb_die_scene scene;
    struct gb_bed_law law; /* of pressing */
    struct gb_die_progress now, good;
    struct gb_bed_copy *kept;        /* the bed of `good` */
    struct gb_die_surface side, top; /* of the compact, against wall and punch */
    double solid_volume;             /* of the spheres; 0: not summed yet */
    int halvings;
    bool have_good;
};

#endif
