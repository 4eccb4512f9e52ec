#include "measure/cap/cap_side.h"

#include <float.h>
#include <gsl/gsl_blas.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <math.h>

#include "base/alloc.h"
#include "measure/fit/fit.h"

enum { SIZE = GB_CAP_SIDE_FREE, ITERATIONS = 200, REWEIGHTINGS = 4 };

/* The cap through points, beside a given shear failure line. */
struct problem {
    const struct gb_cap_side *side;
    struct gb_cap line; /* d, beta and a */
    double unit;        /* of pressures, Pa */
    double *weight;     /* 1/error of each residual */
};

static struct gb_cap at(const struct problem *problem, const gsl_vector *x)
{
    struct gb_cap cap = problem->line;
    cap.r = exp(gsl_vector_get(x, 0));
    cap.p_a = gsl_vector_get(x, 1) * problem->unit;
    return cap;
}

double gb_cap_side_radius(const struct gb_cap *cap, const struct gb_yield_point *point)
{
    return hypot(point->p_pa - cap->p_a, cap->r * point->q_pa / gb_cap_flattening(cap));
}

double gb_cap_side_radius_error(const struct gb_cap *cap,
                                const struct gb_yield_point *point)
{
    const double k = gb_cap_flattening(cap);
    const double length = fmax(gb_cap_side_radius(cap, point), DBL_MIN);
    return hypot((point->p_pa - cap->p_a) / length * point->p_error_pa,
                 cap->r * cap->r * point->q_pa / (k * k * length) * point->q_error_pa);
}

static size_t residual_count(const struct gb_cap_side *side)
{
    return side->flow > 0.0 ? 2 * side->count : side->count;
}

/* The normal of the cap at a point, as gb_cap_flow has it. */
struct normal {
    double volume, shear;
};

static struct normal normal_at(const struct gb_cap *cap,
                               const struct gb_yield_point *point)
{
    const double k = gb_cap_flattening(cap);
    return (struct normal){point->p_pa - cap->p_a,
                           cap->r * cap->r / (k * k) * fabs(point->q_pa)};
}

/* Residuals of the flow: its angle against the normal. */
static void flow_residuals(const struct problem *problem, const struct gb_cap *cap,
                           gsl_vector *f)
{
    for (size_t i = 0; i < problem->side->count && problem->side->flow > 0.0; i++) {
        const struct gb_yield_point *point = problem->side->point[i];
        const struct normal normal = normal_at(cap, point);
        const double angle = atan2(normal.volume, normal.shear) -
                             atan2(point->flow_volume, fabs(point->flow_shear));
        gsl_vector_set(f, problem->side->count + i, problem->side->flow * angle);
    }
}

static void flow_jacobian(const struct problem *problem, const struct gb_cap *cap,
                          gsl_matrix *j)
{
    for (size_t i = 0; i < problem->side->count && problem->side->flow > 0.0; i++) {
        const struct normal normal = normal_at(cap, problem->side->point[i]);
        const double square = normal.volume * normal.volume + normal.shear * normal.shear;
        const double scale = -problem->side->flow * normal.shear /
                             fmax(square, 1e-24 * problem->unit * problem->unit);
        gsl_matrix_set(j, problem->side->count + i, 0, 2.0 * scale * normal.volume);
        gsl_matrix_set(j, problem->side->count + i, 1, scale * problem->unit);
    }
}

static int residuals(const gsl_vector *x, void *data, gsl_vector *f)
{
    const struct problem *problem = data;
    const struct gb_cap cap = at(problem, x);
    flow_residuals(problem, &cap, f);
    for (size_t i = 0; i < problem->side->count; i++) {
        const double off = gb_cap_side_radius(&cap, problem->side->point[i]) -
                           cap.r * gb_cap_depth(&cap);
        gsl_vector_set(f, i, off * problem->weight[i]);
    }
    return GSL_SUCCESS;
}

static int jacobian(const gsl_vector *x, void *data, gsl_matrix *j)
{
    const struct problem *problem = data;
    const struct gb_cap cap = at(problem, x);
    const double slope = tan(cap.beta), k = gb_cap_flattening(&cap);
    flow_jacobian(problem, &cap, j);
    for (size_t i = 0; i < problem->side->count; i++) {
        const struct gb_yield_point *point = problem->side->point[i];
        const double s = fmax(gb_cap_side_radius(&cap, point), 1e-12 * problem->unit);
        const double across = cap.r * point->q_pa / k, off = point->p_pa - cap.p_a;
        const double scale = problem->weight[i];
        gsl_matrix_set(j, i, 0,
                       scale * (across * across / s - cap.r * gb_cap_depth(&cap)));
        gsl_matrix_set(j, i, 1, -scale * problem->unit * (off / s + cap.r * slope));
    }
    return GSL_SUCCESS;
}

/* Weights from the errors of the points, seen at the surface x. */
static void weigh(const struct problem *problem, const gsl_vector *x)
{
    const struct gb_cap cap = at(problem, x);
    for (size_t i = 0; i < problem->side->count; i++) {
        const struct gb_yield_point *point = problem->side->point[i];
        problem->weight[i] =
            1.0 / (problem->side->weighted ? gb_cap_side_radius_error(&cap, point)
                                           : problem->unit);
    }
}

/* Best of a grid of R whose caps end at the largest pressure of the points.  f: room. */
static void start(const struct problem *problem, gsl_vector *x, gsl_vector *f)
{
    for (size_t i = 0; i < problem->side->count; i++) {
        problem->weight[i] = 1.0 / problem->unit;
    }
    double best = INFINITY, log_r = 0.0, p_a = 0.0;
    for (double log_of_r = log(0.05); log_of_r < log(20.0); log_of_r += 0.1) {
        struct gb_cap cap = problem->line;
        cap.r = exp(log_of_r);
        cap = gb_cap_with_end(&cap, problem->unit);
        gsl_vector_set(x, 0, log_of_r);
        gsl_vector_set(x, 1, cap.p_a / problem->unit);
        double sum = INFINITY;
        residuals(x, (void *)(size_t)problem, f);
        gsl_blas_ddot(f, f, &sum);
        if (gb_cap_depth(&cap) > 0.0 && sum < best) {
            best = sum;
            log_r = log_of_r;
            p_a = cap.p_a / problem->unit;
        }
    }
    gsl_vector_set(x, 0, log_r);
    gsl_vector_set(x, 1, p_a);
}

static void take_covariance(struct gb_cap_side_found *found,
                            const struct problem *problem,
                            gsl_multifit_nlinear_workspace *work, gsl_matrix *covariance)
{
    const gsl_vector *f = gsl_multifit_nlinear_residual(work);
    const double scale[SIZE] = {found->r, problem->unit};
    double variance = 1.0;
    found->squares = 0.0;
    for (size_t i = 0; i < f->size; i++) {
        found->squares += gsl_vector_get(f, i) * gsl_vector_get(f, i);
    }
    if (!problem->side->weighted && f->size > SIZE) {
        variance = found->squares / (double)(f->size - SIZE);
    }
    gsl_multifit_nlinear_covar(gsl_multifit_nlinear_jac(work), 0.0, covariance);
    for (size_t i = 0; i < SIZE; i++) {
        for (size_t j = 0; j < SIZE; j++) {
            found->cov[i][j] =
                gsl_matrix_get(covariance, i, j) * scale[i] * scale[j] * variance;
        }
    }
}

/* Levenberg-Marquardt; the weights follow the surface for a few rounds. */
static bool solve(struct gb_cap_side_found *found, const struct problem *problem,
                  gsl_vector *x, gsl_multifit_nlinear_workspace *work,
                  gsl_matrix *covariance)
{
    gsl_multifit_nlinear_fdf system = {.f = residuals,
                                       .df = jacobian,
                                       .n = residual_count(problem->side),
                                       .p = SIZE,
                                       .params = (void *)(size_t)problem};
    int info = 0, status = GSL_SUCCESS;
    start(problem, x, gsl_multifit_nlinear_residual(work));
    for (int round = 0; round < REWEIGHTINGS && status == GSL_SUCCESS; round++) {
        weigh(problem, x);
        gsl_multifit_nlinear_init(x, &system, work);
        status = gsl_multifit_nlinear_driver(ITERATIONS, 1e-10, 1e-10, 0.0, NULL, NULL,
                                             &info, work);
        status = gb_fit_settled(status, info) ? GSL_SUCCESS : status;
        gsl_vector_memcpy(x, gsl_multifit_nlinear_position(work));
    }
    const struct gb_cap cap = at(problem, x);
    found->r = cap.r;
    found->p_a = cap.p_a;
    take_covariance(found, problem, work, covariance);
    return status == GSL_SUCCESS && isfinite(cap.r) && gb_cap_depth(&cap) > 0.0;
}

bool gb_cap_side_fit(struct gb_cap_side_found *found, const struct gb_cap_side *side,
                     const struct gb_cap *line, struct gb_error *err)
{
    const gsl_multifit_nlinear_parameters options =
        gsl_multifit_nlinear_default_parameters();
    struct problem problem = {.side = side, .line = *line};
    for (size_t i = 0; i < side->count; i++) {
        problem.unit = fmax(problem.unit, side->point[i]->p_pa);
    }
    if (!(problem.unit > 0.0)) {
        return gb_error_set(err, GB_ERR_INPUT, "the cap has no point at a pressure");
    }
    problem.weight = gb_alloc_array(side->count, sizeof *problem.weight, err);
    gsl_multifit_nlinear_workspace *work = gsl_multifit_nlinear_alloc(
        gsl_multifit_nlinear_trust, &options, residual_count(side), SIZE);
    gsl_matrix *covariance = gsl_matrix_alloc(SIZE, SIZE);
    gsl_vector *x = gsl_vector_alloc(SIZE);
    bool good = problem.weight && work && covariance && x;
    if (!good) {
        gb_error_set(err, GB_ERR_MEMORY, "out of memory");
    } else {
        good = solve(found, &problem, x, work, covariance) ||
               gb_error_set(err, GB_ERR_NOT_CONVERGED,
                            "no cap through %zu points beside d = %.4g MPa, beta = %.4g "
                            "degrees",
                            side->count, line->d / 1e6, line->beta * 180.0 / M_PI);
    }
    gsl_vector_free(x);
    gsl_matrix_free(covariance);
    gsl_multifit_nlinear_free(work);
    gb_alloc_free(problem.weight);
    return good;
}
