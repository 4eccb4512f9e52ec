#ifndef GB_CLI_CHART_PAGE_H
#define GB_CLI_CHART_PAGE_H

#include "study/chart_advice.h"
#include "study/chart_table.h"

/* A chart as text: table, picture, what follows from it.  g_string_free. */
GString *gb_chart_page(const struct gb_chart_table *table,
                       const struct gb_chart_plan *plan,
                       const struct gb_chart_advice *advice);

#endif
