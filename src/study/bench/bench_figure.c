#include "study/bench/bench_figure.h"

#include <math.h>

#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics.h>

struct gb_bench_figure gb_bench_figure_of(double *round, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        if (!isfinite(round[i])) {
            return (struct gb_bench_figure){NAN, NAN};
        }
    }
    gsl_sort(round, 1, n);
    return (struct gb_bench_figure){gsl_stats_median_from_sorted_data(round, 1, n),
                                    0.5 * (round[n - 1] - round[0])};
}

struct gb_bench_figure gb_bench_figure_scaled(struct gb_bench_figure figure,
                                              double factor)
{
    return (struct gb_bench_figure){factor * figure.value, factor * figure.spread};
}
