#ifndef GB_FIGURES_FIGURES_RELAXATION_H
#define GB_FIGURES_FIGURES_RELAXATION_H

#include "figures/figures.h"

/* One row of fitted parameters per group, P2 (4); see struct gb_figures_row. */
bool gb_figures_relaxation(struct gb_series *series, const struct gb_figures_input *input,
                           struct gb_error *err);

/* The mean relaxation of each group with its fit, over log t. */
bool gb_figures_relaxation_curve(struct gb_series *series,
                                 const struct gb_figures_input *input,
                                 struct gb_error *err);

#endif
