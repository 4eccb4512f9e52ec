#include <gsl/gsl_errno.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <glib.h>

#include "study/calibration.h"

/* Calibration on a stand-in for the engine: compaction curves that friction stiffens and
 * adhesion hinders at low pressure, cells that scatter as those of the engine do. */

enum { DATA = 12, REPLICAS = 4, TRIALS = 20 };

static const double true_mu = 0.13;
static const double true_alpha = 0.37;
static const double measured_error = 0.002;
static const double cell_scatter = 0.004;   /* of a cell as a whole */
static const double chaos_scatter = 0.0007; /* that no seed keeps */

struct bench {
    uint64_t seed; /* of the trial */
    double fail;   /* share of runs that fail */
    bool twins;    /* only mu + alpha matters */
    size_t calls;
};

static double pressure(size_t i)
{
    return 20.0 * pow(1.3, (double)i); /* 20 to 360 MPa */
}

static double density(double mu, double alpha, double mpa, bool twins)
{
    const double friction = twins ? mu + alpha - true_alpha : mu;
    const double gap = twins ? true_alpha : alpha;
    return 0.30 + 0.045 * log(mpa) - 0.16 * pow(friction, 0.7) * (1.0 - mpa / 900.0) -
           0.05 / (gap + 0.1) * exp(-mpa / 120.0);
}

/* Numbers that depend on nothing but their names. */
static double normal(uint64_t a, uint64_t b, double c, double d)
{
    uint64_t bits[4] = {a, b, 0, 0};
    memcpy(&bits[2], &c, sizeof c);
    memcpy(&bits[3], &d, sizeof d);
    unsigned long hash = 1469598103934665603UL;
    for (size_t i = 0; i < sizeof bits; i++) {
        hash = (hash ^ ((const unsigned char *)bits)[i]) * 1099511628211UL;
    }
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(rng, hash ^ (hash >> 32));
    const double value = gsl_ran_gaussian(rng, 1.0);
    gsl_rng_free(rng);
    return value;
}

/* Small cells are off by half a point, and scatter twice as much. */
static bool simulate(const double *parameters, size_t points,
                     enum gb_calibrate_stage stage, double *out, void *context,
                     struct gb_error *err)
{
    struct bench *bench = context;
    (void)err;
    for (size_t p = 0; p < points; p++) {
        const double mu = parameters[2 * p];
        const double alpha = parameters[2 * p + 1];
        g_assert_true(mu >= 0.0 && mu <= 1.0 && alpha >= 0.05 && alpha <= 2.0);
        for (size_t r = 0; r < REPLICAS; r++) {
            const uint64_t cell = 1000 * bench->seed + 10 * (uint64_t)r + (uint64_t)stage;
            const double scale = stage == GB_CALIBRATE_COARSE ? 2.0 : 1.0;
            double *to = out + (p * REPLICAS + r) * DATA;
            const bool fails = fabs(normal(cell, 7, mu, alpha)) < 1.2 * bench->fail;
            for (size_t i = 0; i < DATA; i++) {
                to[i] = fails ? (double)NAN
                              : density(mu, alpha, pressure(i), bench->twins) +
                                    (stage == GB_CALIBRATE_COARSE ? 0.005 : 0.0) +
                                    scale * cell_scatter * normal(cell, 1, 0.0, 0.0) +
                                    scale * chaos_scatter * normal(cell, i, mu, alpha);
            }
        }
        bench->calls++;
    }
    return true;
}

static struct gb_calibrate_problem problem_of(struct bench *bench, double *value,
                                              double *error)
{
    for (size_t i = 0; i < DATA; i++) {
        value[i] = density(true_mu, true_alpha, pressure(i), false) +
                   measured_error * normal(bench->seed, 99, (double)i, 0.0);
        error[i] = measured_error;
    }
    return (struct gb_calibrate_problem){.free = 2,
                                         .low = {0.0, 0.05},
                                         .high = {1.0, 2.0},
                                         .from = {0.1, 0.12},
                                         .to = {0.4, 0.48},
                                         .data = DATA,
                                         .value = value,
                                         .error = error,
                                         .replicas = REPLICAS,
                                         .coarse_stage = true,
                                         .simulate = simulate,
                                         .context = bench};
}

static struct gb_calibrate_result fit(const struct gb_calibrate_problem *problem)
{
    struct gb_calibrate_result result;
    struct gb_error err = {0};
    if (!gb_calibration_search(problem, &result, &err)) {
        g_error("%s", err.text);
    }
    return result;
}

static int trials(void)
{
    const char *more = g_getenv("GB_TEST_TRIALS");
    return more ? atoi(more) : TRIALS;
}

/* Known mu and alpha lie in their 95 % intervals as often as they should. */
static void recover(bool errors_known)
{
    int hits[2] = {0, 0};
    const int count = trials();
    for (int t = 0; t < count; t++) {
        struct bench bench = {.seed = (uint64_t)t + 1};
        double value[DATA], error[DATA];
        struct gb_calibrate_problem problem = problem_of(&bench, value, error);
        problem.error = errors_known ? error : NULL;
        struct gb_calibrate_result result = fit(&problem);
        g_test_message("mu %.4f +- %.4f, alpha %.4f +- %.4f, correlation %.2f, %zu runs",
                       result.value[0], result.error[0], result.value[1], result.error[1],
                       result.correlation[0][1], result.simulated);
        hits[0] += result.low[0] <= true_mu && true_mu <= result.high[0];
        hits[1] += result.low[1] <= true_alpha && true_alpha <= result.high[1];
        /* an interval that says nothing would always hit */
        g_assert_cmpfloat(result.high[0] - result.low[0], <, 0.3);
        g_assert_cmpfloat(result.high[1] - result.low[1], <, 0.4);
        g_assert_false(gb_calibration_confounded(&result, 0, 1));
        g_assert_cmpuint(result.failed, ==, 0);
        gb_calibration_result_finish(&result);
    }
    g_test_message("%d and %d of %d", hits[0], hits[1], count);
    g_assert_cmpint(10 * hits[0], >=, 9 * count);
    g_assert_cmpint(10 * hits[1], >=, 9 * count);
}

static void test_recover(void)
{
    recover(true);
}

static void test_recover_scatter(void)
{
    recover(false);
}

/* Without any noise the fit is exact, and says so. */
static bool simulate_exactly(const double *parameters, size_t points,
                             enum gb_calibrate_stage stage, double *out, void *context,
                             struct gb_error *err)
{
    (void)stage;
    (void)context;
    (void)err;
    for (size_t p = 0; p < points; p++) {
        for (size_t k = 0; k < REPLICAS * DATA; k++) {
            out[p * REPLICAS * DATA + k] = density(
                parameters[2 * p], parameters[2 * p + 1], pressure(k % DATA), false);
        }
    }
    return true;
}

static void test_exact(void)
{
    struct bench bench = {.seed = 1};
    double value[DATA], error[DATA];
    struct gb_calibrate_problem problem = problem_of(&bench, value, error);
    for (size_t i = 0; i < DATA; i++) {
        value[i] = density(true_mu, true_alpha, pressure(i), false);
        error[i] = 1e-5;
    }
    problem.simulate = simulate_exactly;
    struct gb_calibrate_result result = fit(&problem);
    g_assert_true(result.converged);
    g_assert_cmpfloat_with_epsilon(result.value[0], true_mu, 2e-4);
    g_assert_cmpfloat_with_epsilon(result.value[1], true_alpha, 2e-3);
    g_assert_cmpfloat(result.error[0], <, 1e-3);
    g_assert_cmpfloat(result.rms, <, 1e-5);
    gb_calibration_result_finish(&result);
}

/* Runs that fail are left out; the fit is still right. */
static void test_failures(void)
{
    struct bench bench = {.seed = 5, .fail = 0.15};
    double value[DATA], error[DATA];
    struct gb_calibrate_problem problem = problem_of(&bench, value, error);
    struct gb_calibrate_result result = fit(&problem);
    g_assert_cmpuint(result.failed, >, result.simulated / 20);
    g_assert_cmpfloat(fabs(result.value[0] - true_mu), <, 4.0 * result.error[0]);
    g_assert_cmpfloat(fabs(result.value[1] - true_alpha), <, 4.0 * result.error[1]);
    gb_calibration_result_finish(&result);
    struct gb_error err = {0};
    bench.fail = 1e9;
    g_assert_false(gb_calibration_search(&problem, &result, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_GUARD);
}

/* Two parameters of which only the sum matters are reported, with wide intervals. */
static void test_confused(void)
{
    struct bench bench = {.seed = 3, .twins = true};
    double value[DATA], error[DATA];
    struct gb_calibrate_problem problem = problem_of(&bench, value, error);
    struct gb_calibrate_result result = fit(&problem);
    g_assert_true(gb_calibration_confounded(&result, 0, 1));
    g_assert_cmpfloat(result.correlation[0][1], <, -0.97);
    g_assert_cmpfloat(result.high[0] - result.low[0], >, 0.2);
    gb_calibration_result_finish(&result);
}

/* Equal weights change nothing, errors included; of data that contradict each other those
 * of more weight are met better. */
static void test_weights(void)
{
    struct bench bench = {.seed = 4};
    double value[DATA], error[DATA], equal[DATA], first[DATA];
    struct gb_calibrate_problem problem = problem_of(&bench, value, error);
    for (size_t i = 0; i < DATA; i++) {
        equal[i] = 5.0;
        first[i] = i < DATA / 2 ? 100.0 : 1.0;
        value[i] += i < DATA / 2 ? 0.02 : -0.02;
    }
    struct gb_calibrate_result plain = fit(&problem);
    problem.weight = equal;
    struct gb_calibrate_result scaled = fit(&problem);
    problem.weight = first;
    struct gb_calibrate_result weighted = fit(&problem);
    for (size_t k = 0; k < 2; k++) {
        g_assert_cmpfloat_with_epsilon(plain.value[k], scaled.value[k], 1e-4);
        g_assert_cmpfloat_with_epsilon(plain.error[k], scaled.error[k],
                                       1e-3 * plain.error[k]);
    }
    g_assert_cmpfloat_with_epsilon(plain.chi_squared, scaled.chi_squared,
                                   1e-3 * plain.chi_squared);
    double off[2][2] = {{0.0}};
    for (size_t i = 0; i < DATA; i++) {
        off[0][i >= DATA / 2] += fabs(plain.fitted[i] - value[i]);
        off[1][i >= DATA / 2] += fabs(weighted.fitted[i] - value[i]);
    }
    g_assert_cmpfloat(off[1][0], <, 0.7 * off[0][0]);
    g_assert_cmpfloat(off[1][1], >, off[0][1]);
    gb_calibration_result_finish(&plain);
    gb_calibration_result_finish(&scaled);
    gb_calibration_result_finish(&weighted);
}

/* The best value lies beyond what is allowed. */
static void test_limit(void)
{
    struct bench bench = {.seed = 2};
    double value[DATA], error[DATA];
    struct gb_calibrate_problem problem = problem_of(&bench, value, error);
    problem.low[0] = problem.from[0] = 0.2;
    struct gb_calibrate_result result = fit(&problem);
    g_assert_true(result.at_limit[0]);
    g_assert_cmpfloat_with_epsilon(result.value[0], 0.2, 1e-3);
    gb_calibration_result_finish(&result);
}

/* Intervals stay within the range of a key, and say where they end at its limit.  Data
 * from exact to worthless, ranges wide and narrow. */
static void test_range(void)
{
    static const double scale[] = {1.0, 10.0, 100.0};
    static const double ranges[][2] = {
        {0.0, 1.0}, {0.02, 0.4}, {0.2, 0.3}, {0.05, true_mu}, {0.3, 0.8}};
    for (size_t s = 0; s < G_N_ELEMENTS(scale); s++) {
        for (size_t r = 0; r < G_N_ELEMENTS(ranges); r++) {
            struct bench bench = {.seed = 11 + r};
            double value[DATA], error[DATA];
            struct gb_calibrate_problem problem = problem_of(&bench, value, error);
            for (size_t i = 0; i < DATA; i++) {
                value[i] += (scale[s] - 1.0) * measured_error *
                            normal(bench.seed, 98, (double)i, scale[s]);
                error[i] *= scale[s];
            }
            problem.low[0] = problem.from[0] = ranges[r][0];
            problem.high[0] = problem.to[0] = ranges[r][1];
            struct gb_calibrate_result result = fit(&problem);
            for (size_t k = 0; k < 2; k++) {
                const double low = result.low[k];
                const double high = result.high[k];
                g_test_message("errors %g, range %g to %g: %g (%g to %g)%s%s", scale[s],
                               problem.low[k], problem.high[k], result.value[k], low,
                               high, result.low_open[k] ? " low" : "",
                               result.high_open[k] ? " high" : "");
                g_assert_cmpfloat(low, >=, problem.low[k]);
                g_assert_cmpfloat(high, <=, problem.high[k]);
                g_assert_cmpfloat(low, <=, result.value[k]);
                g_assert_cmpfloat(high, >=, result.value[k]);
                g_assert_cmpfloat(high, >, low);
                g_assert_true(low > problem.low[k] || result.low_open[k]);
                g_assert_true(high < problem.high[k] || result.high_open[k]);
            }
            if (s == 2 && r == 2) { /* nothing is known of mu */
                g_assert_true(result.low_open[0] && result.high_open[0]);
            }
            gb_calibration_result_finish(&result);
        }
    }
}

static void test_refuse(void)
{
    struct bench bench = {.seed = 2};
    double value[DATA], error[DATA];
    struct gb_calibrate_problem problem = problem_of(&bench, value, error);
    struct gb_calibrate_result result;
    struct gb_error err = {0};
    problem.data = 1;
    g_assert_false(gb_calibration_search(&problem, &result, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    problem.data = 2;
    problem.error = NULL;
    g_assert_false(gb_calibration_search(&problem, &result, &err));
    problem.data = DATA;
    problem.replicas = 2;
    g_assert_false(gb_calibration_search(&problem, &result, &err));
    g_assert_cmpuint(bench.calls, ==, 0);
}

/* A value stays whole beside an error that is larger, and an open end is named. */
static void test_text(void)
{
    static const struct {
        double value, error;
        const char *text;
    } rows[] = {
        {0.4, 15.4, "contact.mu = 0.4 +- 15, 95 %: "},
        {0.05, 0.12, "contact.mu = 0.05 +- 0.12, 95 %: "},
        {0.40621, 0.00651, "contact.mu = 0.4062 +- 0.0065, 95 %: "},
        {0.40621, 0.22, "contact.mu = 0.41 +- 0.22, 95 %: "},
    };
    struct gb_params params;
    struct gb_error err = {0};
    struct gb_calibration calibration = {0};
    gb_params_init(&params);
    g_assert_true(gb_calibration_keys(&calibration.keys, "mu=0.05:0.5", &params, &err));
    for (size_t k = 0; k < G_N_ELEMENTS(rows); k++) {
        calibration.result.value[0] = rows[k].value;
        calibration.result.error[0] = rows[k].error;
        GString *text = gb_calibration_text(&calibration);
        g_test_message("%s", text->str);
        g_assert_true(g_str_has_prefix(text->str, rows[k].text));
        g_assert_null(strstr(text->str, "leave the interval open"));
        g_string_free(text, TRUE);
        calibration.result.high_open[0] = true;
        text = gb_calibration_text(&calibration);
        g_assert_nonnull(strstr(text->str, "upper limit of the range 0.05 to 0.5"));
        calibration.result.high_open[0] = false;
        g_string_free(text, TRUE);
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    gsl_set_error_handler_off();
    g_test_add_func("/calibrate/exact", test_exact);
    g_test_add_func("/calibrate/recover", test_recover);
    g_test_add_func("/calibrate/recover-scatter", test_recover_scatter);
    g_test_add_func("/calibrate/failures", test_failures);
    g_test_add_func("/calibrate/confused", test_confused);
    g_test_add_func("/calibrate/limit", test_limit);
    g_test_add_func("/calibrate/range", test_range);
    g_test_add_func("/calibrate/weights", test_weights);
    g_test_add_func("/calibrate/refuse", test_refuse);
    g_test_add_func("/calibrate/text", test_text);
    return g_test_run();
}
