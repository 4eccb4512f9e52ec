#ifndef GB_TUI_APP_APP_H
#define GB_TUI_APP_APP_H

#include "greenbody/status.h"
#include "io/preset.h"
#include "tui/term/settings.h"

/* The workbench: takes over the terminal, starts a run of the preset and handles events
 * until the user quits.  The preset's parameters are edited in place; the caller owns it.
 *
 * folder    parent of the directories of the runs; NULL: runs are not stored
 * attached  directory of a run to show instead of starting one; NULL: none
 * settings  settings of the terminal
 *
 * After a hang-up of the terminal the run continues or stops as output.on_hangup says,
 * and the function returns when it has ended.
 *
 * Returns the exit status: 0; 130, 143, 129 after SIGINT, SIGTERM, SIGHUP.  When the
 * terminal cannot be used, err is filled and its status returned. */
int gb_app_run(struct gb_preset *preset, const char *folder, const char *attached,
               const struct gb_settings *settings, struct gb_error *err);

#endif
