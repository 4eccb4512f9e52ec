#ifndef GB_BASE_TABLE_H
#define GB_BASE_TABLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "greenbody/status.h"

/* A table of numbers, such as curve.csv: comment lines with '#', one header row of
 * names, then rows with the same number of cells, separated by commas.  An empty cell
 * is NaN.  One column may contain words, and a column `unit` may contain their units. */
struct gb_table;

enum {
    GB_TABLE_BYTES_MAX = 1 << 28,
    GB_TABLE_COLUMNS_MAX = 256,
    GB_TABLE_CELLS_MAX = 1 << 25
};

/* Reads a regular file.
 *
 * words   name of the column of words; NULL: no such column, nor a column of units
 * Errors are one line "path:line: what was read, what is expected": GB_ERR_INPUT for
 * the contents of the file, GB_ERR_MACHINE if it cannot be read, GB_ERR_MEMORY. nan,
 * inf, quotes, NUL bytes and rows of another length are refused. */
bool gb_table_read(struct gb_table **out, const char *path, const char *words,
                   struct gb_error *err);
/* The same with a column of whole numbers from 0 to 2^64 - 1, such as seeds, which a
 * double cannot represent.  Anything else in this column is an error. */
bool gb_table_read_whole(struct gb_table **out, const char *path, const char *words,
                         const char *whole, struct gb_error *err);
void gb_table_destroy(struct gb_table *table); /* NULL is fine */

const char *gb_table_path(const struct gb_table *table);
size_t gb_table_rows(const struct gb_table *table);

/* Name of a column; NULL after the last. */
const char *gb_table_name(const struct gb_table *table, size_t column);

/* Line of the file that contains a row, from 1. */
int gb_table_line(const struct gb_table *table, size_t row);

/* The numbers of a column, valid as long as the table.  NULL and err (NULL is fine)
 * listing the columns if there is no such column. */
const double *gb_table_column(const struct gb_table *table, const char *name,
                              struct gb_error *err);

/* The column of whole numbers, valid as long as the table; NULL: none. */
const uint64_t *gb_table_whole(const struct gb_table *table);

/* Name of the column of words; NULL: none. */
const char *gb_table_words(const struct gb_table *table);

/* The word of a row; "" without a column of words. */
const char *gb_table_word(const struct gb_table *table, size_t row);

/* Contents of a table from a source other than gb_table_read. */
struct gb_table_content {
    const char *path;        /* for messages */
    const char *const *name; /* columns */
    size_t columns, rows;
    const double *const *value; /* per column; NULL: the column of words */
    const char *const *word;    /* per row; NULL: no column of words */
    const int *line;            /* per row: line of the file */
};

/* Creates a table with a copy of the contents (gb_table_destroy).  Errors:
 * GB_ERR_MEMORY. */
bool gb_table_build(struct gb_table **out, const struct gb_table_content *content,
                    struct gb_error *err);

/* Removes the rows with another word. */
void gb_table_keep(struct gb_table *table, const char *word);

#endif
