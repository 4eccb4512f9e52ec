#include "measure/cap_fit.h"

#include <float.h>
#include <gsl/gsl_blas.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_fit.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include "base/alloc.h"
#include "greenbody/status.h"
#include "measure/cap.h"
#include "measure/fit.h"
#include "measure/yield_point.h"

/* The points of one side of a surface, not owned; gb_alloc_free of the list. */
struct cap_side {
    const struct gb_yield_point **point;
    size_t count;
    bool weighted; /* all points have errors; not where flow counts, too */
    double flow; /* an angle between flow and normal of 1 rad counts like a distance from
                    * the surface of flow times the largest pressure; 0: it does not */
};

enum { SIDE_FREE = 2 }; /* R and p_a */

struct cap_side_found {
    double r, p_a;
    double cov[SIDE_FREE][SIDE_FREE]; /* of R and p_a, the line given */
    double squares;                   /* weighted */
};

enum { SIDE_SIZE = SIDE_FREE, ITERATIONS = 200, SIDE_REWEIGHTINGS = 4 };

/* The cap through points, beside a given shear failure line. */
struct problem {
    const struct cap_side *side;
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

/* sqrt((p - p_a)^2 + (R q/k)^2) of a point; R D on the cap. */
static double cap_side_radius(const struct gb_cap *cap,
                              const struct gb_yield_point *point)
{
    return hypot(point->p_pa - cap->p_a, cap->r * point->q_pa / gb_cap_flattening(cap));
}

/* Standard error of that radius, from the errors of p and q. */
static double cap_side_radius_error(const struct gb_cap *cap,
                                    const struct gb_yield_point *point)
{
    const double k = gb_cap_flattening(cap);
    const double length = fmax(cap_side_radius(cap, point), DBL_MIN);
    return hypot((point->p_pa - cap->p_a) / length * point->p_error_pa,
                 cap->r * cap->r * point->q_pa / (k * k * length) * point->q_error_pa);
}

static size_t residual_count(const struct cap_side *side)
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
        const double off =
            cap_side_radius(&cap, problem->side->point[i]) - cap.r * gb_cap_depth(&cap);
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
        const double s = fmax(cap_side_radius(&cap, point), 1e-12 * problem->unit);
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
            1.0 / (problem->side->weighted ? cap_side_radius_error(&cap, point)
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

static void take_covariance(struct cap_side_found *found, const struct problem *problem,
                            gsl_multifit_nlinear_workspace *work, gsl_matrix *covariance)
{
    const gsl_vector *f = gsl_multifit_nlinear_residual(work);
    const double scale[SIDE_SIZE] = {found->r, problem->unit};
    double variance = 1.0;
    found->squares = 0.0;
    for (size_t i = 0; i < f->size; i++) {
        found->squares += gsl_vector_get(f, i) * gsl_vector_get(f, i);
    }
    if (!problem->side->weighted && f->size > SIDE_SIZE) {
        variance = found->squares / (double)(f->size - SIDE_SIZE);
    }
    gsl_multifit_nlinear_covar(gsl_multifit_nlinear_jac(work), 0.0, covariance);
    for (size_t i = 0; i < SIDE_SIZE; i++) {
        for (size_t j = 0; j < SIDE_SIZE; j++) {
            found->cov[i][j] =
                gsl_matrix_get(covariance, i, j) * scale[i] * scale[j] * variance;
        }
    }
}

/* Levenberg-Marquardt; the weights follow the surface for a few rounds. */
static bool solve(struct cap_side_found *found, const struct problem *problem,
                  gsl_vector *x, gsl_multifit_nlinear_workspace *work,
                  gsl_matrix *covariance)
{
    gsl_multifit_nlinear_fdf system = {.f = residuals,
                                       .df = jacobian,
                                       .n = residual_count(problem->side),
                                       .p = SIDE_SIZE,
                                       .params = (void *)(size_t)problem};
    int info = 0, status = GSL_SUCCESS;
    start(problem, x, gsl_multifit_nlinear_residual(work));
    for (int round = 0; round < SIDE_REWEIGHTINGS && status == GSL_SUCCESS; round++) {
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

/* R and p_a of the cap through points (2 or more), and normal to their flow, beside a given shear failure line, by
 * Levenberg and Marquardt.  line: d, beta and a.  Errors: GB_ERR_INPUT (no point at a
 * pressure above 0), GB_ERR_NOT_CONVERGED, GB_ERR_MEMORY. */
static bool cap_side_fit(struct cap_side_found *found, const struct cap_side *side,
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
        gsl_multifit_nlinear_trust, &options, residual_count(side), SIDE_SIZE);
    gsl_matrix *covariance = gsl_matrix_alloc(SIDE_SIZE, SIDE_SIZE);
    gsl_vector *x = gsl_vector_alloc(SIDE_SIZE);
    bool good = problem.weight && work && covariance && x;
    if (!good) {
        gb_error_set(err, GB_ERR_MEMORY, "out of memory");
    } else {
        good = solve(found, &problem, x, work, covariance) ||
               gb_error_set(err, GB_ERR_NOT_CONVERGED,
                            "no cap through %zu points with d = %.4g MPa, beta = %.4g "
                            "degrees",
                            side->count, line->d / 1e6, line->beta * 180.0 / M_PI);
    }
    gsl_vector_free(x);
    gsl_matrix_free(covariance);
    gsl_multifit_nlinear_free(work);
    gb_alloc_free(problem.weight);
    return good;
}

enum { SIZE = SIDE_FREE, REWEIGHTINGS = 4 };

/* Steps of the differences by which errors of d and beta pass on to R and p_a, in their
 * standard errors. */
static const double passing_step = 0.1;

struct line {
    double d, slope;
    double cov00, cov01, cov11;
};

enum gb_cap_fit_side gb_cap_fit_side_of(const struct gb_yield_point *point)
{
    if (!(point->flow_volume < 0.0)) {
        return GB_CAP_FIT_CAP;
    }
    return -point->flow_volume > GB_CAP_FIT_TENSION * fabs(point->flow_shear)
               ? GB_CAP_FIT_LEFT_OUT
               : GB_CAP_FIT_SHEAR;
}

static bool has_error(const struct gb_yield_point *point)
{
    return point->p_error_pa > 0.0 && point->q_error_pa > 0.0;
}

static bool take_side(struct cap_side *side, const struct gb_yield_point *points,
                      size_t count, enum gb_cap_fit_side which, struct gb_error *err)
{
    side->weighted = true;
    side->point = gb_alloc_array(count > 0 ? count : 1, sizeof(void *), err);
    if (!side->point) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        side->weighted = side->weighted && has_error(&points[i]);
        if (gb_cap_fit_side_of(&points[i]) == which) {
            side->point[side->count++] = &points[i];
        }
    }
    return side->count >= SIZE ||
           gb_error_set(err, GB_ERR_INPUT,
                        "%zu of %zu yield points %s: at least 2 are needed", side->count,
                        count,
                        which == GB_CAP_FIT_SHEAR ? "fail in shear" : "lie on the cap");
}

/* Errors of p count through the slope, which the last round gave. */
static bool fit_line(struct line *line, const struct cap_side *side, struct gb_error *err)
{
    double *room = gb_alloc_array(3 * side->count, sizeof *room, err);
    if (!room) {
        return false;
    }
    double *p = room, *q = room + side->count, *weight = room + 2 * side->count;
    double squares = 0.0;
    line->slope = 0.0;
    for (int round = 0; round < REWEIGHTINGS; round++) {
        for (size_t i = 0; i < side->count; i++) {
            const struct gb_yield_point *point = side->point[i];
            const double error =
                hypot(point->q_error_pa, line->slope * point->p_error_pa);
            p[i] = point->p_pa;
            q[i] = fabs(point->q_pa);
            weight[i] = side->weighted ? 1.0 / (error * error) : 1.0;
        }
        gsl_fit_wlinear(p, 1, weight, 1, q, 1, side->count, &line->d, &line->slope,
                        &line->cov00, &line->cov01, &line->cov11, &squares);
    }
    if (!side->weighted && side->count > SIZE) {
        const double variance = squares / (double)(side->count - SIZE);
        line->cov00 *= variance;
        line->cov01 *= variance;
        line->cov11 *= variance;
    }
    gb_alloc_free(room);
    if (!(line->slope > 0.0) || !(line->d > 0.0) || !isfinite(line->slope)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "the points of shear failure give d = %.4g MPa and "
                            "tan(beta) = %.4g: both must be above 0",
                            line->d / 1e6, line->slope);
    }
    return true;
}

static struct gb_cap line_cap(double d, double slope, double a)
{
    return (struct gb_cap){.d = d, .beta = atan(slope), .r = 1.0, .a = a};
}

/* Changes of R and p_a with d and the slope; columns of `by`. */
static bool pass_on(double by[SIZE][SIZE], const struct cap_side *side,
                    const struct line *line, double a, struct gb_error *err)
{
    const double step[SIZE] = {passing_step * sqrt(line->cov00) + 1e-6 * line->d,
                               passing_step * sqrt(line->cov11) + 1e-6 * line->slope};
    for (int k = 0; k < SIZE; k++) {
        struct cap_side_found side_of[2];
        for (int s = 0; s < 2; s++) {
            const double move = s == 0 ? -step[k] : step[k];
            const struct gb_cap cap = line_cap(line->d + (k == 0 ? move : 0.0),
                                               line->slope + (k == 1 ? move : 0.0), a);
            if (!cap_side_fit(&side_of[s], side, &cap, err)) {
                return false;
            }
        }
        by[0][k] = (side_of[1].r - side_of[0].r) / (2.0 * step[k]);
        by[1][k] = (side_of[1].p_a - side_of[0].p_a) / (2.0 * step[k]);
    }
    return true;
}

static struct gb_fit_value value_of(double value, double variance, double quantile)
{
    const double error = sqrt(fmax(0.0, variance));
    return (struct gb_fit_value){value, error, value - quantile * error,
                                 value + quantile * error};
}

static double quantile_of(const struct cap_side *side)
{
    return side->weighted       ? gsl_cdf_ugaussian_Pinv(0.975)
           : side->count > SIZE ? gsl_cdf_tdist_Pinv(0.975, (double)(side->count - SIZE))
                                : (double)NAN;
}

/* g . C . g of the four parameters d, slope, R, p_a: errors of the line reach the cap by
 * `by`. */
static double variance_of(const double g[2 * SIZE], const struct line *line,
                          const struct cap_side_found *found, double by[SIZE][SIZE])
{
    double own = 0.0, through[SIZE];
    for (int i = 0; i < SIZE; i++) {
        for (int j = 0; j < SIZE; j++) {
            own += g[SIZE + i] * found->cov[i][j] * g[SIZE + j];
        }
        through[i] = g[i] + g[SIZE] * by[0][i] + g[SIZE + 1] * by[1][i];
    }
    return own + through[0] * through[0] * line->cov00 +
           2.0 * through[0] * through[1] * line->cov01 +
           through[1] * through[1] * line->cov11;
}

static void take_values(struct gb_cap_fit *fit, const struct line *line,
                        const struct cap_side_found *found, double by[SIZE][SIZE],
                        const struct cap_side side[2])
{
    const double cosine = cos(fit->cap.beta), depth = gb_cap_depth(&fit->cap);
    const double gradient[5][2 * SIZE] = {
        {1.0, 0.0, 0.0, 0.0},
        {0.0, cosine * cosine, 0.0, 0.0},
        {0.0, 0.0, 1.0, 0.0},
        {0.0, 0.0, 0.0, 1.0},
        {found->r, found->r * found->p_a, depth, 1.0 + found->r * line->slope}};
    const double value[5] = {fit->cap.d, fit->cap.beta, found->r, found->p_a,
                             gb_cap_end(&fit->cap)};
    struct gb_fit_value *const to[5] = {&fit->d, &fit->beta, &fit->r, &fit->p_a,
                                        &fit->p_b};
    const double quantile[2] = {quantile_of(&side[0]),
                                fmax(quantile_of(&side[0]), quantile_of(&side[1]))};
    for (int k = 0; k < 5; k++) {
        *to[k] = value_of(value[k], variance_of(gradient[k], line, found, by),
                          quantile[k > 1]);
    }
}

static struct gb_cap_fit_misses misses_of(const struct gb_cap *cap,
                                          const struct cap_side *side,
                                          enum gb_cap_fit_side which)
{
    const double slope = tan(cap->beta), count = (double)side->count;
    struct gb_cap_fit_misses sum = {0.0, 0.0};
    for (size_t i = 0; i < side->count; i++) {
        const struct gb_yield_point *point = side->point[i];
        double off = fabs(point->q_pa) - cap->d - point->p_pa * slope;
        double error = hypot(point->q_error_pa, slope * point->p_error_pa);
        if (which == GB_CAP_FIT_CAP) {
            off = cap_side_radius(cap, point) - cap->r * gb_cap_depth(cap);
            error = cap_side_radius_error(cap, point);
        }
        sum.distance += off * off;
        sum.error += error * error;
    }
    return (struct gb_cap_fit_misses){sqrt(sum.distance / count),
                                      sqrt(sum.error / count)};
}

static bool fit_sides(struct gb_cap_fit *fit, const struct cap_side side[2], double a,
                      struct gb_error *err)
{
    struct line line;
    struct cap_side_found found;
    double by[SIZE][SIZE];
    if (!fit_line(&line, &side[0], err)) {
        return false;
    }
    const struct gb_cap base = line_cap(line.d, line.slope, a);
    if (!(gb_cap_flattening(&base) > 0.0)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "beta = %.4g degrees: too steep for a transition of %.3g",
                            base.beta * 180.0 / M_PI, a);
    }
    if (!cap_side_fit(&found, &side[1], &base, err) ||
        !pass_on(by, &side[1], &line, a, err)) {
        return false;
    }
    *fit = (struct gb_cap_fit){
        .cap = base, .shear_points = side[0].count, .cap_points = side[1].count};
    fit->cap.r = found.r;
    fit->cap.p_a = found.p_a;
    double squares = 0.0;
    for (int k = 0; k < 2; k++) {
        fit->misses[k] = misses_of(&fit->cap, &side[k], (enum gb_cap_fit_side)k);
        squares +=
            (double)side[k].count * fit->misses[k].distance * fit->misses[k].distance;
    }
    fit->rms = sqrt(squares / (double)(side[0].count + side[1].count));
    take_values(fit, &line, &found, by, side);
    return true;
}

bool gb_cap_fit(struct gb_cap_fit *fit, const struct gb_yield_point *points, size_t count,
                double a, double flow, struct gb_error *err)
{
    struct cap_side side[2] = {{.count = 0}, {.count = 0}};
    bool good = take_side(&side[0], points, count, GB_CAP_FIT_SHEAR, err) &&
                take_side(&side[1], points, count, GB_CAP_FIT_CAP, err);
    side[1].flow = flow;
    side[1].weighted = side[1].weighted && !(flow > 0.0);
    good = good && fit_sides(fit, side, a, err);
    gb_alloc_free(side[0].point);
    gb_alloc_free(side[1].point);
    return good;
}
