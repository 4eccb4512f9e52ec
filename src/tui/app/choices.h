#ifndef GB_TUI_APP_CHOICES_H
#define GB_TUI_APP_CHOICES_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"

/* The table of numerical choices that `greenbody chart` writes (chart.csv): what each one
 * costs and how far it errs. */
struct gb_choices {
    size_t count;
    double *seconds, *error; /* of CPU time a cell; bound of the error in density */
    bool *front;             /* nothing is both cheaper and better */
    size_t chosen;           /* count: none */
    char name[64];           /* of the chosen one: "fire, step 0.1 %, tolerance 0.02" */
};

/* Errors: one line (GB_ERR_INPUT when it is another table). */
bool gb_choices_read(struct gb_choices **out, const char *path, struct gb_error *err);
void gb_choices_destroy(struct gb_choices *choices); /* NULL is fine */

#endif
