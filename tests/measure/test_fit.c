#include <math.h>
#include <string.h>

#include <glib.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

#include "measure/fit.h"
#include "measure/power.h"

enum { POINTS = 600, SAMPLES = 200 };

/* P2, Table 1, v1: MPa and ns over the 30 ns of the hold. */
static const double table[5] = {2603.9, 441.1, 0.0719, 35.3, 4.9304};

/* Times as a run records them: dense in the beginning. */
static double time_at(int i)
{
    const double s = (double)i / (POINTS - 1);
    return 30.0 * s * s * s;
}

static double two(const double q[5], double t)
{
    return q[0] + q[1] * exp(-t / q[2]) + q[3] * exp(-t / q[4]);
}

static struct gb_fit_decay fit_of(const double q[5], double noise, gsl_rng *random)
{
    double t[POINTS], p[POINTS];
    struct gb_fit_decay fit;
    struct gb_error err = {0};
    for (int i = 0; i < POINTS; i++) {
        t[i] = time_at(i);
        p[i] = two(q, t[i]) + (noise > 0.0 ? gsl_ran_gaussian(random, noise) : 0.0);
    }
    if (!gb_fit_decay(&fit, t, p, POINTS, &err)) {
        g_error("%s", err.text);
    }
    return fit;
}

static void expect_near(const struct gb_fit_value *value, double truth, double share)
{
    g_assert_cmpfloat_with_epsilon(value->value, truth, share * fabs(truth));
    g_assert_cmpfloat(value->low, <=, value->high);
}

static void test_exact(void)
{
    const double slow[5] = {2868.6, 30.0, 0.5, -12.0, 9.0};
    const double *const cases[] = {table, slow};
    for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
        const double *q = cases[i];
        const struct gb_fit_decay fit = fit_of(q, 0.0, NULL);
        g_assert_cmpint(fit.terms, ==, 2);
        g_assert_cmpint(fit.reason, ==, GB_FIT_FULL);
        expect_near(&fit.p0, q[0], 1e-7);
        for (int k = 0; k < 2; k++) {
            expect_near(&fit.amplitude[k], q[1 + 2 * k], 1e-5);
            expect_near(&fit.tau[k], q[2 + 2 * k], 1e-5);
        }
        g_assert_cmpfloat_with_epsilon(gb_fit_decay_at(&fit, 1.0), two(q, 1.0), 1e-5);
    }
}

static int covers(const struct gb_fit_value *value, double truth)
{
    return value->low <= truth && truth <= value->high;
}

/* The intervals contain the true value with their nominal probability. */
static void test_coverage(void)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    int covered[5] = {0};
    for (int sample = 0; sample < SAMPLES; sample++) {
        gsl_rng_set(random, (unsigned long)sample + 1);
        const struct gb_fit_decay fit = fit_of(table, 3.0, random);
        g_assert_cmpint(fit.terms, ==, 2);
        g_assert_cmpfloat(fit.tau[0].value, <, fit.tau[1].value);
        g_assert_cmpint(fit.degrees, ==, POINTS - 5);
        g_assert_cmpfloat_with_epsilon(fit.scatter, 3.0, 0.5);
        covered[0] += covers(&fit.p0, table[0]);
        for (int k = 0; k < 2; k++) {
            covered[1 + 2 * k] += covers(&fit.amplitude[k], table[1 + 2 * k]);
            covered[2 + 2 * k] += covers(&fit.tau[k], table[2 + 2 * k]);
        }
    }
    for (int k = 0; k < 5; k++) {
        const double share = (double)covered[k] / SAMPLES;
        g_test_message("parameter %d: %.3f", k, share);
        g_assert_cmpfloat(share, >=, 0.88);
    }
    gsl_rng_free(random);
}

/* Correlated points, as in a simulation.  Taken as independent they
 * would make intervals a third as wide as they are. */
static void test_correlated(void)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    int covered[5] = {0};
    for (int sample = 0; sample < SAMPLES; sample++) {
        double t[POINTS], p[POINTS];
        double noise = 0.0;
        struct gb_fit_decay fit;
        struct gb_error err = {0};
        gsl_rng_set(random, (unsigned long)sample + 1);
        for (int i = 0; i < POINTS; i++) {
            noise = 0.8 * noise + gsl_ran_gaussian(random, 0.6);
            t[i] = time_at(i);
            p[i] = two(table, t[i]) + noise;
        }
        g_assert_true(gb_fit_decay(&fit, t, p, POINTS, &err));
        g_assert_cmpint(fit.terms, ==, 2);
        g_assert_cmpfloat(fit.correlation, >, 3.0);
        covered[0] += covers(&fit.p0, table[0]);
        for (int k = 0; k < 2; k++) {
            covered[1 + 2 * k] += covers(&fit.amplitude[k], table[1 + 2 * k]);
            covered[2 + 2 * k] += covers(&fit.tau[k], table[2 + 2 * k]);
        }
    }
    for (int k = 0; k < 5; k++) {
        g_test_message("parameter %d: %.3f", k, (double)covered[k] / SAMPLES);
        g_assert_cmpfloat((double)covered[k] / SAMPLES, >=, 0.85);
    }
    gsl_rng_free(random);
}

/* How often `terms` exponentials are found. */
static double share_with(const double q[5], double noise, int terms)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    int found = 0;
    for (int sample = 0; sample < SAMPLES; sample++) {
        gsl_rng_set(random, (unsigned long)sample + 1000);
        const struct gb_fit_decay fit = fit_of(q, noise, random);
        found += fit.terms == terms;
        if (fit.terms < 2) {
            g_assert_cmpint(fit.reason, !=, GB_FIT_FULL);
            g_assert_true(isnan(fit.tau[1].value) && isnan(fit.amplitude[1].low));
        }
    }
    gsl_rng_free(random);
    g_test_message("%d terms: %.3f", terms, (double)found / SAMPLES);
    return (double)found / SAMPLES;
}

/* P2, Table 1: at v5 nothing is left of the fast stage, nor of the slow one. */
static void test_vanishing(void)
{
    const double no_slow[5] = {2603.9, 441.1, 0.0719, 0.0, 4.9304};
    const double no_fast[5] = {2803.2, 0.0, 0.4486, 84.1, 9.2157};
    const double none[5] = {2868.6, 0.0, 1.0, 0.0, 2.0};
    g_assert_cmpfloat(share_with(no_slow, 3.0, 1), >, 0.93);
    g_assert_cmpfloat(share_with(no_fast, 3.0, 1), >, 0.93);
    g_assert_cmpfloat(share_with(none, 3.0, 0), >, 0.93);
    const double flat[5] = {2868.6, 0.0, 1.0, 0.0, 2.0};
    const struct gb_fit_decay exact = fit_of(flat, 0.0, NULL);
    g_assert_cmpint(exact.terms, ==, 0);
    g_assert_cmpfloat_with_epsilon(exact.p0.value, 2868.6, 1e-6);
    const struct gb_fit_decay one = fit_of(no_slow, 0.0, NULL);
    g_assert_cmpint(one.terms, ==, 1);
    expect_near(&one.tau[0], 0.0719, 1e-6);
}

static void refuse_decay(const double *t, const double *p, size_t count, const char *said)
{
    struct gb_fit_decay fit;
    struct gb_error err = {0};
    g_assert_false(gb_fit_decay(&fit, t, p, count, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    g_test_message("%s", err.text);
    g_assert_nonnull(strstr(err.text, said));
}

static void test_decay_input(void)
{
    double t[10], p[10];
    for (int i = 0; i < 10; i++) {
        t[i] = i;
        p[i] = 100.0 + i % 3;
    }
    refuse_decay(t, p, 0, "0 points");
    refuse_decay(t, p, 7, "7 points");
    t[9] = NAN;
    refuse_decay(t, p, 10, "point 10 of the relaxation is not");
    t[9] = -1.0;
    refuse_decay(t, p, 10, "before its beginning");
    t[9] = 9.0;
    p[0] = INFINITY;
    refuse_decay(t, p, 10, "point 1 ");
    p[0] = 1.0;
    for (int i = 0; i < 5; i++) {
        t[i] = 0.0;
    }
    refuse_decay(t, p, 10, "6 different times");
}

/* Shapes that are no sum of exponentials end in an answer or an error, never in a NaN. */
static void test_odd_shapes(void)
{
    double t[200], p[200];
    for (int shape = 0; shape < 6; shape++) {
        for (int i = 0; i < 200; i++) {
            t[i] = 0.1 * i;
            const double x = t[i];
            const double shapes[] = {x,           x * x,    sin(x),
                                     pow(x, 0.1), i == 100, 1e300 * exp(-x)};
            p[i] = shapes[shape];
        }
        struct gb_fit_decay fit;
        struct gb_error err = {0};
        const bool good = gb_fit_decay(&fit, t, p, 200, &err);
        g_test_message("shape %d: %d terms, reason %d %s", shape, good ? fit.terms : -1,
                       good ? fit.reason : -1, err.text);
        if (good) {
            g_assert_true(isfinite(fit.p0.low) && isfinite(fit.p0.high));
            for (int k = 0; k < fit.terms; k++) {
                g_assert_true(isfinite(fit.tau[k].low) && isfinite(fit.tau[k].high));
            }
        } else {
            g_assert_cmpint(err.code, ==, GB_ERR_NOT_CONVERGED);
        }
    }
}

/* P2 (9) at 0.95: 21.5 v^(1/4) 0.45^3 over the five rates. */
static const double rates[5] = {6.8e4, 6.8e5, 6.8e6, 6.8e7, 6.8e8};
static const double k_true = 21.5 * 0.45 * 0.45 * 0.45;

static void test_power_exact(void)
{
    double p[5], error[5];
    struct gb_power fit;
    struct gb_error err = {0};
    for (int i = 0; i < 5; i++) {
        p[i] = 2800.0 + k_true * pow(rates[i], 0.25);
        error[i] = 5.0 + i;
    }
    for (int given = 0; given < 2; given++) {
        for (size_t count = 3; count <= 5; count++) {
            g_assert_true(
                gb_power_fit(&fit, rates, p, given ? error : NULL, count, &err));
            g_assert_cmpint(fit.degrees, ==, (int)count - 3);
            g_assert_cmpfloat_with_epsilon(fit.n.value, 0.25, 1e-6);
            g_assert_cmpfloat_with_epsilon(fit.a.value, 2800.0, 1e-2);
            g_assert_cmpfloat_with_epsilon(fit.k.value, k_true, 1e-4 * k_true);
            g_assert_true(isnan(fit.n.low) == (!given && count == 3));
            g_assert_true(!given || covers(&fit.n, 0.25));
        }
    }
}

static void test_power_coverage(void)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    int covered[4] = {0};
    for (int sample = 0; sample < SAMPLES; sample++) {
        double p[5], error[5];
        struct gb_power_point points[15];
        struct gb_error err = {0};
        gsl_rng_set(random, (unsigned long)sample + 1);
        for (int i = 0; i < 5; i++) {
            error[i] = 4.0;
            p[i] = 2800.0 + k_true * pow(rates[i], 0.25) +
                   gsl_ran_gaussian(random, error[i]);
        }
        for (int i = 0; i < 15; i++) {
            const double rho = 0.75 + 0.1 * (i / 5);
            points[i] = (struct gb_power_point){
                rates[i % 5], rho,
                1000.0 * rho + 21.5 * pow(rates[i % 5], 0.25) * pow(rho - 0.5, 3.0) +
                    gsl_ran_gaussian(random, 4.0),
                4.0};
        }
        struct gb_power fit;
        struct gb_power_rate rate;
        struct gb_fit_value exponent;
        const struct gb_power_law law = {0.25, 3.0, 0.5};
        g_assert_true(gb_power_fit(&fit, rates, p, error, 5, &err));
        g_assert_true(gb_power_rate(&rate, &law, points, 15, &err));
        g_assert_true(gb_power_exponent(&exponent, &law, points, 15, &err));
        g_assert_cmpint(rate.degrees, ==, 11);
        covered[0] += covers(&fit.n, 0.25);
        covered[1] += covers(&fit.a, 2800.0);
        covered[2] += covers(&rate.k_v, 21.5);
        covered[3] += covers(&exponent, 0.25);
    }
    for (int k = 0; k < 4; k++) {
        const double share = (double)covered[k] / SAMPLES;
        g_test_message("value %d: %.3f", k, share);
        g_assert_cmpfloat(share, >=, 0.88);
    }
    gsl_rng_free(random);
}

static void test_power_input(void)
{
    const double p[4] = {1.0, 2.0, 3.0, 4.0};
    const double few[4] = {1.0, 1.0, 2.0, 2.0};
    const double bad[4] = {1.0, 0.0, 2.0, 3.0};
    const double zero[4] = {1.0, 1.0, 0.0, 1.0};
    const double exponential[4] = {1.0, 10.0, 100.0, 1000.0};
    struct gb_power fit;
    struct gb_error err = {0};
    g_assert_false(gb_power_fit(&fit, few, p, NULL, 4, &err));
    g_assert_nonnull(strstr(err.text, "2 different rates"));
    g_assert_false(gb_power_fit(&fit, bad, p, NULL, 4, &err));
    g_assert_false(gb_power_fit(&fit, rates, p, zero, 4, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    /* equal steps per decade: a logarithm, as the yield strength of metals in P2 */
    g_assert_false(gb_power_fit(&fit, exponential, p, NULL, 4, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_NOT_CONVERGED);
    g_assert_nonnull(strstr(err.text, "logarithm"));

    const struct gb_power_law law = {0.25, 3.0, 0.5};
    const struct gb_power_point lone[2] = {{1e5, 0.8, 1.0, 0.0}, {1e6, 0.9, 2.0, 0.0}};
    const struct gb_power_point mixed[2] = {{1e5, 0.8, 1.0, 0.0}, {1e6, 0.8, 2.0, 1.0}};
    const struct gb_power_point loose[1] = {{1e5, 0.4, 1.0, 0.0}};
    struct gb_power_rate rate;
    g_assert_false(gb_power_rate(&rate, &law, lone, 2, &err));
    g_assert_nonnull(strstr(err.text, "no density with two rates"));
    g_assert_false(gb_power_rate(&rate, &law, mixed, 2, &err));
    g_assert_nonnull(strstr(err.text, "all or none"));
    g_assert_false(gb_power_rate(&rate, &law, loose, 1, &err));
    g_assert_nonnull(strstr(err.text, "a density above 0.5"));
}

/* One exponential: fall and 1/e time are its own.  Two: what is left at that time. */
static void test_efold(void)
{
    struct gb_fit_decay fit = {.terms = 1, .p0.value = 10.0};
    fit.amplitude[0].value = 5.0;
    fit.tau[0].value = 0.25;
    g_assert_cmpfloat_with_epsilon(gb_fit_decay_fall(&fit), 5.0, 1e-15);
    g_assert_cmpfloat_with_epsilon(gb_fit_decay_efold(&fit), 0.25, 1e-14);
    fit.terms = 2;
    fit.amplitude[1].value = 3.0;
    fit.tau[1].value = 4.0;
    const double left = gb_fit_decay_at(&fit, gb_fit_decay_efold(&fit)) - 10.0;
    g_assert_cmpfloat_with_epsilon(left, 8.0 / M_E, 1e-12);
    fit.terms = 0;
    g_assert_true(isnan(gb_fit_decay_fall(&fit)));
    g_assert_true(isnan(gb_fit_decay_efold(&fit)));
    fit.terms = 1;
    fit.amplitude[0].value = -5.0; /* rises */
    g_assert_true(isnan(gb_fit_decay_efold(&fit)));
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    gsl_set_error_handler_off();
    g_test_add_func("/fit/exact", test_exact);
    g_test_add_func("/fit/coverage", test_coverage);
    g_test_add_func("/fit/correlated", test_correlated);
    g_test_add_func("/fit/vanishing", test_vanishing);
    g_test_add_func("/fit/input", test_decay_input);
    g_test_add_func("/fit/odd-shapes", test_odd_shapes);
    g_test_add_func("/power/exact", test_power_exact);
    g_test_add_func("/power/coverage", test_power_coverage);
    g_test_add_func("/power/input", test_power_input);
    g_test_add_func("/fit/efold", test_efold);
    return g_test_run();
}
