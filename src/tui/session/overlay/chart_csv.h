#ifndef GB_TUI_SESSION_OVERLAY_CHART_CSV_H
#define GB_TUI_SESSION_OVERLAY_CHART_CSV_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"

/* The chart.csv of `greenbody chart`: cost and error of numerical settings. */
struct gb_chart_csv {
    size_t count;
    double *seconds, *error; /* CPU time of one cell; bound of the density error */
    bool *front;             /* on the Pareto front */
    bool *noise;             /* no error exceeds two standard errors */
    size_t chosen;           /* count: none */
    char name[64]; /* of the recommended one: "fire, step 0.1 %, tolerance 0.02" */
};

/* Errors: GB_ERR_INPUT for another table, in one line. */
bool gb_chart_csv_read(struct gb_chart_csv **out, const char *path, struct gb_error *err);
void gb_chart_csv_destroy(struct gb_chart_csv *chart); /* NULL is fine */

#endif
