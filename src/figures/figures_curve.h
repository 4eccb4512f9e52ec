#ifndef GB_FIGURES_FIGURES_CURVE_H
#define GB_FIGURES_FIGURES_CURVE_H

#include "figures/figures.h"

/* Figures over curve.csv of runs. */

/* Coordination number against density, P1 Fig. 8. */
bool gb_figures_curve_coordination(struct gb_series *series,
                                   const struct gb_figures_input *input,
                                   struct gb_error *err);
/* Lateral over axial pressure against density, P1 Fig. 13. */
bool gb_figures_curve_lateral(struct gb_series *series,
                              const struct gb_figures_input *input, struct gb_error *err);
/* Density against pressure with the branches of unloading, P1 Fig. 11, 12. */
bool gb_figures_curve_unloading(struct gb_series *series,
                                const struct gb_figures_input *input,
                                struct gb_error *err);
/* Density gained over that of the smallest particles, against their diameter, P1 Fig. 6.
 */
bool gb_figures_curve_size(struct gb_series *series, const struct gb_figures_input *input,
                           struct gb_error *err);

/* Mean density of a group where loading first reaches a pressure, and its standard error.
 * Errors: GB_ERR_INPUT when no run reaches it. */
bool gb_figures_curve_density(const struct gb_runset *set, size_t group,
                              double pressure_mpa, double *mean, double *error,
                              struct gb_error *err);

/* Mean density of a group, with its standard error, where loading first reaches a
 * pressure.  Errors: GB_ERR_INPUT when no run of the group does. */
bool gb_figures_curve_density(const struct gb_runset *set, size_t group,
                              double pressure_mpa, double *mean, double *error,
                              struct gb_error *err);

#endif
