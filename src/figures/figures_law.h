#ifndef GB_FIGURES_FIGURES_LAW_H
#define GB_FIGURES_FIGURES_LAW_H

#include "figures/figures.h"

/* Figures of contact laws, from a preset. */

/* f_n over the overlap: pressed from afar, released before and after a bridge formed; the
 * letters of P1 Fig. 1. */
bool gb_figures_law_contact(struct gb_series *series,
                            const struct gb_figures_input *input, struct gb_error *err);
/* Stress that breaks a bridge of three lengths, P1 Fig. 2. */
bool gb_figures_law_strength(struct gb_series *series,
                             const struct gb_figures_input *input, struct gb_error *err);

#endif
