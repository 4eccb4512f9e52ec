#ifndef GB_TUI_APP_MOUSE_H
#define GB_TUI_APP_MOUSE_H

#include "tui/app/app_private.h"

/* Mouse events.  A click focuses the pane and selects its row or point, presses a key of
 * the footer, or, on the title of the plot, shows the next view.  The wheel scrolls; over
 * the focused value it changes it.  Everything is possible with keys, too. */
void gb_mouse_handle(struct gb_app *app, const struct gb_term_event *event);

#endif
