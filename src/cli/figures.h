#ifndef GB_CLI_FIGURES_H
#define GB_CLI_FIGURES_H

#include <stdbool.h>
#include <stddef.h>

#include "cli/series.h"

enum { GB_FIGURES_DENSITIES = 64 };

/* What a figure may be told besides its runs. */
struct gb_figures_request {
    size_t reference; /* group that differences are taken to */
    double density[GB_FIGURES_DENSITIES];
    size_t densities; /* 0: the figure picks them */
};

/* A figure: its name, what it shows, and the function that computes its data. */
struct gb_figures_row {
    const char *name;
    const char *doc;
    bool (*compute)(struct gb_series *series, const struct gb_runset *set,
                    const struct gb_figures_request *request, struct gb_error *err);
};

/* Every figure, ended by a row without name. */
const struct gb_figures_row *gb_figures_all(void);
/* NULL when there is none of this name. */
const struct gb_figures_row *gb_figures_find(const char *name);

#endif
