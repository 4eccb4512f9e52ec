#ifndef GB_LAW_LAW_MINDLIN_H
#define GB_LAW_LAW_MINDLIN_H

#include <stdbool.h>

/* Shear force of one contact, carried with it and moved in increments: the rule the
 * engine's batches are tested against.  Units as in law_hertz.h.  Source: P3 (11), (14).
 * The force is that on particle i; n is the unit vector from j to i.
 *
 * A carried force keeps its size while the contact is unloaded and its spring softens.
 * Sheared deep and turned back shallow, a contact gives more than it took in shear: at
 * most mu^2/4 of the energy along the normal (6e-4 at mu = 0.05), as the cap falls, too.
 */

/* Turns a carried shear force into the plane across the new normal, keeping its length:
 * the contact has rolled along, nothing has slid.  A force along the normal is lost. */
void gb_law_mindlin_rotate(double force[3], const double normal[3]);

/* What slides at the contact point: the tangential part of the velocity of i's surface
 * over j's.  Velocities of the centres, angular velocities, and the distances from the
 * centres to the contact point.  A wall has its own velocity and no spin. */
void gb_law_mindlin_slip(const double normal[3], const double velocity_i[3],
                         const double velocity_j[3], const double spin_i[3],
                         const double spin_j[3], double lever_i, double lever_j,
                         double slip[3]);

/* One step: the force, already in the tangent plane, is moved by -stiffness slip dt,
 * (11), and cut back to mu times the whole normal force (spring and dashpot), (14).  True
 * where it was cut: the contact slides. */
bool gb_law_mindlin_advance(double force[3], const double slip[3], double stiffness,
                            double dt, double mu, double normal_force);

#endif
