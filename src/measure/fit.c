/* Fits a relaxation by none, one or two exponentials.  A grid of time constants gives the start
 * values, the method of Levenberg and Marquardt the fit, an F test the number of terms. */
#include "measure/fit.h"

#include <float.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "greenbody/status.h"

/* One fit of a given number of exponentials; fit.h selects the number. */

/* Time constants beyond this multiple of the span cannot be determined. */
#define GB_DECAY_TAU_LONGEST 100.0

/* Points in units in which time span and range of pressures are 1. */
struct decay_points {
    double *t, *p;
    size_t count;
    double t_unit, p_unit, p_shift;
    double spacing; /* least difference of two times */
    double floor;   /* sum of squares of rounding alone */
};

/* Parameters p0, then (amplitude, ln tau) per term with tau ascending. */
struct decay {
    int terms;
    bool converged; /* converged, to time constants within the range of the data */
    double x[GB_DECAY_PARAMETERS];
    double covariance[GB_DECAY_PARAMETERS][GB_DECAY_PARAMETERS]; /* of unit variance */
    double squares;
    double correlation; /* points per independent point, 1 for independent residuals */
};

enum { START_TERMS = 2 };

/* Initial values for the fit of exponentials. */
struct decay_start {
    double p0;
    double amplitude[START_TERMS];
    double tau[START_TERMS]; /* ascending */
};

/* Time constants of the grid: from the span / 3000 to the span * 3, a factor of 1.5
 * apart. Between neighbours the sum of squares has no second minimum. */
enum { GRID = 26, SIZE = GRID + 1 };
static const double shortest = 1.0 / 3000.0;
static const double longest = 3.0;

/* Centred columns: the exponentials of the grid, then p.  All sums that the linear
 * problems need, collected in one pass over the points. */
struct sums {
    double tau[GRID];
    double mean[SIZE];
    double product[SIZE][SIZE];
};

static void fill_row(const struct sums *sums, double t, double p, double row[SIZE])
{
    for (int k = 0; k < GRID; k++) {
        row[k] = exp(-t / sums->tau[k]);
    }
    row[GRID] = p;
}

static void collect(struct sums *sums, const double *t, const double *p, size_t count)
{
    double row[SIZE];
    for (size_t i = 0; i < count; i++) {
        fill_row(sums, t[i], p[i], row);
        for (int a = 0; a < SIZE; a++) {
            sums->mean[a] += row[a] / (double)count;
        }
    }
    for (size_t i = 0; i < count; i++) {
        fill_row(sums, t[i], p[i], row);
        for (int a = 0; a < SIZE; a++) {
            row[a] -= sums->mean[a];
        }
        for (int a = 0; a < SIZE; a++) {
            for (int b = 0; b <= a; b++) {
                sums->product[a][b] += row[a] * row[b];
            }
        }
    }
}

/* Reduction of the sum of squares by one exponential. */
static double gain_of_one(const struct sums *sums, int a, double *amplitude)
{
    const double square = sums->product[a][a];
    *amplitude = square > 0.0 ? sums->product[GRID][a] / square : 0.0;
    return *amplitude * sums->product[GRID][a];
}

/* The same for two, a < b; 0 where they are linearly dependent. */
static double gain_of_two(const struct sums *sums, int a, int b, double amplitude[2])
{
    const double aa = sums->product[a][a];
    const double bb = sums->product[b][b];
    const double ab = sums->product[b][a];
    const double ap = sums->product[GRID][a];
    const double bp = sums->product[GRID][b];
    const double determinant = aa * bb - ab * ab;
    if (!(determinant > 1e-10 * aa * bb)) {
        return 0.0;
    }
    amplitude[0] = (ap * bb - bp * ab) / determinant;
    amplitude[1] = (bp * aa - ap * ab) / determinant;
    return amplitude[0] * ap + amplitude[1] * bp;
}

static void best_one(struct decay_start *start, const struct sums *sums)
{
    double most = -1.0;
    for (int a = 0; a < GRID; a++) {
        double amplitude = 0.0;
        const double gain = gain_of_one(sums, a, &amplitude);
        if (gain > most) {
            most = gain;
            start->amplitude[0] = amplitude;
            start->tau[0] = sums->tau[a];
            start->p0 = sums->mean[GRID] - amplitude * sums->mean[a];
        }
    }
}

static void best_two(struct decay_start *start, const struct sums *sums)
{
    double most = -1.0;
    for (int b = 1; b < GRID; b++) {
        for (int a = 0; a < b; a++) {
            double amplitude[2] = {0.0, 0.0};
            const double gain = gain_of_two(sums, a, b, amplitude);
            if (gain > most) {
                most = gain;
                start->amplitude[0] = amplitude[0];
                start->amplitude[1] = amplitude[1];
                start->tau[0] = sums->tau[a];
                start->tau[1] = sums->tau[b];
                start->p0 = sums->mean[GRID] - amplitude[0] * sums->mean[a] -
                            amplitude[1] * sums->mean[b];
            }
        }
    }
}

/* Best of a grid of time constants for terms exponentials (1 or 2).  The linear
 * parameters are solved for at each point of the grid (variable projection), so no
 * initial value is needed.  t is not negative, has two different values at least, and
 * ends at t_end > 0. */
static bool decay_start(struct decay_start *start, int terms, const double *t,
                        const double *p, size_t count, struct gb_error *err)
{
    struct sums *sums = gb_alloc_array(1, sizeof *sums, err);
    if (sums == NULL) {
        return false;
    }
    double first = t[0];
    double last = t[0];
    for (size_t i = 0; i < count; i++) {
        first = fmin(first, t[i]);
        last = fmax(last, t[i]);
    }
    for (int k = 0; k < GRID; k++) {
        sums->tau[k] =
            (last - first) * shortest * pow(longest / shortest, k / (GRID - 1.0));
    }
    collect(sums, t, p, count);
    *start = (struct decay_start){0};
    if (terms == 1) {
        best_one(start, sums);
    } else {
        best_two(start, sums);
    }
    gb_alloc_free(sums);
    return true;
}

/* Scatter below this share of the largest value is rounding, of the data or of the
 * iteration. */
static const double rounding = 1e-9;

/* Time constants below this multiple of the least spacing cannot be determined. */
static const double tau_shortest = 0.01;

/* Autocorrelation that counts as none. */
static const double died_away = 0.05;

static int compare_doubles(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Least difference of two times, and how many different times there are.  t is sorted in
 * place. */
static size_t measure_times(double *t, size_t count, double *spacing)
{
    size_t different = 1;
    qsort(t, count, sizeof *t, compare_doubles);
    *spacing = t[count - 1] - t[0];
    for (size_t i = 1; i < count; i++) {
        if (t[i] > t[i - 1]) {
            different++;
            *spacing = fmin(*spacing, t[i] - t[i - 1]);
        }
    }
    return different;
}

static bool check_points(const double *t, const double *p, size_t count,
                         struct gb_error *err)
{
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(t[i]) || !isfinite(p[i])) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "point %zu of the relaxation is not a finite number",
                                i + 1);
        }
        if (t[i] < 0.0) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "point %zu of the relaxation is before its beginning",
                                i + 1);
        }
    }
    return count >= GB_FIT_DECAY_POINTS ||
           gb_error_set(err, GB_ERR_INPUT,
                        "%zu points of a relaxation; a fit needs %d or more", count,
                        GB_FIT_DECAY_POINTS);
}

/* Fills the scaled copy; its arrays have room for count. */
static bool scale(struct decay_points *points, const double *t, const double *p,
                  struct gb_error *err)
{
    const size_t count = points->count;
    memcpy(points->t, t, count * sizeof *t);
    const size_t different = measure_times(points->t, count, &points->spacing);
    if (different < GB_FIT_DECAY_POINTS) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%zu different times in a relaxation; a fit needs %d or more",
                            different, GB_FIT_DECAY_POINTS);
    }
    points->t_unit = points->t[count - 1] - points->t[0];
    points->spacing /= points->t_unit;
    double low = p[0];
    double high = p[0];
    for (size_t i = 0; i < count; i++) {
        low = fmin(low, p[i]);
        high = fmax(high, p[i]);
    }
    const double size = fmax(fabs(low), fabs(high));
    points->p_shift = low;
    points->p_unit = fmax(high - low, fmax(size * DBL_EPSILON, DBL_MIN));
    points->floor = (double)count * pow(rounding * size / points->p_unit, 2.0);
    for (size_t i = 0; i < count; i++) {
        points->t[i] = t[i] / points->t_unit;
        points->p[i] = (p[i] - low) / points->p_unit;
    }
    return true;
}

static void decay_points_finish(struct decay_points *points)
{
    gb_alloc_free(points->t);
    gb_alloc_free(points->p);
    *points = (struct decay_points){0};
}

/* Copies and checks.  Errors: GB_ERR_INPUT, GB_ERR_MEMORY; nothing is left to finish. */
static bool decay_points_init(struct decay_points *points, const double *t,
                              const double *p, size_t count, struct gb_error *err)
{
    if (!check_points(t, p, count, err)) {
        return false;
    }
    *points = (struct decay_points){.count = count};
    points->t = gb_alloc_array(count, sizeof *points->t, err);
    points->p = gb_alloc_array(count, sizeof *points->p, err);
    const bool good = points->t != NULL && points->p != NULL && scale(points, t, p, err);
    if (!good) {
        decay_points_finish(points);
    }
    return good;
}

static int residuals(const gsl_vector *x, void *data, gsl_vector *f)
{
    const struct decay_points *points = data;
    for (size_t i = 0; i < points->count; i++) {
        double sum = gsl_vector_get(x, 0) - points->p[i];
        for (size_t k = 1; k + 1 < x->size; k += 2) {
            const double tau = exp(gsl_vector_get(x, k + 1));
            sum += gsl_vector_get(x, k) * exp(-points->t[i] / tau);
        }
        gsl_vector_set(f, i, sum);
    }
    return GSL_SUCCESS;
}

static int jacobian(const gsl_vector *x, void *data, gsl_matrix *j)
{
    const struct decay_points *points = data;
    for (size_t i = 0; i < points->count; i++) {
        gsl_matrix_set(j, i, 0, 1.0);
        for (size_t k = 1; k + 1 < x->size; k += 2) {
            const double u = points->t[i] / exp(gsl_vector_get(x, k + 1));
            const double e = exp(-u);
            gsl_matrix_set(j, i, k, e);
            gsl_matrix_set(j, i, k + 1, e > 0.0 ? gsl_vector_get(x, k) * u * e : 0.0);
        }
    }
    return GSL_SUCCESS;
}

double gb_fit_correlation(const double *f, size_t n, double mean)
{
    double square = 0.0;
    double correlation = 1.0;
    for (size_t i = 0; i < n; i++) {
        square += (f[i] - mean) * (f[i] - mean);
    }
    for (size_t lag = 1; lag < n / 4 && square > 0.0; lag++) {
        double product = 0.0;
        for (size_t i = lag; i < n; i++) {
            product += (f[i] - mean) * (f[i - lag] - mean);
        }
        if (product < died_away * square) {
            break;
        }
        correlation += 2.0 * product / square;
    }
    return correlation;
}

static void take_result(struct decay *found, gsl_multifit_nlinear_workspace *work,
                        gsl_matrix *covariance)
{
    const gsl_vector *f = gsl_multifit_nlinear_residual(work);
    found->squares = 0.0;
    for (size_t i = 0; i < f->size; i++) {
        found->squares += gsl_vector_get(f, i) * gsl_vector_get(f, i);
    }
    found->correlation = gb_fit_correlation(f->data, f->size, 0.0);
    gsl_multifit_nlinear_covar(gsl_multifit_nlinear_jac(work), 0.0, covariance);
    for (size_t a = 0; a < covariance->size1; a++) {
        found->x[a] = gsl_vector_get(gsl_multifit_nlinear_position(work), a);
        for (size_t b = 0; b < covariance->size2; b++) {
            found->covariance[a][b] = gsl_matrix_get(covariance, a, b);
        }
    }
}

/* A time constant within the range that the data determine. */
static bool tau_in_range(const struct decay *found, const struct decay_points *points)
{
    for (int k = 0; k < found->terms; k++) {
        const double tau = exp(found->x[2 + 2 * k]);
        if (!(tau > tau_shortest * points->spacing && tau < GB_DECAY_TAU_LONGEST)) {
            return false;
        }
    }
    return true;
}

/* Levenberg-Marquardt from found->x. */
static bool iterate(struct decay *found, const struct decay_points *points,
                    struct gb_error *err)
{
    const size_t size = (size_t)(1 + 2 * found->terms);
    const gsl_multifit_nlinear_parameters options =
        gsl_multifit_nlinear_default_parameters();
    gsl_multifit_nlinear_fdf system = {.f = residuals,
                                       .df = jacobian,
                                       .n = points->count,
                                       .p = size,
                                       .params = (void *)points};
    gsl_multifit_nlinear_workspace *work = gsl_multifit_nlinear_alloc(
        gsl_multifit_nlinear_trust, &options, points->count, size);
    gsl_matrix *covariance = gsl_matrix_alloc(size, size);
    const bool made = work != NULL && covariance != NULL;
    if (made) {
        const gsl_vector_view start = gsl_vector_view_array(found->x, size);
        int info = 0;
        gsl_multifit_nlinear_init(&start.vector, &system, work);
        const int status = gsl_multifit_nlinear_driver(GB_DECAY_ITERATIONS, 1e-9, 1e-9,
                                                       0.0, NULL, NULL, &info, work);
        take_result(found, work, covariance);
        found->converged = gb_fit_settled(status, info) && isfinite(found->squares) &&
                           tau_in_range(found, points);
    } else {
        gb_error_set(err, GB_ERR_MEMORY, "out of memory for a fit of %zu points",
                     points->count);
    }
    gsl_matrix_free(covariance);
    gsl_multifit_nlinear_free(work);
    return made;
}

static void decay_constant(struct decay *found, const struct decay_points *points)
{
    const double n = (double)points->count;
    double sum = 0.0;
    for (size_t i = 0; i < points->count; i++) {
        sum += points->p[i];
    }
    *found = (struct decay){.converged = true, .x = {sum / n}};
    for (size_t i = 0; i < points->count; i++) {
        found->squares += pow(points->p[i] - found->x[0], 2.0);
    }
    found->covariance[0][0] = 1.0 / n;
    found->correlation = gb_fit_correlation(points->p, points->count, found->x[0]);
}

static void swap_values(double *a, double *b)
{
    const double keep = *a;
    *a = *b;
    *b = keep;
}

/* tau1 < tau2, always. */
static void order_terms(struct decay *found)
{
    if (found->terms < 2 || found->x[2] <= found->x[4]) {
        return;
    }
    for (int k = 1; k <= 2; k++) {
        swap_values(&found->x[k], &found->x[k + 2]);
        for (int other = 0; other < GB_DECAY_PARAMETERS; other++) {
            swap_values(&found->covariance[k][other], &found->covariance[k + 2][other]);
        }
        for (int other = 0; other < GB_DECAY_PARAMETERS; other++) {
            swap_values(&found->covariance[other][k], &found->covariance[other][k + 2]);
        }
    }
}

/* terms 1 or 2.  Errors: GB_ERR_MEMORY; a fit that does not settle is no error. */
static bool decay_terms(struct decay *found, int terms, const struct decay_points *points,
                        struct gb_error *err)
{
    struct decay_start start;
    *found = (struct decay){.terms = terms};
    if (!decay_start(&start, terms, points->t, points->p, points->count, err)) {
        return false;
    }
    found->x[0] = start.p0;
    for (int k = 0; k < terms; k++) {
        found->x[1 + 2 * k] = start.amplitude[k];
        found->x[2 + 2 * k] = log(start.tau[k]);
    }
    if (!iterate(found, points, err)) {
        return false;
    }
    order_terms(found);
    return true;
}

/* Without an exponential its time constant is undetermined, so the F test finds an exponential
 * more often than its level says (the parameter exists under one hypothesis only).  The level
 * is therefore 99 %, while intervals are at 95 %. */
static const double f_level = 0.99;

static const double interval_level = 0.975; /* two-sided 95 % */

bool gb_fit_settled(int status, int info)
{
    return status == GSL_SUCCESS || status == GSL_ENOPROG || info == GSL_ENOPROG;
}

static int degrees_of(const struct decay *found, const struct decay_points *points)
{
    return (int)points->count - 1 - 2 * found->terms;
}

/* Of the points about the fit. */
static double scatter_of(const struct decay *found, const struct decay_points *points)
{
    return sqrt(found->squares / degrees_of(found, points));
}

/* Points of a simulation are correlated: one in `stretch` is independent.
 */
static double independent_degrees(const struct decay *found,
                                  const struct decay_points *points)
{
    const double independent = (double)points->count / found->correlation;
    return fmax(independent - 1.0 - 2.0 * found->terms, 1.0);
}

static double error_of(const struct decay *found, const struct decay_points *points,
                       int k)
{
    return scatter_of(found, points) * sqrt(found->correlation * found->covariance[k][k]);
}

/* Half the 95 % interval of parameter k. */
static double half_width(const struct decay *found, const struct decay_points *points,
                         int k)
{
    return gsl_cdf_tdist_Pinv(interval_level, independent_degrees(found, points)) *
           error_of(found, points, k);
}

/* Every amplitude differs from zero and every time constant has two bounds. */
static bool is_certain(const struct decay *found, const struct decay_points *points)
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
static double f_ratio(const struct decay *poor, const struct decay *rich,
                      const struct decay_points *points)
{
    return 0.5 * (poor->squares - rich->squares) /
           ((rich->squares + points->floor) / degrees_of(rich, points)) /
           rich->correlation;
}

static struct gb_fit_value value_of(const struct decay *found,
                                    const struct decay_points *points, int k, double unit,
                                    double shift)
{
    const double half = half_width(found, points, k);
    const double error = error_of(found, points, k);
    return (struct gb_fit_value){.value = shift + unit * found->x[k],
                                 .error = unit * error,
                                 .low = shift + unit * (found->x[k] - half),
                                 .high = shift + unit * (found->x[k] + half)};
}

static struct gb_fit_value tau_of(const struct decay *found,
                                  const struct decay_points *points, int k)
{
    const struct gb_fit_value logarithm = value_of(found, points, k, 1.0, 0.0);
    const double tau = points->t_unit * exp(logarithm.value);
    return (struct gb_fit_value){.value = tau,
                                 .error = tau * logarithm.error,
                                 .low = points->t_unit * exp(logarithm.low),
                                 .high = points->t_unit * exp(logarithm.high)};
}

static void report(struct gb_fit_decay *fit, const struct decay *found,
                   const struct decay_points *points)
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
static enum gb_fit_reason objection(const struct decay *poor, const struct decay *rich,
                                    const struct decay_points *points, double *f,
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
static bool fit_all(struct decay found[GB_FIT_TERMS + 1],
                    const struct decay_points *points, struct gb_error *err)
{
    decay_constant(&found[0], points);
    double correlation = found[0].correlation;
    for (int terms = 1; terms <= GB_FIT_TERMS; terms++) {
        if (!decay_terms(&found[terms], terms, points, err)) {
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
static bool choose(struct gb_fit_decay *fit, const struct decay_points *points,
                   struct gb_error *err)
{
    struct decay found[GB_FIT_TERMS + 1];
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
    struct decay_points points;
    if (!decay_points_init(&points, t, p, count, err)) {
        return false;
    }
    const bool good = choose(fit, &points, err);
    decay_points_finish(&points);
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
