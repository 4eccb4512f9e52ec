#include "study/calibrate.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "measure/fit/estimate.h"

enum {
    FREE = GB_CALIBRATE_FREE,
    ROUNDS = 8,      /* of a stage at most */
    DESIGN = 32,     /* points of one round at most */
    SEEDS_LEAST = 3, /* with a surrogate, for the noise to be known */
};

/* Points within this many half widths of the centre are used again. */
static const double reach = 1.25;
/* A fit beyond this share of the half width has found the edge, not the minimum. */
static const double edge = 0.9;
/* The region shrinks to this many standard errors: closer, the slopes drown in noise. */
static const double errors_wide = 4.0;
/* It shrinks to no less than this share in one round. */
static const double shrink_most = 0.35;
/* Less is no shrinking, and less than `still` of the half width no moving. */
static const double shrink_least = 0.8;
static const double still = 0.3;
/* Small cells are off by a little: the full stage begins with a wider region. */
static const double widen = 1.5;

/* Everything simulated so far. */
struct pool {
    size_t count, room;
    double *at;    /* count x free */
    double *value; /* count x replicas x data */
    int *stage;
};

struct state {
    const struct gb_calibrate_problem *problem;
    struct pool pool;
    double centre[FREE], half[FREE];
    int stage;
};

static bool grow(struct pool *pool, const struct gb_calibrate_problem *problem,
                 size_t more, struct gb_error *err)
{
    const size_t need = pool->count + more;
    if (need <= pool->room) {
        return true;
    }
    const size_t room = 2 * need;
    const size_t cells = problem->replicas * problem->data;
    struct pool next = {pool->count, room, NULL, NULL, NULL};
    next.at = gb_alloc_array(room * problem->free, sizeof *next.at, err);
    next.value = next.at ? gb_alloc_array(room * cells, sizeof *next.value, err) : NULL;
    next.stage = next.value ? gb_alloc_array(room, sizeof *next.stage, err) : NULL;
    if (next.stage == NULL) {
        gb_alloc_free(next.at);
        gb_alloc_free(next.value);
        return false;
    }
    if (pool->count > 0) {
        memcpy(next.at, pool->at, pool->count * problem->free * sizeof *next.at);
        memcpy(next.value, pool->value, pool->count * cells * sizeof *next.value);
        memcpy(next.stage, pool->stage, pool->count * sizeof *next.stage);
    }
    gb_alloc_free(pool->at);
    gb_alloc_free(pool->value);
    gb_alloc_free(pool->stage);
    *pool = next;
    return true;
}

/* Two digits of the half width: a value that can be written and read again. */
static double rounded(double value, double half)
{
    const double step = pow(10.0, floor(log10(half)) - 2.0);
    return round(value / step) * step;
}

/* Centre, faces and corners of the region; for one parameter halves instead of corners.
 * Returns how many. */
static size_t make_design(const struct state *state, double *design)
{
    const size_t n = state->problem->free;
    const size_t corners = n > 1 ? (size_t)1 << n : 2;
    size_t count = 0;
    for (size_t p = 0; p < 1 + 2 * n + corners; p++, count++) {
        for (size_t k = 0; k < n; k++) {
            double share = 0.0;
            if (p > 2 * n) {
                share = ((p - 2 * n - 1) >> k) & 1 ? 1.0 : -1.0;
                share *= n > 1 ? 1.0 : 0.5;
            } else if (p > 0 && (p - 1) / 2 == k) {
                share = (p - 1) % 2 ? 1.0 : -1.0;
            }
            const double at = state->centre[k] + share * state->half[k];
            design[count * n + k] =
                fmin(fmax(rounded(at, state->half[k]), state->problem->low[k]),
                     state->problem->high[k]);
        }
    }
    return count;
}

static bool is_known(const struct state *state, const double *at)
{
    const size_t n = state->problem->free;
    for (size_t p = 0; p < state->pool.count; p++) {
        if (state->pool.stage[p] == state->stage &&
            memcmp(state->pool.at + p * n, at, n * sizeof *at) == 0) {
            return true;
        }
    }
    return false;
}

/* Simulates what the design has and the pool has not. */
static bool simulate(struct state *state, struct gb_calibrate_result *result,
                     struct gb_error *err)
{
    const struct gb_calibrate_problem *problem = state->problem;
    double design[DESIGN * FREE];
    const size_t n = problem->free;
    const size_t cells = problem->replicas * problem->data;
    const size_t wanted = make_design(state, design);
    if (!grow(&state->pool, problem, wanted, err)) {
        return false;
    }
    const size_t first = state->pool.count;
    for (size_t p = 0; p < wanted; p++) {
        if (!is_known(state, design + p * n)) {
            memcpy(state->pool.at + state->pool.count * n, design + p * n,
                   n * sizeof *design);
            state->pool.stage[state->pool.count++] = state->stage;
        }
    }
    const size_t fresh = state->pool.count - first;
    double *value = state->pool.value + first * cells;
    if (fresh > 0 && !problem->simulate(state->pool.at + first * n, fresh, state->stage,
                                        value, problem->context, err)) {
        return false;
    }
    result->simulated += fresh * problem->replicas;
    for (size_t r = 0; r < fresh * problem->replicas; r++) {
        bool whole = true;
        for (size_t i = 0; i < problem->data; i++) {
            whole = whole && isfinite(value[r * problem->data + i]);
        }
        result->failed += !whole;
    }
    return true;
}

/* Is a point of the pool of this stage and near enough? */
static bool is_near(const struct state *state, size_t point)
{
    const size_t n = state->problem->free;
    for (size_t k = 0; k < n; k++) {
        const double off = state->pool.at[point * n + k] - state->centre[k];
        if (fabs(off) > reach * state->half[k]) {
            return false;
        }
    }
    return state->pool.stage[point] == state->stage;
}

static bool is_whole(const double *value, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(value[i])) {
            return false;
        }
    }
    return true;
}

/* The surrogate of one seed over the points where it did not fail; quadratic, or linear
 * where failures leave too few.  False when even that is not to be had. */
static bool fit_seed(const struct state *state, size_t seed, double *at, double *value,
                     struct gb_surrogate *surrogate)
{
    const struct gb_calibrate_problem *problem = state->problem;
    const size_t n = problem->free;
    size_t points = 0;
    for (size_t p = 0; p < state->pool.count; p++) {
        const double *from =
            state->pool.value + (p * problem->replicas + seed) * problem->data;
        if (!is_near(state, p) || !is_whole(from, problem->data)) {
            continue;
        }
        for (size_t k = 0; k < n; k++) {
            at[points * n + k] =
                (state->pool.at[p * n + k] - state->centre[k]) / state->half[k];
        }
        memcpy(value + points * problem->data, from, problem->data * sizeof *value);
        points++;
    }
    return gb_surrogate_fit(surrogate, n, problem->data, true, at, value, points, NULL) ||
           gb_surrogate_fit(surrogate, n, problem->data, false, at, value, points, NULL);
}

/* Surrogates of all seeds that have one; returns how many.  The caller finishes them. */
static bool fit_seeds(const struct state *state, struct gb_surrogate *surrogate,
                      size_t *seeds, struct gb_error *err)
{
    const struct gb_calibrate_problem *problem = state->problem;
    double *at = gb_alloc_array(state->pool.count * problem->free, sizeof *at, err);
    double *value =
        at ? gb_alloc_array(state->pool.count * problem->data, sizeof *value, err) : NULL;
    *seeds = 0;
    for (size_t s = 0; value != NULL && s < problem->replicas; s++) {
        *seeds += fit_seed(state, s, at, value, &surrogate[*seeds]);
    }
    const bool made = value != NULL;
    gb_alloc_free(at);
    gb_alloc_free(value);
    return made &&
           (*seeds >= SEEDS_LEAST ||
            gb_error_set(err, GB_ERR_GUARD,
                         "only %zu of %zu seeds have enough runs that did not fail near "
                         "the best fit; accepted %d at least",
                         *seeds, problem->replicas, SEEDS_LEAST));
}

/* The estimate in units of the half widths, put into the parameters' own. */
static void keep(const struct state *state, const struct gb_estimate *estimate,
                 struct gb_calibrate_result *result)
{
    for (size_t k = 0; k < state->problem->free; k++) {
        const double half = state->half[k];
        const double value = state->centre[k] + half * estimate->at[k];
        const double margin = 1e-3 * half;
        result->value[k] = value;
        result->error[k] = half * estimate->error[k];
        result->low[k] = value - half * estimate->half_95[k];
        result->high[k] = value + half * estimate->half_95[k];
        result->at_limit[k] = value <= state->problem->low[k] + margin ||
                              value >= state->problem->high[k] - margin;
        memcpy(result->correlation[k], estimate->correlation[k],
               sizeof result->correlation[k]);
    }
    result->chi_squared = estimate->chi_squared;
    result->rms = estimate->rms;
}

/* Design, surrogates and fit around the centre. */
static bool do_round(struct state *state, struct gb_calibrate_result *result,
                     struct gb_error *err)
{
    const struct gb_calibrate_problem *problem = state->problem;
    struct gb_estimate estimate;
    struct gb_surrogate *seeds = gb_alloc_array(problem->replicas, sizeof *seeds, err);
    if (seeds == NULL) {
        return false;
    }
    size_t count = 0;
    bool good = simulate(state, result, err) && fit_seeds(state, seeds, &count, err);
    if (good) {
        struct gb_estimate_problem fit = {.variables = problem->free,
                                          .data = problem->data,
                                          .seeds = count,
                                          .value = problem->value,
                                          .error = problem->error,
                                          .seed = seeds};
        for (size_t k = 0; k < problem->free; k++) {
            fit.low[k] =
                fmax(-1.0, (problem->low[k] - state->centre[k]) / state->half[k]);
            fit.high[k] =
                fmin(1.0, (problem->high[k] - state->centre[k]) / state->half[k]);
        }
        good =
            gb_estimate_fit(&fit, &estimate, result->fitted, result->fitted_error, err);
    }
    if (good) {
        keep(state, &estimate, result);
    }
    for (size_t s = 0; s < count; s++) {
        gb_surrogate_finish(&seeds[s]);
    }
    gb_alloc_free(seeds);
    return good;
}

/* Keeps the region inside the limits: the centre gives way, then the width. */
static void fit_inside(struct state *state)
{
    for (size_t k = 0; k < state->problem->free; k++) {
        const double low = state->problem->low[k];
        const double high = state->problem->high[k];
        state->half[k] = fmin(state->half[k], (high - low) / 2.0);
        state->centre[k] =
            fmin(fmax(state->centre[k], low + state->half[k]), high - state->half[k]);
    }
}

/* Moves to the fit and shrinks; true when neither was due. */
static bool follow(struct state *state, const struct gb_calibrate_result *result)
{
    const size_t n = state->problem->free;
    double before[FREE];
    bool settled = true;
    memcpy(before, state->centre, sizeof before);
    for (size_t k = 0; k < n; k++) {
        const double off = fabs(result->value[k] - state->centre[k]);
        const bool at_edge = off > edge * state->half[k] && !result->at_limit[k];
        if (!at_edge && isfinite(result->error[k])) {
            const double wanted =
                fmax(errors_wide * result->error[k], shrink_most * state->half[k]);
            settled = settled && wanted >= shrink_least * state->half[k];
            state->half[k] = fmin(state->half[k], wanted);
        }
        state->centre[k] = result->value[k];
    }
    fit_inside(state);
    for (size_t k = 0; k < n; k++) { /* at the limits it may not have moved after all */
        settled = settled && fabs(state->centre[k] - before[k]) <= still * state->half[k];
    }
    return settled;
}

static bool do_stage(struct state *state, struct gb_calibrate_result *result,
                     struct gb_error *err)
{
    const struct gb_calibrate_problem *problem = state->problem;
    result->settled = false;
    for (int round = 1; round <= ROUNDS && !result->settled; round++) {
        if (!do_round(state, result, err)) {
            return false;
        }
        result->settled = follow(state, result);
        if (problem->told != NULL) {
            problem->told(state->stage, round, result->value, state->half,
                          problem->context);
        }
    }
    return true;
}

static bool do_stages(struct state *state, struct gb_calibrate_result *result,
                      struct gb_error *err)
{
    const struct gb_calibrate_problem *problem = state->problem;
    for (size_t k = 0; k < problem->free; k++) {
        state->centre[k] = (problem->from[k] + problem->to[k]) / 2.0;
        state->half[k] = (problem->to[k] - problem->from[k]) / 2.0;
    }
    fit_inside(state);
    if (problem->coarse) {
        state->stage = 0;
        if (!do_stage(state, result, err)) {
            return false;
        }
        for (size_t k = 0; k < problem->free; k++) {
            state->half[k] *= widen;
        }
        fit_inside(state);
    }
    state->stage = 1;
    return do_stage(state, result, err);
}

bool gb_calibrate_fit(const struct gb_calibrate_problem *problem,
                      struct gb_calibrate_result *result, struct gb_error *err)
{
    struct state state = {.problem = problem};
    *result = (struct gb_calibrate_result){0};
    const size_t needed = problem->free + (problem->error == NULL);
    if (problem->data < needed || problem->replicas < SEEDS_LEAST) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%zu measured values, %zu replicas for %zu free parameters: "
                            "accepted %zu values (%s errors) and %d replicas at least",
                            problem->data, problem->replicas, problem->free, needed,
                            problem->error ? "with" : "without", SEEDS_LEAST);
    }
    result->degrees = problem->data - problem->free;
    result->fitted = gb_alloc_array(problem->data, sizeof *result->fitted, err);
    result->fitted_error =
        result->fitted ? gb_alloc_array(problem->data, sizeof *result->fitted, err)
                       : NULL;
    const bool good = result->fitted_error != NULL && do_stages(&state, result, err);
    gb_alloc_free(state.pool.at);
    gb_alloc_free(state.pool.value);
    gb_alloc_free(state.pool.stage);
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

/* Correlated by more, the sum or difference is known and neither of the two. */
static const double confused = 0.97;

bool gb_calibrate_confused(const struct gb_calibrate_result *result, size_t i, size_t j)
{
    return fabs(result->correlation[i][j]) > confused;
}
