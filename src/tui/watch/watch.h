#ifndef GB_TUI_WATCH_WATCH_H
#define GB_TUI_WATCH_WATCH_H

#include "greenbody/status.h"
#include "tui/term/settings.h"

/* Shows a directory of many runs until the user quits, read-only; returns the exit status. */
int gb_watch_run(const char *directory, const struct gb_settings *settings,
                 struct gb_error *err);

#endif
