#ifndef GB_FIGURES_CHART_CHART_COLUMNS_H
#define GB_FIGURES_CHART_CHART_COLUMNS_H

#include "base/table.h"
#include "figures/figures.h"

/* Columns of the chart.csv of `greenbody chart`: one row per setting, that is relaxer,
 * particle number and numerical choices.  Errors are fractions of the density. */
struct gb_chart_columns {
    struct gb_table *table;
    const double *particles, *bound, *cpu_s, *front, *chosen;
    /* at one pressure */
    const double *evaluations, *reference, *seeds, *error, *error_se, *scatter;
};

/* A column of the table and its member above. */
struct gb_chart_columns_request {
    const char *name;
    const double **column;
};

/* Reads the table of the one directory or file in input->words.  Errors: GB_ERR_INPUT. */
bool gb_chart_columns_read(struct gb_chart_columns *chart,
                           const struct gb_figures_input *input, struct gb_error *err);
bool gb_chart_columns_find(const struct gb_chart_columns *chart,
                           const struct gb_chart_columns_request *request, size_t count,
                           struct gb_error *err);

/* Whether two rows have one relaxer and particle number. */
bool gb_chart_columns_same_kind(const struct gb_chart_columns *chart, size_t a, size_t b);

/* "relaxer, N = particles" of a row, as Pango markup. */
enum { GB_CHART_COLUMNS_NAME = 80 };
void gb_chart_columns_name(const struct gb_chart_columns *chart, size_t row,
                           char label[GB_CHART_COLUMNS_NAME]);

/* Calls draw with the first row of every kind. */
typedef void gb_chart_columns_draw(struct gb_series *series,
                                   const struct gb_chart_columns *chart, size_t first,
                                   int style);
void gb_chart_columns_each(struct gb_series *series, const struct gb_chart_columns *chart,
                           gb_chart_columns_draw *draw);

#endif
