#ifndef GB_FIGURES_PAPERS_FIGURES_H
#define GB_FIGURES_PAPERS_FIGURES_H

#include "figures/figures.h"
#include "study/papers.h"

/* Adds the numbers that the papers print for a figure (assets/data/papers.csv) as hollow
 * marks with their errors, where a run of the set is of the scene that they are compared
 * with, whatever its size and numerics.  *drawn: how many; NULL is fine.  Errors: those of
 * the file. */
bool gb_papers_figures_add(struct gb_series *series, const struct gb_figures_row *figure,
                           const struct gb_runset *set, size_t *drawn,
                           struct gb_error *err);

/* Figures of the papers over the runs of a plan, with the printed numbers. */

/* Draws those whose experiments are selected as PNG, with its CSV, into the directory of
 * the plan.  *figures: count of them, for gb_papers_figures_finish.  A figure without data
 * says why and is no error.  Errors: GB_ERR_MACHINE. */
bool gb_papers_figures_draw(const struct gb_papers_plan *plan,
                            struct gb_papers_figure **figures, size_t *count,
                            struct gb_error *err);
void gb_papers_figures_finish(struct gb_papers_figure *figures, size_t count);

#endif
