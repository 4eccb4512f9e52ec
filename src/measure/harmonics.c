#include "measure/harmonics.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <string.h>

#include "base/vec.h"

/* Powers of x, y, z of the terms. */
static const int power[GB_HARMONICS_TERMS][3] = {
    {4, 0, 0}, {0, 0, 4}, {2, 0, 2}, {3, 0, 1}, {1, 0, 3},
    {0, 4, 0}, {2, 2, 0}, {0, 2, 2}, {3, 1, 0}, {1, 3, 0},
    {0, 3, 1}, {0, 1, 3}, {2, 1, 1}, {1, 2, 1}, {1, 1, 2},
};

/* The first five terms are those of the plane y = 0. */
enum { PLANAR_TERMS = 5 };

static double raise(double x, int exponent)
{
    double result = 1.0;
    for (int k = 0; k < exponent; k++) {
        result *= x;
    }
    return result;
}

static void terms_of(const double direction[3], double *term)
{
    const double size = gb_vec_length(direction);
    for (int k = 0; k < GB_HARMONICS_TERMS; k++) {
        term[k] = raise(direction[0] / size, power[k][0]) *
                  raise(direction[1] / size, power[k][1]) *
                  raise(direction[2] / size, power[k][2]);
    }
}

/* Normal equations of the terms; returns the mean of the values. */
static double add_up(double *matrix, double *right, size_t terms, const double *axis,
                     const double *value, size_t count)
{
    double sum = 0.0;
    memset(matrix, 0, terms * terms * sizeof *matrix);
    memset(right, 0, terms * sizeof *right);
    for (size_t i = 0; i < count; i++) {
        double term[GB_HARMONICS_TERMS];
        terms_of(&axis[3 * i], term);
        for (size_t a = 0; a < terms; a++) {
            for (size_t b = 0; b < terms; b++) {
                matrix[a * terms + b] += term[a] * term[b];
            }
            right[a] += term[a] * value[i];
        }
        sum += value[i];
    }
    return sum / (double)count;
}

bool gb_harmonics_fit(struct gb_harmonics *rose, int dimension, const double *axis,
                      const double *value, size_t count, struct gb_error *err)
{
    double matrix[GB_HARMONICS_TERMS * GB_HARMONICS_TERMS];
    double right[GB_HARMONICS_TERMS];
    const size_t terms = dimension == 2 ? PLANAR_TERMS : GB_HARMONICS_TERMS;
    *rose = (struct gb_harmonics){.count = count, .dimension = dimension};
    if (count < terms) {
        return gb_error_set(err, GB_ERR_INPUT, "rose of %zu forces: must be at least %zu",
                            count, terms);
    }
    rose->mean = add_up(matrix, right, terms, axis, value, count);
    gsl_matrix_view a = gsl_matrix_view_array(matrix, terms, terms);
    gsl_vector_view b = gsl_vector_view_array(right, terms);
    gsl_vector_view x = gsl_vector_view_array(rose->term, terms);
    if (gsl_linalg_cholesky_decomp1(&a.matrix) != GSL_SUCCESS ||
        gsl_linalg_cholesky_solve(&a.matrix, &b.vector, &x.vector) != GSL_SUCCESS) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "rose of %zu forces: too few different directions", count);
    }
    return true;
}

double gb_harmonics_at(const struct gb_harmonics *rose, const double direction[3])
{
    double term[GB_HARMONICS_TERMS];
    double sum = 0.0;
    terms_of(direction, term);
    for (int k = 0; k < GB_HARMONICS_TERMS; k++) {
        sum += rose->term[k] * term[k];
    }
    return sum;
}
