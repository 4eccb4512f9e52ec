#ifndef GB_IO_RUNS_RUN_LAST_POINT_H
#define GB_IO_RUNS_RUN_LAST_POINT_H

#include <stdbool.h>

/* Density and pressure (Pa) of the last complete row of DIRECTORY/curve.csv, from its two
 * ends: the time does not grow with the number of points.  False: there is no row. */
bool gb_run_last_point_read(const char *directory, double *density, double *pressure_pa);

#endif
