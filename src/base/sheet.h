#ifndef GB_BASE_SHEET_H
#define GB_BASE_SHEET_H

#include <glib.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "greenbody/status.h"

/* A table that a command or a study fills and writes.  First the columns, then the cells
 * row by row; a row ends with its last column.  base/table.h reads such tables back.
 *
 *     struct gb_sheet *sheet = gb_sheet_new();
 *     gb_sheet_comment(sheet, "greenbody " GB_VERSION);
 *     gb_sheet_columns(sheet, "%s", "method");
 *     gb_sheet_columns(sheet, "%.8g", "step,ratio");
 *     gb_sheet_text(sheet, "verlet");
 *     gb_sheet_numbers(sheet, (const double[]){0.1, 0.98}, 2);
 *     GString *text = gb_sheet_end(sheet, GB_SHEET_CSV);
 */
struct gb_sheet;

enum gb_sheet_format {
    GB_SHEET_CSV,  /* comments with '#', a row of names, rows; a missing cell is empty */
    GB_SHEET_JSON, /* {"rows": [{name: number, text or null}, ...]} */
    GB_SHEET_MARKDOWN, /* names, a rule, rows */
    GB_SHEET_TEXT      /* aligned columns; a missing cell is "-" */
};

struct gb_sheet *gb_sheet_new(void);
void gb_sheet_free(struct gb_sheet *sheet); /* NULL is fine */

/* Adds lines of comment above the table.  Empty lines are left out.  NULL is fine. */
void gb_sheet_comment(struct gb_sheet *sheet, const char *lines);

/* Adds a line of comment above the next row, or below the last.  Only CSV has comments. */
void gb_sheet_note(struct gb_sheet *sheet, const char *line);

/* CSV gets every name and every cell in quotes, as spreadsheets write it. */
void gb_sheet_quote(struct gb_sheet *sheet);

/* Adds columns: names separated by commas, or one name by a printf format.
 *
 * format  how cells are printed, a constant.  Numbers: a printf format for one double, as
 *         "%.8g", or "" for all its digits; "%.0f" for integers.  Texts: "%s", or "\"%s\"" for quotes in CSV
 *         also where they are not needed, or "`%s`" for code in Markdown. */
void gb_sheet_columns(struct gb_sheet *sheet, const char *format, const char *names);
void gb_sheet_column(struct gb_sheet *sheet, const char *format, const char *name, ...)
    G_GNUC_PRINTF(3, 4);

/* Fill the next cell.  A number that is not finite, and NULL, is missing. */
void gb_sheet_number(struct gb_sheet *sheet, double value);
void gb_sheet_numbers(struct gb_sheet *sheet, const double *value, size_t count);
void gb_sheet_whole(struct gb_sheet *sheet, uint64_t value);
void gb_sheet_text(struct gb_sheet *sheet, const char *text);

/* The text of a sheet (g_string_free); _end frees the sheet as well. */
GString *gb_sheet_print(const struct gb_sheet *sheet, enum gb_sheet_format format);
GString *gb_sheet_end(struct gb_sheet *sheet, enum gb_sheet_format format);

/* Replaces DIRECTORY/NAME by the sheet as CSV, as a whole, and frees the sheet.  Errors: of
 * gb_file_replace. */
bool gb_sheet_store(struct gb_sheet *sheet, const char *directory, const char *name,
                    struct gb_error *err);

#endif
