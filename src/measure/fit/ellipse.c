#include "measure/fit/ellipse.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <math.h>

#include "measure/fit/fit.h"

enum { N = GB_ELLIPSE_PARAMETERS, ITERATIONS = 200 };

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

bool gb_ellipse_fit(struct gb_ellipse *ellipse, const double *p, const double *q,
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

double gb_ellipse_normal(const struct gb_ellipse *ellipse, double p, double q)
{
    return atan2((q - ellipse->centre_q) / (ellipse->half_q * ellipse->half_q),
                 (p - ellipse->centre_p) / (ellipse->half_p * ellipse->half_p));
}
