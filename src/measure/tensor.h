#ifndef GB_MEASURE_TENSOR_H
#define GB_MEASURE_TENSOR_H

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

#endif
