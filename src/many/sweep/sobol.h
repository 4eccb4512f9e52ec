#ifndef GB_MANY_SWEEP_SOBOL_H
#define GB_MANY_SWEEP_SOBOL_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"

/* Coordinate `axis` (0 to 39) of the first points of a Sobol sequence (GSL; Antonov and
 * Saleev, USSR Comput. Maths Math. Phys. 19, 252 (1980)), each in [0, 1).  Errors:
 * GB_ERR_MEMORY. */
bool gb_sobol_coordinate(size_t axis, size_t points, double *share, struct gb_error *err);

#endif
