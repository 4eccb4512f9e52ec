/* Laws of random quantities: the log-normal law of sizes, and the Weibull law of strengths. */
#include "measure/distribution.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_multimin.h>
#include <gsl/gsl_roots.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"

enum { ITERATIONS = 2000, CLASSES_LEAST = 3 };

/* Of m and ln sigma; errors of a fit are far above. */
static const double simplex_end = 1e-6;
/* Step of second differences: large enough for the sum of logarithms to change. */
static const double hessian_step = 1e-3;
/* Least share of a class: the logarithm of 0 would make the likelihood infinite. */
static const double share_least = 1e-300;

/* Least expectation of a class of Pearson's test. */
static const double expected_least = 5.0;

struct histogram {
    const double *middle, *weight;
    size_t count;
    double total;
};

double gb_distribution_share(const struct gb_lognormal *law, double from, double to)
{
    const double low = from > 0.0 ? (log(from) - law->m) / law->sigma : -INFINITY;
    const double high = (log(to) - law->m) / law->sigma;
    /* on the side where the difference of two small numbers is exact */
    return low > 0.0 ? gsl_cdf_ugaussian_Q(low) - gsl_cdf_ugaussian_Q(high)
                     : gsl_cdf_ugaussian_P(high) - gsl_cdf_ugaussian_P(low);
}

/* Lower border of class i; i = count is the upper border of the last one. */
static double border(const struct histogram *from, size_t i)
{
    const double *x = from->middle;
    const size_t last = from->count - 1;
    if (i == 0) {
        return fmax(0.0, x[0] - (x[1] - x[0]) / 2.0);
    }
    return i > last ? x[last] + (x[last] - x[last - 1]) / 2.0 : (x[i - 1] + x[i]) / 2.0;
}

/* Minus the logarithm of the likelihood. */
static double misfit(const struct histogram *histogram, double m, double ln_sigma)
{
    const struct gb_lognormal law = {.m = m, .sigma = exp(ln_sigma)};
    double sum = 0.0;
    for (size_t i = 0; i < histogram->count; i++) {
        if (histogram->weight[i] > 0.0) {
            const double share = gb_distribution_share(&law, border(histogram, i),
                                                       border(histogram, i + 1));
            sum -= histogram->weight[i] * log(fmax(share, share_least));
        }
    }
    return sum;
}

static double minimised(const gsl_vector *x, void *data)
{
    return misfit(data, gsl_vector_get(x, 0), gsl_vector_get(x, 1));
}

static bool check(struct histogram *histogram, struct gb_error *err)
{
    size_t filled = 0;
    bool good = true;
    for (size_t i = 0; i < histogram->count; i++) {
        const double x = histogram->middle[i];
        const double w = histogram->weight[i];
        good = good && isfinite(x) && x > 0.0 && isfinite(w) && w >= 0.0 &&
               (i == 0 || x > histogram->middle[i - 1]);
        filled += w > 0.0;
        histogram->total += w;
    }
    return (good && filled >= CLASSES_LEAST) ||
           gb_error_set(err, GB_ERR_INPUT,
                        "size histogram: sizes must be above 0 and ascending, counts not "
                        "negative, and at least %d classes not empty",
                        CLASSES_LEAST);
}

/* Mean and deviation of ln x with every particle at the middle of its class. */
static void first_estimate(const struct histogram *histogram, gsl_vector *x)
{
    double mean = 0.0;
    double square = 0.0;
    for (size_t i = 0; i < histogram->count; i++) {
        mean += histogram->weight[i] / histogram->total * log(histogram->middle[i]);
    }
    for (size_t i = 0; i < histogram->count; i++) {
        const double off = log(histogram->middle[i]) - mean;
        square += histogram->weight[i] / histogram->total * off * off;
    }
    gsl_vector_set(x, 0, mean);
    gsl_vector_set(x, 1, 0.5 * log(square));
}

static bool minimise(struct histogram *histogram, struct gb_lognormal *law,
                     struct gb_error *err)
{
    gsl_multimin_function function = {minimised, 2, histogram};
    gsl_multimin_fminimizer *solver =
        gsl_multimin_fminimizer_alloc(gsl_multimin_fminimizer_nmsimplex2, 2);
    gsl_vector *start = gsl_vector_alloc(2);
    gsl_vector *size = gsl_vector_alloc(2);
    int status = GSL_ENOMEM;
    if (solver != NULL && start != NULL && size != NULL) {
        first_estimate(histogram, start);
        gsl_vector_set_all(size, 0.1);
        gsl_multimin_fminimizer_set(solver, &function, start, size);
        status = GSL_CONTINUE;
        for (int i = 0; i < ITERATIONS && status == GSL_CONTINUE; i++) {
            status = gsl_multimin_fminimizer_iterate(solver);
            if (status == GSL_SUCCESS) {
                status = gsl_multimin_test_size(gsl_multimin_fminimizer_size(solver),
                                                simplex_end);
            }
        }
        law->m = gsl_vector_get(gsl_multimin_fminimizer_x(solver), 0);
        law->sigma = exp(gsl_vector_get(gsl_multimin_fminimizer_x(solver), 1));
    }
    if (solver != NULL) {
        gsl_multimin_fminimizer_free(solver);
    }
    gsl_vector_free(start);
    gsl_vector_free(size);
    if (status == GSL_ENOMEM) {
        return gb_error_set(err, GB_ERR_MEMORY, "out of memory for a fit");
    }
    /* no progress: only rounding is left */
    return status == GSL_SUCCESS || status == GSL_ENOPROG ||
           gb_error_set(err, GB_ERR_NOT_CONVERGED,
                        "the fit of the log-normal law did not converge");
}

/* From the curvature of the likelihood. */
static void set_errors(const struct histogram *histogram, struct gb_lognormal *law)
{
    const double m = law->m;
    const double s = log(law->sigma);
    const double h = hessian_step * law->sigma;
    const double k = hessian_step;
    const double here = misfit(histogram, m, s);
    const double mm =
        (misfit(histogram, m + h, s) + misfit(histogram, m - h, s) - 2.0 * here) /
        (h * h);
    const double ss =
        (misfit(histogram, m, s + k) + misfit(histogram, m, s - k) - 2.0 * here) /
        (k * k);
    const double ms =
        (misfit(histogram, m + h, s + k) - misfit(histogram, m + h, s - k) -
         misfit(histogram, m - h, s + k) + misfit(histogram, m - h, s - k)) /
        (4.0 * h * k);
    const double determinant = mm * ss - ms * ms;
    if (determinant > 0.0 && mm > 0.0) {
        law->m_error = sqrt(ss / determinant);
        law->sigma_error = law->sigma * sqrt(mm / determinant);
        law->correlation = -ms / sqrt(mm * ss);
    }
}

/* Pearson's test over merged classes.  A rest with less than the least expectation joins
 * the class before it. */
static void set_chi_squared(const struct histogram *histogram, struct gb_lognormal *law)
{
    double sum = 0.0, last = 0.0, observed = 0.0, expected = 0.0;
    double last_observed = 0.0, last_expected = 0.0;
    size_t classes = 0;
    for (size_t i = 0; i < histogram->count; i++) {
        const double from = i > 0 ? border(histogram, i) : 0.0;
        const double to = i + 1 < histogram->count ? border(histogram, i + 1) : INFINITY;
        observed += histogram->weight[i];
        expected += histogram->total * gb_distribution_share(law, from, to);
        if (expected >= expected_least) {
            classes++;
            last = (observed - expected) * (observed - expected) / expected;
            sum += last;
            last_observed = observed;
            last_expected = expected;
            observed = expected = 0.0;
        }
    }
    const double off = last_observed + observed - last_expected - expected;
    sum += off * off / (last_expected + expected) - last;
    if (classes > CLASSES_LEAST) {
        law->chi_squared = sum;
        law->degrees = classes - CLASSES_LEAST;
        law->probability = gsl_cdf_chisq_Q(sum, (double)law->degrees);
    }
}

static void set_distance(const struct histogram *histogram, struct gb_lognormal *law)
{
    double below = 0.0;
    for (size_t i = 0; i + 1 < histogram->count; i++) {
        below += histogram->weight[i] / histogram->total;
        const double off =
            below - gb_distribution_share(law, 0.0, border(histogram, i + 1));
        law->distance = fmax(law->distance, fabs(off));
    }
}

bool gb_distribution_lognormal(struct gb_lognormal *law, const double *middle,
                               const double *weight, size_t count,
                               enum gb_lognormal_weight kind, struct gb_error *err)
{
    struct histogram histogram = {middle, weight, count, 0.0};
    *law = (struct gb_lognormal){.m_error = NAN,
                                 .sigma_error = NAN,
                                 .correlation = NAN,
                                 .chi_squared = NAN,
                                 .probability = NAN};
    if (!check(&histogram, err) || !minimise(&histogram, law, err)) {
        return false;
    }
    set_distance(&histogram, law);
    if (kind == GB_LOGNORMAL_PARTICLES) {
        set_errors(&histogram, law);
        set_chi_squared(&histogram, law);
    }
    return true;
}

enum { WEIBULL_ITERATIONS = 200 };

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
    for (int i = 0; good && status == GSL_CONTINUE && i < WEIBULL_ITERATIONS; i++) {
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

bool gb_distribution_weibull(struct gb_weibull *law, const double *value, size_t count,
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
