#ifndef GB_FIGURES_FIGURES_MEANS_H
#define GB_FIGURES_FIGURES_MEANS_H

#include "figures/figures.h"

/* Computes a figure of means. */
bool gb_figures_means_compute(struct gb_series *series, const struct gb_runset *set,
                              const struct gb_figures_mean *mean, struct gb_error *err);

#endif
