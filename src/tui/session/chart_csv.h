#ifndef GB_TUI_SESSION_CHART_CSV_H
#define GB_TUI_SESSION_CHART_CSV_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"

/* The table of numerical choices that `greenbody chart` writes (chart.csv): what each one
 * costs and how far it errs. */
struct gb_chart_csv {
    size_t count;
    double *seconds, *error; /* of CPU time a cell; bound of the error in density */
    bool *front;             /* nothing is both cheaper and better */
    size_t chosen;           /* count: none */
    char name[64];           /* of the chosen one: "fire, step 0.1 %, tolerance 0.02" */
};

/* Errors: one line (GB_ERR_INPUT when it is another table). */
bool gb_chart_csv_read(struct gb_chart_csv **out, const char *path, struct gb_error *err);
void gb_chart_csv_destroy(struct gb_chart_csv *chart); /* NULL is fine */

#endif
