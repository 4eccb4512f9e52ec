#include "measure/fit/fit.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <math.h>

#include "measure/fit/decay.h"

/* Without an exponential its time constant is undetermined, so the F test finds an exponential
 * more often than its level says (the parameter exists under one hypothesis only).  The level
 * is therefore 99 %, while intervals are at 95 %. */
static const double f_level = 0.99;

static const double interval_level = 0.975; /* two-sided 95 % */

bool gb_fit_settled(int status, int info)
{
    return status == GSL_SUCCESS || status == GSL_ENOPROG || info == GSL_ENOPROG;
}

static int degrees_of(const struct gb_decay *found, const struct gb_decay_points *points)
{
    return (int)points->count - 1 - 2 * found->terms;
}

/* Of the points about the fit. */
static double scatter_of(const struct gb_decay *found,
                         const struct gb_decay_points *points)
{
    return sqrt(found->squares / degrees_of(found, points));
}

/* Points of a simulation are correlated: one in `stretch` is independent.
 */
static double independent_degrees(const struct gb_decay *found,
                                  const struct gb_decay_points *points)
{
    const double independent = (double)points->count / found->correlation;
    return fmax(independent - 1.0 - 2.0 * found->terms, 1.0);
}

static double error_of(const struct gb_decay *found, const struct gb_decay_points *points,
                       int k)
{
    return scatter_of(found, points) * sqrt(found->correlation * found->covariance[k][k]);
}

/* Half the 95 % interval of parameter k. */
static double half_width(const struct gb_decay *found,
                         const struct gb_decay_points *points, int k)
{
    return gsl_cdf_tdist_Pinv(interval_level, independent_degrees(found, points)) *
           error_of(found, points, k);
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
           ((rich->squares + points->floor) / degrees_of(rich, points)) /
           rich->correlation;
}

static struct gb_fit_value value_of(const struct gb_decay *found,
                                    const struct gb_decay_points *points, int k,
                                    double unit, double shift)
{
    const double half = half_width(found, points, k);
    const double error = error_of(found, points, k);
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
    fit->correlation = found->correlation;
    fit->scatter = points->p_unit * scatter_of(found, points);
    fit->p0 = value_of(found, points, 0, points->p_unit, points->p_shift);
    for (int k = 0; k < GB_FIT_TERMS; k++) {
        const bool there = k < found->terms;
        fit->amplitude[k] =
            there ? value_of(found, points, 1 + 2 * k, points->p_unit, 0.0) : none;
        fit->tau[k] = there ? tau_of(found, points, 2 + 2 * k) : none;
    }
}

/* Reason to reject the last exponential of rich; GB_FIT_FULL when there is none. */
static enum gb_fit_reason objection(const struct gb_decay *poor,
                                    const struct gb_decay *rich,
                                    const struct gb_decay_points *points, double *f,
                                    double *f_most)
{
    *f = f_ratio(poor, rich, points);
    *f_most = gsl_cdf_fdist_Pinv(f_level, 2.0, independent_degrees(rich, points));
    if (!(*f > *f_most)) {
        return GB_FIT_INSIGNIFICANT;
    }
    if (!rich->converged) {
        return GB_FIT_NOT_CONVERGED;
    }
    return is_certain(rich, points) ? GB_FIT_FULL : GB_FIT_UNCERTAIN;
}

/* The fits with 0, 1 and 2 exponentials.  A fit with too few terms leaves residuals that
 * look correlated, so the least correlation of the three is taken for all. */
static bool fit_all(struct gb_decay found[GB_FIT_TERMS + 1],
                    const struct gb_decay_points *points, struct gb_error *err)
{
    gb_decay_constant(&found[0], points);
    double correlation = found[0].correlation;
    for (int terms = 1; terms <= GB_FIT_TERMS; terms++) {
        if (!gb_decay_terms(&found[terms], terms, points, err)) {
            return false;
        }
        correlation = fmin(correlation, found[terms].converged ? found[terms].correlation
                                                               : correlation);
    }
    for (int terms = 0; terms <= GB_FIT_TERMS; terms++) {
        found[terms].correlation = correlation;
    }
    return true;
}

/* Removes exponentials that the data do not support. */
static bool choose(struct gb_fit_decay *fit, const struct gb_decay_points *points,
                   struct gb_error *err)
{
    struct gb_decay found[GB_FIT_TERMS + 1];
    if (!fit_all(found, points, err)) {
        return false;
    }
    int terms = GB_FIT_TERMS;
    fit->reason = GB_FIT_FULL;
    while (terms > 0) {
        double f = 0.0;
        double f_most = 0.0;
        const enum gb_fit_reason against =
            objection(&found[terms - 1], &found[terms], points, &f, &f_most);
        if (against != GB_FIT_FULL || terms == GB_FIT_TERMS) {
            fit->f = f;
            fit->f_most = f_most;
        }
        if (against == GB_FIT_FULL) {
            break;
        }
        fit->reason = (int)against;
        terms--;
    }
    if (terms == 0 && fit->reason == GB_FIT_NOT_CONVERGED) {
        return gb_error_set(err, GB_ERR_NOT_CONVERGED,
                            "the fit of an exponential did not settle in %d iterations: "
                            "the points show no time constant between their spacing and "
                            "their span",
                            GB_DECAY_ITERATIONS);
    }
    report(fit, &found[terms], points);
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

double gb_fit_decay_fall(const struct gb_fit_decay *fit)
{
    double fall = 0.0;
    for (int i = 0; i < fit->terms; i++) {
        fall += fit->amplitude[i].value;
    }
    return fall > 0.0 ? fall : (double)NAN;
}

double gb_fit_decay_efold(const struct gb_fit_decay *fit)
{
    const double level = fit->p0.value + gb_fit_decay_fall(fit) / M_E;
    if (!isfinite(level)) {
        return NAN;
    }
    double low = 0.0;
    double high = fit->tau[fit->terms - 1].value;
    while (gb_fit_decay_at(fit, high) > level) { /* p may rise at first */
        high *= 2.0;
    }
    for (int i = 0; i < 60; i++) {
        const double middle = 0.5 * (low + high);
        if (gb_fit_decay_at(fit, middle) > level) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return high;
}
