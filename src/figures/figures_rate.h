#ifndef GB_FIGURES_FIGURES_RATE_H
#define GB_FIGURES_FIGURES_RATE_H

#include "figures/figures.h"

/* Pressure at given densities against the rate, P2 (9); see struct gb_figures_row. */
bool gb_figures_rate(struct gb_series *series, const struct gb_figures_input *input,
                     struct gb_error *err);

/* All runs are dynamic, or an error that names the figure. */
bool gb_figures_rate_check(const struct gb_runset *set, const char *figure,
                           struct gb_error *err);

#endif
