#ifndef GB_TUI_APP_DISPATCH_H
#define GB_TUI_APP_DISPATCH_H

#include "tui/app/app_private.h"

/* A key or a character: to the open dialog, the value being edited, or the key table. */
void gb_dispatch_event(struct gb_app *app, const struct gb_term_event *event);

/* Calls the command of a row of the key table if the focused pane is in its scope. */
void gb_dispatch_key(struct gb_app *app, const struct gb_key *key);

#endif
