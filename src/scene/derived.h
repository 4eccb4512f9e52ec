#ifndef GB_SCENE_DERIVED_H
#define GB_SCENE_DERIVED_H

#include "greenbody/params.h"

/* Quantities derived from the parameters: relative values in SI units, and the values
 * of "auto".  Exception: gb_derived_cell is in particle diameters. */

/* Resolved lengths and pressures, SI. */
double gb_derived_bridge_length_m(const struct gb_params *params);
double gb_derived_shear_strength_pa(const struct gb_params *params);
/* Median diameter of the log-normal law. */
double gb_derived_median_m(const struct gb_params *params);
/* Meaning of "d" in preset values and reduced units: particles.diameter, or the mean
 * diameter by number if a quasi-static scene has a size distribution. */
double gb_derived_reference_m(const struct gb_params *params);
/* sigma_0 of Hollomon's law; auto: the curve passes through the yield point.  Source:
 * P3 section 4. */
double gb_derived_hollomon_pa(const struct gb_params *params);
/* Density of the initial structure; auto is 0.24 in 3D and 0.5 in 2D (P1, P2). */
double gb_derived_structure_density(const struct gb_params *params);

/* Compressed axes, an enum gb_geometry: loading.geometry, or the axes of the first leg
 * of loading.path. */
int gb_derived_geometry(const struct gb_params *params);

/* The reduced unit of time T = sqrt(m/(E d)) = sqrt(pi rho_m d^2/(6 E)), 0.74 ps for
 * alumina of 10 nm.  Source: P2 section 2. */
double gb_derived_unit_time_s(const struct gb_params *params);
/* Time step of dynamic scenes; NaN: auto. */
double gb_derived_time_step_s(const struct gb_params *params);

/* Edges of the initial cell in particle diameters (x, y, z); y is 1 in 2D, where the
 * scene lies in the x-z plane.  base = auto: in 3D the aspect ratio of P1's cells (18 x
 * 18 x 53.87 for 8000 particles), in 2D a square. */
void gb_derived_cell(const struct gb_params *params, double edges[3]);

#endif
