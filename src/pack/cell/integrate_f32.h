#ifndef GB_PACK_CELL_INTEGRATE_F32_H
#define GB_PACK_CELL_INTEGRATE_F32_H

#include <stdbool.h>

struct gb_model;
struct gb_world;

/* Motion with inertia of the particles of a world in single precision.  Their velocities
 * lie in the world, and one pass over each block of particles does all that comes between
 * two evaluations: velocities, places and turns as the next sweep sees them, and the ways
 * since the lists were built.  Positions follow when gb_world_synchronise asks for them. */
struct gb_integrate_f32 {
    double keep, kick, back, step; /* x -= back v, v = keep v + kick F, x += step v */
    double inertia;                /* of turns, m d^2: their F is the torque over it */
    double most; /* d; who would go farther in a step is slowed, and turns slower */
};

/* Does the world do that, and will that of a model? */
bool gb_integrate_f32_in_use(const struct gb_world *world);
bool gb_integrate_f32_applies(const struct gb_model *model);

/* All velocities to 0. */
void gb_integrate_f32_reset(struct gb_world *world);

/* One motion, by the forces of the last evaluation; the next one uses it up, and has to
 * follow before anything else moves the particles.  Returns the sum of the squared
 * velocities, those of turns with their inertia.
 *
 * turned   count x 3, to which the turns are added; NULL: to nothing */
double gb_integrate_f32_step(struct gb_world *world, const struct gb_integrate_f32 *by,
                             float *turned);

#endif
