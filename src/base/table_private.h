#ifndef GB_BASE_TABLE_PRIVATE_H
#define GB_BASE_TABLE_PRIVATE_H

#include "base/table.h"

/* For table.c (from a file) and table_build.c (from arrays). */
struct gb_table {
    char *path;
    char *text; /* names and words; of a file: cut into lines and cells in place */
    size_t length;
    size_t columns, rows;
    char *name[GB_TABLE_COLUMNS_MAX]; /* into text */
    size_t words;                     /* column of words; columns: none */
    size_t units;                     /* column of units beside it, which is skipped */
    size_t wholes;                    /* column of whole numbers; columns: none */
    double *value;                    /* columns x rows */
    uint64_t *whole;                  /* rows; NULL without whole numbers */
    char **word;                      /* rows, into text; NULL without words */
    int *line;                        /* rows */
};

#endif
