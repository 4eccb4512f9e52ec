#ifndef GB_BASE_TABLE_H
#define GB_BASE_TABLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "greenbody/status.h"

/* A table of numbers as curve.csv has it: '#' comment lines, one header row of names,
 * rows of as many cells separated by commas; an empty cell is NaN.  One column may hold
 * words, and a column `unit` beside it theirs. */
struct gb_table;

enum {
    GB_TABLE_BYTES_MAX = 1 << 28,
    GB_TABLE_COLUMNS_MAX = 256,
    GB_TABLE_CELLS_MAX = 1 << 25
};

/* Reads a regular file.
 *
 * words   name of the column that holds words; NULL: there is none, nor one of units
 * Errors are one line "path:line: what was read, what is accepted": GB_ERR_INPUT for
 * anything in the file, GB_ERR_MACHINE when it cannot be read, GB_ERR_MEMORY.  nan, inf,
 * quotes, NUL bytes and rows of another length are refused. */
bool gb_table_read(struct gb_table **out, const char *path, const char *words,
                   struct gb_error *err);
/* The same with a column of whole numbers from 0 to 2^64 - 1, as of seeds, which a double
 * does not keep; anything else in it is refused. */
bool gb_table_read_whole(struct gb_table **out, const char *path, const char *words,
                         const char *whole, struct gb_error *err);
void gb_table_destroy(struct gb_table *table); /* NULL is fine */

const char *gb_table_path(const struct gb_table *table);
size_t gb_table_rows(const struct gb_table *table);

/* Name of a column; NULL behind the last. */
const char *gb_table_name(const struct gb_table *table, size_t column);

/* Line of the file that a row stands in, from 1. */
int gb_table_line(const struct gb_table *table, size_t row);

/* The numbers of a column, as long as the table lives; NULL and err (NULL is fine) naming
 * the columns when there is no such. */
const double *gb_table_column(const struct gb_table *table, const char *name,
                              struct gb_error *err);

/* The column of whole numbers, as long as the table lives; NULL: there is none. */
const uint64_t *gb_table_whole(const struct gb_table *table);

/* The name of the column of words; NULL: there is none. */
const char *gb_table_words(const struct gb_table *table);

/* The word of a row; "" when the column of words is missing. */
const char *gb_table_word(const struct gb_table *table, size_t row);

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
void gb_table_keep(struct gb_table *table, const char *word);

#endif
