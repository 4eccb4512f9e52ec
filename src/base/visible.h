#ifndef GB_BASE_VISIBLE_H
#define GB_BASE_VISIBLE_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include <glib.h>

/* Text that cannot drive a terminal: names of files, titles and messages of files may hold
 * its control sequences.  Control characters of ASCII become "\x1b", those of U+0080 to
 * U+009F "\u009b", bytes that are no UTF-8 "\xff"; other UTF-8 stays.  All that the program
 * prints goes through gb_visible_print, _line or _put. */

/* Copies text, as far as whole characters and escapes fit into size bytes. */
void gb_visible_copy(char *to, size_t size, const char *text);

/* The text in newly allocated memory (g_free).  Control characters named in kept stay. */
char *gb_visible_text(const char *text, const char *kept);

/* Adds text to a table that a spreadsheet may open.  Where a cell would begin with =, +, - or @
 * and is no number, it would be a formula there: a "'" goes in front.
 *
 * cell   the text begins a cell; false: something precedes it, as in a comment */
void gb_visible_add_cell(GString *to, const char *text, bool cell);

/* Prints to a terminal or a pipe; new lines and tabs stay.  False: errno says why. */
bool gb_visible_put(FILE *to, const char *text);
bool gb_visible_print(FILE *to, const char *format, ...) G_GNUC_PRINTF(2, 3);

/* One line: a new line in it is escaped too, the one at its end is added. */
bool gb_visible_line(FILE *to, const char *format, ...) G_GNUC_PRINTF(2, 3);
bool gb_visible_line_of(FILE *to, const char *format, va_list arguments)
    G_GNUC_PRINTF(2, 0);

/* Replaces the line at the cursor of a terminal, of which `width` columns are in use; "" only
 * clears it. */
void gb_visible_rewrite(FILE *to, int width, const char *line);

#endif
