#ifndef GB_TUI_APP_APP_H
#define GB_TUI_APP_APP_H

#include "greenbody/status.h"
#include "io/preset.h"
#include "tui/term/settings.h"

/* The workbench: takes the terminal, starts a run of the preset and works with the user
 * until he leaves.  The preset's parameters are edited in place; the caller keeps it.
 *
 * folder    each run is kept in a directory of its own there; NULL: runs are not kept
 * attached  directory of a run to be shown instead of starting one; NULL: none
 * settings  what the user says about his terminal
 *
 * When the terminal goes away, the run goes on as output.on_hangup says, and this returns
 * when it is over.
 *
 * Returns the exit status: 0; 130, 143, 129 after SIGINT, SIGTERM, SIGHUP.  When the
 * terminal cannot be taken, err is filled and its status returned. */
int gb_app_run(struct gb_preset *preset, const char *folder, const char *attached,
               const struct gb_settings *settings, struct gb_error *err);

#endif
