#ifndef GB_TUI_PANEL_PANEL_STATE_ITEMS_H
#define GB_TUI_PANEL_PANEL_STATE_ITEMS_H

#include "tui/session/session.h"

/* Quantities of the state pane.  A new one is a writing function and a row. */
struct gb_panel_state_item {
    const char *brief, *name; /* for narrow and wide columns */
    void (*write)(const struct gb_session_shown *shown, char *text, size_t size);
};

enum { GB_PANEL_STATE_ITEMS = 20 };

/* The items that apply to a run, in the order of the columns and of importance. */
struct gb_panel_state_choice {
    const struct gb_panel_state_item *item[GB_PANEL_STATE_ITEMS];
    const struct gb_panel_state_item *by_weight[GB_PANEL_STATE_ITEMS];
    int count;
};

struct gb_panel_state_choice
gb_panel_state_items_choose(const struct gb_session *session);

/* Value of an item; "-" where there is none yet. */
void gb_panel_state_items_write(const struct gb_panel_state_item *item,
                                const struct gb_session_shown *shown, char *text,
                                size_t size);

/* "0.7 s", "12:34", "3:04:05"; returns text. */
char *gb_panel_state_items_duration(double seconds, char *text, size_t size);

#endif
