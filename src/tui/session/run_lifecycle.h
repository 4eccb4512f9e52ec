#ifndef GB_TUI_SESSION_RUN_LIFECYCLE_H
#define GB_TUI_SESSION_RUN_LIFECYCLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "greenbody/params.h"
#include "tui/panel/panels.h"

/* Life cycle of a run apart from the screen: its directory, a hang-up of the terminal, a
 * run of another process that is shown or taken over. */

/* Directory of the next run (g_free); NULL: not stored. */
char *gb_run_lifecycle_directory(const struct gb_session *session);

/* Creates an engine for the parameters with a new directory in session->folder. */
bool gb_run_lifecycle_start(struct gb_runner **out, const struct gb_session *session,
                            const struct gb_params *params, struct gb_error *err);

/* Shows the run in session->attached. */
bool gb_run_lifecycle_attach(struct gb_session *session, struct gb_error *err);

/* Stops the engine of the attached run with a checkpoint and continues the run in this
 * process; the same for a run without engine. */
void gb_run_lifecycle_take_over(struct gb_session *session, struct gb_message *message);

/* After a hang-up: the run continues to its end, or stops with a checkpoint, as
 * output.on_hangup says; the function waits for it.  Returns the exit status. */
int gb_run_lifecycle_run_detached(struct gb_session *session);

/* What quitting does to what is live: engines of this process end, others go on. */
void gb_run_lifecycle_quit_text(const struct gb_session *session, char *text,
                                size_t size);

/* What `d` does before quitting: an engine of this process goes on in one without a
 * terminal.  GB_DETACH_START: the quick cell computes, and the full one is started. */
enum gb_run_lifecycle_detaching { GB_DETACH_NOTHING, GB_DETACH_RUN, GB_DETACH_START };
enum gb_run_lifecycle_detaching
gb_run_lifecycle_detaching(const struct gb_session *session);
/* Resumes a run without terminal, in a session of its own, and prints where it is on
 * standard error.  Call it when the engine of the run has ended with its checkpoint. */
void gb_run_lifecycle_detach(const char *directory);

/* Prints on standard error, after the screen is closed, how a live run is resumed. */
void gb_run_lifecycle_print_resume_hint(const struct gb_session *session);

/* $XDG_STATE_HOME/greenbody/runs (g_free). */
char *gb_run_lifecycle_folder(void);

/* A line for --diagnose: number of stored runs in the folder and their size on disk.
 * Runs are removed by the user only. */
void gb_run_lifecycle_print_runs(FILE *out, const char *folder);

/* Whether a run needs a confirmation because of its estimated cost; text then receives
 * the estimate and cheaper parameters.  False for invalid parameters, whose error comes
 * at the start.
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
