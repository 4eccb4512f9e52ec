#ifndef GB_FIGURES_FIGURES_DIE_H
#define GB_FIGURES_FIGURES_DIE_H

#include "figures/figures.h"

/* Change of the height of the powder over its height before pressing, against the
 * pressure, P3 Fig. 17. */
bool gb_figures_die_height(struct gb_series *series, const struct gb_figures_input *input,
                           struct gb_error *err);
/* Density of the whole specimen and of the ball in its middle against the pressure, P3
 * Fig. 18 to 20. */
bool gb_figures_die_density(struct gb_series *series,
                            const struct gb_figures_input *input, struct gb_error *err);

#endif
