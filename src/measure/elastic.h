#ifndef GB_MEASURE_ELASTIC_H
#define GB_MEASURE_ELASTIC_H

#include <stdbool.h>

/* What follows from an elasticity matrix C[stress][strain], components xx, yy, zz, yz, xz,
 * xy, the last three strains engineering shears.  Under stress C is not symmetric; the
 * averages are of its symmetric part. */

/* Of a polycrystal of randomly turned pieces: bounds by Voigt (equal strain) and Reuss
 * (equal stress), their mean by Hill, Young's modulus and Poisson's ratio from the mean.
 * Source: R. Hill, Proc. Phys. Soc. A 65, 349 (1952). */
struct gb_elastic_averages {
    double bulk_voigt, bulk_reuss, bulk;
    double shear_voigt, shear_reuss, shear;
    double young, poisson;
};

/* The nearest material with an axis of symmetry along z, by least squares over all
 * components of the tensor: its mean over rotations about z.  Source: M. Moakher,
 * A. N. Norris, J. Elasticity 85, 215 (2006). */
struct gb_elastic_axial {
    double c11, c12, c13, c33, c44;
    double misfit; /* norm of what is left over that of C */
};

/* Speeds of plane waves, sqrt(C/rho): pressure waves along z and across, shear waves along
 * z and in the plane across it.  The stress of the state beside C is left out. */
struct gb_elastic_waves {
    double p_along, p_across, s_along, s_across;
};

/* NaN where C has no inverse, as in 2D. */
struct gb_elastic_averages gb_elastic_average(const double c[6][6]);
struct gb_elastic_axial gb_elastic_project(const double c[6][6]);
/* Slopes of p = tr/3 and q = p_z - (p_x + p_y)/2, pressures positive in compression, by the
 * volume strain v alone and by the shear strain w alone (measure/yield_point.h), with
 * e_x = e_y and no shear of the axes. */
void gb_elastic_plane(const double c[6][6], double by_volume[2], double by_shear[2]);
/* C in Pa, mass density in kg/m3, speeds in m/s; NaN for a negative C. */
struct gb_elastic_waves gb_elastic_wave_speeds(const struct gb_elastic_axial *axial,
                                               double density_kg_m3);

#endif
