#ifndef GB_MEASURE_TENSOR_H
#define GB_MEASURE_TENSOR_H

#include "pack/cell/world.h"
#include "pack/kernel/fabric_sums.h"

/* Invariants of a tensor of stresses or of fabric, in 3D or in the x-z plane (dimension 2:
 * row and column y do not count). */

/* Mean of the normal components. */
double gb_tensor_mean(const double tensor[3][3], int dimension);

/* sqrt(3/2 s:s), s the deviator of the symmetric part; 2D: sqrt(2 s:s), the difference of
 * the principal values.  As q of a triaxial test. */
double gb_tensor_deviatoric(const double tensor[3][3], int dimension);

/* Norm of the antisymmetric part over the mean; NaN where the mean is 0. */
double gb_tensor_asymmetry(const double tensor[3][3], int dimension);

/* Largest eigenvalue of the deviator of the symmetric part, in closed form. */
double gb_tensor_largest_deviator(const double tensor[3][3], int dimension);

/* Fabric tensors F_ij = <n_i n_j> of a world right after an evaluation, n the unit vector
 * along a contact (r < d).  NaN where there is no such contact. */
struct gb_fabric {
    double all[6]; /* of all contacts: xx, yy, zz, xy, xz, yz */
    /* By enum gb_fabric_of: 3/2 of the largest eigenvalue of the deviator, 2D: twice; from
     * 0 (isotropic) to 1 (all contacts parallel). */
    double anisotropy[GB_FABRIC_KINDS];
};

/* Fabric, and in the same pass the pressure tensor of gb_observe_pressure (E). */
void gb_tensor_fabric(const struct gb_world *world, double pressure[3][3],
                      struct gb_fabric *fabric);

#endif
