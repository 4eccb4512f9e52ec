#include "measure/fit.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

#include "measure/decay.h"

/* The time constant of an exponential that is not there is free, so the F test finds one
 * more often than its level says (the parameter exists under one hypothesis only); hence
 * 99 % where the intervals are at 95 %. */
static const double f_level = 0.99;

static const double interval_level = 0.975; /* two-sided 95 % */

static int degrees_of(const struct gb_decay *found, const struct gb_decay_points *points)
{
    return (int)points->count - 1 - 2 * found->terms;
}

static double variance_of(const struct gb_decay *found,
                          const struct gb_decay_points *points)
{
    return found->squares / degrees_of(found, points);
}

/* Half the 95 % interval of parameter k. */
static double half_width(const struct gb_decay *found,
                         const struct gb_decay_points *points, int k)
{
    return gsl_cdf_tdist_Pinv(interval_level, degrees_of(found, points)) *
           sqrt(found->covariance[k][k] * variance_of(found, points));
}

/* Every amplitude differs from zero and every time constant has two bounds. */
static bool is_certain(const struct gb_decay *found, const struct gb_decay_points *points)
{
    for (int k = 0; k < found->terms; k++) {
        const double amplitude = half_width(found, points, 1 + 2 * k);
        const double tau = half_width(found, points, 2 + 2 * k);
        if (!(amplitude < fabs(found->x[1 + 2 * k])) ||
            !(tau < log(GB_DECAY_TAU_LONGEST))) {
            return false;
        }
    }
    return true;
}

/* F of two more parameters.  A common floor keeps rounding from being significant. */
static double f_ratio(const struct gb_decay *poor, const struct gb_decay *rich,
                      const struct gb_decay_points *points)
{
    return 0.5 * (poor->squares - rich->squares) /
           ((rich->squares + points->floor) / degrees_of(rich, points));
}

static struct gb_fit_value value_of(const struct gb_decay *found,
                                    const struct gb_decay_points *points, int k,
                                    double unit, double shift)
{
    const double half = half_width(found, points, k);
    const double error = sqrt(found->covariance[k][k] * variance_of(found, points));
    return (struct gb_fit_value){.value = shift + unit * found->x[k],
                                 .error = unit * error,
                                 .low = shift + unit * (found->x[k] - half),
                                 .high = shift + unit * (found->x[k] + half)};
}

static struct gb_fit_value tau_of(const struct gb_decay *found,
                                  const struct gb_decay_points *points, int k)
{
    const struct gb_fit_value logarithm = value_of(found, points, k, 1.0, 0.0);
    const double tau = points->t_unit * exp(logarithm.value);
    return (struct gb_fit_value){.value = tau,
                                 .error = tau * logarithm.error,
                                 .low = points->t_unit * exp(logarithm.low),
                                 .high = points->t_unit * exp(logarithm.high)};
}

static void report(struct gb_fit_decay *fit, const struct gb_decay *found,
                   const struct gb_decay_points *points)
{
    static const struct gb_fit_value none = {(double)NAN, (double)NAN, (double)NAN,
                                             (double)NAN};
    fit->terms = found->terms;
    fit->degrees = degrees_of(found, points);
    fit->scatter = points->p_unit * sqrt(variance_of(found, points));
    fit->p0 = value_of(found, points, 0, points->p_unit, points->p_shift);
    for (int k = 0; k < GB_FIT_TERMS; k++) {
        const bool there = k < found->terms;
        fit->amplitude[k] =
            there ? value_of(found, points, 1 + 2 * k, points->p_unit, 0.0) : none;
        fit->tau[k] = there ? tau_of(found, points, 2 + 2 * k) : none;
    }
}

/* Adds exponentials as long as the data ask for them. */
static bool choose(struct gb_fit_decay *fit, const struct gb_decay_points *points,
                   struct gb_error *err)
{
    struct gb_decay best, next;
    gb_decay_constant(&best, points);
    fit->reason = GB_FIT_FULL;
    for (int terms = 1; terms <= GB_FIT_TERMS && fit->reason == GB_FIT_FULL; terms++) {
        if (!gb_decay_terms(&next, terms, points, err)) {
            return false;
        }
        fit->f = f_ratio(&best, &next, points);
        fit->f_most = gsl_cdf_fdist_Pinv(f_level, 2.0, degrees_of(&next, points));
        if (!(fit->f > fit->f_most)) {
            fit->reason = GB_FIT_INSIGNIFICANT;
        } else if (!next.settled) {
            fit->reason = GB_FIT_UNSETTLED;
        } else if (!is_certain(&next, points)) {
            fit->reason = GB_FIT_UNCERTAIN;
        } else {
            best = next;
        }
    }
    if (best.terms == 0 && fit->reason == GB_FIT_UNSETTLED) {
        return gb_error_set(err, GB_ERR_NOT_CONVERGED,
                            "the fit of an exponential did not settle in %d iterations: "
                            "the points show no time constant between their spacing and "
                            "their span",
                            GB_DECAY_ITERATIONS);
    }
    report(fit, &best, points);
    return true;
}

bool gb_fit_decay(struct gb_fit_decay *fit, const double *t, const double *p,
                  size_t count, struct gb_error *err)
{
    struct gb_decay_points points;
    if (!gb_decay_points_init(&points, t, p, count, err)) {
        return false;
    }
    const bool good = choose(fit, &points, err);
    gb_decay_points_finish(&points);
    return good;
}

double gb_fit_decay_at(const struct gb_fit_decay *fit, double t)
{
    double p = fit->p0.value;
    for (int k = 0; k < fit->terms; k++) {
        p += fit->amplitude[k].value * exp(-t / fit->tau[k].value);
    }
    return p;
}
