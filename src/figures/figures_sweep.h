#ifndef GB_FIGURES_FIGURES_SWEEP_H
#define GB_FIGURES_FIGURES_SWEEP_H

#include "figures/figures.h"

/* Density where loading first reaches a pressure, against the key that was varied most; a
 * line for each value of the others.  Errors: GB_ERR_INPUT when no number differs between
 * the runs, or a group never reaches the pressure. */
bool gb_figures_sweep(struct gb_series *series, const struct gb_figures_input *input,
                      struct gb_error *err);

#endif
