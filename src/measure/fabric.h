#ifndef GB_MEASURE_FABRIC_H
#define GB_MEASURE_FABRIC_H

#include "pack/cell/world.h"

/* Fabric tensors F_ij = <n_i n_j> of a world right after an evaluation, n the unit vector
 * along a contact (r < d).  NaN where there is no such contact. */
enum gb_fabric_of {
    GB_FABRIC_ALL,
    GB_FABRIC_BRIDGED,
    GB_FABRIC_TENSION, /* f_n < 0 */
    GB_FABRIC_FORCE,   /* all, weighted by |f_n| */
    GB_FABRIC_KINDS
};

struct gb_fabric {
    double all[6]; /* of all contacts: xx, yy, zz, xy, xz, yz */
    /* By enum gb_fabric_of: 3/2 of the largest eigenvalue of the deviator, 2D: twice; from
     * 0 (isotropic) to 1 (all contacts parallel). */
    double anisotropy[GB_FABRIC_KINDS];
};

void gb_fabric_measure(const struct gb_world *world, struct gb_fabric *fabric);

#endif
