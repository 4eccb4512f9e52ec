#ifndef GB_BASE_LISTING_H
#define GB_BASE_LISTING_H

#include <glib.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "greenbody/status.h"

/* A table that a command or a study fills and writes.  Define the columns first, then
 * fill the cells row by row; a row ends with its last column. base/table.h reads such
 * tables back.
 *
 *     struct gb_listing *listing = gb_listing_new();
 *     gb_listing_comment(listing, "greenbody " GB_VERSION);
 *     gb_listing_columns(listing, "%s", "method");
 *     gb_listing_columns(listing, "%.8g", "step,ratio");
 *     gb_listing_text(listing, "verlet");
 *     gb_listing_numbers(listing, (const double[]){0.1, 0.98}, 2);
 *     GString *text = gb_listing_end(listing, GB_LISTING_CSV); */
struct gb_listing;

enum gb_listing_format {
    GB_LISTING_CSV, /* comments with '#', a row of names, rows; a missing cell is empty */
    GB_LISTING_JSON,     /* {"rows": [{name: number, text or null}, ...]} */
    GB_LISTING_MARKDOWN, /* names, a rule, rows */
    GB_LISTING_TEXT      /* aligned columns; a missing cell is "-" */
};

struct gb_listing *gb_listing_new(void);
void gb_listing_free(struct gb_listing *listing); /* NULL is fine */

/* Adds comment lines above the table.  Empty lines are omitted.  NULL is fine. */
void gb_listing_comment(struct gb_listing *listing, const char *lines);

/* Adds a comment line above the next row, or after the last row.  CSV only. */
void gb_listing_note(struct gb_listing *listing, const char *line);

/* Quotes every name and cell in CSV, as spreadsheets do. */
void gb_listing_quote(struct gb_listing *listing);

/* Adds columns: names separated by commas, or one name from a printf format.
 *
 * format  how cells are printed, a constant.  Numbers: a printf format for one double, as
 *         "%.8g", or "" for all digits; "%.0f" for integers.  Texts: "%s"; "\"%s\"" to
 *         quote always in CSV; "`%s`" for code in Markdown. */
void gb_listing_columns(struct gb_listing *listing, const char *format,
                        const char *names);
void gb_listing_column(struct gb_listing *listing, const char *format, const char *name,
                       ...) G_GNUC_PRINTF(3, 4);

/* Fill the next cell.  A number that is not finite and a NULL text are missing cells. */
void gb_listing_number(struct gb_listing *listing, double value);
void gb_listing_numbers(struct gb_listing *listing, const double *value, size_t count);
void gb_listing_whole(struct gb_listing *listing, uint64_t value);
void gb_listing_text(struct gb_listing *listing, const char *text);

/* Returns the text of a listing (g_string_free); _end also frees the listing. */
GString *gb_listing_print(const struct gb_listing *listing,
                          enum gb_listing_format format);
GString *gb_listing_end(struct gb_listing *listing, enum gb_listing_format format);

/* Replaces DIRECTORY/NAME by the listing as CSV and frees the listing.  Errors: see
 * gb_file_replace. */
bool gb_listing_store(struct gb_listing *listing, const char *directory, const char *name,
                      struct gb_error *err);

#endif
