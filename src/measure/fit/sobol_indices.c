#include "measure/fit/sobol_indices.h"

#include <math.h>

#include "base/alloc.h"
#include "measure/fit/average.h"

enum {
    VARIABLES = GB_SURROGATE_VARIABLES,
    TERMS = GB_SURROGATE_TERMS,
    JACKKNIFE_MIN = 3
};

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
    gb_surrogate_value(&surrogate, work->at + point * work->variables, &fitted);
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

bool gb_sobol_indices_fit(struct gb_sobol_indices *indices, size_t variables,
                          size_t points, size_t seeds, const double *at,
                          const double *value, struct gb_error *err)
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
