#include "measure/fit/surrogate.h"

#include <gsl/gsl_multifit.h>
#include <math.h>

#include "base/alloc.h"

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

void gb_surrogate_value(const struct gb_surrogate *surrogate, const double *at,
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

void gb_surrogate_slope(const struct gb_surrogate *surrogate, const double *at,
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
