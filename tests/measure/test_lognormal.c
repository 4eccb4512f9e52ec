#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <math.h>

#include <glib.h>

#include "measure/distribution.h"

/* P1 Fig. 10: alumina by target evaporation, sizes in nm. */
static const double p1_m = 2.644;
static const double p1_sigma = 0.547;

enum { CLASSES = 40, WIDTH = 2 };

static void set_middles(double *middle)
{
    for (int i = 0; i < CLASSES; i++) {
        middle[i] = WIDTH * (i + 0.5);
    }
}

/* The law's own shares give the law back, and P1's statements about it hold. */
static void test_exact(void)
{
    const struct gb_lognormal truth = {.m = p1_m, .sigma = p1_sigma};
    double middle[CLASSES], weight[CLASSES];
    struct gb_lognormal law;
    set_middles(middle);
    double sum = 0.0;
    for (int i = 0; i < CLASSES; i++) {
        weight[i] = gb_distribution_share(&truth, WIDTH * i, WIDTH * (i + 1));
        sum += weight[i];
    }
    g_assert_cmpfloat(sum, >, 0.999);
    /* erf by another route: share below the median is a half */
    g_assert_cmpfloat_with_epsilon(gb_distribution_share(&truth, 0.0, exp(p1_m)), 0.5,
                                   1e-14);
    g_assert_true(gb_distribution_lognormal(&law, middle, weight, CLASSES,
                                            GB_LOGNORMAL_SHARES, NULL));
    /* 0.001 of the particles lie beyond the last class, where the fit expects none */
    g_assert_cmpfloat_with_epsilon(law.m, p1_m, 2e-3);
    g_assert_cmpfloat_with_epsilon(law.sigma, p1_sigma, 3e-3);
    g_assert_cmpfloat_with_epsilon(exp(law.m - law.sigma * law.sigma), 10.4, 0.1);
    g_assert_true(isnan(law.m_error) && isnan(law.chi_squared));
}

/* Samples: the law lies within its errors with the expected probability. */
static void test_samples(void)
{
    enum { TRIALS = 200, PARTICLES = 1000 };
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    double middle[CLASSES];
    int hits[2] = {0, 0};
    double chi = 0.0;
    set_middles(middle);
    for (int t = 0; t < TRIALS; t++) {
        double weight[CLASSES] = {0.0};
        struct gb_lognormal law;
        for (int p = 0; p < PARTICLES; p++) {
            const int i = (int)(gsl_ran_lognormal(rng, p1_m, p1_sigma) / WIDTH);
            weight[i < CLASSES ? i : CLASSES - 1] += 1.0;
        }
        g_assert_true(gb_distribution_lognormal(&law, middle, weight, CLASSES,
                                                GB_LOGNORMAL_PARTICLES, NULL));
        hits[0] += fabs(law.m - p1_m) < 1.96 * law.m_error;
        hits[1] += fabs(law.sigma - p1_sigma) < 1.96 * law.sigma_error;
        g_assert_cmpfloat_with_epsilon(law.m_error, p1_sigma / sqrt(PARTICLES), 2e-3);
        g_assert_cmpfloat_with_epsilon(law.sigma_error, p1_sigma / sqrt(2.0 * PARTICLES),
                                       2e-3);
        chi += law.chi_squared / (double)law.degrees / TRIALS;
    }
    g_test_message("%d and %d of %d, chi-squared %g", hits[0], hits[1], TRIALS, chi);
    g_assert_cmpint(hits[0], >=, TRIALS * 90 / 100);
    g_assert_cmpint(hits[1], >=, TRIALS * 90 / 100);
    g_assert_cmpfloat(chi, >, 0.7);
    g_assert_cmpfloat(chi, <, 1.5);
    gsl_rng_free(rng);
}

/* A histogram of draws of the law, with middles in equal steps or equal ratios; the outer
 * classes take what lies beyond. */
static void draw(gsl_rng *rng, bool ratios, int classes, int particles, double *middle,
                 double *weight)
{
    const double least = exp(p1_m - 3.2 * p1_sigma), largest = exp(p1_m + 3.2 * p1_sigma);
    for (int i = 0; i < classes; i++) {
        const double share = (i + 0.5) / classes;
        middle[i] = ratios ? least * pow(largest / least, share) : largest * share;
        weight[i] = 0.0;
    }
    for (int p = 0; p < particles; p++) {
        const double x = gsl_ran_lognormal(rng, p1_m, p1_sigma);
        int i = 0;
        while (i + 1 < classes && x >= 0.5 * (middle[i] + middle[i + 1])) {
            i++;
        }
        weight[i] += 1.0;
    }
}

/* The true law is rejected at 5 % as often as that, whatever the classes: the count lies
 * in the exact 99.9 % interval of a binomial law. */
static void test_true_law(void)
{
    enum { TRIALS = 400 };
    static const int classes[] = {12, 24, 48}, particles[] = {100, 300, 1000};
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    double middle[CLASSES + 8], weight[CLASSES + 8];
    for (int k = 0; k < 18; k++) {
        unsigned rejected = 0;
        for (int t = 0; t < TRIALS; t++) {
            struct gb_lognormal law;
            const int n = classes[k % 3];
            draw(rng, k >= 9, n, particles[k / 3 % 3], middle, weight);
            g_assert_true(gb_distribution_lognormal(&law, middle, weight, (size_t)n,
                                                    GB_LOGNORMAL_PARTICLES, NULL));
            g_assert_cmpuint(law.degrees, >=, 1);
            rejected += law.probability < GB_LOGNORMAL_REJECTED;
        }
        g_test_message("%d classes, %d particles: %u of %d rejected", classes[k % 3],
                       particles[k / 3 % 3], rejected, TRIALS);
        const double level = GB_LOGNORMAL_REJECTED;
        g_assert_cmpfloat(gsl_cdf_binomial_P(rejected, level, TRIALS), >, 5e-4);
        g_assert_cmpfloat(gsl_cdf_binomial_Q(rejected - 1, level, TRIALS), >, 5e-4);
    }
    gsl_rng_free(rng);
}

/* Two powders mixed, nearly all sizes in one class, a flat histogram: no law. */
static void test_other_laws(void)
{
    static const double counts[][8] = {{200, 80, 5, 1, 1, 5, 80, 200},
                                       {0, 1, 0, 500, 1, 0, 1, 1},
                                       {100, 100, 100, 100, 100, 100, 100, 100}};
    static const double middle[8] = {10, 20, 30, 40, 50, 60, 70, 80};
    for (size_t k = 0; k < G_N_ELEMENTS(counts); k++) {
        struct gb_lognormal law;
        g_assert_true(gb_distribution_lognormal(&law, middle, counts[k], 8,
                                                GB_LOGNORMAL_PARTICLES, NULL));
        g_assert_true(law.degrees == 0 || law.probability < GB_LOGNORMAL_REJECTED);
        g_assert_true(law.degrees > 0 || isnan(law.chi_squared));
        g_assert_true(law.degrees == 0 || law.chi_squared < 1e4);
    }
}

static void test_refuse(void)
{
    static const double middle[] = {1.0, 2.0, 3.0, 4.0};
    static const double falls[] = {1.0, 3.0, 2.0, 4.0};
    static const double weight[] = {1.0, 5.0, 2.0, 1.0};
    static const double two[] = {0.0, 5.0, 2.0, 0.0};
    static const double below[] = {1.0, -5.0, 2.0, 1.0};
    struct gb_lognormal law;
    struct gb_error err = {0};
    g_assert_false(
        gb_distribution_lognormal(&law, falls, weight, 4, GB_LOGNORMAL_PARTICLES, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    g_assert_false(
        gb_distribution_lognormal(&law, middle, two, 4, GB_LOGNORMAL_PARTICLES, &err));
    g_assert_false(
        gb_distribution_lognormal(&law, middle, below, 4, GB_LOGNORMAL_PARTICLES, &err));
    g_assert_false(
        gb_distribution_lognormal(&law, middle, weight, 0, GB_LOGNORMAL_PARTICLES, &err));
    g_assert_true(
        gb_distribution_lognormal(&law, middle, weight, 4, GB_LOGNORMAL_PARTICLES, &err));
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    gsl_set_error_handler_off();
    g_test_add_func("/lognormal/exact", test_exact);
    g_test_add_func("/lognormal/samples", test_samples);
    g_test_add_func("/lognormal/true-law", test_true_law);
    g_test_add_func("/lognormal/other-laws", test_other_laws);
    g_test_add_func("/lognormal/refuse", test_refuse);
    return g_test_run();
}
