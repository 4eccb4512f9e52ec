#ifndef GB_SOLVE_LOADING_DIE_DIE_STATE_H
#define GB_SOLVE_LOADING_DIE_DIE_STATE_H

#include <stdbool.h>
#include <stdint.h>

#include "pack/die/bed.h"
#include "pack/die/bed_record.h"
#include "scene/model.h"
#include "solve/leapfrog.h"
#include "solve/loading/die/die_stages.h"
#include "solve/loading/die/die_surface.h"
#include "solve/loading/die/punch.h"

/* Internal to die_stages.c, die_sequence.c, die_cycle.c and die_rest.c.  Reduced units. */

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
    bool flattened;     /* flattening has begun */
    int64_t rest_from;  /* since_point when the punch had been lifted */
    double punch_from;  /* position of the punch when flattening began */
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
    double solid_volume; /* of the spheres; 0: not summed yet */
    int halvings;
    bool have_good;
};

#endif
