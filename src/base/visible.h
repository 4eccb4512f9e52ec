#ifndef GB_BASE_VISIBLE_H
#define GB_BASE_VISIBLE_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include <glib.h>

/* Printing of text that may contain control sequences of a terminal, as names of files,
 * titles and messages may.  ASCII control characters become "\x1b", U+0080 to U+009F
 * "\u009b", bytes that are not UTF-8 "\xff"; other UTF-8 is unchanged.  All output of
 * the program uses gb_visible_print, _line or _put. */

/* Copies as many whole characters and escapes of the text as fit into size bytes. */
void gb_visible_copy(char *to, size_t size, const char *text);

/* The escaped text (g_free).  Control characters in `kept` are not escaped. */
char *gb_visible_text(const char *text, const char *kept);

/* Adds text to a table that a spreadsheet may open.  A cell that begins with =, +, - or
 * @ and is not a number would be a formula there, so a "'" is put before it.
 *
 * cell   the text begins a cell; false: something precedes it, as in a comment */
void gb_visible_add_cell(GString *to, const char *text, bool cell);

/* Prints to a terminal or a pipe; newlines and tabs are kept.  False: see errno. */
bool gb_visible_put(FILE *to, const char *text);
bool gb_visible_print(FILE *to, const char *format, ...) G_GNUC_PRINTF(2, 3);

/* Prints one line: escapes newlines in it and adds one at its end. */
bool gb_visible_line(FILE *to, const char *format, ...) G_GNUC_PRINTF(2, 3);
bool gb_visible_line_of(FILE *to, const char *format, va_list arguments)
    G_GNUC_PRINTF(2, 0);

/* Replaces the current line of a terminal, of which `width` columns are used; "" only
 * clears it. */
void gb_visible_rewrite(FILE *to, int width, const char *line);

#endif
