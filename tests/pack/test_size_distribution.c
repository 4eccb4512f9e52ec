#include "pack/structure/assign_sizes.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_integration.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <glib.h>

#include "base/alloc.h"

enum { P3_COUNT = 1751 };

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* A scene that accepts sizes is not needed to freeze a law. */
static struct gb_sizes freeze(const char *const sets[])
{
    struct gb_params params;
    struct gb_sizes sizes;
    struct gb_error err = {0};
    gb_params_init(&params);
    params.kind = GB_KIND_DIE;
    for (int i = 0; sets[i]; i++) {
        if (!gb_params_assign(&params, sets[i], &err)) {
            g_error("%s", err.text);
        }
    }
    if (!gb_sizes_init(&sizes, &params, &err)) {
        g_error("%s", err.text);
    }
    return sizes;
}

static double *draw(const struct gb_sizes *sizes, int64_t count, uint64_t seed)
{
    double *d = g_new(double, (gsize)count);
    struct gb_error err = {0};
    g_assert_true(gb_assign_sizes(sizes, count, seed, d, &err));
    return d;
}

static double mean_power(const double *d, int64_t count, int power)
{
    double sum = 0.0;
    for (int64_t i = 0; i < count; i++) {
        sum += pow(d[i], power);
    }
    return sum / (double)count;
}

static const char *const p1[] = {"particles.distribution=lognormal",
                                 "particles.median=14.06938 nm", "particles.sigma=0.547",
                                 NULL};
static const char *const nial_law[] = {"particles.distribution=lognormal",
                                       "particles.median=4.26 um",
                                       "particles.sigma=0.42",
                                       "particles.least=1.5 um",
                                       "particles.largest=18.5 um",
                                       NULL};

/* P1 (17): m = 2.644, sigma = 0.547, x in nm.  Its maximum lies at 10.4 nm; moments of an
 * uncut log-normal law are exp(k m + k^2 sigma^2/2). */
static void test_p1(void)
{
    const struct gb_sizes sizes = freeze(p1);
    const double m = log(sizes.median_m / 1e-9), s = sizes.sigma;
    g_assert_cmpfloat_with_epsilon(m, 2.644, 1e-5);
    g_assert_cmpfloat_with_epsilon(exp(m - s * s), 10.4, 0.05);
    for (int k = 1; k <= 4; k++) {
        const double expected = exp(k * m + 0.5 * k * k * s * s);
        g_assert_cmpfloat_with_epsilon(gb_sizes_moment(&sizes, k) / pow(1e-9, k),
                                       expected, 1e-12 * expected);
    }
}

struct law {
    double m, s;
    int power;
};

static double density(double x, void *data)
{
    const struct law *law = data;
    const double z = (law->m - log(x)) / law->s;
    return pow(x, law->power) * exp(-0.5 * z * z) / (x * law->s * sqrt(2.0 * G_PI));
}

/* Moments of the cut law against quadrature of (17). */
static void test_moments(void)
{
    const struct gb_sizes sizes = freeze(nial_law);
    gsl_integration_workspace *work = gsl_integration_workspace_alloc(1000);
    double value[4], error;
    for (int k = 0; k < 4; k++) {
        struct law law = {log(4.26), 0.42, k};
        gsl_function f = {density, &law};
        gsl_integration_qag(&f, 1.5, 18.5, 0.0, 1e-12, 1000, GSL_INTEG_GAUSS61, work,
                            &value[k], &error);
    }
    gsl_integration_workspace_free(work);
    for (int k = 1; k < 4; k++) {
        const double expected = value[k] / value[0];
        g_assert_cmpfloat_with_epsilon(gb_sizes_moment(&sizes, k) * pow(1e6, k), expected,
                                       1e-11 * expected);
    }
    /* What stands in for P3's histogram has P3's mean volume. */
    g_assert_cmpfloat_with_epsilon(gb_sizes_mean_volume(&sizes) * 1e18, 88.9, 0.1);
}

/* The volume of a draw is that of the law for any count, and its distribution follows the
 * law to within one particle. */
static void test_strata(void)
{
    static const int64_t counts[] = {1, 2, 17, P3_COUNT, 100000};
    static const char *const *const laws[] = {p1, nial_law};
    for (size_t l = 0; l < G_N_ELEMENTS(laws); l++) {
        const struct gb_sizes sizes = freeze(laws[l]);
        const double low = gsl_cdf_ugaussian_P(sizes.z_least);
        const double mass = gsl_cdf_ugaussian_P(sizes.z_largest) - low;
        for (size_t c = 0; c < G_N_ELEMENTS(counts); c++) {
            const int64_t n = counts[c];
            double *d = draw(&sizes, n, 3);
            const double volume = gb_sizes_moment(&sizes, 3);
            g_assert_cmpfloat_with_epsilon(mean_power(d, n, 3), volume, 1e-10 * volume);
            qsort(d, (size_t)n, sizeof *d, compare);
            for (int64_t i = 0; i < n; i++) {
                const double z = log(d[i] / sizes.median_m) / sizes.sigma;
                const double share = (gsl_cdf_ugaussian_P(z) - low) / mass;
                g_assert_cmpfloat(share * (double)n, >=, (double)i - 1e-6);
                g_assert_cmpfloat(share * (double)n, <=, (double)(i + 1) + 1e-6);
            }
            g_free(d);
        }
    }
}

/* Every seed: the same sizes in another order; the same seed: the same bits. */
static void test_seeds(void)
{
    const struct gb_sizes sizes = freeze(nial_law);
    double *a = draw(&sizes, P3_COUNT, 1), *b = draw(&sizes, P3_COUNT, 1);
    double *c = draw(&sizes, P3_COUNT, UINT64_MAX);
    const size_t bytes = P3_COUNT * sizeof *a;
    g_assert_true(memcmp(a, b, bytes) == 0);
    g_assert_true(memcmp(a, c, bytes) != 0);
    /* shuffled: size and place are not correlated (4 deviations) */
    double sum = 0.0;
    const double mean = mean_power(a, P3_COUNT, 1);
    const double variance = mean_power(a, P3_COUNT, 2) - mean * mean;
    for (int i = 0; i < P3_COUNT; i++) {
        sum += (a[i] - mean) * ((i + 0.5) / P3_COUNT - 0.5);
    }
    const double deviation = sqrt(P3_COUNT * variance / 12.0);
    g_assert_cmpfloat(fabs(sum), <, 4.0 * deviation);
    qsort(a, P3_COUNT, sizeof *a, compare);
    qsort(c, P3_COUNT, sizeof *c, compare);
    g_assert_true(memcmp(a, c, bytes) == 0);
    g_free(a);
    g_free(b);
    g_free(c);
}

/* The shipped table: P3's 1751 spheres. */
static void test_nial(void)
{
    static const char *const sets[] = {
        "particles.distribution=table",
        "particles.table=" GB_TEST_PRESETS "/nial-sizes.csv", NULL};
    const struct gb_sizes sizes = freeze(sets);
    const struct gb_sizes law = freeze(nial_law);
    double *d = draw(&sizes, P3_COUNT, 1);
    qsort(d, P3_COUNT, sizeof *d, compare);
    g_assert_cmpfloat(d[0], ==, 1.5e-6);
    g_assert_cmpfloat(d[P3_COUNT - 1], ==, 18.5e-6);
    const double volume = G_PI / 6.0 * mean_power(d, P3_COUNT, 3) * 1e18;
    g_test_message("mean volume %.4f um3", volume);
    g_assert_cmpfloat_with_epsilon(volume, 88.9, 0.02);
    g_assert_cmpfloat_with_epsilon(gb_sizes_mean_volume(&sizes) * 1e18, volume, 1e-3);
    /* as many spheres of each size as the file says, so a sample of 1751 is the file */
    double most = 0.0;
    for (int row = 0, i = 0; row < sizes.rows; row++) {
        int n = 0;
        for (; i < P3_COUNT && d[i] == sizes.diameter_m[row]; i++) {
            n++;
        }
        const double share = sizes.below[row] - (row > 0 ? sizes.below[row - 1] : 0.0);
        g_assert_cmpfloat_with_epsilon(n, share * P3_COUNT, 1e-3);
        most = fmax(most, share);
    }
    /* within one class of the law everywhere (Kolmogorov) */
    const double low = gsl_cdf_ugaussian_P(law.z_least);
    const double mass = gsl_cdf_ugaussian_P(law.z_largest) - low;
    for (int row = 0; row < sizes.rows; row++) {
        const double z = log(sizes.diameter_m[row] / law.median_m) / law.sigma;
        const double share = (gsl_cdf_ugaussian_P(z) - low) / mass;
        g_assert_cmpfloat(fabs(share - sizes.below[row]), <, most);
    }
    g_free(d);
}

/* Shares of the volume: 1 um and 2 um with half of the volume each are 8 to 1. */
static void test_by_volume(void)
{
    static const char *const sets[] = {"particles.distribution=table",
                                       "particles.table=volume: 1 um 0.5; 2 um 0.5",
                                       NULL};
    const struct gb_sizes sizes = freeze(sets);
    double *d = draw(&sizes, 900, 1);
    int small = 0;
    for (int i = 0; i < 900; i++) {
        g_assert_true(d[i] == 1e-6 || d[i] == 2e-6);
        small += d[i] == 1e-6;
    }
    g_assert_cmpint(small, ==, 800);
    g_assert_cmpfloat_with_epsilon(gb_sizes_moment(&sizes, 3), 16.0 / 9.0 * 1e-18, 1e-30);
    g_free(d);
}

static void test_mono(void)
{
    static const char *const sets[] = {"particles.diameter=3 um", NULL};
    const struct gb_sizes sizes = freeze(sets);
    double *d = draw(&sizes, 10, 1);
    for (int i = 0; i < 10; i++) {
        g_assert_cmpfloat(d[i], ==, 3e-6);
    }
    g_assert_cmpfloat_with_epsilon(gb_sizes_mean_volume(&sizes) * 1e18, 4.5 * G_PI,
                                   1e-12);
    g_free(d);
}

static void test_errors(void)
{
    struct gb_params params;
    struct gb_sizes sizes;
    struct gb_error err = {0};
    gb_params_init(&params);
    params.distribution = GB_DISTRIBUTION_TABLE;
    g_assert_false(gb_sizes_init(&sizes, &params, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    params.sizes.count = GB_SIZES_MAX + 1;
    g_assert_false(gb_sizes_init(&sizes, &params, &err));
    double d[4];
    const struct gb_sizes law = freeze(p1);
    gb_alloc_fail_after(1);
    g_assert_false(gb_assign_sizes(&law, 4, 1, d, &err));
    gb_alloc_fail_after(0);
    g_assert_cmpint(err.code, ==, GB_ERR_MEMORY);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/sizes/p1", test_p1);
    g_test_add_func("/sizes/moments", test_moments);
    g_test_add_func("/sizes/strata", test_strata);
    g_test_add_func("/sizes/seeds", test_seeds);
    g_test_add_func("/sizes/nial", test_nial);
    g_test_add_func("/sizes/by-volume", test_by_volume);
    g_test_add_func("/sizes/mono", test_mono);
    g_test_add_func("/sizes/errors", test_errors);
    return g_test_run();
}
