#ifndef GB_STUDY_CHART_CHART_ADVICE_H
#define GB_STUDY_CHART_CHART_ADVICE_H

#include <stdbool.h>
#include <stdint.h>

#include "study/chart/chart_table.h"

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
bool gb_chart_advice_init(struct gb_chart_advice *advice,
                          const struct gb_chart_table *table,
                          const struct gb_chart_plan *plan, double standard_error,
                          struct gb_error *err);

#endif
