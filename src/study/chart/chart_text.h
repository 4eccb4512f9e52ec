#ifndef GB_STUDY_CHART_CHART_TEXT_H
#define GB_STUDY_CHART_CHART_TEXT_H

#include "study/chart/chart_advice.h"
#include "study/chart/chart_table.h"

/* A chart as text; g_string_free. */

/* A line per setting, and the legend of its marks. */
GString *gb_chart_text_table(const struct gb_chart_table *table,
                             const struct gb_chart_plan *plan);

/* Scatter, the recommended setting, and the cells for a standard error. */
GString *gb_chart_text_results(const struct gb_chart_table *table,
                               const struct gb_chart_plan *plan,
                               const struct gb_chart_advice *advice);

#endif
