#ifndef GB_STUDY_CHART_TABLE_H
#define GB_STUDY_CHART_TABLE_H

#include <glib.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "study/chart.h"

/* Error against cost, one row per setting, from the cells simulated so far. */
struct gb_chart_row {
    struct gb_chart_setting setting;
    int seeds;                 /* cells with the seeds of the reference */
    int failed;                /* of them stopped by a guard: there are no errors then */
    double evaluations, cpu_s; /* means */
    /* At each pressure: mean density; difference from the reference, seed by seed (from
     * its mean for cells of another size), with its standard error; standard deviation
     * between the seeds. */
    double density[GB_CHART_PRESSURES], error[GB_CHART_PRESSURES],
        error_se[GB_CHART_PRESSURES], scatter[GB_CHART_PRESSURES];
    double coordination_error[GB_CHART_PRESSURES],
        coordination_error_se[GB_CHART_PRESSURES];
    double bound;       /* largest of |error| + standard error; NaN: not known */
    bool noise_limited; /* no error exceeds two standard errors */
    bool pareto;        /* no other row costs less and has a smaller bound */
    bool chosen;        /* recommended */
};

struct gb_chart_table {
    struct gb_chart_row *row; /* in the order of the plan */
    size_t rows;
    double scatter[GB_CHART_PRESSURES]; /* of one cell of the preset's size, pooled */
    double allowed;                     /* error limit; NaN: the scatter */
};

/* allowed: error limit of the recommended setting; NaN: the scatter.  It is the cheapest
 * complete setting of the preset's cell size whose |error| + standard error is within the
 * limit at every pressure. */
void gb_chart_table_init(struct gb_chart_table *table, const struct gb_chart_log *log,
                         double allowed);

void gb_chart_table_finish(struct gb_chart_table *table); /* zeroed is fine */

/* The recommended row, or NULL. */
const struct gb_chart_row *gb_chart_table_chosen(const struct gb_chart_table *table);

/* As CSV; comment goes in front, lines with '#'.  g_string_free. */
GString *gb_chart_table_csv(const struct gb_chart_table *table,
                            const struct gb_chart_plan *plan, const char *comment);

/* Size and number of cells for a given standard error. */
struct gb_chart_size {
    int64_t count;
    double half_edge;  /* half the shortest edge of the initial cell, d */
    double g_end;      /* mean g(r) over the last diameter before it ... */
    double ripple;     /* ... and how far its quarters are from 1, rms */
    bool large_enough; /* it is 1: no correlation across the periodic cell */
    double scatter[GB_CHART_PRESSURES]; /* of one cell; NaN: not measured */
    double cpu_s;                       /* of one cell */
    double cells;                       /* for the standard error at every pressure */
};

enum { GB_CHART_SIZES = 8 };

struct gb_chart_advice {
    double standard_error;
    struct gb_chart_size size[GB_CHART_SIZES]; /* by particles */
    int sizes;
};

/* From the rows that differ from the preset's own in the number of particles only; g(r)
 * of up to eight initial structures each.  Errors: those of the engine. */
bool gb_chart_table_advise(struct gb_chart_advice *advice,
                           const struct gb_chart_table *table,
                           const struct gb_chart_plan *plan, double standard_error,
                           struct gb_error *err);

/* A chart as text; g_string_free. */

/* A line per setting, and the legend of its marks. */
GString *gb_chart_table_text(const struct gb_chart_table *table,
                             const struct gb_chart_plan *plan);

/* Scatter, the recommended setting, and the cells for a standard error. */
GString *gb_chart_table_results(const struct gb_chart_table *table,
                                const struct gb_chart_plan *plan,
                                const struct gb_chart_advice *advice);

#endif
