#ifndef GB_STUDY_CHART_CHART_LOG_H
#define GB_STUDY_CHART_CHART_LOG_H

#include <stdbool.h>

#include <glib.h>

#include "study/chart/chart_plan.h"

/* The directory of a chart: preset.ini (the scene), runs.csv (one row per simulated
 * cell, so that an interrupted chart can be continued) and chart.csv. */
struct gb_chart_log {
    char *directory;
    GArray *runs; /* of struct gb_chart_run */
    const struct gb_chart_plan *plan;
    int lock;
};

/* Makes the directory, or continues the chart in it.  The plan must outlive the log.
 * Errors: GB_ERR_INPUT for the chart of another scene or other pressures, for a directory
 * with other files, and for a chart under way; GB_ERR_MACHINE. */
bool gb_chart_log_open(struct gb_chart_log *log, const char *directory,
                       const struct gb_chart_plan *plan, struct gb_error *err);
void gb_chart_log_close(struct gb_chart_log *log); /* zeroed is fine */

/* The result of a cell, or NULL. */
const struct gb_chart_run *gb_chart_log_find(const struct gb_chart_log *log,
                                             const struct gb_chart_setting *setting,
                                             uint64_t seed);

/* Adds a cell and writes runs.csv. */
bool gb_chart_log_add(struct gb_chart_log *log, const struct gb_chart_run *run,
                      struct gb_error *err);

/* Writes text as a file of the directory. */
bool gb_chart_log_keep(const struct gb_chart_log *log, const char *name,
                       const GString *text, struct gb_error *err);

#endif
