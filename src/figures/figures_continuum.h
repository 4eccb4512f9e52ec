#ifndef GB_FIGURES_FIGURES_CONTINUUM_H
#define GB_FIGURES_FIGURES_CONTINUUM_H

#include "figures/figures.h"

/* The runs, and what the continuum theory foretells for the three geometries from the
 * uniaxial ones among them, P1 Fig. 12.  Errors: GB_ERR_INPUT without uniaxial runs. */
bool gb_figures_continuum(struct gb_series *series, const struct gb_figures_input *input,
                          struct gb_error *err);

#endif
