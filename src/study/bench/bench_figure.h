#ifndef GB_STUDY_BENCH_BENCH_FIGURE_H
#define GB_STUDY_BENCH_BENCH_FIGURE_H

#include <stddef.h>

/* Rounds in which the figures of a table are timed in turn, so that other work on the
 * machine slows all of them alike. */
enum { GB_BENCH_ROUNDS = 5 };

/* A figure measured in rounds. */
struct gb_bench_figure {
    double value;  /* median of the rounds */
    double spread; /* half of the difference between the largest and the smallest */
};

/* Of the values of n rounds, 1 or more; NaN where a round has none.  They are sorted. */
struct gb_bench_figure gb_bench_figure_of(double *round, size_t n);

struct gb_bench_figure gb_bench_figure_scaled(struct gb_bench_figure figure,
                                              double factor);

#endif
