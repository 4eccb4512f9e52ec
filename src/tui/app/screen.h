#ifndef GB_TUI_APP_SCREEN_H
#define GB_TUI_APP_SCREEN_H

#include "tui/app/dialog.h"
#include "tui/panel/panels.h"
#include "tui/term/pixels.h"

/* All state of the screen: app.c changes it, screen.c draws it. */
struct gb_screen {
    struct gb_term *term;
    struct gb_session session;
    struct gb_layout layout;
    enum gb_pane focus;
    bool zoom; /* the focused pane alone is shown */
    struct gb_panel_params params;
    struct gb_panel_plot plot;
    struct gb_panel_events events;
    struct gb_dialog dialog;
    struct gb_term_image image; /* picture over the cells of the packing */
    struct gb_message message;  /* "": the description of the focused pane instead */
    const char *making; /* message to clear when the child command ends; NULL: none */
};

/* Draws everything into curses' virtual screen; gb_term_flush sends the differences to
 * the terminal. */
void gb_screen_draw(struct gb_screen *screen);

/* The packing or picture to be shown in pixels. */
struct gb_term_picture gb_screen_picture(const struct gb_screen *screen);

/* The key at a cell of the footer; false: none. */
bool gb_screen_key_at(const struct gb_screen *screen, int row, int col,
                      struct gb_key *key);

/* One row per pane; NULL: not supported. */
struct gb_pane_type {
    void (*draw)(struct gb_screen *screen, const struct gb_paint *paint,
                 enum gb_paint_focus focus);
    void (*navigate)(struct gb_screen *screen, enum gb_action action);
    void (*click)(struct gb_screen *screen, int row, int col);
    void (*describe)(struct gb_screen *screen, struct gb_message *message);
    /* The text under the cursor, for the clipboard (g_free); NULL: nothing. */
    char *(*copied)(struct gb_screen *screen);
};

const struct gb_pane_type *gb_screen_pane(enum gb_pane pane);

#endif
