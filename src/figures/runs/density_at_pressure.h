#ifndef GB_FIGURES_RUNS_DENSITY_AT_PRESSURE_H
#define GB_FIGURES_RUNS_DENSITY_AT_PRESSURE_H

#include "many/runset.h"

/* Mean relative density of a group where loading first reaches a pressure, with its
 * standard error (NaN for one run), over the runs that reach it.  Returns their number.
 * Errors: 0 and GB_ERR_INPUT when no run reaches it. */
size_t gb_density_at_pressure(const struct gb_runset *set, size_t group,
                              double pressure_mpa, double *mean, double *error,
                              struct gb_error *err);

#endif
