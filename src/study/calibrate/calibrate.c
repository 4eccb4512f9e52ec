/* The fit: simulated points, a quadratic surrogate per seed, and a region that moves and
 * shrinks (calibrate.h has the method). */
#include "study/calibrate/calibrate.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "measure/surrogate.h"

/* --- points that were simulated ------------------------------------------------------- */

/* The region of parameters in which a fit is sought. */
struct region {
    double centre[GB_CALIBRATE_FREE];
    double half[GB_CALIBRATE_FREE]; /* half widths */
};

/* All points simulated so far, of both stages. */
struct samples {
    const struct gb_calibrate_problem *problem;
    size_t count, capacity;
    double *at;    /* count x free: parameters */
    double *value; /* count x replicas x data */
    enum gb_calibrate_stage *stage;
};

enum { FREE = GB_CALIBRATE_FREE, DESIGN_MAX = 32 };

/* Points within this many half widths of the centre are used again. */
static const double near_half_widths = 1.25;

static void samples_finish(struct samples *samples)
{
    gb_alloc_free(samples->at);
    gb_alloc_free(samples->value);
    gb_alloc_free(samples->stage);
    *samples = (struct samples){0};
}

static bool reserve(struct samples *samples, size_t more, struct gb_error *err)
{
    const struct gb_calibrate_problem *problem = samples->problem;
    const size_t need = samples->count + more;
    if (need <= samples->capacity) {
        return true;
    }
    const size_t capacity = 2 * need;
    const size_t cells = problem->replicas * problem->data;
    struct samples next = {
        .problem = problem, .count = samples->count, .capacity = capacity};
    next.at = gb_alloc_array(capacity * problem->free, sizeof *next.at, err);
    next.value =
        next.at ? gb_alloc_array(capacity * cells, sizeof *next.value, err) : NULL;
    next.stage = next.value ? gb_alloc_array(capacity, sizeof *next.stage, err) : NULL;
    if (next.stage == NULL) {
        samples_finish(&next);
        return false;
    }
    if (samples->count > 0) {
        memcpy(next.at, samples->at, samples->count * problem->free * sizeof *next.at);
        memcpy(next.value, samples->value, samples->count * cells * sizeof *next.value);
        memcpy(next.stage, samples->stage, samples->count * sizeof *next.stage);
    }
    samples_finish(samples);
    *samples = next;
    return true;
}

/* Two digits of the half width: a value that can be written and read again. */
static double rounded(double value, double half)
{
    const double step = pow(10.0, floor(log10(half)) - 2.0);
    return round(value / step) * step;
}

/* Coordinate k of point p of the design in half widths: the centre, the faces, the
 * corners; for one parameter points halfway to the faces instead of corners. */
static double design_share(size_t free, size_t p, size_t k)
{
    if (p > 2 * free) {
        const double side = ((p - 2 * free - 1) >> k) & 1 ? 1.0 : -1.0;
        return side * (free > 1 ? 1.0 : 0.5);
    }
    if (p > 0 && (p - 1) / 2 == k) {
        return (p - 1) % 2 ? 1.0 : -1.0;
    }
    return 0.0;
}

/* The design of a region; returns its number of points. */
static size_t make_design(const struct gb_calibrate_problem *problem,
                          const struct region *region, double *design)
{
    const size_t n = problem->free;
    const size_t points = 1 + 2 * n + (n > 1 ? (size_t)1 << n : 2);
    for (size_t p = 0; p < points; p++) {
        for (size_t k = 0; k < n; k++) {
            const double at = region->centre[k] + design_share(n, p, k) * region->half[k];
            design[p * n + k] = fmin(fmax(rounded(at, region->half[k]), problem->low[k]),
                                     problem->high[k]);
        }
    }
    return points;
}

static bool is_known(const struct samples *samples, enum gb_calibrate_stage stage,
                     const double *at)
{
    const size_t n = samples->problem->free;
    for (size_t p = 0; p < samples->count; p++) {
        if (samples->stage[p] == stage &&
            memcmp(samples->at + p * n, at, n * sizeof *at) == 0) {
            return true;
        }
    }
    return false;
}

static bool is_finite(const double *value, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(value[i])) {
            return false;
        }
    }
    return true;
}

/* Adds the points of the design that are new; returns their number. */
static size_t add_points(struct samples *samples, enum gb_calibrate_stage stage,
                         const double *design, size_t points)
{
    const size_t n = samples->problem->free;
    const size_t first = samples->count;
    for (size_t p = 0; p < points; p++) {
        if (!is_known(samples, stage, design + p * n)) {
            memcpy(samples->at + samples->count * n, design + p * n, n * sizeof *design);
            samples->stage[samples->count++] = stage;
        }
    }
    return samples->count - first;
}

/* Simulates the design of a region, as far as it is new, and counts runs and failures in
 * result.  samples_finish is due. */
static bool calibrate_samples_add(struct samples *samples, const struct region *region,
                                  enum gb_calibrate_stage stage,
                                  struct gb_calibrate_result *result,
                                  struct gb_error *err)
{
    const struct gb_calibrate_problem *problem = samples->problem;
    double design[DESIGN_MAX * FREE];
    const size_t points = make_design(problem, region, design);
    if (!reserve(samples, points, err)) {
        return false;
    }
    const size_t first = samples->count;
    const size_t added = add_points(samples, stage, design, points);
    double *value = samples->value + first * problem->replicas * problem->data;
    if (added > 0 && !problem->simulate(samples->at + first * problem->free, added, stage,
                                        value, problem->context, err)) {
        return false;
    }
    result->simulated += added * problem->replicas;
    for (size_t r = 0; r < added * problem->replicas; r++) {
        result->failed += !is_finite(value + r * problem->data, problem->data);
    }
    return true;
}

static bool is_near(const struct samples *samples, const struct region *region,
                    size_t point)
{
    const size_t n = samples->problem->free;
    for (size_t k = 0; k < n; k++) {
        const double off = samples->at[point * n + k] - region->centre[k];
        if (fabs(off) > near_half_widths * region->half[k]) {
            return false;
        }
    }
    return true;
}

/* Points of a stage near the region where a seed did not fail: at (in half widths from the
 * centre) and values; both have room for all samples.  Returns their number. */
static size_t calibrate_samples_near(const struct samples *samples,
                                     const struct region *region,
                                     enum gb_calibrate_stage stage, size_t seed,
                                     double *at, double *value)
{
    const struct gb_calibrate_problem *problem = samples->problem;
    const size_t n = problem->free;
    size_t points = 0;
    for (size_t p = 0; p < samples->count; p++) {
        const double *from =
            samples->value + (p * problem->replicas + seed) * problem->data;
        if (samples->stage[p] != stage || !is_near(samples, region, p) ||
            !is_finite(from, problem->data)) {
            continue;
        }
        for (size_t k = 0; k < n; k++) {
            at[points * n + k] =
                (samples->at[p * n + k] - region->centre[k]) / region->half[k];
        }
        memcpy(value + points * problem->data, from, problem->data * sizeof *value);
        points++;
    }
    return points;
}

/* --- the fit -------------------------------------------------------------------------- */

enum {
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
    struct samples samples;
    struct region region;
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
    const size_t points =
        calibrate_samples_near(&fit->samples, &fit->region, fit->stage, seed, at, value);
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
                         "the best fit; expected %d at least",
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
    const struct region *region = &fit->region;
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
    if (!gb_surrogate_estimate(&data, &estimate, result->fitted, result->fitted_error,
                               err)) {
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
        calibrate_samples_add(&fit->samples, &fit->region, fit->stage, result, err) &&
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
    struct region *region = &fit->region;
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
    struct region *region = &fit->region;
    const struct region before = *region;
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
                            "expected %zu values (%s errors) and %d replicas at least",
                            problem->data, problem->replicas, problem->free, needed,
                            problem->error ? "with" : "without", SEEDS_MIN);
    }
    result->degrees = problem->data - problem->free;
    result->fitted = gb_alloc_array(problem->data, sizeof *result->fitted, err);
    result->fitted_error =
        result->fitted ? gb_alloc_array(problem->data, sizeof *result->fitted, err)
                       : NULL;
    const bool good = result->fitted_error != NULL && do_stages(&fit, result, err);
    samples_finish(&fit.samples);
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
