#ifndef GB_SCENE_SIZE_TABLE_H
#define GB_SCENE_SIZE_TABLE_H

#include "greenbody/params.h"

/* Tables of particle sizes.  A row is one size, not a class with a width: a share of the
 * particles (or of their volume) has exactly this diameter.  For a histogram take the
 * middles of its classes.
 *
 * A preset names a CSV file, but what the parameters keep, and what is written, is the
 * table itself in one line: a run directory stays whole when the file is gone or changed.
 *   number: 1.5 um 0.25; 2 um 0.75
 *   volume: 100 nm 0.5; 1 um 0.5 */

/* Reads "" (no table), the line above, or the CSV file of that name: '#' comments, a
 * header row, a column `diameter` with units in its cells ("1.5 um") or `diameter_um` (or
 * another unit of length) without, and one column `share_number` or `share_volume`; other
 * columns are ignored.
 * Errors are one line with what is expected, for a file after "path:line: "; table is
 * untouched then. */
bool gb_size_table_read(struct gb_sizetable *table, const char *text,
                        struct gb_error *err);

/* The table in one line that reads back to the same bits.  Returns buffer. */
char *gb_size_table_write(const struct gb_sizetable *table, char *buffer, size_t size);

/* Does the text name a file? */
bool gb_size_table_is_path(const char *text);

/* Diameters finite, positive and ascending, shares not negative and summing to 1 within
 * GB_SIZE_FRACTIONS_TOLERANCE; no rows at all are fine.
 *
 * row   the one that is wrong, from 0; -1: all together; NULL is fine */
bool gb_size_table_check(const struct gb_sizetable *table, int *row,
                         struct gb_error *err);

/* The part of gb_params_check that is about sizes: each distribution has what it needs. */
bool gb_size_table_check_params(const struct gb_params *params, struct gb_error *err);

#endif
