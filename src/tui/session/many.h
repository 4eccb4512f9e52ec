#ifndef GB_TUI_SESSION_MANY_H
#define GB_TUI_SESSION_MANY_H

#include "tui/app/app_private.h"

/* Many cells, started from the workbench and computed beside it by the same commands that
 * a shell would use: more cells of the scene shown, a fit of its keys to the experiment
 * over the plot. */

/* Ask how many, or which keys. */
void gb_many_ask_cells(struct gb_app *app);
void gb_many_ask_fit(struct gb_app *app);

/* The answer of the dialog: begins, or says in the dialog what is accepted. */
void gb_many_cells(struct gb_app *app);
void gb_many_fit(struct gb_app *app);

#endif
