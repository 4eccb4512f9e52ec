#ifndef GB_STUDY_CHART_TABLE_H
#define GB_STUDY_CHART_TABLE_H

#include <stdbool.h>
#include <stddef.h>

#include <glib.h>

#include "study/chart_log.h"

/* Error against cost, one row per choice, from the cells pressed so far. */
struct gb_chart_row {
    struct gb_chart_setting choice;
    int seeds;                 /* cells of it that also the reference has */
    int failed;                /* of them stopped by a guard: no errors are given then */
    double evaluations, cpu_s; /* means */
    /* At each pressure: mean density; difference from the reference, seed by seed (from
     * its mean where the cells have another size), with its standard error; standard
     * deviation between the seeds. */
    double density[GB_CHART_PRESSURES], error[GB_CHART_PRESSURES],
        error_se[GB_CHART_PRESSURES], scatter[GB_CHART_PRESSURES];
    double coordination_error[GB_CHART_PRESSURES],
        coordination_error_se[GB_CHART_PRESSURES];
    double bound;       /* largest of |error| + standard error; NaN: not known yet */
    bool noise_limited; /* no error exceeds two standard errors: more seeds would tell */
    bool front;         /* nothing costs less and has a smaller bound */
    bool chosen;
};

struct gb_chart_table {
    struct gb_chart_row *row; /* in the order of the plan */
    size_t rows;
    double scatter[GB_CHART_PRESSURES]; /* of one cell of the preset's size, pooled */
    double allowed;                     /* bound allowed; NaN: the scatter */
};

/* allowed: error that a choice may have to be chosen; NaN: as large as the scatter.  The
 * chosen one is the cheapest complete choice of the preset's cell size whose |error| +
 * standard error stays within it at every pressure. */
void gb_chart_table_init(struct gb_chart_table *table, const struct gb_chart_log *log,
                         double allowed);
void gb_chart_table_finish(struct gb_chart_table *table); /* zeroed is fine */

/* The chosen row, or NULL. */
const struct gb_chart_row *gb_chart_table_chosen(const struct gb_chart_table *table);

/* As CSV; comment goes in front, lines with '#'.  g_string_free. */
GString *gb_chart_table_csv(const struct gb_chart_table *table,
                            const struct gb_chart_plan *plan, const char *comment);

#endif
