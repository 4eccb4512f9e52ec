#include "measure/fit/exponent_profile.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_min.h>
#include <math.h>

/* Points of the grid in which the lowest minimum is bracketed. */
enum { GRID_POINTS = 120, ITERATIONS = 200 };

static double squares_at(double exponent, void *data)
{
    const struct gb_exponent_profile *profile = data;
    return profile->squares(exponent, profile->data);
}

static double grid_exponent(int k)
{
    return GB_EXPONENT_PROFILE_MIN *
           pow(GB_EXPONENT_PROFILE_MAX / GB_EXPONENT_PROFILE_MIN,
               (double)k / (GRID_POINTS - 1));
}

/* Brent minimisation between the neighbours of the lowest grid point. */
static bool refine(const struct gb_exponent_profile *profile, int best, double *exponent)
{
    gsl_function function = {squares_at, (void *)profile};
    gsl_min_fminimizer *work = gsl_min_fminimizer_alloc(gsl_min_fminimizer_brent);
    if (work == NULL) {
        return false;
    }
    int status = gsl_min_fminimizer_set(work, &function, grid_exponent(best),
                                        grid_exponent(best - 1), grid_exponent(best + 1));
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

bool gb_exponent_profile_minimum(const struct gb_exponent_profile *profile,
                                 double *exponent, struct gb_error *err)
{
    int best = 0;
    double least = INFINITY;
    for (int k = 0; k < GRID_POINTS; k++) {
        const double squares = profile->squares(grid_exponent(k), profile->data);
        if (squares < least) {
            least = squares;
            best = k;
        }
    }
    if (best == 0 || best == GRID_POINTS - 1) {
        return gb_error_set(err, GB_ERR_NOT_CONVERGED,
                            "the pressures show no power law of the rate: the best "
                            "exponent is %s",
                            best == 0 ? "0, a logarithm" : "4 or more");
    }
    return refine(profile, best, exponent) ||
           gb_error_set(err, GB_ERR_MEMORY, "out of memory for a fit");
}

double gb_exponent_profile_crossing(const struct gb_exponent_profile *profile,
                                    double level, double inside, double outside)
{
    if (profile->squares(outside, profile->data) <= level) {
        return outside;
    }
    double low = fmin(inside, outside);
    double high = fmax(inside, outside);
    const bool rising = outside > inside;
    for (int i = 0; i < ITERATIONS && high - low > 1e-12 * fmax(fabs(low), fabs(high));
         i++) {
        const double middle = 0.5 * (low + high);
        const bool beyond = profile->squares(middle, profile->data) > level;
        if (beyond == rising) {
            high = middle;
        } else {
            low = middle;
        }
    }
    return 0.5 * (low + high);
}
