#include "measure/fit/valley.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_min.h>
#include <math.h>

/* Places of the grid that finds the deepest valley. */
enum { PLACES = 120, ITERATIONS = 200 };

static double squares_at(double exponent, void *data)
{
    const struct gb_valley *valley = data;
    return valley->squares(exponent, valley->data);
}

static double place(int k)
{
    return GB_VALLEY_LEAST *
           pow(GB_VALLEY_MOST / GB_VALLEY_LEAST, (double)k / (PLACES - 1));
}

/* Between two places around the deepest one. */
static bool refine(const struct gb_valley *valley, int best, double *exponent)
{
    gsl_function function = {squares_at, (void *)valley};
    gsl_min_fminimizer *work = gsl_min_fminimizer_alloc(gsl_min_fminimizer_brent);
    if (work == NULL) {
        return false;
    }
    int status = gsl_min_fminimizer_set(work, &function, place(best), place(best - 1),
                                        place(best + 1));
    for (int i = 0; i < ITERATIONS && status == GSL_SUCCESS; i++) {
        status = gsl_min_fminimizer_iterate(work);
        if (status == GSL_SUCCESS &&
            gsl_min_test_interval(gsl_min_fminimizer_x_lower(work),
                                  gsl_min_fminimizer_x_upper(work), 0.0,
                                  1e-10) == GSL_SUCCESS) {
            break;
        }
    }
    *exponent = gsl_min_fminimizer_x_minimum(work);
    gsl_min_fminimizer_free(work);
    return true;
}

bool gb_valley_find(const struct gb_valley *valley, double *exponent,
                    struct gb_error *err)
{
    int best = 0;
    double least = INFINITY;
    for (int k = 0; k < PLACES; k++) {
        const double squares = valley->squares(place(k), valley->data);
        if (squares < least) {
            least = squares;
            best = k;
        }
    }
    if (best == 0 || best == PLACES - 1) {
        return gb_error_set(err, GB_ERR_NOT_CONVERGED,
                            "the pressures show no power law of the rate: the best "
                            "exponent is %s",
                            best == 0 ? "0, a logarithm" : "4 or more");
    }
    return refine(valley, best, exponent) ||
           gb_error_set(err, GB_ERR_MEMORY, "out of memory for a fit");
}

double gb_valley_level(const struct gb_valley *valley, double level, double inside,
                       double outside)
{
    if (valley->squares(outside, valley->data) <= level) {
        return outside;
    }
    double low = fmin(inside, outside);
    double high = fmax(inside, outside);
    const bool rising = outside > inside;
    for (int i = 0; i < ITERATIONS && high - low > 1e-12 * high; i++) {
        const double middle = 0.5 * (low + high);
        const bool beyond = valley->squares(middle, valley->data) > level;
        if (beyond == rising) {
            high = middle;
        } else {
            low = middle;
        }
    }
    return 0.5 * (low + high);
}
