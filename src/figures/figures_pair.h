#ifndef GB_FIGURES_FIGURES_PAIR_H
#define GB_FIGURES_FIGURES_PAIR_H

#include "figures/figures.h"

/* Figures of two bodies in contact, P3, from a preset of a pair: elastic and plastic law
 * for the exponents of hardening of P3. */

/* Force against indentation, P3 Fig. 10 and 11. */
bool gb_figures_pair_force(struct gb_series *series, const struct gb_figures_input *input,
                           struct gb_error *err);
/* Critical time step against indentation, P3 Fig. 12. */
bool gb_figures_pair_step(struct gb_series *series, const struct gb_figures_input *input,
                          struct gb_error *err);

#endif
