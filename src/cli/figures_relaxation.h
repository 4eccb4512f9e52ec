#ifndef GB_CLI_FIGURES_RELAXATION_H
#define GB_CLI_FIGURES_RELAXATION_H

#include "cli/figures.h"

/* One row of fitted parameters per group, P2 (4); see struct gb_figures_row. */
bool gb_figures_relaxation(struct gb_series *series, const struct gb_runset *set,
                           const struct gb_figures_request *request,
                           struct gb_error *err);

#endif
