#ifndef GB_STUDY_PAPERS_PAPERS_PRINTED_H
#define GB_STUDY_PAPERS_PAPERS_PRINTED_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"
#include "io/lab/lab_grid.h"

/* The numbers that the papers print, assets/data/papers.csv; its comment lines describe the
 * columns. */

enum gb_papers_relation {
    GB_PAPERS_EQUAL, /* "=" */
    GB_PAPERS_ABOUT, /* "~" */
    GB_PAPERS_BELOW  /* "<": the value is an upper bound */
};

struct gb_papers_printed {
    const char *paper, *item, *id, *quantity, *condition, *unit, *source;
    const char *digits; /* the value as printed */
    double value;
    double error; /* standard error: printed, rounding of the digits, and "about" */
    enum gb_papers_relation relation;
    double cells;            /* that the paper averages; NaN: not stated */
    const char *figure;      /* "": in none */
    double x, y;             /* its point there */
    double x_error, y_error; /* NaN for the coordinate that is not the value */
    const char *series;
    const char *without; /* why it is not compared; "": it is */
    int line;            /* of the file */
};

struct gb_papers_numbers {
    struct gb_lab_grid grid; /* owns the texts */
    char *path;
    struct gb_papers_printed *row;
    size_t count;
};

/* Reads a file, NULL: the one of the program.  gb_papers_printed_finish is due in any case.
 * Errors: GB_ERR_INPUT with line, column and what is accepted; GB_ERR_MACHINE. */
bool gb_papers_printed_read(struct gb_papers_numbers *numbers, const char *path,
                            struct gb_error *err);
void gb_papers_printed_finish(struct gb_papers_numbers *numbers); /* zeroed is fine */

/* NULL: no number of this id. */
const struct gb_papers_printed *
gb_papers_printed_find(const struct gb_papers_numbers *numbers, const char *id);

#endif
