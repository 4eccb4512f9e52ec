#ifndef GB_CLI_CHART_PLOT_H
#define GB_CLI_CHART_PLOT_H

#include "study/chart/chart_table.h"

/* Error against CPU time as a plot in characters, with its legend; empty where fewer than
 * two settings have errors.  g_string_free. */
GString *gb_chart_plot(const struct gb_chart_table *table,
                       const struct gb_chart_plan *plan);

#endif
