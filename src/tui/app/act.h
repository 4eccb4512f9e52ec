#ifndef GB_TUI_APP_ACT_H
#define GB_TUI_APP_ACT_H

#include "tui/app/app_private.h"

/* An action of the key table, wherever the focus is. */
void gb_act_do(struct gb_app *app, enum gb_action action);

/* A key or a character: for the dialog that is open, the value being edited, or the key
 * table. */
void gb_act_type(struct gb_app *app, const struct gb_term_event *event);

#endif
