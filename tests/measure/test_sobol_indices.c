#include "measure/surrogate.h"

#include <math.h>
#include <string.h>

#include <glib.h>
#include <gsl/gsl_qrng.h>
#include <gsl/gsl_randist.h>

enum { VARIABLES = 3, POINTS = 64, SEEDS = 5 };

/* f = 2 + 3 x + 2 y^2 + 4 x z over -1 to 1: variances 9/3, 4 * 4/45, 16/9. */
static const double of_x = 3.0, of_y = 16.0 / 45.0, of_xz = 16.0 / 9.0;

static double exact(const double *at)
{
    return 2.0 + 3.0 * at[0] + 2.0 * at[1] * at[1] + 4.0 * at[0] * at[2];
}

static void fill_design(double *at, size_t points)
{
    gsl_qrng *design = gsl_qrng_alloc(gsl_qrng_sobol, VARIABLES);
    for (size_t p = 0; p < points; p++) {
        gsl_qrng_get(design, at + VARIABLES * p);
        for (size_t k = 0; k < VARIABLES; k++) {
            at[VARIABLES * p + k] = 2.0 * at[VARIABLES * p + k] - 1.0;
        }
    }
    gsl_qrng_free(design);
}

/* Noise of a seed: an offset common to all points and a part of its own at each. */
static void fill_values(const double *at, double offset, double noise, gsl_rng *random,
                        double *value)
{
    double common[SEEDS];
    for (size_t s = 0; s < SEEDS; s++) {
        common[s] = gsl_ran_gaussian(random, 1.0) * offset;
    }
    for (size_t p = 0; p < POINTS; p++) {
        for (size_t s = 0; s < SEEDS; s++) {
            value[p * SEEDS + s] = exact(at + VARIABLES * p) + common[s] +
                                   gsl_ran_gaussian(random, 1.0) * noise;
        }
    }
}

static struct gb_sobol_indices fit(const double *at, const double *value)
{
    struct gb_sobol_indices indices;
    struct gb_error err = {0};
    g_assert_true(
        gb_surrogate_sobol(&indices, VARIABLES, POINTS, SEEDS, at, value, &err));
    return indices;
}

static void test_exact(void)
{
    double at[VARIABLES * POINTS], value[POINTS * SEEDS];
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    fill_design(at, POINTS);
    fill_values(at, 0.0, 0.0, random, value);
    value[3] = NAN; /* a run that failed */
    const struct gb_sobol_indices indices = fit(at, value);
    const double all = of_x + of_y + of_xz;
    g_assert_cmpfloat_with_epsilon(indices.mean, 2.0 + 2.0 / 3.0, 1e-9);
    g_assert_cmpfloat_with_epsilon(indices.range_sd, sqrt(all), 1e-9);
    g_assert_cmpfloat_with_epsilon(indices.first[0], of_x / all, 1e-9);
    g_assert_cmpfloat_with_epsilon(indices.first[1], of_y / all, 1e-9);
    g_assert_cmpfloat_with_epsilon(indices.first[2], 0.0, 1e-9);
    g_assert_cmpfloat_with_epsilon(indices.total[0], (of_x + of_xz) / all, 1e-9);
    g_assert_cmpfloat_with_epsilon(indices.total[1], of_y / all, 1e-9);
    g_assert_cmpfloat_with_epsilon(indices.total[2], of_xz / all, 1e-9);
    g_assert_cmpfloat(indices.unexplained, <, 1e-12);
    g_assert_cmpuint(indices.seeds, ==, SEEDS);
    gsl_rng_free(random);
}

/* Over many samples of noise as large as the effects: no bias of the shares, errors of
 * the right size, scatter known apart. */
static void test_noise(void)
{
    enum { SAMPLES = 300 };
    double at[VARIABLES * POINTS], value[POINTS * SEEDS];
    const double all = of_x + of_y + of_xz;
    double sum[VARIABLES] = {0.0}, squares[VARIABLES] = {0.0}, errors[VARIABLES] = {0.0};
    double seed_variance = 0.0;
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    fill_design(at, POINTS);
    for (int i = 0; i < SAMPLES; i++) {
        fill_values(at, 1.5, 2.0, random, value);
        const struct gb_sobol_indices indices = fit(at, value);
        for (size_t k = 0; k < VARIABLES; k++) {
            sum[k] += indices.total[k];
            squares[k] += indices.total[k] * indices.total[k];
            errors[k] += indices.total_error[k] * indices.total_error[k];
        }
        seed_variance += indices.seed_sd * indices.seed_sd;
        g_assert_cmpfloat(indices.unexplained, <, 0.2);
    }
    const double want[] = {(of_x + of_xz) / all, of_y / all, of_xz / all};
    for (size_t k = 0; k < VARIABLES; k++) {
        const double mean = sum[k] / SAMPLES;
        const double variance = squares[k] / SAMPLES - mean * mean;
        g_test_message("%zu: %.4f for %.4f, sd %.4f, error %.4f", k, mean, want[k],
                       sqrt(variance), sqrt(errors[k] / SAMPLES));
        g_assert_cmpfloat(fabs(mean - want[k]), <, 4.0 * sqrt(variance / SAMPLES) + 0.01);
        g_assert_cmpfloat(errors[k] / SAMPLES, >, 0.5 * variance);
        g_assert_cmpfloat(errors[k] / SAMPLES, <, 2.0 * variance);
    }
    const double noise = 1.5 * 1.5 + 2.0 * 2.0;
    g_test_message("between seeds %.3f for %.3f", seed_variance / SAMPLES, noise);
    g_assert_cmpfloat_with_epsilon(seed_variance / SAMPLES, noise, 0.1 * noise);
    gsl_rng_free(random);
}

/* What a quadratic cannot have is told. */
static void test_unexplained(void)
{
    double at[VARIABLES * POINTS], value[POINTS * SEEDS];
    fill_design(at, POINTS);
    for (size_t p = 0; p < POINTS; p++) {
        for (size_t s = 0; s < SEEDS; s++) {
            value[p * SEEDS + s] = sin(6.0 * at[VARIABLES * p]);
        }
    }
    g_assert_cmpfloat(fit(at, value).unexplained, >, 0.5);
}

static void test_errors(void)
{
    double at[VARIABLES * POINTS], value[POINTS * SEEDS];
    struct gb_sobol_indices indices;
    struct gb_error err = {0};
    fill_design(at, POINTS);
    for (size_t i = 0; i < G_N_ELEMENTS(value); i++) {
        value[i] = NAN;
    }
    g_assert_false(
        gb_surrogate_sobol(&indices, VARIABLES, POINTS, SEEDS, at, value, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    g_assert_nonnull(strstr(err.text, "too few"));
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/sobol/exact", test_exact);
    g_test_add_func("/sobol/noise", test_noise);
    g_test_add_func("/sobol/unexplained", test_unexplained);
    g_test_add_func("/sobol/errors", test_errors);
    return g_test_run();
}
