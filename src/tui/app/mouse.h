#ifndef GB_TUI_APP_MOUSE_H
#define GB_TUI_APP_MOUSE_H

#include "tui/app/app_private.h"

/* The mouse: a click takes the pane, its row or its point, a key of the footer, the title
 * of the plot (next view); the wheel scrolls, or changes the focused value below it.  Keys
 * do all of this, too. */
void gb_mouse_handle(struct gb_app *app, const struct gb_term_event *event);

#endif
