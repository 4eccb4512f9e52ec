#ifndef GB_FIGURES_PLOTTING_H
#define GB_FIGURES_PLOTTING_H

#include "base/table.h"
#include "figures/series.h"

enum gb_plotting_existing { GB_PLOTTING_KEEP, GB_PLOTTING_REPLACE };

/* Page of a figure. */
struct gb_plotting_page {
    int width, height;                  /* pixels */
    const char *name;                   /* of the figure */
    const char *title;                  /* plain text; NULL: none */
    const struct gb_runset *set;        /* source; NULL: contact laws */
    enum gb_plotting_existing existing; /* of a CSV with other data beside the figure */
    int per_inch;                       /* in print; 0: none (image.h) */
};

/* Checks the targets before the work: extension, folder, and an existing output.  Errors:
 * GB_ERR_INPUT. */
bool gb_plotting_check(const char *output, enum gb_plotting_existing existing,
                       struct gb_error *err);

/* Writes the figure in the format of the extension and its data beside it as .csv.  Errors:
 * GB_ERR_INPUT for a CSV with other data that is kept, before anything is written. */
bool gb_plotting_write(const struct gb_series *series,
                       const struct gb_plotting_page *page, const char *output,
                       struct gb_error *err);

/* Adds measured points: a table with the columns of both axes, optionally a column of
 * words (one marker per word: series, or branches as in a curve.csv) and
 * "<column>_error".  Errors: GB_ERR_INPUT. */
bool gb_plotting_data(struct gb_series *series, const struct gb_table *table,
                      struct gb_error *err);

#endif
