#ifndef GB_FIGURES_COMPACTS_COMPACT_TABLE_H
#define GB_FIGURES_COMPACTS_COMPACT_TABLE_H

#include "base/table.h"
#include "figures/figures.h"

/* A table of the directory of `greenbody yield` or `greenbody strength`, which is the one
 * word of the input.
 *
 * columns  `count` names; their numbers go to column
 * Errors: GB_ERR_INPUT (not one word, no such file or column), as gb_table_read. */
bool gb_compact_table_read(struct gb_table **table, const struct gb_figures_input *input,
                           const char *command, const char *file, const char *words,
                           struct gb_error *err);
bool gb_compact_table_columns(const struct gb_table *table, const char *const *names,
                              size_t count, const double **column, struct gb_error *err);

/* The different values of a column in the order of the table, NaN left out; at most `most`.
 *
 * where  NULL: of all rows; else of those in which this column is `equal`
 * Returns how many there are. */
size_t gb_compact_table_distinct(const struct gb_table *table, const double *column,
                                 const double *where, double equal, double *value,
                                 size_t most);

#endif
