#ifndef GB_TUI_TERM_STYLE_H
#define GB_TUI_TERM_STYLE_H

#include <stdint.h>

/* curses attributes of every enum gb_style for the terminal that was just started: 256,
 * 16, 8 or no colours; NO_COLOR is honoured; the background stays the terminal's own. */
void gb_term_style_init(uint64_t *style);

#endif
