#ifndef GB_PACK_F32_INTEGRATE_F32_H
#define GB_PACK_F32_INTEGRATE_F32_H

#include <stdbool.h>

struct gb_model;
struct gb_world;

/* Velocity update in single precision, for relaxers with inertia: F is the force over the
 * diameter, the mass that relaxers give to a particle.  The velocities belong to the world; one pass over each block of particles does all that lies between two
 * evaluations: velocities, fixed-point positions and rotation increments for the next
 * sweep, and the bounds of the displacements since the list build.  `position` follows
 * with gb_world_synchronise. */
struct gb_integrate_f32 {
    /* x -= back v, v = keep v + kick F, x += step v */
    double keep, kick, back, step;
    double inertia; /* of rotations, m d^2: their F is the torque over it */
    double
        displacement_max; /* d; a particle that would move farther in one step is slowed
                              * down, with its rotation */
};

/* True if the world is in single precision; and if a world of the model will be. */
bool gb_integrate_f32_in_use(const struct gb_world *world);
bool gb_integrate_f32_applies(const struct gb_model *model);

/* Sets all velocities to 0. */
void gb_integrate_f32_reset(struct gb_world *world);

/* One update by the forces of the last evaluation.  The next evaluation has to follow
 * before anything else moves the particles.  Returns the sum of squared velocities, those
 * of rotations times the inertia.
 *
 * rotation_total: count x 3, which the rotation increments are added to; NULL: none */
double gb_integrate_f32_step(struct gb_world *world, const struct gb_integrate_f32 *by,
                             float *rotation_total);

#endif
