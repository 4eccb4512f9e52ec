#ifndef GB_PACK_CELL_WORLD_MEASURE_H
#define GB_PACK_CELL_WORLD_MEASURE_H

#include "pack/cell/world.h"
#include "pack/kernel/fabric_sums.h"

/* Density and pressure of a world right after an evaluation: what a loading follows. */

/* rho = N (pi/6) <d^3> / V; 2D: (pi/4) N d^2 / A. */
double gb_world_measure_density(const struct gb_world *world);

/* P_ij = (1/V) sum over pairs of f_i r_j, f the whole force on the first particle, r from
 * the second to it: minus the stress tensor of P1 (16).  E. */
void gb_world_measure_pressure(const struct gb_world *world, double pressure[3][3]);

/* The same, and what fabric tensors are made of. */
void gb_world_measure_tensors(const struct gb_world *world, double pressure[3][3],
                              struct gb_fabric_sums *fabric);

/* The normal pressures P_xx, P_yy, P_zz alone. */
void gb_world_measure_normal_pressures(const struct gb_world *world, double pressure[3]);

#endif
