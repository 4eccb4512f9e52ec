#ifndef GB_SOLVE_LOADING_DYNAMIC_H
#define GB_SOLVE_LOADING_DYNAMIC_H

#include <stdbool.h>
#include <stdint.h>

#include "base/record.h"
#include "greenbody/status.h"
#include "pack/cell/world.h"
#include "solve/step_outcome.h"
#include "solve/verlet.h"

/* High-speed pressing of P2: relax in a fixed cell, compress at a rate to a density,
 * hold.  Steps of gb_verlet between recorded points; a guard on the share of
 * sliding contacts and on the critical step.  The world belongs to the caller. */
struct gb_dynamic;

enum gb_dynamic_stage {
    GB_DYNAMIC_RELAX,
    GB_DYNAMIC_LOAD,
    GB_DYNAMIC_HOLD,
    GB_DYNAMIC_OVER
};

/* The world must have been evaluated. */
bool gb_dynamic_create(struct gb_dynamic **out, struct gb_world *world,
                       struct gb_error *err);
void gb_dynamic_destroy(struct gb_dynamic *motion); /* NULL is fine */

/* At most max_steps time steps.  text (size bytes) receives one line when a guard acted.
 */
enum gb_step_outcome gb_dynamic_advance(struct gb_dynamic *motion, struct gb_world *world,
                                        int64_t max_steps, char *text, size_t size,
                                        struct gb_error *err);

/* Quantities of a recorded point, reduced units. */
struct gb_dynamic_report {
    enum gb_dynamic_stage stage; /* the one that has just been recorded */
    double time;                 /* since the start */
    int64_t steps;               /* since the last point */
    double kinetic, work, absorbed;
    double time_step; /* last used */
    double progress;  /* 0..1, by time */
};
struct gb_dynamic_report gb_dynamic_report(const struct gb_dynamic *motion);

/* Velocities of the particles, valid until the next advance. */
const struct gb_verlet *gb_dynamic_verlet(const struct gb_dynamic *motion);

/* The motion at a recorded point into a record, or out of it after gb_dynamic_create
 * with the same world.  Errors: GB_ERR_INPUT naming the member. */
bool gb_dynamic_record(struct gb_dynamic *motion, struct gb_record *record,
                       struct gb_error *err);

#endif
