#ifndef GB_TUI_APP_ASKS_H
#define GB_TUI_APP_ASKS_H

#include "tui/app/app_private.h"

/* What the workbench asks and what it does with the answers; beginning and leaving. */

void gb_asks_tell(struct gb_app *app, enum gb_style style, const char *text);
void gb_asks_leave(struct gb_app *app, int status);

/* Begins a run; what would take hours is asked about first. */
void gb_asks_start_run(struct gb_app *app);
/* A scene that is opened answers with its quick cell first, unless it is quick itself. */
void gb_asks_start_scene(struct gb_app *app);
/* When the quick curve is there, the full cell follows.  What takes hours waits for r. */
void gb_asks_follow(struct gb_app *app);
void gb_asks_toggle_follow(struct gb_app *app);
/* The costly run is not begun. */
void gb_asks_decline(struct gb_app *app);

void gb_asks_save(struct gb_app *app);
void gb_asks_data(struct gb_app *app);
void gb_asks_fork(struct gb_app *app);
void gb_asks_command(struct gb_app *app);
void gb_asks_quit(struct gb_app *app);
/* The question before a run that is live is left. */
void gb_asks_leave_live(struct gb_app *app);

/* Another command of this program makes it from the run's directory, beside the screen.
 * Its path: the directory, middle, a number that is free, end. */
void gb_asks_errand(struct gb_app *app, const char *what, const char *command,
                    const char *middle, const char *end);

/* The answer of the dialog that is open. */
void gb_asks_answer(struct gb_app *app);

#endif
