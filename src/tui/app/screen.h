#ifndef GB_TUI_APP_SCREEN_H
#define GB_TUI_APP_SCREEN_H

#include "tui/app/dialog.h"
#include "tui/panel/panels.h"
#include "tui/term/term_image.h"

/* Everything the screen shows, in one place: app.c changes it, screen.c draws it. */
struct gb_screen {
    struct gb_term *term;
    struct gb_session session;
    struct gb_layout layout;
    enum gb_pane focus;
    struct gb_panel_params params;
    struct gb_panel_plot plot;
    struct gb_panel_events events;
    struct gb_dialog dialog;
    struct gb_term_image image; /* on top of the packing's cells */
    struct gb_message message;  /* "": the focused pane describes itself */
};

/* Draws all of it into curses' memory; what differs from the terminal is sent by
 * gb_term_flush. */
void gb_screen_draw(struct gb_screen *screen);

/* What is to lie on the screen in pixels; NULL: nothing. */
const struct gb_view_sample *gb_screen_sample(const struct gb_screen *screen);

/* The key in that cell of the footer; false: none. */
bool gb_screen_key_at(const struct gb_screen *screen, int row, int col,
                      struct gb_key *key);

#endif
