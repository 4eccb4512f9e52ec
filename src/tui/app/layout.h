#ifndef GB_TUI_APP_LAYOUT_H
#define GB_TUI_APP_LAYOUT_H

#include <stdbool.h>

#include "tui/term/term.h"

/* Panes in the order of Tab. */
enum gb_pane { GB_PANE_PARAMS, GB_PANE_PLOT, GB_PANE_STATE, GB_PANE_EVENTS, GB_PANES };

enum gb_layout_kind {
    GB_LAYOUT_TOO_SMALL, /* only a message with the required size */
    GB_LAYOUT_COMPACT,   /* plot and state, or the focused pane */
    GB_LAYOUT_ZOOMED,    /* the focused pane alone */
    GB_LAYOUT_FULL,      /* everything, state below the plot */
    GB_LAYOUT_WIDE       /* everything, state to the right of the plot */
};

enum {
    GB_LAYOUT_MIN_ROWS = 12,
    GB_LAYOUT_MIN_COLS = 40,
    GB_LAYOUT_FULL_ROWS = 24,
    GB_LAYOUT_FULL_COLS = 80
};

/* The first row of a pane is its title.  In full and wide layouts the last column of
 * the parameters is a separator; in wide layouts also the last column of the plot. */
struct gb_layout {
    enum gb_layout_kind kind;
    struct gb_rect header, pane[GB_PANES], message, footer;
};

/* Computes all rectangles from the size and the focus. */
void gb_layout_make(struct gb_layout *layout, int rows, int cols, enum gb_pane focus);

/* Gives the focused pane the whole area between header and message.  Screens that are
 * too small do not change. */
void gb_layout_zoom(struct gb_layout *layout, enum gb_pane focus);

/* Is a pane on the screen? */
bool gb_layout_shows(const struct gb_layout *layout, enum gb_pane pane);

#endif
