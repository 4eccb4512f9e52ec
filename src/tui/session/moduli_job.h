#ifndef GB_TUI_SESSION_MODULI_JOB_H
#define GB_TUI_SESSION_MODULI_JOB_H

#include <glib.h>
#include <stdbool.h>

#include "run/moduli/moduli_states.h"
#include "runner/runner.h"
#include "tui/session/child_command.h"

/* Elastic moduli of the run shown: `greenbody moduli DIR --out DIR` as a child command, after
 * the run has stored its present state, and the table that it writes. */
struct gb_moduli_job {
    char *directory; /* of the run whose table is shown; NULL: none */
    GArray *states;  /* struct gb_moduli_state in the order of the run; NULL: none */
    const struct gb_runner *waits_for; /* run that stores its state first; NULL: none */
    int64_t stored;                    /* gb_runner_stored before that */
    struct gb_error failed;            /* for the events: the command could not start */
};

void gb_moduli_job_finish(struct gb_moduli_job *job); /* zeroed is fine */

/* Measures the states of the run that have no moduli yet: those kept in its directory and
 * the present one.  Errors: GB_ERR_INPUT (no stored run, no periodic cell, another child
 * command), GB_ERR_MACHINE. */
bool gb_moduli_job_start(struct gb_moduli_job *job, struct gb_runner *runner, bool live,
                         struct gb_child_command *child, struct gb_error *err);
/* Whether a measurement is under way, whether it is of the run shown, and its end. */
bool gb_moduli_job_runs(const struct gb_moduli_job *job,
                        const struct gb_child_command *child);
bool gb_moduli_job_measures(const struct gb_moduli_job *job,
                            const struct gb_child_command *child);
void gb_moduli_job_stop(struct gb_moduli_job *job, const struct gb_child_command *child);

/* Starts the command when the state is stored, and reads the table of the run, again with
 * news of the child command; true if the display changes. */
bool gb_moduli_job_refresh(struct gb_moduli_job *job, struct gb_runner *runner,
                           struct gb_child_command *child, bool news);

#endif
