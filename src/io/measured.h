#ifndef GB_IO_MEASURED_H
#define GB_IO_MEASURED_H

#include <stddef.h>

#include "base/table.h"
#include "greenbody/curve.h"

/* Measured points of density and pressure to compare with a run.  They come from a
 * table whose header names the units: density or density_percent, and p_MPa (or
 * pressure_MPa; also Pa, kPa, GPa).  Errors are optional columns named <column>_error. */
struct gb_measured {
    char *path;
    size_t count;
    double *density, *pressure_pa;
    double *density_error, *pressure_error_pa; /* NaN where none is given */
};

/* Takes the points of a table from gb_lab_reader_read. from_zero: pressures may be 0;
 * otherwise they must be above it.  Errors name file, line and what is expected
 * (GB_ERR_INPUT, GB_ERR_MEMORY). */
bool gb_measured_take(struct gb_measured **out, const struct gb_table *table,
                      bool from_zero, struct gb_error *err);
void gb_measured_destroy(struct gb_measured *measured); /* NULL is fine */

/* Distance of a loading curve from the measured points: differences in density at the
 * same pressure. */
struct gb_measured_misfit {
    size_t reached; /* points whose pressure the curve has reached */
    double mean;    /* of curve minus experiment; NaN while nothing is reached */
    double rms;
    double weighted; /* rms over the errors; NaN unless all reached have one */
};

/* Density at which the first `points` points of a curve first reach a pressure on
 * loading, interpolated between two points; NaN: not reached. */
double gb_measured_density_at(const struct gb_curve *curve, size_t points,
                              double pressure_pa);

void gb_measured_compare(const struct gb_measured *measured, const struct gb_curve *curve,
                         size_t points, struct gb_measured_misfit *out);

#endif
