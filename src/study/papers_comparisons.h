#ifndef GB_STUDY_PAPERS_COMPARISONS_H
#define GB_STUDY_PAPERS_COMPARISONS_H

#include <stdbool.h>
#include <stddef.h>

#include "many/reading.h"
#include "study/papers_plan.h"

/* What is compared with each printed number: a measure over the runs of an experiment. */

struct gb_papers_comparison;

/* A number of one run; NaN where it has none. */
typedef double gb_papers_read(const struct gb_runset_run *run,
                              const struct gb_papers_comparison *row);

/* A number of all runs; NaN where it has none. */
typedef double gb_papers_measure(const struct gb_papers_view *view,
                                 const struct gb_papers_comparison *row);

enum { GB_PAPERS_USED = 6 };

struct gb_papers_comparison {
    const char *id;    /* of the printed number */
    const char *label; /* where several comparisons share a number; else NULL */
    const char
        *experiment[GB_PAPERS_USED]; /* NULL behind the last; none: from the laws */
    gb_papers_measure *measure;
    gb_papers_read *read; /* of the means; NULL for other measures */
    enum gb_reading_quantity quantity;
    const char *column;  /* of curve.csv, where no quantity is meant; or a kept state */
    int contacts;        /* of a particle */
    double at;           /* MPa, relative density, exponent: the measure says which */
    double hardening;    /* Hollomon's exponent, of laws of a pair */
    size_t point, other; /* indices on the axis of the experiment */
    double scale;        /* of the result; 0: 1 */
    const char *why;     /* the reason of a deviation, Markdown; NULL: not known */
};

/* Mean of the reading at a point, and difference of the means at `point` and `other`: for
 * tests of rows. */
gb_papers_measure gb_papers_comparisons_mean, gb_papers_comparisons_difference;

/* THE table; the last row has no id. */
const struct gb_papers_comparison *gb_papers_comparisons_table(void);

/* Value of a row and its standard error by the jackknife over the cells of each experiment
 * that it uses; cells of equal seed at different points of one experiment are left out
 * together.  error NaN: fewer than two cells, or no runs at all (laws).  Returns the cells of
 * the first experiment at the point, of a difference the fewer ones. */
size_t gb_papers_comparisons_value(const struct gb_papers_comparison *row,
                                   const struct gb_papers_data *data, double *value,
                                   double *error);

#endif
