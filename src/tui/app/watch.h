#ifndef GB_TUI_APP_WATCH_H
#define GB_TUI_APP_WATCH_H

#include <glib.h>

#include "greenbody/status.h"
#include "tui/term/settings.h"

/* A screen to choose a run from a list of live, detached and past runs.  Typing
 * filters, Enter chooses, Del or Ctrl-D deletes a run after a question, but never a
 * live one.
 *
 * list       returns the runs (io/run_list.h), called repeatedly; g_ptr_array_unref
 * directory  of the chosen run, g_free; NULL: none
 *
 * Returns the exit status. */
int gb_watch_pick(GPtrArray *(*list)(void), const struct gb_settings *settings,
                  char **directory, struct gb_error *err);

/* Shows a directory of many runs until the user quits, read-only; returns the exit
 * status. */
int gb_watch_run(const char *directory, const struct gb_settings *settings,
                 struct gb_error *err);

#endif
