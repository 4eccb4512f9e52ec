#ifndef GB_TUI_APP_H
#define GB_TUI_APP_H

#include "greenbody/status.h"
#include "run/preset.h"

/* The workbench: takes the terminal, starts a run of the preset and works with the user
 * until he leaves.  The preset's parameters are edited in place; the caller keeps it.
 *
 * Returns the exit status: 0; 130, 143, 129 after SIGINT, SIGTERM, SIGHUP.  When the
 * terminal cannot be taken, err is filled and its status returned. */
int gb_app_run(struct gb_preset *preset, struct gb_error *err);

#endif
