#ifndef GB_PACK_KERNEL_SIZED_CONTACT_H
#define GB_PACK_KERNEL_SIZED_CONTACT_H

#include <stdbool.h>
#include <stdint.h>

#include "law/law_unequal.h"
#include "scene/model.h"

struct gb_engine;

/* Increments since the last evaluation; those of springs are 0 where a contact has just
 * formed. */
struct gb_sized_contact_increments {
    double shear[3], roll[3], pivot, overlap;
    /* products with the springs before them, for the work */
    double shear_before, roll_before, pivot_before;
};

/* One near pair of unequal particles while the laws are applied to it: P1 (1)-(12) by
 * law/law_unequal.h, viscous forces P2 (3).  Reduced units; rotations of sweep_sized.h. */
struct gb_sized_contact {
    struct gb_law_unequal law;
    double r[3], n[3], distance, overlap;
    double rotation_sum[3];        /* of arcs */
    double rotation_difference[3]; /* of angles */
    double deepest;
    double shear[3], roll[3], pivot;
    double f_elastic;
    bool slides;
    struct gb_sized_contact_increments by;
    /* viscous scenes: */
    bool viscous;
    double damp;    /* viscous time A over time step */
    double last[4]; /* normal force, stiffnesses of shear, roll, pivot, one step before */
    double absorbed; /* work in this step, E d^3 */
};

/* Geometry of near pair k with the branch vector contact->r, and its contact record.
 * rotation_i, rotation_j: rotation increments of its particles. */
void gb_sized_contact_load(const struct gb_engine *engine, int64_t k,
                           const double rotation_i[3], const double rotation_j[3],
                           struct gb_sized_contact *contact);

/* After it: what viscous forces need of the last evaluation. */
void gb_sized_contact_load_viscous(const struct gb_engine *engine, int64_t k,
                                   struct gb_sized_contact *contact);

void gb_sized_contact_store(struct gb_engine *engine, int64_t k,
                            const struct gb_sized_contact *contact);

/* Springs and bridge after the relative motion since the last evaluation. */
void gb_sized_contact_advance(const struct gb_engine *engine, int64_t k,
                              struct gb_sized_contact *contact);

/* Row of a pair in contact: force on i, torque (over arcs) on j, on i. */
void gb_sized_contact_forces(const struct gb_model *model,
                             struct gb_sized_contact *contact, double row[9]);

/* Attraction on i of a pair across a gap.  Returns its magnitude. */
double gb_sized_contact_gap(const struct gb_model *model,
                            const struct gb_law_unequal *law, const double r[3],
                            double distance, double force[3]);

/* Of a near pair across a gap: the same, the work it absorbs, and no springs. */
void gb_sized_contact_near_gap(const struct gb_model *model,
                               struct gb_sized_contact *contact, double force[3]);

#endif
