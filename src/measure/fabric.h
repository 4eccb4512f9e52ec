#ifndef GB_MEASURE_FABRIC_H
#define GB_MEASURE_FABRIC_H

#include "pack/cell/world.h"
#include "pack/kernel/fabric_sums.h"

/* Fabric tensors F_ij = <n_i n_j> of a world right after an evaluation, n the unit vector
 * along a contact (r < d).  NaN where there is no such contact. */
struct gb_fabric {
    double all[6]; /* of all contacts: xx, yy, zz, xy, xz, yz */
    /* By enum gb_fabric_of: 3/2 of the largest eigenvalue of the deviator, 2D: twice; from
     * 0 (isotropic) to 1 (all contacts parallel). */
    double anisotropy[GB_FABRIC_KINDS];
};

/* Fabric, and in the same pass the pressure tensor of gb_observe_pressure (E). */
void gb_fabric_measure(const struct gb_world *world, double pressure[3][3],
                       struct gb_fabric *fabric);

#endif
