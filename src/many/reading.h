#ifndef GB_MANY_READING_H
#define GB_MANY_READING_H

#include <stdbool.h>

#include "base/table.h"

/* Figures of a finished run at a pressure, for the tables of sweeps and for
 * calibration. */
enum gb_reading_quantity {
    GB_READING_DENSITY,
    GB_READING_COORDINATION,
    GB_READING_BRIDGED,
    GB_READING_RATTLERS,
    GB_READING_PX, /* MPa */
    GB_READING_PY,
    GB_READING_PZ,
    GB_READING_QUANTITIES
};

/* Column of curve.csv with this quantity. */
const char *gb_reading_name(enum gb_reading_quantity quantity);

/* Reads curve.csv of a run directory (gb_table_destroy).  Errors: see gb_table_read;
 * missing columns. */
bool gb_reading_open(struct gb_table **out, const char *directory, struct gb_error *err);

/* The figures where the pressure over the compressed axes first reaches pressure_pa on
 * loading, interpolated linearly.  False, and all NaN, if it never does. */
bool gb_reading_loaded(const struct gb_table *curve, double pressure_pa,
                       double values[GB_READING_QUANTITIES]);

/* The figures after unloading from pressure_pa: the last point of this branch. */
bool gb_reading_unloaded(const struct gb_table *curve, double pressure_pa,
                         double values[GB_READING_QUANTITIES]);

/* Secant modulus of unloading from pressure_pa to half of it, Pa: the fall of the
 * pressure over the logarithm of the density ratio, which is the axial strain if the
 * side walls are fixed.  NaN if the branch is missing. */
double gb_reading_unloading_modulus(const struct gb_table *curve, double pressure_pa);

#endif
