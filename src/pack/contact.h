#ifndef GB_PACK_CONTACT_H
#define GB_PACK_CONTACT_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/model.h"

/* One contact: its history between evaluations.  The record is read and written as a whole,
 * so it is kept together. */
struct gb_contact {
    double arm[3];     /* r_ij at the last evaluation */
    double deepest;    /* h_min; 0: touching without a bridge; < 0: not touching */
    double shear[3];   /* delta, half the relative displacement, in the tangent plane */
    double roll[3];    /* theta_r, likewise */
    double pivot;      /* theta_p, about the normal */
    double line_force; /* f_e(h_min) and its slope: derived, kept to save the logarithm */
    double line_slope;
};

/* What of it must be kept in a copy made right after an evaluation: the arm and the line follow
 * from the positions and h_min. */
struct gb_contact_core {
    double deepest;
    double shear[3];
    double roll[3];
    double pivot;
};

/* What a contact does to its two particles: the force on i (the opposite on j) and the torques.
 * The torque of the shear force is the same on both, those of pivoting and rolling opposed. */
struct gb_wrench {
    double force[3];
    double torque_j[3];
};

/* What a sweep counts beside the forces, summed in a fixed order. */
struct gb_tally {
    int64_t contacts;    /* pairs with r < d */
    int64_t sliding;     /* of these: shear spring at its cap */
    double normal_sum;   /* sum of |f_n| over contacts */
    double deepest;      /* largest overlap; NaN when a pair force is not finite */
};

void gb_contact_clear(struct gb_contact *contact);

/* Advances one pair; fills its wrench and adds the torque on i to torque_i.
 *
 * r       x_i - x_j, nearest image; its length is distance
 * turn_i  rotation of the particles since the last evaluation (3 each)
 * The increment of relative motion is r minus the stored arm, so the affine motion of the cell
 * counts.  Source: P1 eqs. (1)-(12); kinematics: stored vectors are turned into the current
 * tangent plane keeping their length before the increment is added. */
void gb_contact_advance(const struct gb_model *model, struct gb_contact *contact,
                        const double r[3], double distance, const double turn_i[3],
                        const double turn_j[3], struct gb_wrench *wrench,
                        double torque_i[3], struct gb_tally *tally);

struct gb_contact_core gb_contact_core(const struct gb_contact *contact);
struct gb_contact gb_contact_revive(const struct gb_model *model,
                                    const struct gb_contact_core *core,
                                    const double arm[3]);

/* Refreshes line_force and line_slope from deepest, after a record was read or set. */
void gb_contact_derive(const struct gb_model *model, struct gb_contact *contact);

#endif
