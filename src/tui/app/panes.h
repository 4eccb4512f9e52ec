#ifndef GB_TUI_APP_PANES_H
#define GB_TUI_APP_PANES_H

#include "tui/app/screen.h"

/* One row per pane; NULL: not supported. */
struct gb_pane_type {
    void (*draw)(struct gb_screen *screen, const struct gb_paint *paint,
                 enum gb_paint_focus focus);
    void (*navigate)(struct gb_screen *screen, enum gb_action action);
    void (*click)(struct gb_screen *screen, int row, int col);
    void (*describe)(struct gb_screen *screen, struct gb_message *message);
    /* What is under the cursor, for the clipboard (g_free); NULL: nothing. */
    char *(*copied)(struct gb_screen *screen);
};

const struct gb_pane_type *gb_panes_type(enum gb_pane pane);

#endif
