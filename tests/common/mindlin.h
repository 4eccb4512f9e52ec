#ifndef GB_TESTS_COMMON_MINDLIN_H
#define GB_TESTS_COMMON_MINDLIN_H

#include <math.h>
#include <stdbool.h>

#include "base/vec.h"

/* Shear force of one contact, carried with it and moved in increments: the rule that
 * kernels are tested against.  Units as in law/law_hertz.h.  Source: P3 (11), (14).
 * The force is that on particle i; n is the unit vector from j to i.
 *
 * A carried force keeps its size while the contact is unloaded and its spring softens.
 * Sheared deep and turned back shallow, a contact gives more than it took in shear: at
 * most mu^2/4 of the energy along the normal (6e-4 at mu = 0.05), as the cap falls, too.
 */

/* Turns a carried shear force into the plane across the new normal, keeping its length:
 * the contact has rolled along, nothing has slid.  A force along the normal is lost. */
static inline void mindlin_rotate(double force[3], const double normal[3])
{
    const double before = gb_vec_length(force);
    gb_vec_add(force, -gb_vec_dot(force, normal), normal);
    const double after = gb_vec_length(force);
    gb_vec_scale(force, after > 0.0 ? before / after : 0.0);
}

/* What slides at the contact point: the tangential part of the velocity of i's surface
 * over j's.  Velocities of the centres, angular velocities, and the distances from the
 * centres to the contact point.  A wall has its own velocity and no spin. */
static inline void mindlin_slip(const double normal[3], const double velocity_i[3],
                                const double velocity_j[3], const double spin_i[3],
                                const double spin_j[3], double lever_i, double lever_j,
                                double slip[3])
{
    /* contact point at -lever_i n from i, at +lever_j n from j */
    double turning[3], swept[3];
    for (int k = 0; k < 3; k++) {
        turning[k] = -(lever_i * spin_i[k] + lever_j * spin_j[k]);
    }
    gb_vec_cross(turning, normal, swept);
    for (int k = 0; k < 3; k++) {
        slip[k] = velocity_i[k] - velocity_j[k] + swept[k];
    }
    gb_vec_add(slip, -gb_vec_dot(slip, normal), normal);
}

/* One step: the force, already in the tangent plane, is moved by -stiffness slip dt,
 * (11), and cut back to mu times the whole normal force (spring and dashpot), (14).  True
 * where it was cut: the contact slides. */
static inline bool mindlin_advance(double force[3], const double slip[3],
                                   double stiffness, double dt, double mu,
                                   double normal_force)
{
    gb_vec_add(force, -stiffness * dt, slip);
    const double cap = mu * fabs(normal_force), length = gb_vec_length(force);
    if (length <= cap) {
        return false;
    }
    gb_vec_scale(force, cap / length);
    return true;
}

#endif
