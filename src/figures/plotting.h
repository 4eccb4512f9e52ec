#ifndef GB_FIGURES_PLOTTING_H
#define GB_FIGURES_PLOTTING_H

#include "figures/series.h"

/* From the series of a figure to its files. */
struct gb_plotting_page {
    int width, height;           /* pixels */
    const char *name;            /* of the figure */
    const char *title;           /* plain text; NULL: none */
    const struct gb_runset *set; /* what it was made from; NULL: from laws */
};

/* Could these files be written: the ending, the folder, and nothing that is there without
 * force. */
bool gb_plotting_check(const char *output, bool force, struct gb_error *err);

/* The figure by the ending of output (.png, .svg, .pdf) with its data beside it, or the
 * data alone (.csv). */
bool gb_plotting_write(const struct gb_series *series,
                       const struct gb_plotting_page *page, const char *output,
                       struct gb_error *err);

/* Points of an experiment: a table with the columns of both axes, and, if it likes,
 * "series" or "branch" (words: one kind of mark each) and "<column>_error". */
bool gb_plotting_data(struct gb_series *series, const char *path, const char *figure,
                      struct gb_error *err);

#endif
