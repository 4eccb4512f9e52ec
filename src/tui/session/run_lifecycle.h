#ifndef GB_TUI_SESSION_RUN_LIFECYCLE_H
#define GB_TUI_SESSION_RUN_LIFECYCLE_H

#include <stdio.h>

#include "tui/panel/panels.h"

/* The life of a run beside its screen: the directory that keeps it, a terminal that goes
 * away, a run of another process that is shown or taken over. */

/* Where the next run is to be kept (g_free); NULL: nowhere. */
char *gb_run_lifecycle_directory(const struct gb_session *session);

/* An engine for these parameters, kept in a new directory of session->folder. */
bool gb_run_lifecycle_start(struct gb_runner **out, const struct gb_session *session,
                            const struct gb_params *params, struct gb_error *err);

/* Shows the run in session->attached. */
bool gb_run_lifecycle_attach(struct gb_session *session, struct gb_error *err);

/* Asks its engine to stop with a checkpoint and goes on here; the same for a run that has
 * no engine any more. */
void gb_run_lifecycle_take_over(struct gb_session *session, struct gb_message *message);

/* The terminal is gone.  The run goes on to its end, or stops with a checkpoint, as
 * output.on_hangup says; meanwhile nothing else is done.  Returns the exit status. */
int gb_run_lifecycle_run_detached(struct gb_session *session);

/* Tells on standard error, the screen being given back, where a live run is kept. */
void gb_run_lifecycle_print_resume_hint(const struct gb_session *session);

/* $XDG_STATE_HOME/greenbody/runs (g_free). */
char *gb_run_lifecycle_folder(void);

/* A line for --diagnose: how many runs are kept in the folder, and what they take of the
 * disk.  Nothing removes them but the user. */
void gb_run_lifecycle_print_runs(FILE *out, const char *folder);

#endif
