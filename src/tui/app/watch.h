#ifndef GB_TUI_APP_WATCH_H
#define GB_TUI_APP_WATCH_H

#include <glib.h>

#include "greenbody/status.h"
#include "tui/term/settings.h"

/* A screen to choose a run from a list of live, detached and past ones: typing filters,
 * Enter chooses, Del or Ctrl-D deletes after a question, never a live run.
 *
 * list       the runs (io/run_list.h), asked for again and again; g_ptr_array_unref
 * directory  of the run chosen, g_free; NULL: none
 *
 * Returns the exit status. */
int gb_watch_pick(GPtrArray *(*list)(void), const struct gb_settings *settings,
                  char **directory, struct gb_error *err);

/* Shows a directory of many runs until the user quits, read-only; returns the exit status. */
int gb_watch_run(const char *directory, const struct gb_settings *settings,
                 struct gb_error *err);

#endif
