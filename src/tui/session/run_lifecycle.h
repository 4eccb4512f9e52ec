#ifndef GB_TUI_SESSION_RUN_LIFECYCLE_H
#define GB_TUI_SESSION_RUN_LIFECYCLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "greenbody/params.h"
#include "tui/panel/panels.h"

/* Life cycle of a run independent of the screen: its directory, a hang-up of the
 * terminal, and a run of another process that is shown or taken over. */

/* Directory of the next run (g_free); NULL: not stored. */
char *gb_run_lifecycle_directory(const struct gb_session *session);

/* Creates an engine for the parameters with a new directory in session->folder. */
bool gb_run_lifecycle_start(struct gb_runner **out, const struct gb_session *session,
                            const struct gb_params *params, struct gb_error *err);

/* Shows the run in session->attached. */
bool gb_run_lifecycle_attach(struct gb_session *session, struct gb_error *err);

/* Stops the engine of the attached run with a checkpoint and continues the run in this
 * process.  A run without an engine is continued as well. */
void gb_run_lifecycle_take_over(struct gb_session *session, struct gb_message *message);

/* After a hang-up: the run continues to its end or stops with a checkpoint, as
 * output.on_hangup says.  The function waits for it and returns the exit status. */
int gb_run_lifecycle_run_detached(struct gb_session *session);

/* Describes what quitting does: engines of this process end, other engines continue. */
void gb_run_lifecycle_quit_text(const struct gb_session *session, char *text,
                                size_t size);

/* Effect of `d` before quitting: a process without a terminal continues the run of this
 * process.  GB_DETACH_START: the quick cell is computing, and the full one is started. */
enum gb_run_lifecycle_detaching { GB_DETACH_NOTHING, GB_DETACH_RUN, GB_DETACH_START };
enum gb_run_lifecycle_detaching
gb_run_lifecycle_detaching(const struct gb_session *session);
/* Resumes a run without a terminal, in a session of its own, and prints its directory
 * on standard error.  Call it after the engine of the run has ended with a checkpoint. */
void gb_run_lifecycle_detach(const char *directory);

/* Prints on standard error, after the screen is closed, how to resume a live run. */
void gb_run_lifecycle_print_resume_hint(const struct gb_session *session);

/* $XDG_STATE_HOME/greenbody/runs (g_free). */
char *gb_run_lifecycle_folder(void);

/* A line for --diagnose: number of stored runs in the folder and their size on disk.
 * Runs are removed by the user only. */
void gb_run_lifecycle_print_runs(FILE *out, const char *folder);

/* Does the estimated cost of a run require a confirmation? text then receives the
 * estimate and cheaper parameters.  False for invalid parameters, which fail at the
 * start.
 *
 * particle_steps_per_s  measured speed; 0: none yet, an assumption is used */
bool gb_run_lifecycle_cost_question(const struct gb_params *params,
                                    double particle_steps_per_s, char *text, size_t size);

/* The same for a quasi-static run, estimated from the time of its quick cell.  *seconds:
 * estimated duration of the run, NaN: no estimate. */
bool gb_run_lifecycle_cost_after_quick(const struct gb_params *full,
                                       const struct gb_params *quick, double quick_s,
                                       double *seconds, char *text, size_t size);

#endif
