#ifndef GB_FIGURES_FIGURES_CHART_H
#define GB_FIGURES_FIGURES_CHART_H

#include "figures/figures.h"

/* Bound of the error of a choice of numbers against the processor time of one cell, from
 * the chart.csv of `greenbody chart`. */
bool gb_figures_chart(struct gb_series *series, const struct gb_figures_input *input,
                      struct gb_error *err);

/* Error at one pressure with its standard error, against the evaluations of one cell; the
 * scatter between the seeds as a band. */
bool gb_figures_chart_error(struct gb_series *series,
                            const struct gb_figures_input *input, struct gb_error *err);

#endif
