#include "measure/fit/weibull.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>
#include <math.h>

enum { ITERATIONS = 200 };

/* Moduli that are looked for. */
static const double modulus_min = 1e-3, modulus_max = 1e5;

struct sample {
    const double *value;
    size_t count;
    double mean_log; /* of the values over the largest one */
    double largest, level;
};

/* Mean of x^m and of x^m ln x, x the value over the largest one. */
static void moments(const struct sample *sample, double m, double *power,
                    double *weighted)
{
    *power = *weighted = 0.0;
    for (size_t i = 0; i < sample->count; i++) {
        const double log_x = log(sample->value[i] / sample->largest);
        *power += exp(m * log_x) / (double)sample->count;
        *weighted += exp(m * log_x) * log_x / (double)sample->count;
    }
}

/* Derivative of the profile likelihood per value. */
static double slope(double m, void *data)
{
    const struct sample *sample = data;
    double power, weighted;
    moments(sample, m, &power, &weighted);
    return 1.0 / m + sample->mean_log - weighted / power;
}

/* Logarithm of the likelihood, the scale at its best, less the level. */
static double profile(double m, void *data)
{
    const struct sample *sample = data;
    double power, weighted;
    moments(sample, m, &power, &weighted);
    return (double)sample->count * (log(m) - log(power) + (m - 1.0) * sample->mean_log) -
           sample->level;
}

/* Root between two moduli at which the function has two signs. */
static bool find_root(double (*function)(double m, void *data), struct sample *sample,
                      double low, double high, double *root)
{
    gsl_function f = {function, sample};
    gsl_root_fsolver *solver = gsl_root_fsolver_alloc(gsl_root_fsolver_brent);
    bool good =
        solver != NULL && gsl_root_fsolver_set(solver, &f, low, high) == GSL_SUCCESS;
    int status = GSL_CONTINUE;
    for (int i = 0; good && status == GSL_CONTINUE && i < ITERATIONS; i++) {
        good = gsl_root_fsolver_iterate(solver) == GSL_SUCCESS;
        status = gsl_root_test_interval(gsl_root_fsolver_x_lower(solver),
                                        gsl_root_fsolver_x_upper(solver), 0.0, 1e-10);
    }
    if (good) {
        *root = gsl_root_fsolver_root(solver);
    }
    gsl_root_fsolver_free(solver);
    return good && status == GSL_SUCCESS;
}

static bool find_all(struct gb_weibull *law, struct sample *sample)
{
    if (!find_root(slope, sample, modulus_min, modulus_max, &law->modulus)) {
        return false;
    }
    double power, weighted;
    moments(sample, law->modulus, &power, &weighted);
    law->scale = sample->largest * pow(power, 1.0 / law->modulus);
    sample->level = 0.0;
    sample->level = profile(law->modulus, sample) - 0.5 * gsl_cdf_chisq_Pinv(0.95, 1.0);
    return find_root(profile, sample, modulus_min, law->modulus, &law->modulus_low) &&
           find_root(profile, sample, law->modulus, modulus_max, &law->modulus_high);
}

bool gb_weibull_fit(struct gb_weibull *law, const double *value, size_t count,
                    struct gb_error *err)
{
    struct sample sample = {.value = value, .count = count};
    double least = INFINITY;
    for (size_t i = 0; i < count; i++) {
        sample.largest = fmax(sample.largest, value[i]);
        least = fmin(least, value[i]);
    }
    if (count < 3 || !(least > 0.0) || !(sample.largest > least) ||
        !isfinite(sample.largest)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "Weibull's law needs 3 or more different strengths above 0");
    }
    for (size_t i = 0; i < count; i++) {
        sample.mean_log += log(value[i] / sample.largest) / (double)count;
    }
    gsl_error_handler_t *handler = gsl_set_error_handler_off();
    const bool good = find_all(law, &sample);
    gsl_set_error_handler(handler);
    return good || gb_error_set(err, GB_ERR_NOT_CONVERGED,
                                "Weibull's law: no modulus between %g and %g is best",
                                modulus_min, modulus_max);
}
