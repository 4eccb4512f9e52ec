#ifndef GB_FIGURES_FIGURES_H
#define GB_FIGURES_FIGURES_H

#include <stdbool.h>
#include <stddef.h>

#include "figures/series.h"

/* The table of figures.  A figure is a row in one of the files figures_NAME.c.  A mean of Y over
 * X needs no more than its row; other figures have a function above it.  Help, checks of
 * options and the report follow from the row. */

enum { GB_FIGURES_DENSITIES = 64 };

/* Source of the data. */
enum gb_figures_takes {
    GB_FIGURES_RUNS,   /* run directories: their curve.csv */
    GB_FIGURES_STATES, /* run directories or packings: their states */
    GB_FIGURES_SCENE,  /* a preset and group.key=value: contact laws */
    GB_FIGURES_TABLE,  /* the directory of a study: `greenbody chart`, `card`, `moduli`,
                        * `yield`, `strength` */
};

/* Options of the command line that a figure reads. */
enum gb_figures_options {
    GB_FIGURES_REFERENCE = 1, /* required where read */
    GB_FIGURES_DENSITY = 2,
    GB_FIGURES_PRESSURE = 4,
    GB_FIGURES_AT = 8,
};

/* Whether the report of some runs contains the figure. */
enum gb_figures_report {
    GB_FIGURES_ON_REQUEST, /* plot alone: needs options, or compares chosen runs */
    GB_FIGURES_IN_REPORT,
};

struct gb_figures_input {
    const struct gb_runset *set;   /* NULL for scenes and tables */
    const struct gb_params *scene; /* NULL for the others */
    char *const *words;            /* arguments of the command line */
    size_t reference;              /* group that is subtracted */
    double density[GB_FIGURES_DENSITIES];
    size_t densities;   /* 0: default of the figure */
    double pressure_pa; /* 0: default of the figure */
    const char *at;     /* point of the kept states; NULL: the last state */
};

/* Fills a series that is zeroed.  Errors: GB_ERR_INPUT when the input has no data for the
 * figure, in one line. */
typedef bool gb_figures_compute(struct gb_series *series,
                                const struct gb_figures_input *input,
                                struct gb_error *err);

/* The usual figure: means of the groups. */
struct gb_figures_mean {
    const char *branch;        /* of curve.csv; NULL: all */
    const char *x, *y;         /* columns of curve.csv */
    const char *over;          /* y is divided by this column; NULL: it is not */
    const char *column, *unit; /* name of the columns: NAME_1UNIT and se_1UNIT */
    bool runs;                 /* every run, too */
    bool unrelaxed;            /* points that are not in equilibrium, too */
    /* Adds more to the means; NULL: nothing. */
    bool (*more)(struct gb_series *series, const struct gb_runset *set, const double *x,
                 struct gb_error *err);
};

struct gb_figures_row {
    const char *name;
    const char *doc;    /* quantity against quantity */
    const char *source; /* papers and their figures; "": none */
    enum gb_figures_takes takes;
    enum gb_figures_report report;
    unsigned options;                /* sum of gb_figures_options */
    const char *preset;              /* default scene of a contact law */
    const char *const *ignored_keys; /* runs that differ in these only are one group */
    struct gb_series_axis x, y;      /* name NULL: set by the function */
    gb_figures_compute *compute;     /* NULL: a figure of means */
    struct gb_figures_mean mean;
};

/* Axes that many figures have. */
#define GB_FIGURES_DENSITY_AXIS                                                          \
    {                                                                                    \
        .name = "density", .label = "relative density <i>ρ</i>"                         \
    }
#define GB_FIGURES_PRESSURE_AXIS                                                         \
    {                                                                                    \
        .name = "p_MPa", .label = "pressure <i>p</i> (MPa)"                              \
    }

/* Keys of what follows the loading branch. */
extern const char *const gb_figures_after_loading[];

extern const struct gb_figures_row gb_figures_means_rows[];
extern const struct gb_figures_row gb_figures_rates_rows[];
extern const struct gb_figures_row gb_figures_runs_rows[];
extern const struct gb_figures_row gb_figures_packings_rows[];
extern const struct gb_figures_row gb_figures_die_rows[];
extern const struct gb_figures_row gb_figures_laws_rows[];
extern const struct gb_figures_row gb_figures_compacts_rows[];
extern const struct gb_figures_row gb_figures_chart_rows[];

/* Figure 0, 1, ...; NULL after the last. */
const struct gb_figures_row *gb_figures_at(size_t number);
/* NULL: no figure of this name. */
const struct gb_figures_row *gb_figures_find(const char *name);
/* Groups runs that differ in the ignored keys of the row only. */
void gb_figures_group(const struct gb_figures_row *row, struct gb_runset *set);
/* Sets the axes of the row where it has them. */
void gb_figures_axes(const struct gb_figures_row *row, struct gb_series *series);
/* Computes the series with the axes of the row. */
bool gb_figures_run(const struct gb_figures_row *row, struct gb_series *series,
                    const struct gb_figures_input *input, struct gb_error *err);

/* Computes a figure of means.  Errors: a missing column, no points. */
bool gb_figures_means_compute(struct gb_series *series, const struct gb_runset *set,
                              const struct gb_figures_mean *mean, struct gb_error *err);

/* "doc (source)"; g_free. */
char *gb_figures_describe(const struct gb_figures_row *row);
/* Names of the figures that read all of these options (0: of all figures), separated by
 * commas; g_free. */
char *gb_figures_names(unsigned options);
/* Checks given options against those that the figure reads.  Errors: GB_ERR_INPUT naming
 * the figures of a wrong option, or the option that is missing. */
bool gb_figures_check_options(const struct gb_figures_row *row, unsigned given,
                              struct gb_error *err);

#endif
