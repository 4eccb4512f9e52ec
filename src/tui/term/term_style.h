#ifndef GB_TUI_TERM_TERM_STYLE_H
#define GB_TUI_TERM_TERM_STYLE_H

#include <stdbool.h>
#include <stdint.h>

/* curses attributes of every enum gb_style for the current terminal: 256, 16, 8 or no
 * colours, none unless `coloured`; the colours and the background of all cells are those
 * of the theme.  True: shades are available, too. */
bool gb_term_style_init(uint64_t *style, bool coloured, int theme);

/* Attributes of a shade on a background of another shade; -1: background of the theme. */
uint64_t gb_term_style_shade(int shade, int back);

#endif
