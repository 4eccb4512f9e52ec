#include "study/calibrate/calibrate.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "measure/fit/estimate.h"
#include "study/calibrate/calibrate_samples.h"

enum {
    FREE = GB_CALIBRATE_FREE,
    ROUNDS_MAX = 8, /* of a stage */
    SEEDS_MIN = 3,  /* with a surrogate, for the noise to be known */
};

/* A fit beyond this fraction of the half width is at the edge of the region. */
static const double edge = 0.9;
/* The region shrinks to this many standard errors: in a smaller one noise hides slopes. */
static const double region_errors = 4.0;
/* It shrinks to no less than this fraction in one round. */
static const double shrink_min = 0.35;
/* Converged: it shrinks by less than this, and moves by less than the second fraction of
 * its half width. */
static const double shrink_converged = 0.8;
static const double move_converged = 0.3;
/* Small cells have a bias: the full stage begins with a wider region. */
static const double widen = 1.5;
/* Correlated by more, only the sum or the difference of two parameters is known. */
static const double confused = 0.97;

struct fit {
    const struct gb_calibrate_problem *problem;
    struct gb_calibrate_samples samples;
    struct gb_calibrate_region region;
    enum gb_calibrate_stage stage;
};

enum seed_outcome {
    SEED_FITTED,
    SEED_TOO_FEW, /* failed runs leave too few points for a linear surrogate */
    SEED_FAILED   /* err */
};

/* The surrogate of one seed over the points where it did not fail: quadratic, or linear
 * where failures leave too few points. */
static enum seed_outcome fit_seed(const struct fit *fit, size_t seed, double *at,
                                  double *value, struct gb_surrogate *surrogate,
                                  struct gb_error *err)
{
    static const enum gb_surrogate_order order[] = {GB_SURROGATE_QUADRATIC,
                                                    GB_SURROGATE_LINEAR};
    const struct gb_calibrate_problem *problem = fit->problem;
    const size_t points = gb_calibrate_samples_near(&fit->samples, &fit->region,
                                                    fit->stage, seed, at, value);
    for (size_t i = 0; i < sizeof order / sizeof order[0]; i++) {
        struct gb_error why = {0};
        if (gb_surrogate_fit(surrogate, problem->free, problem->data, order[i], at, value,
                             points, &why)) {
            return SEED_FITTED;
        }
        if (why.code != GB_ERR_INPUT) {
            (void)gb_error_set(err, why.code, "%s", why.text);
            return SEED_FAILED;
        }
    }
    return SEED_TOO_FEW;
}

/* Surrogates of all seeds that have one, and their number.  The caller finishes them. */
static bool fit_seeds(const struct fit *fit, struct gb_surrogate *surrogate,
                      size_t *seeds, struct gb_error *err)
{
    const struct gb_calibrate_problem *problem = fit->problem;
    const size_t count = fit->samples.count;
    double *at = gb_alloc_array(count * problem->free, sizeof *at, err);
    double *value = at ? gb_alloc_array(count * problem->data, sizeof *value, err) : NULL;
    *seeds = 0;
    bool made = value != NULL;
    for (size_t s = 0; made && s < problem->replicas; s++) {
        const enum seed_outcome outcome =
            fit_seed(fit, s, at, value, &surrogate[*seeds], err);
        *seeds += outcome == SEED_FITTED;
        made = outcome != SEED_FAILED;
    }
    gb_alloc_free(at);
    gb_alloc_free(value);
    return made &&
           (*seeds >= SEEDS_MIN ||
            gb_error_set(err, GB_ERR_GUARD,
                         "only %zu of %zu seeds have enough runs that did not fail near "
                         "the best fit; accepted %d at least",
                         *seeds, problem->replicas, SEEDS_MIN));
}

/* The estimate is in half widths from the centre; the result in units of the parameters.
 */
static void set_result(const struct fit *fit, const struct gb_estimate *estimate,
                       struct gb_calibrate_result *result)
{
    for (size_t k = 0; k < fit->problem->free; k++) {
        const double half = fit->region.half[k];
        const double low = fit->problem->low[k];
        const double high = fit->problem->high[k];
        const double value =
            fmin(fmax(fit->region.centre[k] + half * estimate->at[k], low), high);
        const double margin = 1e-3 * half;
        result->value[k] = value;
        result->error[k] = half * estimate->error[k];
        result->low[k] = fmax(fit->region.centre[k] + half * estimate->low_95[k], low);
        result->high[k] = fmin(fit->region.centre[k] + half * estimate->high_95[k], high);
        result->low_open[k] = result->low[k] <= low + margin;
        result->high_open[k] = result->high[k] >= high - margin;
        result->at_limit[k] = value <= low + margin || value >= high - margin;
        memcpy(result->correlation[k], estimate->correlation[k],
               sizeof result->correlation[k]);
    }
    result->chi_squared = estimate->chi_squared;
    result->rms = estimate->rms;
}

static bool fit_data(const struct fit *fit, const struct gb_surrogate *seeds,
                     size_t count, struct gb_calibrate_result *result,
                     struct gb_error *err)
{
    const struct gb_calibrate_problem *problem = fit->problem;
    const struct gb_calibrate_region *region = &fit->region;
    struct gb_estimate estimate;
    struct gb_estimate_problem data = {.variables = problem->free,
                                       .data = problem->data,
                                       .seeds = count,
                                       .value = problem->value,
                                       .error = problem->error,
                                       .weight = problem->weight,
                                       .seed = seeds};
    for (size_t k = 0; k < problem->free; k++) {
        data.least[k] = (problem->low[k] - region->centre[k]) / region->half[k];
        data.most[k] = (problem->high[k] - region->centre[k]) / region->half[k];
        data.low[k] = fmax(-1.0, data.least[k]);
        data.high[k] = fmin(1.0, data.most[k]);
    }
    if (!gb_estimate_fit(&data, &estimate, result->fitted, result->fitted_error, err)) {
        return false;
    }
    set_result(fit, &estimate, result);
    return true;
}

/* Design, surrogates and fit in the region. */
static bool do_round(struct fit *fit, struct gb_calibrate_result *result,
                     struct gb_error *err)
{
    struct gb_surrogate *seeds =
        gb_alloc_array(fit->problem->replicas, sizeof *seeds, err);
    if (seeds == NULL) {
        return false;
    }
    size_t count = 0;
    const bool good =
        gb_calibrate_samples_add(&fit->samples, &fit->region, fit->stage, result, err) &&
        fit_seeds(fit, seeds, &count, err) && fit_data(fit, seeds, count, result, err);
    for (size_t s = 0; s < count; s++) {
        gb_surrogate_finish(&seeds[s]);
    }
    gb_alloc_free(seeds);
    return good;
}

/* Moves the region inside the limits, and narrows it where that is not enough. */
static void clamp_region(struct fit *fit)
{
    struct gb_calibrate_region *region = &fit->region;
    for (size_t k = 0; k < fit->problem->free; k++) {
        const double low = fit->problem->low[k];
        const double high = fit->problem->high[k];
        region->half[k] = fmin(region->half[k], (high - low) / 2.0);
        region->centre[k] =
            fmin(fmax(region->centre[k], low + region->half[k]), high - region->half[k]);
    }
}

/* Moves the region to the fit and shrinks it; true when it has converged. */
static bool move_region(struct fit *fit, const struct gb_calibrate_result *result)
{
    struct gb_calibrate_region *region = &fit->region;
    const struct gb_calibrate_region before = *region;
    const size_t n = fit->problem->free;
    bool converged = true;
    for (size_t k = 0; k < n; k++) {
        const double off = fabs(result->value[k] - region->centre[k]);
        const bool at_edge = off > edge * region->half[k] && !result->at_limit[k];
        if (!at_edge && isfinite(result->error[k])) {
            const double half =
                fmax(region_errors * result->error[k], shrink_min * region->half[k]);
            converged = converged && half >= shrink_converged * region->half[k];
            region->half[k] = fmin(region->half[k], half);
        }
        region->centre[k] = result->value[k];
    }
    clamp_region(fit);
    for (size_t k = 0; k < n; k++) { /* at a limit the centre may be where it was */
        converged = converged && fabs(region->centre[k] - before.centre[k]) <=
                                     move_converged * region->half[k];
    }
    return converged;
}

static bool do_stage(struct fit *fit, struct gb_calibrate_result *result,
                     struct gb_error *err)
{
    const struct gb_calibrate_problem *problem = fit->problem;
    result->converged = false;
    for (int round = 1; round <= ROUNDS_MAX && !result->converged; round++) {
        if (!do_round(fit, result, err)) {
            return false;
        }
        result->converged = move_region(fit, result);
        if (problem->progress != NULL) {
            problem->progress(fit->stage, round, result->value, fit->region.half,
                              problem->context);
        }
    }
    return true;
}

static bool do_stages(struct fit *fit, struct gb_calibrate_result *result,
                      struct gb_error *err)
{
    const struct gb_calibrate_problem *problem = fit->problem;
    for (size_t k = 0; k < problem->free; k++) {
        fit->region.centre[k] = (problem->from[k] + problem->to[k]) / 2.0;
        fit->region.half[k] = (problem->to[k] - problem->from[k]) / 2.0;
    }
    clamp_region(fit);
    if (problem->coarse_stage) {
        fit->stage = GB_CALIBRATE_COARSE;
        if (!do_stage(fit, result, err)) {
            return false;
        }
        for (size_t k = 0; k < problem->free; k++) {
            fit->region.half[k] *= widen;
        }
        clamp_region(fit);
    }
    fit->stage = GB_CALIBRATE_FULL;
    return do_stage(fit, result, err);
}

bool gb_calibrate_fit(const struct gb_calibrate_problem *problem,
                      struct gb_calibrate_result *result, struct gb_error *err)
{
    struct fit fit = {.problem = problem, .samples = {.problem = problem}};
    *result = (struct gb_calibrate_result){0};
    const size_t needed = problem->free + (problem->error == NULL);
    if (problem->data < needed || problem->replicas < SEEDS_MIN) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%zu measured values, %zu replicas for %zu free parameters: "
                            "accepted %zu values (%s errors) and %d replicas at least",
                            problem->data, problem->replicas, problem->free, needed,
                            problem->error ? "with" : "without", SEEDS_MIN);
    }
    result->degrees = problem->data - problem->free;
    result->fitted = gb_alloc_array(problem->data, sizeof *result->fitted, err);
    result->fitted_error =
        result->fitted ? gb_alloc_array(problem->data, sizeof *result->fitted, err)
                       : NULL;
    const bool good = result->fitted_error != NULL && do_stages(&fit, result, err);
    gb_calibrate_samples_finish(&fit.samples);
    if (!good) {
        gb_calibrate_finish(result);
    }
    return good;
}

void gb_calibrate_finish(struct gb_calibrate_result *result)
{
    gb_alloc_free(result->fitted);
    gb_alloc_free(result->fitted_error);
    result->fitted = NULL;
    result->fitted_error = NULL;
}

bool gb_calibrate_confounded(const struct gb_calibrate_result *result, size_t i, size_t j)
{
    return fabs(result->correlation[i][j]) > confused;
}
