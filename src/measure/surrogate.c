/* Polynomials in place of the simulation near a point, and what is computed with them: the best
 * fit to data, and Sobol indices. */
#include "measure/surrogate.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_multifit.h>
#include <gsl/gsl_multimin.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include "base/alloc.h"
#include "greenbody/status.h"
#include "measure/average.h"
#include "measure/power.h"

/* Singular values below this share of the greatest mean that points lie in a plane. */
static const double least_share = 1e-7;

size_t gb_surrogate_terms(size_t variables, enum gb_surrogate_order order)
{
    return 1 + variables +
           (order == GB_SURROGATE_QUADRATIC ? variables * (variables + 1) / 2 : 0);
}

/* 1, x_i, x_i x_j with i <= j. */
static void fill_terms(const double *at, size_t variables, size_t terms, double *term)
{
    size_t next = 0;
    term[next++] = 1.0;
    for (size_t i = 0; i < variables; i++) {
        term[next++] = at[i];
    }
    for (size_t i = 0; i < variables && next < terms; i++) {
        for (size_t j = i; j < variables; j++) {
            term[next++] = at[i] * at[j];
        }
    }
}

/* What GSL needs for one fit. */
struct bench {
    gsl_multifit_linear_workspace *space;
    gsl_matrix *design, *covariance;
    gsl_vector *y, *c;
};

static void finish_bench(struct bench *bench)
{
    if (bench->space != NULL) {
        gsl_multifit_linear_free(bench->space);
    }
    gsl_matrix_free(bench->design);
    gsl_matrix_free(bench->covariance);
    gsl_vector_free(bench->y);
    gsl_vector_free(bench->c);
}

static bool init_bench(struct bench *bench, size_t points, size_t terms)
{
    bench->space = gsl_multifit_linear_alloc(points, terms);
    bench->design = gsl_matrix_alloc(points, terms);
    bench->covariance = gsl_matrix_alloc(terms, terms);
    bench->y = gsl_vector_alloc(points);
    bench->c = gsl_vector_alloc(terms);
    return bench->space && bench->design && bench->covariance && bench->y && bench->c;
}

static bool fit_output(struct gb_surrogate *surrogate, struct bench *bench, size_t output,
                       const double *value, size_t points)
{
    double squares = 0.0;
    size_t rank = 0;
    for (size_t p = 0; p < points; p++) {
        gsl_vector_set(bench->y, p, value[p * surrogate->outputs + output]);
    }
    const int status =
        gsl_multifit_linear_tsvd(bench->design, bench->y, least_share, bench->c,
                                 bench->covariance, &squares, &rank, bench->space);
    for (size_t t = 0; t < surrogate->terms; t++) {
        surrogate->coefficient[output * surrogate->terms + t] =
            gsl_vector_get(bench->c, t);
    }
    return status == 0 && rank == surrogate->terms;
}

bool gb_surrogate_fit(struct gb_surrogate *surrogate, size_t variables, size_t outputs,
                      enum gb_surrogate_order order, const double *at,
                      const double *value, size_t points, struct gb_error *err)
{
    const size_t terms = gb_surrogate_terms(variables, order);
    *surrogate = (struct gb_surrogate){variables, outputs, terms, NULL};
    if (points < terms) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%zu points for a polynomial of %zu terms: too few", points,
                            terms);
    }
    struct bench bench = {0};
    surrogate->coefficient =
        gb_alloc_array(outputs * terms, sizeof *surrogate->coefficient, err);
    bool good = surrogate->coefficient != NULL;
    if (good && !init_bench(&bench, points, terms)) {
        good = gb_error_set(err, GB_ERR_MEMORY, "out of memory for a fit");
    }
    for (size_t p = 0; p < points && good; p++) {
        double term[GB_SURROGATE_TERMS];
        fill_terms(at + p * variables, variables, terms, term);
        for (size_t t = 0; t < terms; t++) {
            gsl_matrix_set(bench.design, p, t, term[t]);
        }
    }
    for (size_t o = 0; o < outputs && good; o++) {
        good = fit_output(surrogate, &bench, o, value, points) ||
               gb_error_set(err, GB_ERR_INPUT,
                            "the points do not determine the %zu terms of a polynomial",
                            terms);
    }
    finish_bench(&bench);
    if (!good) {
        gb_surrogate_finish(surrogate);
    }
    return good;
}

void gb_surrogate_finish(struct gb_surrogate *surrogate)
{
    gb_alloc_free(surrogate->coefficient);
    *surrogate = (struct gb_surrogate){0};
}

/* value[outputs] at a point. */
static void value_at(const struct gb_surrogate *surrogate, const double *at,
                     double *value)
{
    double term[GB_SURROGATE_TERMS];
    fill_terms(at, surrogate->variables, surrogate->terms, term);
    for (size_t o = 0; o < surrogate->outputs; o++) {
        const double *c = surrogate->coefficient + o * surrogate->terms;
        value[o] = 0.0;
        for (size_t t = 0; t < surrogate->terms; t++) {
            value[o] += c[t] * term[t];
        }
    }
}

/* slope[outputs x variables] at a point. */
static void slope_at(const struct gb_surrogate *surrogate, const double *at,
                     double *slope)
{
    const size_t n = surrogate->variables;
    for (size_t o = 0; o < surrogate->outputs; o++) {
        const double *c = surrogate->coefficient + o * surrogate->terms;
        size_t next = 1 + n;
        for (size_t i = 0; i < n; i++) {
            slope[o * n + i] = c[1 + i];
        }
        for (size_t i = 0; i < n && next < surrogate->terms; i++) {
            for (size_t j = i; j < n; j++, next++) { /* i = j: both contributions */
                slope[o * n + i] += c[next] * at[j];
                slope[o * n + j] += c[next] * at[i];
            }
        }
    }
}

enum { VARIABLES = GB_SURROGATE_VARIABLES, ITERATIONS = 2000 };

/* The simplex starts with this share of the box, ends when it is this small. */
static const double simplex_start = 0.25;
static const double simplex_end = 1e-7;

/* Added to the diagonal of the scaled normal matrix: parameters that the data cannot tell
 * apart at all come out with errors about 1e4 times too large, and not as an error. */
static const double ridge = 1e-8;

/* An interval stands where the root of the rise of the misfit at its ends is within this
 * fraction of what it expects. */
static const double linear_enough = 0.05;

struct fit {
    const struct gb_estimate_problem *problem;
    double *mean, *weight;  /* data */
    double *seen;           /* seeds x data: outputs of each seed */
    double *slope;          /* data x variables */
    double *gain;           /* variables x data: change of the fit with the data */
    double unit[VARIABLES]; /* squared: diagonal of (J'WJ)^-1 */
};

/* The outputs of every seed at a point, and their mean. */
static void look(const struct fit *fit, const double *at)
{
    const struct gb_estimate_problem *problem = fit->problem;
    memset(fit->mean, 0, problem->data * sizeof *fit->mean);
    for (size_t s = 0; s < problem->seeds; s++) {
        double *seen = fit->seen + s * problem->data;
        value_at(&problem->seed[s], at, seen);
        for (size_t i = 0; i < problem->data; i++) {
            fit->mean[i] += seen[i] / (double)problem->seeds;
        }
    }
}

/* Standard error of the mean over seeds of value i, squared. */
static double noise(const struct fit *fit, size_t i)
{
    const struct gb_estimate_problem *problem = fit->problem;
    const double n = (double)problem->seeds;
    double squares = 0.0;
    for (size_t s = 0; s < problem->seeds; s++) {
        const double off = fit->seen[s * problem->data + i] - fit->mean[i];
        squares += off * off;
    }
    return squares / (n * (n - 1.0));
}

static void set_weights(const struct fit *fit)
{
    const struct gb_estimate_problem *problem = fit->problem;
    static const double centre[VARIABLES] = {0.0};
    look(fit, centre);
    for (size_t i = 0; i < problem->data; i++) {
        fit->weight[i] = 1.0;
        if (problem->error != NULL) {
            fit->weight[i] =
                1.0 / (problem->error[i] * problem->error[i] + noise(fit, i));
        }
        if (problem->weight != NULL) {
            fit->weight[i] *= problem->weight[i];
        }
    }
}

/* By the errors alone, at the mean that was looked at last. */
static double chi_squared(const struct fit *fit)
{
    double sum = 0.0;
    for (size_t i = 0; i < fit->problem->data; i++) {
        const double off = fit->mean[i] - fit->problem->value[i];
        sum += fit->weight[i] / fit->problem->weight[i] * off * off;
    }
    return sum;
}

static double misfit(const struct fit *fit, const double *at)
{
    double sum = 0.0;
    look(fit, at);
    for (size_t i = 0; i < fit->problem->data; i++) {
        const double off = fit->mean[i] - fit->problem->value[i];
        sum += fit->weight[i] * off * off;
    }
    return sum;
}

/* Moves variable k into the box; returns the squared distance to it. */
static double clip(const struct gb_estimate_problem *problem, size_t k, double *at)
{
    const double from = *at;
    *at = fmin(fmax(from, problem->low[k]), problem->high[k]);
    return (from - *at) * (from - *at);
}

/* The misfit with some variables held. */
struct search {
    const struct fit *fit;
    size_t moving[VARIABLES];
    const double *at; /* of the held ones */
};

/* Outside of the box: the misfit at the nearest point, increased with the distance. */
static double bounded_misfit(const gsl_vector *x, void *data)
{
    const struct search *search = data;
    double from[VARIABLES], at[VARIABLES];
    memcpy(from, search->at, sizeof from);
    for (size_t k = 0; k < x->size; k++) {
        from[search->moving[k]] = gsl_vector_get(x, k);
    }
    memcpy(at, from, sizeof at);
    double distance = 0.0;
    for (size_t k = 0; k < x->size; k++) {
        distance += clip(search->fit->problem, search->moving[k], &at[search->moving[k]]);
    }
    return misfit(search->fit, at) * (1.0 + distance) + distance;
}

/* Best of a coarse grid over the box, so that the simplex does not start near a local
 * minimum. */
static void find_start(const struct fit *fit, double *best)
{
    const struct gb_estimate_problem *problem = fit->problem;
    double least = INFINITY;
    size_t points = 1;
    for (size_t k = 0; k < problem->variables; k++) {
        points *= 5;
    }
    for (size_t p = 0; p < points; p++) {
        double at[VARIABLES];
        size_t rest = p;
        for (size_t k = 0; k < problem->variables; k++, rest /= 5) {
            const double share = (double)(rest % 5) / 4.0;
            at[k] = problem->low[k] + share * (problem->high[k] - problem->low[k]);
        }
        const double here = misfit(fit, at);
        if (here < least) {
            least = here;
            memcpy(best, at, sizeof at);
        }
    }
}

/* No variable is held. */
enum { NONE = -1 };

/* Moves all variables but `held` from `at` to the least misfit. */
static bool minimise(const struct fit *fit, int held, double *at, struct gb_error *err)
{
    struct search search = {.fit = fit, .at = at};
    size_t n = 0;
    for (size_t k = 0; k < fit->problem->variables; k++) {
        if ((int)k != held) {
            search.moving[n++] = k;
        }
    }
    if (n == 0) {
        return true;
    }
    gsl_multimin_function function = {bounded_misfit, n, &search};
    gsl_multimin_fminimizer *solver =
        gsl_multimin_fminimizer_alloc(gsl_multimin_fminimizer_nmsimplex2, n);
    gsl_vector *start = gsl_vector_alloc(n);
    gsl_vector *size = gsl_vector_alloc(n);
    const bool made = solver != NULL && start != NULL && size != NULL;
    if (made) {
        for (size_t k = 0; k < n; k++) {
            const size_t to = search.moving[k];
            const double width = fit->problem->high[to] - fit->problem->low[to];
            gsl_vector_set(start, k, at[to]);
            gsl_vector_set(size, k, simplex_start * width);
        }
        gsl_multimin_fminimizer_set(solver, &function, start, size);
        int status = GSL_CONTINUE;
        for (int i = 0; i < ITERATIONS && status == GSL_CONTINUE; i++) {
            if (gsl_multimin_fminimizer_iterate(solver) != 0) {
                break;
            }
            status =
                gsl_multimin_test_size(gsl_multimin_fminimizer_size(solver), simplex_end);
        }
        for (size_t k = 0; k < n; k++) {
            double *to = &at[search.moving[k]];
            *to = gsl_vector_get(gsl_multimin_fminimizer_x(solver), k);
            clip(fit->problem, search.moving[k], to);
        }
    }
    if (solver != NULL) {
        gsl_multimin_fminimizer_free(solver);
    }
    gsl_vector_free(start);
    gsl_vector_free(size);
    return made || gb_error_set(err, GB_ERR_MEMORY, "out of memory for a fit");
}

/* Slope of the mean at the best fit. */
static bool set_slope(const struct fit *fit, const double *at, struct gb_error *err)
{
    const struct gb_estimate_problem *problem = fit->problem;
    const size_t cells = problem->data * problem->variables;
    double *one = gb_alloc_array(cells, sizeof *one, err);
    if (one == NULL) {
        return false;
    }
    memset(fit->slope, 0, cells * sizeof *one);
    for (size_t s = 0; s < problem->seeds; s++) {
        slope_at(&problem->seed[s], at, one);
        for (size_t c = 0; c < cells; c++) {
            fit->slope[c] += one[c] / (double)problem->seeds;
        }
    }
    gb_alloc_free(one);
    return true;
}

/* gain = (J'WJ)^-1 J'W, the normal matrix scaled to a diagonal of ones.  effect[k] is 0
 * for a variable that changes nothing. */
static bool set_gain(struct fit *fit, double *effect, struct gb_error *err)
{
    const struct gb_estimate_problem *problem = fit->problem;
    const size_t n = problem->variables;
    const double *slope = fit->slope;
    gsl_matrix *normal = gsl_matrix_calloc(n, n);
    if (normal == NULL) {
        return gb_error_set(err, GB_ERR_MEMORY, "out of memory for a fit");
    }
    for (size_t k = 0; k < n; k++) {
        effect[k] = 0.0;
        for (size_t i = 0; i < problem->data; i++) {
            effect[k] += fit->weight[i] * slope[i * n + k] * slope[i * n + k];
        }
        effect[k] = sqrt(effect[k]);
    }
    for (size_t k = 0; k < n; k++) {
        for (size_t l = 0; l < n; l++) {
            double sum = 0.0;
            for (size_t i = 0; i < problem->data; i++) {
                sum += fit->weight[i] * slope[i * n + k] * slope[i * n + l];
            }
            const double scale = effect[k] * effect[l];
            gsl_matrix_set(normal, k, l,
                           (scale > 0.0 ? sum / scale : 0.0) +
                               (k == l ? ridge + (scale > 0.0 ? 0.0 : 1.0) : 0.0));
        }
    }
    const bool good = gsl_linalg_cholesky_decomp1(normal) == 0 &&
                      gsl_linalg_cholesky_invert(normal) == 0;
    for (size_t k = 0; k < n && good; k++) {
        fit->unit[k] = sqrt(gsl_matrix_get(normal, k, k)) / effect[k];
        for (size_t i = 0; i < problem->data; i++) {
            double sum = 0.0;
            for (size_t l = 0; l < n; l++) {
                const double scale = effect[k] * effect[l];
                sum += scale > 0.0 ? gsl_matrix_get(normal, k, l) / scale *
                                         slope[i * n + l] * fit->weight[i]
                                   : 0.0;
            }
            fit->gain[k * problem->data + i] = sum;
        }
    }
    gsl_matrix_free(normal);
    return good || gb_error_set(err, GB_ERR_NOT_CONVERGED,
                                "the normal matrix of the fit cannot be inverted");
}

/* Covariance of variables k and l by the errors of the data, variance each. */
static double from_data(const struct fit *fit, double scatter, size_t k, size_t l)
{
    const struct gb_estimate_problem *problem = fit->problem;
    double sum = 0.0;
    for (size_t i = 0; i < problem->data; i++) {
        const double variance =
            problem->error ? problem->error[i] * problem->error[i] : scatter;
        sum += fit->gain[k * problem->data + i] * fit->gain[l * problem->data + i] *
               variance;
    }
    return sum;
}

/* Covariance by the noise of the model: the scatter of the fits to single seeds. */
static double from_seeds(const struct fit *fit, size_t k, size_t l)
{
    const struct gb_estimate_problem *problem = fit->problem;
    const double n = (double)problem->seeds;
    double sum = 0.0;
    for (size_t s = 0; s < problem->seeds; s++) {
        double move[2] = {0.0, 0.0};
        for (size_t i = 0; i < problem->data; i++) {
            const double off = fit->seen[s * problem->data + i] - fit->mean[i];
            move[0] += fit->gain[k * problem->data + i] * off;
            move[1] += fit->gain[l * problem->data + i] * off;
        }
        sum += move[0] * move[1];
    }
    return sum / (n * (n - 1.0));
}

/* Student's factor for a variance of two parts with their own degrees of freedom
 * (Welch and Satterthwaite). */
static double student(double data, double data_degrees, double seeds, double seed_degrees)
{
    const double whole = data + seeds;
    const double below = data * data / data_degrees + seeds * seeds / seed_degrees;
    const double degrees = below > 0.0 ? whole * whole / below : INFINITY;
    return degrees < 1e6 ? gsl_cdf_tdist_Pinv(0.975, degrees)
                         : gsl_cdf_ugaussian_Pinv(0.975);
}

static void set_errors(const struct fit *fit, const double *effect, double scatter,
                       struct gb_estimate *to, double *half)
{
    const struct gb_estimate_problem *problem = fit->problem;
    const size_t n = problem->variables;
    const double free_data = (double)(problem->data - n);
    for (size_t k = 0; k < n; k++) {
        const double data = from_data(fit, scatter, k, k);
        const double seeds = from_seeds(fit, k, k);
        to->error[k] = effect[k] > 0.0 ? sqrt(data + seeds) : INFINITY;
        half[k] = to->error[k] * student(data, problem->error ? INFINITY : free_data,
                                         seeds, (double)problem->seeds - 1.0);
    }
    for (size_t k = 0; k < n; k++) {
        for (size_t l = 0; l < n; l++) {
            const double shared = from_data(fit, scatter, k, l) + from_seeds(fit, k, l);
            const double scale = to->error[k] * to->error[l];
            to->correlation[k][l] = k == l                           ? 1.0
                                    : isfinite(scale) && scale > 0.0 ? shared / scale
                                                                     : 0.0;
        }
    }
}

/* Profile of variable k. */
struct profile {
    const struct fit *fit;
    const struct gb_estimate *best;
    size_t k;
    double least; /* misfit of the best fit */
    struct gb_error *err;
    bool *good; /* memory */
};

/* Square of the distance from the best fit at which a linear model has this misfit. */
static double squares_at(double at, const void *data)
{
    const struct profile *profile = data;
    double all[VARIABLES];
    memcpy(all, profile->best->at, sizeof all);
    all[profile->k] = at;
    if (!*profile->good || !minimise(profile->fit, (int)profile->k, all, profile->err)) {
        *profile->good = false;
        return 0.0;
    }
    const double rise = fmax(misfit(profile->fit, all) - profile->least, 0.0);
    return rise * profile->fit->unit[profile->k] * profile->fit->unit[profile->k];
}

/* The end of an interval on the side of `box`, `half` away in a linear model. */
static double find_end(const struct profile *profile, double half, double box,
                       double limit)
{
    const double at = profile->best->at[profile->k];
    const double linear = box > at ? at + half : at - half;
    const struct gb_exponent_profile crossing = {squares_at, profile};
    if (box != at && squares_at(box, profile) > half * half) {
        return gb_power_crossing(&crossing, half * half, at, box);
    }
    return limit < at ? fmax(fmin(linear, box), limit) : fmin(fmax(linear, box), limit);
}

static bool is_linear(const struct profile *profile, double half)
{
    for (int side = -1; side <= 1; side += 2) {
        const double end = profile->best->at[profile->k] + side * half;
        if (end < profile->fit->problem->low[profile->k] ||
            end > profile->fit->problem->high[profile->k] ||
            fabs(sqrt(squares_at(end, profile)) - half) > linear_enough * half) {
            return false;
        }
    }
    return true;
}

/* half: of the intervals of a linear model. */
static bool set_intervals(const struct fit *fit, double least, const double *half,
                          struct gb_estimate *to, struct gb_error *err)
{
    const struct gb_estimate_problem *problem = fit->problem;
    bool good = true;
    for (size_t k = 0; k < problem->variables; k++) {
        const struct profile profile = {fit, to, k, least, err, &good};
        if (!isfinite(half[k])) {
            to->low_95[k] = problem->least[k];
            to->high_95[k] = problem->most[k];
        } else if (is_linear(&profile, half[k])) {
            to->low_95[k] = to->at[k] - half[k];
            to->high_95[k] = to->at[k] + half[k];
        } else {
            to->low_95[k] =
                find_end(&profile, half[k], problem->low[k], problem->least[k]);
            to->high_95[k] =
                find_end(&profile, half[k], problem->high[k], problem->most[k]);
        }
    }
    return good;
}

static bool alloc_fit(struct fit *fit, struct gb_error *err)
{
    const struct gb_estimate_problem *problem = fit->problem;
    const size_t data = problem->data;
    fit->mean = gb_alloc_array(data * (2 + problem->seeds + 2 * problem->variables),
                               sizeof *fit->mean, err);
    if (fit->mean == NULL) {
        return false;
    }
    fit->weight = fit->mean + data;
    fit->seen = fit->weight + data;
    fit->slope = fit->seen + problem->seeds * data;
    fit->gain = fit->slope + problem->variables * data;
    return true;
}

bool gb_surrogate_estimate(const struct gb_estimate_problem *problem,
                           struct gb_estimate *estimate, double *fitted,
                           double *fitted_error, struct gb_error *err)
{
    struct fit fit = {.problem = problem};
    double effect[VARIABLES], half[VARIABLES];
    *estimate = (struct gb_estimate){0};
    const size_t needed = problem->variables + (problem->error == NULL);
    if (problem->data < needed || problem->seeds < 2) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "%zu values and %zu seeds for %zu parameters: must be at least as many "
            "values (one more without errors) and 2 seeds",
            problem->data, problem->seeds, problem->variables);
    }
    if (!alloc_fit(&fit, err)) {
        return false;
    }
    set_weights(&fit);
    find_start(&fit, estimate->at);
    bool good = minimise(&fit, NONE, estimate->at, err) &&
                set_slope(&fit, estimate->at, err) && set_gain(&fit, effect, err);
    if (good) {
        const double least = misfit(&fit, estimate->at); /* also sets fit.mean */
        const double weighted = problem->weight != NULL ? chi_squared(&fit) : least;
        double squares = 0.0;
        for (size_t i = 0; i < problem->data; i++) {
            const double off = fit.mean[i] - problem->value[i];
            squares += off * off;
            fitted[i] = fit.mean[i];
            fitted_error[i] = sqrt(noise(&fit, i));
        }
        estimate->rms = sqrt(squares / (double)problem->data);
        estimate->chi_squared = problem->error ? weighted : (double)NAN;
        const size_t degrees = problem->data - problem->variables;
        set_errors(&fit, effect, degrees > 0 ? squares / (double)degrees : 0.0, estimate,
                   half);
        good = set_intervals(&fit, least, half, estimate, err);
    }
    gb_alloc_free(fit.mean);
    return good;
}

enum { TERMS = GB_SURROGATE_TERMS, JACKKNIFE_MIN = 3 };

/* Variances over -1 to 1 of x, x^2 and x y. */
static const double of_x = 1.0 / 3.0;
static const double of_square = 4.0 / 45.0;
static const double of_product = 1.0 / 9.0;

struct work {
    size_t variables, points, seeds, terms;
    const double *at, *value;
    double *coefficient; /* fitted seeds x terms */
    size_t *seed;        /* which they are */
    size_t fitted;
    double *x, *y; /* of one fit: points x variables, points */
};

static bool open_work(struct work *work, struct gb_error *err)
{
    work->coefficient = gb_alloc_array(work->seeds * work->terms, sizeof(double), err);
    work->seed = gb_alloc_array(work->seeds, sizeof *work->seed, err);
    work->x = gb_alloc_array(work->points * work->variables, sizeof(double), err);
    work->y = gb_alloc_array(work->points, sizeof(double), err);
    return work->coefficient && work->seed && work->x && work->y;
}

static void close_work(struct work *work)
{
    gb_alloc_free(work->coefficient);
    gb_alloc_free(work->seed);
    gb_alloc_free(work->x);
    gb_alloc_free(work->y);
}

static size_t collect(const struct work *work, size_t seed)
{
    size_t count = 0;
    for (size_t p = 0; p < work->points; p++) {
        const double y = work->value[p * work->seeds + seed];
        if (isnan(y)) {
            continue;
        }
        for (size_t k = 0; k < work->variables; k++) {
            work->x[count * work->variables + k] = work->at[p * work->variables + k];
        }
        work->y[count++] = y;
    }
    return count;
}

/* Seeds with too few values are left out. */
static bool fit_seed(struct work *work, size_t seed, struct gb_error *why)
{
    struct gb_surrogate surrogate;
    const size_t count = collect(work, seed);
    if (!gb_surrogate_fit(&surrogate, work->variables, 1, GB_SURROGATE_QUADRATIC, work->x,
                          work->y, count, why)) {
        return why->code == GB_ERR_INPUT;
    }
    for (size_t t = 0; t < work->terms; t++) {
        work->coefficient[work->fitted * work->terms + t] = surrogate.coefficient[t];
    }
    work->seed[work->fitted++] = seed;
    gb_surrogate_finish(&surrogate);
    return true;
}

static bool fit_seeds(struct work *work, struct gb_error *err)
{
    struct gb_error why = {0};
    for (size_t s = 0; s < work->seeds; s++) {
        if (!fit_seed(work, s, &why)) {
            return gb_error_set(err, why.code, "%s", why.text);
        }
    }
    return work->fitted > 0 || gb_error_set(err, why.code, "%s", why.text);
}

/* Mean of a coefficient over the fitted seeds but `left_out`, and its square without what
 * the scatter of the seeds adds to it. */
static double mean_of(const struct work *work, size_t term, size_t left_out,
                      double *square)
{
    double sum = 0.0, squares = 0.0;
    size_t n = 0;
    for (size_t s = 0; s < work->fitted; s++) {
        if (s != left_out) {
            sum += work->coefficient[s * work->terms + term];
            n++;
        }
    }
    const double mean = sum / (double)n;
    for (size_t s = 0; s < work->fitted; s++) {
        const double off = work->coefficient[s * work->terms + term] - mean;
        squares += s != left_out ? off * off : 0.0;
    }
    const double count = (double)n;
    *square = mean * mean - (n > 1 ? squares / (count * (count - 1.0)) : 0.0);
    return mean;
}

struct shares {
    double mean, variance;
    double first[VARIABLES], total[VARIABLES];
};

/* The parts of the variance; left_out = fitted: none. */
static struct shares share(const struct work *work, size_t left_out)
{
    struct shares shares = {0};
    const size_t n = work->variables;
    double square = 0.0;
    size_t term = 1 + n;
    shares.mean = mean_of(work, 0, left_out, &square);
    for (size_t i = 0; i < n; i++) {
        (void)mean_of(work, 1 + i, left_out, &square);
        shares.first[i] = of_x * square;
    }
    for (size_t i = 0; i < n; i++) {
        for (size_t j = i; j < n; j++, term++) {
            const double mean = mean_of(work, term, left_out, &square);
            if (i == j) {
                shares.mean += mean / 3.0;
                shares.first[i] += of_square * square;
                continue;
            }
            shares.variance += of_product * square;
            shares.total[i] += of_product * square;
            shares.total[j] += of_product * square;
        }
    }
    for (size_t i = 0; i < n; i++) {
        shares.total[i] += shares.first[i];
        shares.variance += shares.first[i];
    }
    for (size_t i = 0; i < n; i++) {
        shares.first[i] = shares.variance > 0.0 ? shares.first[i] / shares.variance : NAN;
        shares.total[i] = shares.variance > 0.0 ? shares.total[i] / shares.variance : NAN;
    }
    return shares;
}

static bool fill_errors(const struct work *work, struct gb_sobol_indices *indices,
                        struct gb_error *err)
{
    double *without = gb_alloc_array(2 * work->fitted, sizeof *without, err);
    if (without == NULL) {
        return false;
    }
    for (size_t k = 0; k < work->variables; k++) {
        for (size_t s = 0; s < work->fitted; s++) {
            const struct shares shares = share(work, s);
            without[s] = shares.first[k];
            without[work->fitted + s] = shares.total[k];
        }
        const bool known = work->fitted >= JACKKNIFE_MIN;
        indices->first_error[k] =
            known ? gb_average_jackknife(without, work->fitted) : NAN;
        indices->total_error[k] =
            known ? gb_average_jackknife(without + work->fitted, work->fitted) : NAN;
    }
    gb_alloc_free(without);
    return true;
}

static double residual(const struct work *work, size_t point, size_t fit)
{
    struct gb_surrogate surrogate = {work->variables, 1, work->terms,
                                     work->coefficient + fit * work->terms};
    double fitted = 0.0;
    value_at(&surrogate, work->at + point * work->variables, &fitted);
    return work->value[point * work->seeds + work->seed[fit]] - fitted;
}

/* Over the points that all fitted seeds have: the mean square of the seeds' mean residual
 * less what their scatter gives it, per degree of freedom, and the variance between
 * seeds. */
static void fill_scatter(const struct work *work, double variance,
                         struct gb_sobol_indices *indices)
{
    double lack = 0.0, noise = 0.0, between = 0.0;
    const double n = (double)work->fitted;
    size_t points = 0;
    for (size_t p = 0; p < work->points; p++) {
        double r = 0.0, rr = 0.0, y = 0.0, yy = 0.0;
        for (size_t s = 0; s < work->fitted; s++) {
            const double value =
                work->value[p * work->seeds + work->seed[s]] - indices->mean;
            const double off = residual(work, p, s);
            r += off;
            rr += off * off;
            y += value;
            yy += value * value;
        }
        if (isnan(r)) {
            continue;
        }
        points++;
        lack += r / n * (r / n);
        noise += (rr - r * r / n) / n;
        between += yy - y * y / n;
    }
    const double freedom = (double)points - (double)work->terms;
    if (work->fitted > 1) {
        lack -= noise / (n - 1.0);
        indices->seed_sd = sqrt(between / ((n - 1.0) * (double)points));
    }
    lack = fmax(lack, 0.0) / freedom;
    indices->unexplained = freedom > 0.0 ? lack / (lack + fmax(variance, 0.0)) : NAN;
}

static bool fill(const struct work *work, struct gb_sobol_indices *indices,
                 struct gb_error *err)
{
    const struct shares all = share(work, work->fitted);
    indices->seeds = work->fitted;
    indices->mean = all.mean;
    indices->range_sd = sqrt(fmax(all.variance, 0.0));
    indices->seed_sd = NAN;
    for (size_t k = 0; k < work->variables; k++) {
        indices->first[k] = all.first[k];
        indices->total[k] = all.total[k];
    }
    fill_scatter(work, all.variance, indices);
    return fill_errors(work, indices, err);
}

bool gb_surrogate_sobol(struct gb_sobol_indices *indices, size_t variables, size_t points,
                        size_t seeds, const double *at, const double *value,
                        struct gb_error *err)
{
    struct work work = {.variables = variables,
                        .points = points,
                        .seeds = seeds,
                        .terms = gb_surrogate_terms(variables, GB_SURROGATE_QUADRATIC),
                        .at = at,
                        .value = value};
    *indices = (struct gb_sobol_indices){0};
    const bool good =
        open_work(&work, err) && fit_seeds(&work, err) && fill(&work, indices, err);
    close_work(&work);
    return good;
}
