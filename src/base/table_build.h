#ifndef GB_BASE_TABLE_BUILD_H
#define GB_BASE_TABLE_BUILD_H

#include "base/table.h"

/* Tables that come from elsewhere than a file in the format of gb_table_read. */
struct gb_table_content {
    const char *path;        /* for messages */
    const char *const *name; /* columns */
    size_t columns, rows;
    const double *const *value; /* columns; NULL: the column of words */
    const char *const *word;    /* rows; NULL: there is no column of words */
    const int *line;            /* rows: lines of the file */
};

/* A copy of the content, for gb_table_destroy.  Errors: GB_ERR_MEMORY. */
bool gb_table_build(struct gb_table **out, const struct gb_table_content *content,
                    struct gb_error *err);

/* Leaves out the rows with another word. */
void gb_table_build_keep(struct gb_table *table, const char *word);

#endif
