#ifndef GB_TUI_SESSION_OVERLAY_CHART_CSV_H
#define GB_TUI_SESSION_OVERLAY_CHART_CSV_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"
#include "study/chart/chart.h"

/* The chart.csv of `greenbody chart`: cost and error of numerical settings. */
struct gb_chart_csv {
    size_t count;
    struct gb_chart_setting *setting; /* relaxer "": the row has no setting */
    double *seconds, *error; /* CPU time of one cell; bound of the density error */
    double reference_s;      /* CPU time of a cell of the reference; NaN: not known */
    bool *front;             /* on the Pareto front */
    bool *noise;             /* no error exceeds two standard errors */
    size_t chosen;           /* count: none */
    char name[64];   /* of the recommended one: "fire, step 0.1 %, tolerance 0.02" */
    size_t *by_cost; /* rows with an error, the cheapest first */
    size_t known;    /* of these */
};

/* Errors: GB_ERR_INPUT for another table, in one line. */
bool gb_chart_csv_read(struct gb_chart_csv **out, const char *path, struct gb_error *err);
/* Whether row i is known: it has a cost and an error. */
bool gb_chart_csv_is_known(const struct gb_chart_csv *chart, size_t i);
/* The parameters with the setting of row i.  The number of particles stays where the row
 * has that of the chart's own scene. */
void gb_chart_csv_apply(const struct gb_chart_csv *chart, size_t i,
                        struct gb_params *params);

void gb_chart_csv_destroy(struct gb_chart_csv *chart); /* NULL is fine */

#endif
