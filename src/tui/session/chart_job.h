#ifndef GB_TUI_SESSION_CHART_JOB_H
#define GB_TUI_SESSION_CHART_JOB_H

#include <glib.h>
#include <stdbool.h>

#include "tui/session/child_command.h"
#include "tui/session/overlay/chart_csv.h"

/* Accuracy against cost of the scene shown: `greenbody chart` as a child command, whose
 * chart.csv is read while it grows. */
struct gb_chart_job {
    char *directory;    /* NULL: none was started */
    gint64 modified_ns; /* of the chart.csv that was read */
};

/* Follows the chart in a directory from now on. */
void gb_chart_job_follow(struct gb_chart_job *job, const char *directory);
void gb_chart_job_finish(struct gb_chart_job *job); /* zeroed is fine */

/* Whether the child command is a chart. */
bool gb_chart_job_runs(const struct gb_child_command *child);

/* Reads chart.csv again where it has changed; true if *chart is another one. */
bool gb_chart_job_refresh(struct gb_chart_job *job, struct gb_chart_csv **chart);

#endif
