#ifndef GB_MEASURE_CELL_SCATTER_H
#define GB_MEASURE_CELL_SCATTER_H

#include "greenbody/params.h"

/* Standard deviation of the relative density of one cell at a pressure, from structure to
 * structure: 0.0064 (1000/N)^0.4, through what was measured on the powder of P1 set II:
 * 0.011 for 250 particles, 0.006 for 1000, 0.003 for 8000 at 10 to 100 MPa
 * (docs/accuracy.md).  NaN where it was not measured: 2D, runs with time, dies, lattices
 * and packings of a file. */
double gb_cell_scatter(const struct gb_params *params);

#endif
