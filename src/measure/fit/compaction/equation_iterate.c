#include "measure/fit/compaction/equation_iterate.h"

#include <gsl/gsl_multifit_nlinear.h>
#include <math.h>
#include <string.h>

#include "measure/fit/compaction/equation_starts.h"
#include "measure/fit/fit.h"

enum { ITERATIONS = 400 };

/* Residual where parameters give no density: a step there is rejected. */
static const double outside = 1e6;

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

double gb_equation_iterate_coordinate(const struct gb_equation *equation, size_t k,
                                      double x)
{
    return gb_equations_parameter(equation, k)->positive ? log(x) : x;
}

double gb_equation_iterate_value(const struct gb_equation *equation, size_t k,
                                 double coordinate)
{
    return gb_equations_parameter(equation, k)->positive ? exp(coordinate) : coordinate;
}

static void set_parameters(struct state *state, const gsl_vector *coordinate)
{
    for (size_t k = 0; k < coordinate->size; k++) {
        state->x[state->free[k]] =
            gb_equation_iterate_value(state->equation, state->free[k],
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
        const double root = sqrt(gb_equation_starts_weight(points, i));
        gsl_vector_set(f, i, root * (fabs(off) < outside ? off : outside));
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
        const double root = sqrt(gb_equation_starts_weight(points, i));
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
        weights += gb_equation_starts_weight(state->points, i);
    }
    return effect > (positive ? least_effect * least_effect * weights : 0.0) &&
           variance > 0.0 && least_own * variance * effect < 1.0;
}

static void take_result(struct gb_equation_iterate *iterate, const struct state *state,
                        gsl_multifit_nlinear_workspace *work, gsl_matrix *covariance)
{
    const gsl_matrix *slopes = gsl_multifit_nlinear_jac(work);
    gsl_multifit_nlinear_covar(slopes, 0.0, covariance);
    iterate->undetermined = GB_EQUATION_ITERATE_ALL;
    for (size_t k = 0; k < covariance->size1; k++) {
        const size_t at = state->free[k];
        const double unit = state->unit[k];
        const double variance = gsl_matrix_get(covariance, k, k);
        iterate->x[at] = gb_equation_iterate_value(
            state->equation, at,
            unit * gsl_vector_get(gsl_multifit_nlinear_position(work), k));
        iterate->covariance[at] = unit * unit * variance;
        if (!is_determined(state, k, slopes, variance)) {
            iterate->undetermined = (int)at;
        }
    }
    iterate->squares =
        gb_equation_starts_squares(state->points, state->equation->density, iterate->x);
}

static bool run(struct gb_equation_iterate *iterate, struct state *state, size_t size,
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
                           gb_equation_iterate_coordinate(iterate->equation,
                                                          state->free[k],
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

bool gb_equation_iterate(struct gb_equation_iterate *iterate, struct gb_error *err)
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
