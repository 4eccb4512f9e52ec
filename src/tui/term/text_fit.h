#ifndef GB_TUI_TERM_TEXT_FIT_H
#define GB_TUI_TERM_TEXT_FIT_H

#include <stddef.h>

/* Texts cut to the room there is.  A cut text ends with an ellipsis and never with a part
 * of a number: "mu 0.15" gives "mu ..." and not "mu 0.1..."; nor with a part of its unit.  Only a text that is one number
 * is cut among its decimals. */

/* The text in at most `cols` cells; g_free. */
char *gb_text_fit(const char *text, int cols);

/* Copies the text into a buffer of `size` bytes.  Returns to. */
char *gb_text_fit_copy(char *to, size_t size, const char *text);

#endif
