#ifndef GB_TUI_TERM_TERM_STYLE_H
#define GB_TUI_TERM_TERM_STYLE_H

#include <stdbool.h>
#include <stdint.h>

/* curses attributes of every enum gb_style for the terminal that was just started: 256,
 * 16, 8 or no colours, none unless coloured; the background stays the terminal's own.
 * True: it has the shades, too. */
bool gb_term_style_init(uint64_t *style, bool coloured);

/* Attributes of a shade before a background of another, -1: the terminal's own. */
uint64_t gb_term_style_shade(int shade, int back);

#endif
