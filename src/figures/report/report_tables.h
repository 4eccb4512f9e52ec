#ifndef GB_FIGURES_REPORT_REPORT_TABLES_H
#define GB_FIGURES_REPORT_REPORT_TABLES_H

#include "figures/report/report.h"

/* Densities of each group at round pressures of loading, and where its branches end; into
 * the page and as CSV into the folder tables. */
bool gb_report_tables(struct gb_report *report, struct gb_error *err);

/* One row per run: seed, points, end, checksum of its curve; and the copies of its preset
 * and curve in the folder runs. */
bool gb_report_tables_runs(struct gb_report *report, struct gb_error *err);

#endif
