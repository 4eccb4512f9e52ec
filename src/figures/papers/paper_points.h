#ifndef GB_FIGURES_PAPERS_PAPER_POINTS_H
#define GB_FIGURES_PAPERS_PAPER_POINTS_H

#include "figures/figures.h"

/* Adds the numbers that the papers print for a figure (assets/data/papers.csv) as hollow
 * marks with their errors, where a run of the set is of the scene that they are compared
 * with, whatever its size and numerics.  *drawn: how many; NULL is fine.  Errors: those of
 * the file. */
bool gb_paper_points_add(struct gb_series *series, const struct gb_figures_row *figure,
                         const struct gb_runset *set, size_t *drawn,
                         struct gb_error *err);

#endif
