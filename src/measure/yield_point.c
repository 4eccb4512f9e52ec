/* Yield points: where a loading path leaves the elastic range, and an ellipse through them. */
#include "measure/yield_point.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"
#include "measure/fit.h"

bool gb_yield_point_elastic(struct gb_yield_elastic *elastic, const double by_volume[2],
                            const double by_shear[2])
{
    const double determinant = by_volume[0] * by_shear[1] - by_volume[1] * by_shear[0];
    if (!(determinant > 0.0) || !(by_volume[0] > 0.0) || !isfinite(determinant)) {
        return false;
    }
    elastic->compliance[0][0] = by_shear[1] / determinant;
    elastic->compliance[0][1] = -by_shear[0] / determinant;
    elastic->compliance[1][0] = -by_volume[1] / determinant;
    elastic->compliance[1][1] = by_volume[0] / determinant;
    return true;
}

/* A state between two rows. */
struct state {
    double p, q, volume, shear; /* plastic strains */
};

static struct state state_at(const struct gb_yield_path *path,
                             const struct gb_yield_elastic *elastic, size_t row)
{
    const double p = path->p[row] - path->p[0], q = path->q[row] - path->q[0];
    const double(*compliance)[2] = elastic->compliance;
    return (struct state){
        path->p[row], path->q[row],
        path->volume[row] - path->volume[0] - compliance[0][0] * p - compliance[0][1] * q,
        path->shear[row] - path->shear[0] - compliance[1][0] * p - compliance[1][1] * q};
}

/* Compacts stiffen under pressure, so that the compliance at the beginning overestimates the
 * elastic strain of compression.  What is left is then opposite to the loading, and no flow. */
static double measure_of(const struct state *state, double direction)
{
    const double along = state->volume * cos(direction) + state->shear * sin(direction);
    return along > 0.0 ? fmax(fabs(state->volume), fabs(state->shear)) : 0.0;
}

static double between(double a, double b, double share)
{
    return a + share * (b - a);
}

/* The first state whose plastic strain reaches a level; false: none, the last one. */
static bool reach(const struct gb_yield_path *path,
                  const struct gb_yield_elastic *elastic, double level,
                  struct state *found)
{
    struct state before = state_at(path, elastic, 0);
    for (size_t i = 1; i < path->count; i++) {
        const struct state now = state_at(path, elastic, i);
        const double low = measure_of(&before, path->direction),
                     high = measure_of(&now, path->direction);
        if (high >= level) {
            const double share = high > low ? (level - low) / (high - low) : 1.0;
            found->p = between(before.p, now.p, share);
            found->q = between(before.q, now.q, share);
            found->volume = between(before.volume, now.volume, share);
            found->shear = between(before.shear, now.shear, share);
            return true;
        }
        before = now;
    }
    *found = before;
    return false;
}

bool gb_yield_point_find(const struct gb_yield_path *path,
                         const struct gb_yield_elastic *elastic, double offset,
                         double flow_end, struct gb_yield_point *point)
{
    struct state at, first, last;
    if (!reach(path, elastic, offset, &at)) {
        return false;
    }
    reach(path, elastic, GB_YIELD_FLOW_BEGIN * offset, &first);
    reach(path, elastic, flow_end * offset, &last);
    point->p_pa = at.p;
    point->q_pa = at.q;
    point->flow_volume = last.volume - first.volume;
    point->flow_shear = last.shear - first.shear;
    point->direction = path->direction;
    return true;
}

enum { N = 4, ITERATIONS = 200 };

struct points {
    const double *p, *q;
    size_t count;
};

/* Parameters: centre, logarithms of the half axes. */
static double residual(const gsl_vector *x, double p, double q)
{
    const double u = (p - gsl_vector_get(x, 0)) / exp(gsl_vector_get(x, 2));
    const double v = (q - gsl_vector_get(x, 1)) / exp(gsl_vector_get(x, 3));
    return hypot(u, v) - 1.0;
}

static int residuals(const gsl_vector *x, void *data, gsl_vector *f)
{
    const struct points *points = data;
    for (size_t i = 0; i < points->count; i++) {
        gsl_vector_set(f, i, residual(x, points->p[i], points->q[i]));
    }
    return GSL_SUCCESS;
}

static void range(const double *value, size_t count, double *middle, double *half)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < count; i++) {
        low = fmin(low, value[i]);
        high = fmax(high, value[i]);
    }
    *middle = 0.5 * (low + high);
    *half = 0.5 * (high - low);
}

static void read_result(struct gb_ellipse *ellipse, const gsl_vector *x,
                        const struct points *points)
{
    double squares = 0.0;
    for (size_t i = 0; i < points->count; i++) {
        squares += pow(residual(x, points->p[i], points->q[i]), 2.0);
    }
    *ellipse = (struct gb_ellipse){gsl_vector_get(x, 0), gsl_vector_get(x, 1),
                                   exp(gsl_vector_get(x, 2)), exp(gsl_vector_get(x, 3)),
                                   sqrt(squares / (double)points->count)};
}

static bool solve(struct gb_ellipse *ellipse, struct points *points,
                  const double start[N], struct gb_error *err)
{
    gsl_multifit_nlinear_parameters options = gsl_multifit_nlinear_default_parameters();
    gsl_multifit_nlinear_fdf system = {
        .f = residuals, .n = points->count, .p = N, .params = points};
    gsl_multifit_nlinear_workspace *work = gsl_multifit_nlinear_alloc(
        gsl_multifit_nlinear_trust, &options, points->count, N);
    if (work == NULL) {
        return gb_error_set(err, GB_ERR_MEMORY, "no memory for the fit of an ellipse");
    }
    gsl_vector_const_view from = gsl_vector_const_view_array(start, N);
    int info = 0;
    int status = gsl_multifit_nlinear_init(&from.vector, &system, work);
    if (status == GSL_SUCCESS) {
        status = gsl_multifit_nlinear_driver(ITERATIONS, 1e-10, 1e-10, 1e-12, NULL, NULL,
                                             &info, work);
    }
    const bool good = gb_fit_settled(status, info);
    if (good) {
        read_result(ellipse, gsl_multifit_nlinear_position(work), points);
    }
    gsl_multifit_nlinear_free(work);
    return good || gb_error_set(err, GB_ERR_NOT_CONVERGED,
                                "the fit of an ellipse does not converge");
}

bool gb_yield_point_ellipse(struct gb_ellipse *ellipse, const double *p, const double *q,
                            size_t count, struct gb_error *err)
{
    struct points points = {p, q, count};
    double start[N];
    range(p, count, &start[0], &start[2]);
    range(q, count, &start[1], &start[3]);
    if (count < N || !(start[2] > 0.0) || !(start[3] > 0.0)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "an ellipse needs %d points that lie on no line", N);
    }
    start[2] = log(start[2]);
    start[3] = log(start[3]);
    gsl_error_handler_t *handler = gsl_set_error_handler_off();
    const bool good = solve(ellipse, &points, start, err);
    gsl_set_error_handler(handler);
    return good;
}

double gb_yield_point_ellipse_normal(const struct gb_ellipse *ellipse, double p, double q)
{
    return atan2((q - ellipse->centre_q) / (ellipse->half_q * ellipse->half_q),
                 (p - ellipse->centre_p) / (ellipse->half_p * ellipse->half_p));
}
