#ifndef GB_FIGURES_FIGURES_H
#define GB_FIGURES_FIGURES_H

#include <stdbool.h>
#include <stddef.h>

#include "figures/series.h"

enum { GB_FIGURES_DENSITIES = 64 };

/* What a figure is made from. */
enum gb_figures_takes {
    GB_FIGURES_RUNS,   /* run directories */
    GB_FIGURES_STATES, /* run directories or packings, with their states */
    GB_FIGURES_SCENE,  /* a preset and group.key=value: contact laws */
    GB_FIGURES_TABLE,  /* a directory with a table of its own, in words */
};

/* All that a figure is told. */
struct gb_figures_input {
    const struct gb_runset *set;   /* NULL for GB_FIGURES_SCENE */
    const struct gb_params *scene; /* NULL for the others */
    char *const *words;            /* of the command line */
    size_t reference;              /* group that differences are taken to */
    double density[GB_FIGURES_DENSITIES];
    size_t densities;   /* 0: the figure picks them */
    double pressure_pa; /* 0: the figure picks it */
    const char *at;     /* which kept states; NULL: the last ones */
};

/* A figure: its name, what it shows, what from, the preset of a law's figure when none is
 * given, and the function that computes and describes it. */
struct gb_figures_row {
    const char *name;
    const char *doc;
    enum gb_figures_takes takes;
    const char *preset;
    bool (*compute)(struct gb_series *series, const struct gb_figures_input *input,
                    struct gb_error *err);
};

/* Every figure, ended by a row without name. */
const struct gb_figures_row *gb_figures_all(void);
/* Keys in which runs may differ and still be one group of a figure, NULL at the end: what
 * comes after the branch it shows. */
const char *const *gb_figures_ignored(const struct gb_figures_row *row);
/* NULL when there is none of this name. */
const struct gb_figures_row *gb_figures_find(const char *name);

#endif
