#ifndef GB_FIGURES_FIGURES_STATE_H
#define GB_FIGURES_FIGURES_STATE_H

#include "figures/figures.h"

/* Figures over the packings that runs keep. */

/* g(r), P1 (14). */
bool gb_figures_state_rdf(struct gb_series *series, const struct gb_figures_input *input,
                          struct gb_error *err);
/* Mean normal force of contacts against the angle of their axis to z, P1 Fig. 14. */
bool gb_figures_state_force(struct gb_series *series,
                            const struct gb_figures_input *input, struct gb_error *err);
/* Distribution of the diameters by number, with the log-normal law P1 (17) of the same
 * mean and variance of the logarithm; and by volume. */
bool gb_figures_state_sizes(struct gb_series *series,
                            const struct gb_figures_input *input, struct gb_error *err);
bool gb_figures_state_volumes(struct gb_series *series,
                              const struct gb_figures_input *input, struct gb_error *err);

#endif
