#include "measure/compaction_fits.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "measure/average.h"
#include "measure/equations.h"
#include "measure/fit.h"

/* Least squares of a compaction equation, and the intervals of its parameters.
 *
 *   iteration   Levenberg-Marquardt steps in coordinates: the logarithm of positive parameters
 *   fit         start values, iteration, linear intervals, AICc
 *   jackknife   intervals from the scatter of replicas
 *   profile     intervals where the sum of squares is not quadratic */

enum { GB_EQUATION_ITERATE_ALL = -1 };

struct iteration {
    const struct gb_equation *equation;
    const struct gb_equations_points *points;
    int fixed; /* a parameter that is held; GB_EQUATION_ITERATE_ALL: none */
    double *x; /* parameters, D0 last: start values, and the result */
    double squares;
    bool converged;
    int undetermined; /* a parameter that the points do not determine; ALL: none */
    double covariance[GB_EQUATIONS_PARAMETERS]; /* diagonal, of unit variance */
};

/* ---- Iteration ---- */

enum { ITERATIONS = 400 };

/* Residual where parameters give no density: a step there is rejected. */
static const double outside_most = 1e6;

/* Points do not determine a positive parameter where a factor of e changes no density by
 * more than this, */
static const double least_effect = 1e-9;

/* nor one that the others replace but for this fraction of its squared effect. */
static const double least_own = 1e-14;

/* Parameters that move, and all of them at the present step. */
struct state {
    const struct gb_equation *equation;
    const struct gb_equations_points *points;
    size_t free[GB_EQUATIONS_PARAMETERS];
    double unit[GB_EQUATIONS_PARAMETERS]; /* of the coordinates, powers of 2 */
    double x[GB_EQUATIONS_PARAMETERS];
};

/* Parameter k as a coordinate, and back. */
static double coordinate_of(const struct gb_equation *equation, size_t k, double x)
{
    return gb_equations_parameter(equation, k)->positive ? log(x) : x;
}

static double value_of(const struct gb_equation *equation, size_t k, double coordinate)
{
    return gb_equations_parameter(equation, k)->positive ? exp(coordinate) : coordinate;
}

static void set_parameters(struct state *state, const gsl_vector *coordinate)
{
    for (size_t k = 0; k < coordinate->size; k++) {
        state->x[state->free[k]] =
            value_of(state->equation, state->free[k],
                     state->unit[k] * gsl_vector_get(coordinate, k));
    }
}

static int residuals(const gsl_vector *coordinate, void *data, gsl_vector *f)
{
    struct state *state = data;
    const struct gb_equations_points *points = state->points;
    set_parameters(state, coordinate);
    for (size_t i = 0; i < points->count; i++) {
        const double off =
            state->equation->density(state->x, points->pressure[i]) - points->density[i];
        const double root = sqrt(gb_equations_weight(points, i));
        gsl_vector_set(f, i, root * (fabs(off) < outside_most ? off : outside_most));
    }
    return GSL_SUCCESS;
}

static int jacobian(const gsl_vector *coordinate, void *data, gsl_matrix *j)
{
    struct state *state = data;
    const struct gb_equations_points *points = state->points;
    set_parameters(state, coordinate);
    for (size_t i = 0; i < points->count; i++) {
        double slope[GB_EQUATIONS_PARAMETERS];
        const double root = sqrt(gb_equations_weight(points, i));
        state->equation->slope(state->x, points->pressure[i], slope);
        for (size_t k = 0; k < coordinate->size; k++) {
            const size_t at = state->free[k];
            const double inner = gb_equations_parameter(state->equation, at)->positive
                                     ? state->x[at]
                                     : 1.0;
            const double value = root * inner * slope[at] * state->unit[k];
            gsl_matrix_set(j, i, k, isfinite(value) ? value : 0.0);
        }
    }
    return GSL_SUCCESS;
}

/* The solver ends at absolute limits: a unit in which a parameter that is not positive
 * changes the densities by about 1 makes them independent of the unit of the pressure. */
static void set_units(struct state *state, size_t size)
{
    for (size_t k = 0; k < size; k++) {
        const size_t at = state->free[k];
        double most = 0.0;
        state->unit[k] = 1.0;
        for (size_t i = 0; i < state->points->count; i++) {
            double slope[GB_EQUATIONS_PARAMETERS];
            state->equation->slope(state->x, state->points->pressure[i], slope);
            most = isfinite(slope[at]) ? fmax(most, fabs(slope[at])) : most;
        }
        if (!gb_equations_parameter(state->equation, at)->positive && most > 0.0) {
            int exponent = 0;
            frexp(most, &exponent);
            state->unit[k] = ldexp(1.0, -exponent);
        }
    }
}

/* Whether the points determine free parameter k, with its variance in the coordinate. */
static bool is_determined(const struct state *state, size_t k, const gsl_matrix *slopes,
                          double variance)
{
    const bool positive =
        gb_equations_parameter(state->equation, state->free[k])->positive;
    double effect = 0.0;
    double weights = 0.0;
    for (size_t i = 0; i < slopes->size1; i++) {
        effect += pow(gsl_matrix_get(slopes, i, k), 2.0);
        weights += gb_equations_weight(state->points, i);
    }
    return effect > (positive ? least_effect * least_effect * weights : 0.0) &&
           variance > 0.0 && least_own * variance * effect < 1.0;
}

static void take_result(struct iteration *iterate, const struct state *state,
                        gsl_multifit_nlinear_workspace *work, gsl_matrix *covariance)
{
    const gsl_matrix *slopes = gsl_multifit_nlinear_jac(work);
    gsl_multifit_nlinear_covar(slopes, 0.0, covariance);
    iterate->undetermined = GB_EQUATION_ITERATE_ALL;
    for (size_t k = 0; k < covariance->size1; k++) {
        const size_t at = state->free[k];
        const double unit = state->unit[k];
        const double variance = gsl_matrix_get(covariance, k, k);
        iterate->x[at] =
            value_of(state->equation, at,
                     unit * gsl_vector_get(gsl_multifit_nlinear_position(work), k));
        iterate->covariance[at] = unit * unit * variance;
        if (!is_determined(state, k, slopes, variance)) {
            iterate->undetermined = (int)at;
        }
    }
    iterate->squares =
        gb_equations_squares(state->points, state->equation->density, iterate->x);
}

static bool run(struct iteration *iterate, struct state *state, size_t size,
                struct gb_error *err)
{
    const gsl_multifit_nlinear_parameters options =
        gsl_multifit_nlinear_default_parameters();
    gsl_multifit_nlinear_fdf system = {.f = residuals,
                                       .df = jacobian,
                                       .n = iterate->points->count,
                                       .p = size,
                                       .params = state};
    gsl_multifit_nlinear_workspace *work = gsl_multifit_nlinear_alloc(
        gsl_multifit_nlinear_trust, &options, iterate->points->count, size);
    gsl_matrix *covariance = gsl_matrix_alloc(size, size);
    gsl_vector *start = gsl_vector_alloc(size);
    const bool made = work != NULL && covariance != NULL && start != NULL;
    if (made) {
        int info = 0;
        set_units(state, size);
        for (size_t k = 0; k < size; k++) {
            gsl_vector_set(start, k,
                           coordinate_of(iterate->equation, state->free[k],
                                         iterate->x[state->free[k]]) /
                               state->unit[k]);
        }
        gsl_multifit_nlinear_init(start, &system, work);
        const int status = gsl_multifit_nlinear_driver(ITERATIONS, 1e-10, 1e-12, 0.0,
                                                       NULL, NULL, &info, work);
        take_result(iterate, state, work, covariance);
        iterate->converged = gb_fit_settled(status, info) && isfinite(iterate->squares);
    } else {
        gb_error_set(err, GB_ERR_MEMORY, "out of memory for a fit of %zu points",
                     iterate->points->count);
    }
    gsl_vector_free(start);
    gsl_matrix_free(covariance);
    gsl_multifit_nlinear_free(work);
    return made;
}

/* Errors: GB_ERR_MEMORY; an iteration that does not settle is no error. */
static bool iteration(struct iteration *iterate, struct gb_error *err)
{
    struct state state = {.equation = iterate->equation, .points = iterate->points};
    const size_t size = gb_equations_size(iterate->equation, iterate->points);
    size_t moving = 0;
    memcpy(state.x, iterate->x, sizeof state.x);
    for (size_t k = 0; k < size; k++) {
        if ((int)k != iterate->fixed) {
            state.free[moving++] = k;
        }
    }
    return run(iterate, &state, moving, err);
}

/* ---- Fit ---- */

static const double interval_level = 0.975; /* two-sided 95 % */

/* Residuals below this are equation_fit_rounding. */
static const double equation_fit_rounding = 1e-12;

/* Fewer replicas tell nothing about their scatter. */
enum { REPLICAS_LEAST = 3 };

/* Unknown initial densities that the iteration starts from, over the lowest density. */
static const double initial_shares[] = {0.99, 0.95, 0.85, 0.7, 0.45};

double gb_compaction_fits_at(const struct gb_equation_fit *fit, double pressure)
{
    return fit->equation->density(fit->x, pressure);
}

static double lowest_density(const struct gb_equations_points *points)
{
    double low = points->density[0];
    for (size_t i = 1; i < points->count; i++) {
        low = fmin(low, points->density[i]);
    }
    return low;
}

/* k1 < k2: the terms of Cooper and Eaton have no order of their own. */
static void order_terms(const struct gb_equation *equation, double *x, double *covariance)
{
    if (equation != gb_equations_find("cooper-eaton") || x[2] <= x[3]) {
        return;
    }
    for (int k = 0; k <= 2; k += 2) {
        const double kept = x[k];
        const double kept_covariance = covariance[k];
        x[k] = x[k + 1];
        covariance[k] = covariance[k + 1];
        x[k + 1] = kept;
        covariance[k + 1] = kept_covariance;
    }
}

/* Why the points leave an equation without a best fit. */
static bool refuse(const struct gb_equation *equation,
                   const struct gb_equations_points *points, int undetermined,
                   struct gb_error *err)
{
    const double *p = points->pressure;
    const double *rho = points->density;
    double low = rho[0];
    double high = rho[0];
    double middle = 0.0;
    double rise = 0.0; /* sign of the slope of rho over P */
    for (size_t i = 0; i < points->count; i++) {
        low = fmin(low, rho[i]);
        high = fmax(high, rho[i]);
        middle += p[i] / (double)points->count;
    }
    for (size_t i = 0; i < points->count; i++) {
        rise += (p[i] - middle) * (rho[i] - low);
    }
    const char *name = "its parameters";
    if (undetermined != GB_EQUATION_ITERATE_ALL) {
        name = gb_equations_parameter(equation, (size_t)undetermined)->name;
    }
    if (high - low <= equation_fit_rounding * high) {
        return gb_error_set(err, GB_ERR_NOT_CONVERGED,
                            "%s: all densities are %.6g: the points do not determine %s",
                            equation->name, low, name);
    }
    if (!(rise > 0.0)) {
        return gb_error_set(err, GB_ERR_NOT_CONVERGED,
                            "%s: the density falls with the pressure, from %.6g to %.6g: "
                            "the points do not determine %s",
                            equation->name, rho[0], rho[points->count - 1], name);
    }
    return gb_error_set(err, GB_ERR_NOT_CONVERGED,
                        "%s: the points do not determine %s: other values describe them "
                        "as well",
                        equation->name, name);
}

/* The best of the iterations from all start values. */
static bool minimise(struct gb_equation_fit *fit,
                     const struct gb_equations_points *points, double *covariance,
                     struct gb_error *err)
{
    const struct gb_equation *equation = fit->equation;
    const bool unknown = gb_equations_fits_initial(equation, points);
    const size_t starts = unknown ? sizeof initial_shares / sizeof initial_shares[0] : 1;
    int undetermined = GB_EQUATION_ITERATE_ALL;
    fit->squares = INFINITY;
    for (size_t s = 0; s < starts; s++) {
        double x[GB_EQUATIONS_PARAMETERS] = {0.0};
        struct iteration iterate = {.equation = equation,
                                    .points = points,
                                    .fixed = GB_EQUATION_ITERATE_ALL,
                                    .x = x};
        if ((equation->domain & GB_EQUATIONS_ABOVE_INITIAL) != 0) {
            x[equation->count] =
                unknown ? initial_shares[s] * lowest_density(points) : points->initial;
        }
        equation->start(points, x);
        if (!iteration(&iterate, err)) {
            return false;
        }
        if (iterate.undetermined != GB_EQUATION_ITERATE_ALL) {
            undetermined = iterate.undetermined;
        } else if (iterate.converged && iterate.squares < fit->squares) {
            order_terms(equation, x, iterate.covariance);
            fit->squares = iterate.squares;
            memcpy(fit->x, x, sizeof x);
            memcpy(covariance, iterate.covariance, sizeof iterate.covariance);
        }
    }
    return isfinite(fit->squares) || refuse(equation, points, undetermined, err);
}

/* rms, correlation and what follows from them. */
static bool set_scatter(struct gb_equation_fit *fit,
                        const struct gb_equations_points *points, struct gb_error *err)
{
    const double n = (double)points->count;
    const double degrees = n - (double)fit->size;
    const double k = (double)fit->size + 1.0;
    double *residual = gb_alloc_array(points->count, sizeof *residual, err);
    double sum = 0.0;
    if (residual == NULL) {
        return false;
    }
    for (size_t i = 0; i < points->count; i++) {
        const double off =
            gb_compaction_fits_at(fit, points->pressure[i]) - points->density[i];
        sum += off * off;
        residual[i] = off * sqrt(gb_equations_weight(points, i));
    }
    fit->rms = sqrt(sum / n);
    fit->correlation = gb_fit_correlation(residual, points->count, 0.0);
    gb_alloc_free(residual);
    const double least =
        points->error != NULL ? 1.0 : equation_fit_rounding * equation_fit_rounding;
    fit->variance = fmax(fit->squares / degrees, least) * fit->correlation;
    fit->quantile = gsl_cdf_tdist_Pinv(
        interval_level, fmax(n / fit->correlation - (double)fit->size, 1.0));
    fit->aicc =
        n * log(fmax(fit->squares / n, equation_fit_rounding * equation_fit_rounding)) +
        2.0 * k + 2.0 * k * (k + 1.0) / (n - k - 1.0);
    return true;
}

/* An interval of half width `half` in the coordinate of the fit. */
static void set_interval(struct gb_equation_fit *fit, size_t k, double half)
{
    const double at = coordinate_of(fit->equation, k, fit->x[k]);
    fit->value[k].low = value_of(fit->equation, k, at - half);
    fit->value[k].high = value_of(fit->equation, k, at + half);
}

static void set_values(struct gb_equation_fit *fit, const double *covariance)
{
    for (size_t k = 0; k < fit->size; k++) {
        const double error = sqrt(covariance[k] * fit->variance);
        const bool positive = gb_equations_parameter(fit->equation, k)->positive;
        fit->value[k].value = fit->x[k];
        fit->value[k].error = positive ? fit->x[k] * error : error;
        set_interval(fit, k, fit->quantile * error);
    }
}

bool gb_compaction_fits_equation_fit(struct gb_equation_fit *fit,
                                     const struct gb_equation *equation,
                                     const struct gb_equations_points *points,
                                     struct gb_error *err)
{
    double covariance[GB_EQUATIONS_PARAMETERS] = {0.0};
    *fit = (struct gb_equation_fit){.equation = equation, .points = points->count};
    if (!gb_equations_check(equation, points, err)) {
        return false;
    }
    fit->size = gb_equations_size(equation, points);
    if (!minimise(fit, points, covariance, err) || !set_scatter(fit, points, err)) {
        return false;
    }
    set_values(fit, covariance);
    return true;
}

/* ---- Jackknife over replicas ---- */

/* Mean over the replicas but one. */
static void mean_without(const struct gb_equations_points *points, size_t without,
                         double *mean)
{
    for (size_t i = 0; i < points->count; i++) {
        double sum = 0.0;
        for (size_t r = 0; r < points->replicas; r++) {
            sum += r != without ? points->rows[r * points->stride + i] : 0.0;
        }
        mean[i] = sum / (double)(points->replicas - 1);
    }
}

/* found: replicas x size, in the coordinates of the fit; NaN where one does not settle. */
static bool fit_without(const struct gb_equation_fit *fit,
                        const struct gb_equations_points *points, size_t without,
                        double *mean, double *found, struct gb_error *err)
{
    double x[GB_EQUATIONS_PARAMETERS];
    struct gb_equations_points some = *points;
    struct iteration iterate = {.equation = fit->equation,
                                .points = &some,
                                .fixed = GB_EQUATION_ITERATE_ALL,
                                .x = x};
    memcpy(x, fit->x, sizeof x);
    mean_without(points, without, mean);
    some.density = mean;
    if (!iteration(&iterate, err)) {
        return false;
    }
    for (size_t k = 0; k < fit->size; k++) {
        found[k * points->replicas + without] =
            iterate.converged ? coordinate_of(fit->equation, k, x[k]) : (double)NAN;
    }
    return true;
}

static void widen(struct gb_equation_fit *fit, size_t k, double error, double quantile)
{
    const struct gb_fit_value before = fit->value[k];
    const bool positive = gb_equations_parameter(fit->equation, k)->positive;
    if (!isfinite(error)) {
        return;
    }
    set_interval(fit, k, quantile * error);
    fit->value[k].low = fmin(fit->value[k].low, before.low);
    fit->value[k].high = fmax(fit->value[k].high, before.high);
    fit->value[k].error = fmax(before.error, positive ? fit->x[k] * error : error);
}

/* Widens the intervals to those of the scatter of the replicas, by the jackknife over
 * them: the points of one replica are correlated along its curve.  Nothing with fewer
 * than three.  Errors: GB_ERR_MEMORY. */
static bool equation_fit_jackknife(struct gb_equation_fit *fit,
                                   const struct gb_equations_points *points,
                                   struct gb_error *err)
{
    const size_t replicas = points->replicas;
    if (points->rows == NULL || replicas < REPLICAS_LEAST) {
        return true;
    }
    double *mean =
        gb_alloc_array(points->count + fit->size * replicas, sizeof *mean, err);
    bool good = mean != NULL;
    double *found = good ? mean + points->count : NULL;
    for (size_t r = 0; r < replicas && good; r++) {
        good = fit_without(fit, points, r, mean, found, err);
    }
    for (size_t k = 0; k < fit->size && good; k++) {
        widen(fit, k, gb_average_jackknife(found + k * replicas, replicas),
              gsl_cdf_tdist_Pinv(interval_level, (double)(replicas - 1)));
    }
    gb_alloc_free(mean);
    return good;
}

/* ---- Profile likelihood ---- */

/* A linear interval stands where the root of the rise of the sum of squares at its ends
 * is within this share of its quantile. */
static const double linear_enough = 0.05;

/* Of the quantile, at an end of a profile interval. */
static const double end_tolerance = 0.005;

enum { DOUBLINGS = 20, STEPS = 60 };

/* Positive parameters this many factors of e away are not bounded. */
static const double farthest_logarithm = 12.0;

/* Profile of one parameter. */
struct profile {
    struct gb_equation_fit *fit;
    const struct gb_equations_points *points;
    size_t k;
    double x[GB_EQUATIONS_PARAMETERS]; /* of the last value inside: the next start */
    struct gb_error *err;
    bool good; /* memory */
};

/* Root of the rise of the sum of squares in units of the variance, with parameter k held
 * at a coordinate; infinite where no other parameters give densities. */
static double rise(struct profile *profile, double coordinate)
{
    const struct gb_equation *equation = profile->fit->equation;
    double x[GB_EQUATIONS_PARAMETERS];
    struct iteration iterate = {.equation = equation,
                                .points = profile->points,
                                .fixed = (int)profile->k,
                                .x = x};
    memcpy(x, profile->x, sizeof x);
    x[profile->k] = value_of(equation, profile->k, coordinate);
    if (!iteration(&iterate, profile->err)) {
        profile->good = false;
        return INFINITY;
    }
    if (!isfinite(iterate.squares)) {
        return INFINITY;
    }
    const double above =
        sqrt(fmax(iterate.squares - profile->fit->squares, 0.0) / profile->fit->variance);
    if (above < profile->fit->quantile) {
        memcpy(profile->x, x, sizeof x);
    }
    return above;
}

/* The coordinate between `inside` and `outside` where the rise is the quantile. */
static double bisect(struct profile *profile, double inside, double outside)
{
    const double wanted = profile->fit->quantile;
    double below = 0.0;
    double above = INFINITY;
    for (int i = 0; i < STEPS && profile->good; i++) {
        /* the rise is almost linear: interpolation, kept away from the ends */
        double share = isfinite(above) ? (wanted - below) / (above - below) : 0.5;
        share = fmin(fmax(share, 0.1), 0.9);
        const double middle = inside + share * (outside - inside);
        const double here = rise(profile, middle);
        if (fabs(here - wanted) < end_tolerance * wanted || middle == inside) {
            return middle;
        }
        if (here < wanted) {
            inside = middle;
            below = here;
        } else {
            outside = middle;
            above = here;
        }
    }
    return 0.5 * (inside + outside);
}

/* The end of the interval, as a coordinate, on the side of `half`. */
static double find_end(struct profile *profile, double at, double half)
{
    const bool positive =
        gb_equations_parameter(profile->fit->equation, profile->k)->positive;
    double inside = at;
    double step = half;
    memcpy(profile->x, profile->fit->x, sizeof profile->x);
    for (int i = 0; i < DOUBLINGS && profile->good; i++) {
        if (positive && fabs(step) > farthest_logarithm) {
            break;
        }
        if (rise(profile, at + step) >= profile->fit->quantile) {
            return bisect(profile, inside, at + step);
        }
        inside = at + step;
        step *= 2.0;
    }
    return half > 0.0 ? INFINITY : -INFINITY;
}

/* The rise at both ends of the linear interval. */
static bool is_linear(struct profile *profile, double at, double half)
{
    const double wanted = profile->fit->quantile;
    for (int side = -1; side <= 1; side += 2) {
        memcpy(profile->x, profile->fit->x, sizeof profile->x);
        if (!(fabs(rise(profile, at + side * half) - wanted) < linear_enough * wanted)) {
            return false;
        }
    }
    return true;
}

/* Replaces linear intervals by those of the profile likelihood where both differ: the sum
 * of squares, minimised over the other parameters, has risen by quantile^2 variance.  An
 * end that is never reached is infinite, or 0 for a positive parameter.
 * Errors: GB_ERR_MEMORY. */
static bool equation_fit_profile(struct gb_equation_fit *fit,
                                 const struct gb_equations_points *points,
                                 struct gb_error *err)
{
    struct profile profile = {.fit = fit, .points = points, .err = err, .good = true};
    for (size_t k = 0; k < fit->size && profile.good; k++) {
        const struct gb_equation *equation = fit->equation;
        struct gb_fit_value *value = &fit->value[k];
        const double at = coordinate_of(equation, k, fit->x[k]);
        const double half = coordinate_of(equation, k, value->high) - at;
        profile.k = k;
        if (!(half > 0.0) || !isfinite(half)) {
            continue;
        }
        if (!is_linear(&profile, at, half) && profile.good) {
            value->low = value_of(equation, k, find_end(&profile, at, -half));
            value->high = value_of(equation, k, find_end(&profile, at, half));
        }
    }
    return profile.good;
}

/* Least length: points, and this share of all. */
enum { POINTS_LEAST = 5 };
static const double share_least = 1.0 / 6.0;

/* Ends of stretches that are tried, for tables of many points. */
enum { ENDS = 200 };

/* Of the F test. */
static const double level = 0.95;

/* Ratios of variances that need no quantile: F at 95 % lies between for any length. */
static const double ratio_small = 1.0;
static const double ratio_large = 10.0;

/* Least share of the variance that is more than rounding. */
static const double rounding = 1e-14;

/* Weighted moments of the points (P, y). */
struct moments {
    double w, x, y, xx, xy, yy; /* means, and sums of products about them */
    double steps;               /* sum of squares from point to point */
};

/* West's update: no cancellation of large sums. */
static void add_point(struct moments *m, double weight, double x, double y)
{
    m->w += weight;
    const double dx = x - m->x;
    const double dy = y - m->y;
    const double share = weight / m->w;
    m->x += share * dx;
    m->y += share * dy;
    m->xx += weight * dx * (x - m->x);
    m->xy += weight * dx * (y - m->y);
    m->yy += weight * dy * (y - m->y);
}

/* A point of the plot: all that were measured at one pressure. */
struct dot {
    double x, y, weight; /* P, y, 1/error^2 of y */
    size_t first, count; /* its points */
};

/* Means over the points from `first` on at its pressure. */
static struct dot dot_at(const struct gb_equations_points *points, size_t first)
{
    struct dot dot = {.x = points->pressure[first], .first = first};
    for (size_t i = first; i < points->count && points->pressure[i] == dot.x; i++) {
        const double porosity = 1.0 - points->density[i];
        const double share = 1.0 / (double)++dot.count;
        dot.y += share * (-log(porosity) - dot.y);
        dot.weight +=
            share * (gb_equations_weight(points, i) * porosity * porosity - dot.weight);
    }
    return dot;
}

/* Squared distance of a dot from the line through its neighbours, in units in which it
 * is the variance of a point on average. */
static double step_at(const struct dot *dot)
{
    const double span = dot[1].x - dot[-1].x;
    const double share = (dot->x - dot[-1].x) / span;
    const double off = dot->y - (1.0 - share) * dot[-1].y - share * dot[1].y;
    return dot->weight * off * off /
           (1.0 + share * share + (1.0 - share) * (1.0 - share));
}

/* Sum of squares that a line leaves. */
static double rest_of(const struct moments *m)
{
    return m->xx > 0.0 ? fmax(m->yy - m->xy * m->xy / m->xx, rounding * m->yy) : m->yy;
}

/* A stretch, its length in MPa, and 1 - R^2 (adjusted). */
struct candidate {
    size_t first, count;
    double length, remainder;
};

static double remainder_of(const struct moments *m, size_t count)
{
    if (count <= 2) {
        return 0.0;
    }
    return m->yy > 0.0 ? rest_of(m) / m->yy * (double)(count - 1) / (double)(count - 2)
                       : 1.0;
}

static bool is_straight(const struct moments *m, size_t count)
{
    const double ratio =
        rest_of(m) / fmax(m->steps, rounding * m->yy); /* as many terms in both */
    const double degrees = (double)(count - 2);
    return ratio <= ratio_small ||
           (ratio < ratio_large && ratio <= gsl_cdf_fdist_Pinv(level, degrees, degrees));
}

/* The best stretches so far. */
struct found {
    struct candidate straight, least; /* count 0: none */
};

static void judge(struct found *found, const struct moments *moments,
                  const struct candidate *here)
{
    if (here->length > found->straight.length && is_straight(moments, here->count)) {
        found->straight = *here;
    }
    if (found->least.count == 0 || here->remainder < found->least.remainder) {
        found->least = *here;
    }
}

static void search_from(struct found *found, const struct dot *dots, size_t size,
                        size_t first, size_t least, size_t stride)
{
    struct moments moments = {0};
    for (size_t i = first; i < size; i++) {
        const size_t count = i + 1 - first;
        add_point(&moments, dots[i].weight, dots[i].x, dots[i].y);
        moments.steps += count > 2 ? step_at(&dots[i - 1]) : 0.0;
        if (count >= least && (size - 1 - i) % stride == 0) {
            const struct candidate here = {first, count, dots[i].x - dots[first].x,
                                           remainder_of(&moments, count)};
            judge(found, &moments, &here);
        }
    }
}

bool gb_compaction_fits_heckel_stretch(struct gb_compaction_fits_heckel_stretch *stretch,
                                       const struct gb_equations_points *points,
                                       struct gb_error *err)
{
    struct dot *dots = gb_alloc_array(points->count, sizeof *dots, err);
    if (dots == NULL) {
        return false;
    }
    size_t size = 0;
    for (size_t i = 0; i < points->count; i += dots[size++].count) {
        dots[size] = dot_at(points, i);
    }
    const double share = ceil(share_least * (double)size);
    const size_t enough = share > POINTS_LEAST ? (size_t)share : POINTS_LEAST;
    const size_t least = enough < size ? enough : size;
    const size_t stride = 1 + size / ENDS;
    struct found found = {0};
    for (size_t first = 0; first + least <= size; first += stride) {
        search_from(&found, dots, size, first, least, stride);
    }
    const bool straight = found.straight.count > 0;
    const struct candidate *best = straight ? &found.straight : &found.least;
    const struct dot *last = &dots[best->first + best->count - 1];
    const size_t begin = dots[best->first].first;
    *stretch = (struct gb_compaction_fits_heckel_stretch){
        begin, last->first + last->count - begin, straight, 1.0 - best->remainder};
    gb_alloc_free(dots);
    return true;
}

static bool set_intervals(struct gb_equation_fit *fit,
                          const struct gb_equations_points *points,
                          enum gb_compaction_intervals intervals, struct gb_error *err)
{
    return intervals == GB_COMPACTION_LINEAR ||
           (equation_fit_profile(fit, points, err) &&
            equation_fit_jackknife(fit, points, err));
}

static bool fit_one(struct gb_compaction_fit *row, const struct gb_equation *equation,
                    const struct gb_equations_points *points,
                    enum gb_compaction_intervals intervals, struct gb_error *err)
{
    *row = (struct gb_compaction_fit){.equation = equation, .delta = NAN};
    row->fitted =
        gb_compaction_fits_equation_fit(&row->all, equation, points, &row->refusal);
    if (row->refusal.code == GB_ERR_MEMORY) {
        return gb_error_set(err, GB_ERR_MEMORY, "%s", row->refusal.text);
    }
    return !row->fitted || set_intervals(&row->all, points, intervals, err);
}

static bool fit_stretch(struct gb_compaction_fits *fits,
                        const struct gb_equation *equation,
                        const struct gb_equations_points *points,
                        enum gb_compaction_intervals intervals, struct gb_error *err)
{
    struct gb_equations_points part = *points;
    if (!gb_compaction_fits_heckel_stretch(&fits->stretch, points, err)) {
        return false;
    }
    const size_t first = fits->stretch.first;
    part.count = fits->stretch.count;
    part.pressure += first;
    part.density += first;
    part.error = points->error != NULL ? points->error + first : NULL;
    part.rows = points->rows != NULL ? points->rows + first : NULL;
    return gb_compaction_fits_equation_fit(&fits->heckel, equation, &part, err) &&
           set_intervals(&fits->heckel, &part, intervals, err);
}

/* 1/K; unbounded where the interval of K contains 0 or K is not above it. */
static void set_yield(struct gb_compaction_fits *fits)
{
    const struct gb_fit_value *k = &fits->heckel.value[0];
    fits->yield = (struct gb_fit_value){
        .value = k->value > 0.0 ? 1.0 / k->value : (double)INFINITY,
        .error = k->error / (k->value * k->value),
        .low = k->high > 0.0 ? 1.0 / k->high : -(double)INFINITY,
        .high = k->low > 0.0 ? 1.0 / k->low : (double)INFINITY,
    };
}

/* The straightest stretch of Heckel's plot, where the equation is defined. */
static bool fit_heckel(struct gb_compaction_fits *fits, struct gb_compaction_fit *row,
                       const struct gb_equations_points *points,
                       enum gb_compaction_intervals intervals, struct gb_error *err)
{
    struct gb_error cause = {0};
    if (!row->fitted) {
        return true;
    }
    if (fit_stretch(fits, row->equation, points, intervals, &cause)) {
        set_yield(fits);
        return true;
    }
    row->fitted = false;
    row->refusal = cause;
    return cause.code != GB_ERR_MEMORY || gb_error_set(err, cause.code, "%s", cause.text);
}

static bool before(const struct gb_compaction_fit *a, const struct gb_compaction_fit *b)
{
    return a->fitted != b->fitted ? a->fitted : a->fitted && a->all.aicc < b->all.aicc;
}

/* By AICc; equal ones, such as Walker's and Balshin's, in the order of the table. */
static void sort(struct gb_compaction_fits *fits)
{
    for (size_t i = 1; i < fits->count; i++) {
        const struct gb_compaction_fit moved = fits->fit[i];
        size_t at = i;
        for (; at > 0 && before(&moved, &fits->fit[at - 1]); at--) {
            fits->fit[at] = fits->fit[at - 1];
        }
        fits->fit[at] = moved;
    }
    for (size_t i = 0; i < fits->count; i++) {
        struct gb_compaction_fit *row = &fits->fit[i];
        fits->fitted += row->fitted;
        row->delta = row->fitted ? row->all.aicc - fits->fit[0].all.aicc : (double)NAN;
    }
}

static bool is_heckel(const struct gb_equation *equation)
{
    return equation == gb_equations_find("heckel");
}

bool gb_compaction_fits(struct gb_compaction_fits *fits,
                        const struct gb_equations_points *points,
                        const struct gb_equation *only,
                        enum gb_compaction_intervals intervals, struct gb_error *err)
{
    *fits = (struct gb_compaction_fits){0};
    for (size_t i = 0; i < gb_equations_count(); i++) {
        const struct gb_equation *equation = gb_equations_at(i);
        if (only != NULL && only != equation) {
            continue;
        }
        struct gb_compaction_fit *row = &fits->fit[fits->count++];
        if (!fit_one(row, equation, points, intervals, err) ||
            (is_heckel(equation) && !fit_heckel(fits, row, points, intervals, err))) {
            return false;
        }
    }
    sort(fits);
    return true;
}

const struct gb_equation_fit *
gb_compaction_fits_reported(const struct gb_compaction_fits *fits, size_t index)
{
    const struct gb_compaction_fit *row = &fits->fit[index];
    return is_heckel(row->equation) ? &fits->heckel : &row->all;
}

size_t gb_compaction_fits_values(const struct gb_compaction_fits *fits, size_t index)
{
    return gb_compaction_fits_reported(fits, index)->size +
           is_heckel(fits->fit[index].equation);
}

struct gb_compaction_value gb_compaction_fits_value(const struct gb_compaction_fits *fits,
                                                    size_t index, size_t k)
{
    const struct gb_equation_fit *fit = gb_compaction_fits_reported(fits, index);
    if (k == fit->size) {
        return (struct gb_compaction_value){"yield_pressure", "MPa", fits->yield};
    }
    const struct gb_equations_parameter *parameter =
        gb_equations_parameter(fit->equation, k);
    return (struct gb_compaction_value){parameter->name, parameter->unit, fit->value[k]};
}
