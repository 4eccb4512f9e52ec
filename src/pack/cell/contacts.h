#ifndef GB_PACK_CELL_CONTACTS_H
#define GB_PACK_CELL_CONTACTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "greenbody/status.h"

/* Precision of forces, contact histories and velocities.  Fixed for the life of a world
 * by numerics.precision. */
enum gb_real {
    GB_REAL_F64,
    GB_REAL_F32, /* quasi-static scenes in 3D */
};

static inline size_t gb_real_size(enum gb_real precision)
{
    return precision == GB_REAL_F32 ? sizeof(float) : sizeof(double);
}

/* Contact records of the near pairs, one per slot of the list: structure of arrays, so
 * that a batch of them passes through the laws in vector registers.  In 2D (x-z plane)
 * vectors in the plane have two components (0: x, 1: z); springs and rotations one.
 *
 * A member named after a quantity is the index of its array in `plane`; in 2D and in
 * quasi-static scenes some quantities have none. */
struct gb_contacts {
    int64_t capacity;
    int planes; /* arrays in use ... */
    int kept; /* ... the first of which are the history that a copy keeps.  Branch vectors
                 * follow from the positions of a copy made right after an evaluation. */
    enum gb_real real;
    void *plane[15];
    int deepest;   /* h_min; 0: in contact without a bridge; < 0: not in contact */
    int shear[3];  /* delta, in the tangent plane; 2D: along (n_z, -n_x) */
    int roll[3];   /* theta_r, likewise; 2D: about y */
    int pivot;     /* theta_p, about the normal; 3D only */
    int branch[3]; /* branch vector r_ij at the last evaluation */
    /* Dynamic scenes: normal force without its viscous part and stiffnesses of shear,
     * roll and pivot at the last evaluation, for the work that contacts absorb. */
    int last_normal, last_shear, last_roll, last_pivot;
};

struct gb_contacts_shape {
    int dimension;
    bool viscous; /* dynamic scene */
    enum gb_real real;
};

/* GB_REAL_F32: in 3D without viscous forces only. */
bool gb_contacts_init(struct gb_contacts *contacts, struct gb_contacts_shape shape,
                      int64_t capacity, struct gb_error *err);
void gb_contacts_finish(struct gb_contacts *contacts);

/* Marks a slot as not in contact. */
void gb_contacts_clear(struct gb_contacts *contacts, int64_t slot);

/* One number of a record, in either precision. */
static inline double gb_contacts_value(const struct gb_contacts *contacts, int plane,
                                       int64_t slot)
{
    return contacts->real == GB_REAL_F32
               ? (double)((const float *)contacts->plane[plane])[slot]
               : ((const double *)contacts->plane[plane])[slot];
}

static inline void gb_contacts_put(struct gb_contacts *contacts, int plane, int64_t slot,
                                   double value)
{
    if (contacts->real == GB_REAL_F32) {
        ((float *)contacts->plane[plane])[slot] = (float)value;
    } else {
        ((double *)contacts->plane[plane])[slot] = value;
    }
}

static inline double gb_contacts_deepest(const struct gb_contacts *contacts, int64_t slot)
{
    return gb_contacts_value(contacts, contacts->deepest, slot);
}

static inline bool gb_contacts_touch(const struct gb_contacts *contacts, int64_t slot)
{
    return gb_contacts_deepest(contacts, slot) >= 0.0;
}

#endif
