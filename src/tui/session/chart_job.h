#ifndef GB_TUI_SESSION_CHART_JOB_H
#define GB_TUI_SESSION_CHART_JOB_H

#include <glib.h>
#include <stdbool.h>

#include "tui/session/child_command.h"
#include "tui/session/overlay/chart_csv.h"
#include "tui/session/overlay/stability_csv.h"

/* Accuracy against cost and stability of the scene shown: `greenbody chart` or `greenbody
 * stability` as a child command, whose table is read while it grows. */
struct gb_chart_job {
    char *directory;    /* NULL: none was started */
    bool stability;     /* its table is stability.csv, else chart.csv */
    gint64 modified_ns; /* of the table that was read */
};

/* Follows the table in a directory from now on. */
void gb_chart_job_follow(struct gb_chart_job *job, const char *directory, bool stability);
void gb_chart_job_finish(struct gb_chart_job *job); /* zeroed is fine */

/* Whether the child command is one of the two. */
bool gb_chart_job_runs(const struct gb_child_command *child);

/* Reads the table again where it has changed; true if *chart or *stability is another one. */
bool gb_chart_job_refresh(struct gb_chart_job *job, struct gb_chart_csv **chart,
                          struct gb_stability_csv **stability);

#endif
