#include "study/bench/bench.h"

#include <gsl/gsl_fit.h>
#include <math.h>
#include <string.h>

#include <glib.h>

static bool assign(struct gb_params *params, const char *const *assignment,
                   struct gb_error *err)
{
    for (; *assignment; assignment++) {
        if (!gb_params_assign(params, *assignment, err)) {
            return false;
        }
    }
    return true;
}

/* The width and the cut of p1-set2-lognormal. */
static bool make_sizes(struct gb_params *params, struct gb_error *err)
{
    char median[64], largest[64];
    struct gb_params sized = *params;
    g_snprintf(median, sizeof median, "particles.median=%.17g nm",
               0.969 * 1e9 * params->diameter_m);
    g_snprintf(largest, sizeof largest, "particles.largest=%.17g nm",
               2.06 * 1e9 * params->diameter_m);
    const char *const assignment[] = {"particles.distribution=lognormal", median,
                                      "particles.sigma=0.25", largest, NULL};
    if (!assign(&sized, assignment, err)) {
        return false;
    }
    if (gb_params_check(&sized, NULL)) { /* not: a law of one size */
        *params = sized;
    }
    return true;
}

bool gb_bench_plan(struct gb_bench_cell cell[GB_BENCH_CELLS],
                   const struct gb_params *params, struct gb_error *err)
{
    for (int i = 0; i < GB_BENCH_CELLS; i++) {
        cell[i] = (struct gb_bench_cell){.params = *params};
    }
    cell[GB_BENCH_SCENE].busy = g_get_num_processors() > 1;
    cell[GB_BENCH_SMALL].params.count = GB_BENCH_SMALL_COUNT;
    cell[GB_BENCH_DOUBLE].params.precision = GB_PRECISION_DOUBLE;
    return params->distribution != GB_DISTRIBUTION_MONO ||
           make_sizes(&cell[GB_BENCH_SIZES].params, err);
}

double gb_bench_exponent(const double *count, const double *cost, size_t n)
{
    double *x = g_new(double, n), *y = g_new(double, n);
    double constant, power, cov00, cov01, cov11, square;
    for (size_t i = 0; i < n; i++) {
        x[i] = log(count[i]);
        y[i] = log(cost[i]);
    }
    gsl_fit_linear(x, 1, y, 1, n, &constant, &power, &cov00, &cov01, &cov11, &square);
    g_free(x);
    g_free(y);
    return power;
}
