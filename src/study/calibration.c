/* A calibration in a directory: which keys are free, the runs at each point, and its tables. */

#include "study/calibration.h"

#include <glib.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include "base/alloc.h"
#include "base/file.h"
#include "base/listing.h"
#include "base/number.h"
#include "base/units.h"
#include "greenbody/params.h"
#include "greenbody/status.h"
#include "io/preset.h"
#include "many/compaction_data.h"
#include "many/ensemble.h"
#include "many/reading.h"
#include "many/runset.h"
#include "measure/surrogate.h"

/* The fit: simulated points, a quadratic surrogate per seed, and a region that moves and
 * shrinks (calibration.h has the method). */

/* Fits free parameters of a noisy simulation to measured values.
 *
 * Around a centre a design of parameters is simulated with the same seeds at every point.
 * Each seed gives a quadratic surrogate of all values; their mean is fitted to the data,
 * the centre moves to the fit, the region shrinks to a few standard errors.  The scatter
 * between seeds at the best fit is the noise of the simulation; it enters the intervals
 * in addition to the errors of the data.  A coarse stage (small cells) finds the region for the
 * full one. */

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
 * result.  samples_finish must be called. */
static bool samples_add(struct samples *samples, const struct region *region,
                        enum gb_calibrate_stage stage, struct gb_calibrate_result *result,
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
static size_t samples_near(const struct samples *samples, const struct region *region,
                           enum gb_calibrate_stage stage, size_t seed, double *at,
                           double *value)
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
        samples_near(&fit->samples, &fit->region, fit->stage, seed, at, value);
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
    const bool good = samples_add(&fit->samples, &fit->region, fit->stage, result, err) &&
                      fit_seeds(fit, seeds, &count, err) &&
                      fit_data(fit, seeds, count, result, err);
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

bool gb_calibration_search(const struct gb_calibrate_problem *problem,
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
        gb_calibration_result_finish(result);
    }
    return good;
}

void gb_calibration_result_finish(struct gb_calibrate_result *result)
{
    gb_alloc_free(result->fitted);
    gb_alloc_free(result->fitted_error);
    result->fitted = NULL;
    result->fitted_error = NULL;
}

bool gb_calibration_confounded(const struct gb_calibrate_result *result, size_t i,
                               size_t j)
{
    return fabs(result->correlation[i][j]) > confused;
}

/* --- free keys ------------------------------------------------------------------------ */

enum { DIGITS = 10 };

/* Without a range the fit begins between the value over this and the value times it. */
static const double first_factor = 2.0;

/* The number of a field in params. */
static double number_of(const struct gb_params *params, const struct gb_field *field,
                        bool *relative)
{
    const void *at = (const char *)params + field->offset;
    *relative = false;
    if (field->type == GB_FIELD_RELATIVE) {
        const struct gb_relative *both = at;
        *relative = both->relative;
        return both->value;
    }
    return *(const double *)at;
}

/* One end of a range; takes the unit behind the whole when it has none. */
static bool read_end(struct gb_free_key *key, const char *text, const char *unit,
                     double *value, struct gb_error *err)
{
    struct gb_params params;
    const char *end = text;
    double number = 0.0;
    gb_params_init(&params);
    const bool bare = gb_units_number(text, &end, &number) && *end == '\0';
    char *whole = g_strconcat(text, bare && *unit ? " " : "", bare ? unit : "", NULL);
    const bool good = gb_params_set(&params, key->field, whole, err);
    g_free(whole);
    *value = number_of(&params, key->field, &key->relative);
    return good;
}

static bool read_range(struct gb_free_key *key, const char *text, struct gb_error *err)
{
    char **ends = g_strsplit(text, ":", 3);
    bool good = g_strv_length(ends) == 2;
    if (good) {
        const char *unit = "";
        double number = 0.0;
        g_strstrip(ends[0]);
        if (gb_units_number(g_strstrip(ends[1]), &unit, &number)) {
            unit += strspn(unit, " \t");
        }
        bool relative = false;
        good = read_end(key, ends[0], unit, &key->low, err);
        relative = key->relative;
        good = good && read_end(key, ends[1], unit, &key->high, err);
        good = good && relative == key->relative && key->low < key->high;
    }
    g_strfreev(ends);
    key->from = key->low;
    key->to = key->high;
    return good || gb_error_set(err, GB_ERR_INPUT,
                                "--free %s.%s=%.80s: expected two values that the key "
                                "takes, LOW:HIGH",
                                key->field->group, key->field->key, text);
}

static bool take_around(struct gb_free_key *key, const struct gb_params *params,
                        struct gb_error *err)
{
    const double value = number_of(params, key->field, &key->relative);
    if (!(value > 0.0)) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "--free %s.%s: the preset has no value above 0 to begin with; "
            "expected %s.%s=LOW:HIGH",
            key->field->group, key->field->key, key->field->group, key->field->key);
    }
    key->low = fmax(key->field->min, value / 100.0);
    key->high = fmin(key->field->max, value * 100.0);
    key->from = fmax(key->low, value / first_factor);
    key->to = fmin(key->high, value * first_factor);
    return true;
}

static bool find_field(const struct gb_free_keys *keys, struct gb_free_key *key,
                       const char *name, struct gb_error *err)
{
    key->field = gb_params_find_name(name, err);
    if (key->field == NULL) {
        return false;
    }
    const bool fit =
        !gb_runset_bookkeeping(key->field) &&
        (key->field->type == GB_FIELD_NUMBER || key->field->type == GB_FIELD_RELATIVE);
    bool twice = false;
    for (size_t i = 0; i < keys->count; i++) {
        twice = twice || keys->key[i].field == key->field;
    }
    return (fit && !twice) ||
           gb_error_set(
               err, GB_ERR_INPUT,
               "--free %.80s: expected keys that are numbers, as contact.mu, each "
               "once; see greenbody params",
               name);
}

bool gb_calibration_keys(struct gb_free_keys *keys, const char *text,
                         const struct gb_params *params, struct gb_error *err)
{
    char **parts = g_strsplit(text, ",", GB_CALIBRATE_FREE + 2);
    bool good = parts[0] != NULL;
    keys->count = 0;
    if (!good || g_strv_length(parts) > GB_CALIBRATE_FREE) {
        good =
            gb_error_set(err, GB_ERR_INPUT, "--free %.80s: must be between 1 and %d keys",
                         text, GB_CALIBRATE_FREE);
    }
    for (size_t i = 0; good && parts[i] != NULL; i++) {
        struct gb_free_key *key = &keys->key[keys->count];
        char **sides = g_strsplit(g_strstrip(parts[i]), "=", 2);
        *key = (struct gb_free_key){0};
        good = sides[0] != NULL
                   ? find_field(keys, key, g_strstrip(sides[0]), err)
                   : gb_error_set(err, GB_ERR_INPUT, "--free: a key is empty");
        good = good && (sides[1] ? read_range(key, sides[1], err)
                                 : take_around(key, params, err));
        keys->count += good;
        g_strfreev(sides);
    }
    g_strfreev(parts);
    return good;
}

/* The value of a key as a preset would write it, ten digits.  Returns buffer. */
static char *free_keys_text(const struct gb_free_key *key, double value, char *buffer,
                            size_t size)
{
    if (key->relative) {
        g_snprintf(buffer, (gulong)size, "%.*g %s", DIGITS, value, key->field->relative);
        return buffer;
    }
    return gb_units_format_short(value, (enum gb_dimension)key->field->dimension, DIGITS,
                                 buffer, size);
}

/* Gives params the values. */
static bool calibration_apply(const struct gb_free_keys *keys, const double *value,
                              struct gb_params *params, struct gb_error *err)
{
    for (size_t k = 0; k < keys->count; k++) {
        char text[96];
        free_keys_text(&keys->key[k], value[k], text, sizeof text);
        if (!gb_params_set(params, keys->key[k].field, text, err)) {
            return false;
        }
    }
    return true;
}

/* --- runs and fit --------------------------------------------------------------------- */

/* Cells of the coarse stage: this fraction of the particles, but not fewer. */
enum { COARSE_FRACTION = 8, COARSE_MIN = 200 };

const char *gb_calibration_key_name(const struct gb_free_key *key, char *buffer,
                                    size_t size)
{
    g_snprintf(buffer, (gulong)size, "%s.%s", key->field->group, key->field->key);
    return buffer;
}

/* A smaller cell of the same shape.  Errors: GB_ERR_INPUT for too few particles. */
static bool make_coarse(struct gb_params *params, struct gb_error *err)
{
    const int64_t count = params->count / COARSE_FRACTION;
    if (count < COARSE_MIN) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "a coarse cell of %lld particles: expected %d at least",
                            (long long)count, (int)COARSE_MIN);
    }
    params->base.value *= cbrt((double)count / (double)params->count);
    params->count = count;
    return gb_params_check(params, err);
}

/* "coarse_1_mu-0.13_alpha-0.37_seed-2": depends on the parameters of the run only. */
static char *directory_of(const struct gb_calibration *calibration,
                          enum gb_calibrate_stage stage, size_t scene, const double *at,
                          uint64_t seed)
{
    GString *name = g_string_new(NULL);
    g_string_printf(name, "%s/runs/%s_%zu", calibration->directory,
                    stage == GB_CALIBRATE_COARSE ? "coarse" : "full", scene + 1);
    for (size_t k = 0; k < calibration->keys.count; k++) {
        g_string_append_printf(name, "_%s-%.10g", calibration->keys.key[k].field->key,
                               at[k]);
    }
    g_string_append_printf(name, "_seed-%" G_GUINT64_FORMAT, seed);
    return g_string_free(name, FALSE);
}

/* A batch of parameters as runs: point p of scene s is p x scenes + s. */
static bool fill(const struct gb_calibration *calibration, const double *parameters,
                 enum gb_calibrate_stage stage, struct gb_ensemble *ensemble,
                 struct gb_error *err)
{
    const size_t scenes = calibration->lab.scenes;
    for (size_t i = 0; i < ensemble->points * ensemble->replicas; i++) {
        struct gb_ensemble_run *run = &ensemble->run[i];
        const double *at = parameters + run->point / scenes * calibration->keys.count;
        const size_t scene = run->point % scenes;
        run->params = calibration->lab.scene[scene];
        run->params.seed += run->replica;
        run->params.threads = run->params.threads > 0 ? run->params.threads : 1;
        if (!calibration_apply(&calibration->keys, at, &run->params, err) ||
            (stage == GB_CALIBRATE_COARSE && !make_coarse(&run->params, err)) ||
            !gb_params_check(&run->params, err)) {
            return false;
        }
        run->directory = directory_of(calibration, stage, scene, at, run->params.seed);
    }
    return true;
}

/* Values of one run for the rows of its scene; NaN where it failed. */
static void read_values(const struct gb_calibration *calibration,
                        const struct gb_ensemble_run *run, double *out)
{
    const struct gb_labdata *lab = &calibration->lab;
    struct gb_table *curve = NULL;
    const bool good =
        run->error.code == GB_OK && gb_reading_open(&curve, run->directory, NULL);
    for (size_t i = 0; i < lab->count; i++) {
        const struct gb_labdata_row *row = &lab->row[i];
        if (row->scene != run->point % lab->scenes) {
            continue;
        }
        out[i] = good ? gb_compaction_data_simulated(row, curve) : (double)NAN;
    }
    gb_table_destroy(curve);
}

static bool simulate(const double *parameters, size_t points,
                     enum gb_calibrate_stage stage, double *out, void *context,
                     struct gb_error *err)
{
    struct gb_calibration *calibration = context;
    const size_t data = calibration->lab.count;
    const size_t scenes = calibration->lab.scenes;
    const size_t replicas = calibration->replicas;
    struct gb_ensemble ensemble;
    const bool good = gb_ensemble_init(&ensemble, points * scenes, replicas, err) &&
                      fill(calibration, parameters, stage, &ensemble, err) &&
                      gb_ensemble_find_done(&ensemble, err) &&
                      calibration->work(&ensemble, calibration->data, err);
    for (size_t i = 0; good && i < ensemble.points * replicas; i++) {
        const struct gb_ensemble_run *run = &ensemble.run[i];
        const size_t point = run->point / scenes;
        if (run->error.code == GB_ERR_MACHINE && calibration->machine.code == GB_OK) {
            calibration->machine = run->error;
        }
        read_values(calibration, run, out + (point * replicas + run->replica) * data);
    }
    gb_ensemble_finish(&ensemble);
    return good;
}

static bool write_table(const struct gb_calibration *calibration, const char *name,
                        GString *text, struct gb_error *err)
{
    char *path = g_build_filename(calibration->directory, name, NULL);
    const bool good = gb_file_replace(path, text->str, text->len, err);
    g_free(path);
    g_string_free(text, TRUE);
    return good;
}

static struct gb_listing *new_rounds(const struct gb_calibration *calibration)
{
    struct gb_listing *listing = gb_listing_new();
    char name[96];
    gb_listing_columns(listing, "%s", "cells");
    gb_listing_columns(listing, "%.0f", "round");
    for (size_t k = 0; k < calibration->keys.count; k++) {
        gb_calibration_key_name(&calibration->keys.key[k], name, sizeof name);
        gb_listing_column(listing, "%.5g", "%s", name);
        gb_listing_column(listing, "%.3g", "within_%s", name);
    }
    return listing;
}

/* A row of rounds.csv, for other programs that follow the fit; the fit continues when it
 * cannot be written. */
static void add_round(enum gb_calibrate_stage stage, int round, const double *best,
                      const double *half_width, void *context)
{
    struct gb_calibration *calibration = context;
    struct gb_listing *listing = calibration->rounds;
    gb_listing_text(listing, stage == GB_CALIBRATE_COARSE ? "small" : "full");
    gb_listing_number(listing, round);
    for (size_t k = 0; k < calibration->keys.count; k++) {
        gb_listing_number(listing, best[k]);
        gb_listing_number(listing, half_width[k]);
    }
    (void)write_table(calibration, "rounds.csv",
                      gb_listing_print(listing, GB_LISTING_CSV), NULL);
    if (calibration->progress != NULL) {
        calibration->progress(calibration, stage, round, best, half_width,
                              calibration->data);
    }
}

static struct gb_calibrate_problem problem_of(struct gb_calibration *calibration)
{
    struct gb_calibrate_problem problem = {.free = calibration->keys.count,
                                           .data = calibration->lab.count,
                                           .value = calibration->lab.value,
                                           .error = calibration->lab.error,
                                           .weight = calibration->lab.weight,
                                           .replicas = calibration->replicas,
                                           .coarse_stage = true,
                                           .simulate = simulate,
                                           .progress = add_round,
                                           .context = calibration};
    for (size_t k = 0; k < calibration->keys.count; k++) {
        problem.low[k] = calibration->keys.key[k].low;
        problem.high[k] = calibration->keys.key[k].high;
        problem.from[k] = calibration->keys.key[k].from;
        problem.to[k] = calibration->keys.key[k].to;
    }
    for (size_t s = 0; s < calibration->lab.scenes; s++) {
        struct gb_params smaller = calibration->lab.scene[s];
        problem.coarse_stage = problem.coarse_stage && make_coarse(&smaller, NULL);
    }
    return problem;
}

bool gb_calibration_fit(struct gb_calibration *calibration, struct gb_error *err)
{
    const struct gb_calibrate_problem problem = problem_of(calibration);
    calibration->rounds = new_rounds(calibration);
    if (gb_calibration_search(&problem, &calibration->result, err)) {
        return true;
    }
    /* where runs are missing because of a full disk, that is the error */
    if (err->code == GB_ERR_GUARD && calibration->machine.code != GB_OK) {
        *err = calibration->machine;
    }
    return false;
}

void gb_calibration_finish(struct gb_calibration *calibration)
{
    gb_calibration_result_finish(&calibration->result);
    gb_compaction_data_targets_finish(&calibration->lab);
    gb_listing_free(calibration->rounds);
    calibration->rounds = NULL;
}

/* --- tables and text ------------------------------------------------------------------ */

enum { NAME_MAX_BYTES = 96 };

static const char no_influence[] = ": the data do not depend on it";

static const char *name_of(const struct gb_calibration *calibration, size_t k,
                           char *buffer)
{
    return gb_calibration_key_name(&calibration->keys.key[k], buffer, NAME_MAX_BYTES);
}

/* calibration.csv: a row per parameter. */
static GString *parameter_table(const struct gb_calibration *calibration)
{
    const struct gb_calibrate_result *result = &calibration->result;
    const size_t n = calibration->keys.count;
    char name[NAME_MAX_BYTES];
    struct gb_listing *listing = gb_listing_new();
    gb_listing_comment(listing,
                       "best fit, standard error and 95 % interval; SI, or the "
                       "multiple that the preset gives; open (1): the interval ends "
                       "at that limit of the range");
    gb_listing_columns(listing, "%s", "key,unit");
    gb_listing_columns(listing, "%.8g", "value,error,low_95,high_95");
    for (size_t k = 0; k < n; k++) {
        gb_listing_column(listing, "%.4f", "correlation_%s",
                          name_of(calibration, k, name));
    }
    gb_listing_columns(listing, "%.0f", "low_open,high_open");
    for (size_t k = 0; k < n; k++) {
        const struct gb_free_key *key = &calibration->keys.key[k];
        gb_listing_text(listing, name_of(calibration, k, name));
        gb_listing_text(listing, key->relative ? key->field->relative : "SI");
        gb_listing_number(listing, result->value[k]);
        gb_listing_number(listing, result->error[k]);
        gb_listing_number(listing, result->low[k]);
        gb_listing_number(listing, result->high[k]);
        gb_listing_numbers(listing, result->correlation[k], n);
        gb_listing_number(listing, result->low_open[k]);
        gb_listing_number(listing, result->high_open[k]);
    }
    return gb_listing_end(listing, GB_LISTING_CSV);
}

/* fit.csv: measured values beside those simulated with the best fit. */
static GString *fit_table(const struct gb_calibration *calibration)
{
    const struct gb_labdata *lab = &calibration->lab;
    struct gb_listing *listing = gb_listing_new();
    gb_listing_columns(listing, "%.0f", "scene");
    gb_listing_columns(listing, "%s", "branch");
    gb_listing_columns(listing, "%.12g", "p_MPa,measured,measured_error");
    gb_listing_columns(listing, "%.8g", "simulated");
    gb_listing_columns(listing, "%.3g", "se_simulated");
    gb_listing_columns(listing, "%s", "quantity");
    gb_listing_columns(listing, "%.12g", "weight");
    for (size_t i = 0; i < lab->count; i++) {
        const struct gb_labdata_row *row = &lab->row[i];
        gb_listing_whole(listing, row->scene + 1);
        gb_listing_text(listing, row->unloaded ? "unload" : "load");
        gb_listing_number(listing, row->pressure_pa / 1e6);
        gb_listing_number(listing, lab->value[i]);
        gb_listing_number(listing, lab->error != NULL ? lab->error[i] : (double)NAN);
        gb_listing_number(listing, calibration->result.fitted[i]);
        gb_listing_number(listing, calibration->result.fitted_error[i]);
        gb_listing_text(listing, gb_lab_quantity_rows[row->quantity].name);
        gb_listing_number(listing, lab->weight != NULL ? lab->weight[i] : 1.0);
    }
    return gb_listing_end(listing, GB_LISTING_CSV);
}

/* Root mean square of the residuals of each quantity. */
static void add_residuals(GString *text, const struct gb_calibration *calibration)
{
    const struct gb_labdata *lab = &calibration->lab;
    const char *between = "residuals: rms";
    for (int q = 0; q < GB_LAB_QUANTITIES; q++) {
        double squares = 0.0;
        size_t count = 0;
        for (size_t i = 0; i < lab->count; i++) {
            const double off = calibration->result.fitted[i] - lab->value[i];
            const bool is_own = lab->row[i].quantity == (enum gb_lab_quantity)q;
            squares += is_own ? off * off : 0.0;
            count += is_own;
        }
        if (count > 0) {
            g_string_append_printf(text, "%s %.2g in %s", between,
                                   sqrt(squares / (double)count),
                                   gb_lab_quantity_rows[q].label);
            between = ",";
        }
    }
}

static const char not_converged[] = "the fit has not converged";

bool gb_calibration_warns(const char *line)
{
    return line[0] == ' ' || g_str_has_prefix(line, not_converged) ||
           g_str_has_suffix(line, no_influence);
}

bool gb_calibration_write(const struct gb_calibration *calibration,
                          struct gb_preset *preset, struct gb_error *err)
{
    struct gb_params *params = gb_preset_params(preset);
    if (!calibration_apply(&calibration->keys, calibration->result.value, params, err)) {
        return false;
    }
    char *path = g_build_filename(calibration->directory, "calibrated.ini", NULL);
    const bool saved = gb_preset_save(preset, path, GB_PRESET_CHANGED_KEYS, err);
    g_free(path);
    return saved && write_table(calibration, "fit.csv", fit_table(calibration), err) &&
           write_table(calibration, GB_CALIBRATION_TABLE_TEXT,
                       gb_calibration_text(calibration), err) &&
           write_table(calibration, "calibration.csv", parameter_table(calibration), err);
}

static const char *unit_of(const struct gb_free_key *key)
{
    if (key->relative) {
        return key->field->relative;
    }
    return key->field->dimension != GB_DIM_NONE ? "(SI)" : "";
}

/* The value to the decimal place of its error; where the error is the larger one that
 * would be zero, outside of the range of most keys. */
static char *write_value(double value, double error, char number[GB_NUMBER_ERROR_MAX])
{
    if (error > fabs(value)) {
        g_snprintf(number, GB_NUMBER_ERROR_MAX, "%.2g +- %.2g", value, error);
        return number;
    }
    return gb_number_error(value, error, 2, " +- ", number);
}

static void add_parameter(GString *text, const struct gb_calibration *calibration,
                          size_t k)
{
    const struct gb_calibrate_result *result = &calibration->result;
    const struct gb_free_key *key = &calibration->keys.key[k];
    const char *unit = unit_of(key);
    char name[NAME_MAX_BYTES];
    name_of(calibration, k, name);
    if (isinf(result->error[k])) {
        g_string_append_printf(text, "%s%s\n", name, no_influence);
        return;
    }
    char number[GB_NUMBER_ERROR_MAX];
    g_string_append_printf(text, "%s = %s, 95 %%: %.4g to %.4g%s%s\n", name,
                           write_value(result->value[k], result->error[k], number),
                           result->low[k], result->high[k], *unit ? " " : "", unit);
    if (result->low_open[k] || result->high_open[k]) {
        const char *end = result->low_open[k] ? "lower limit" : "upper limit";
        g_string_append_printf(text,
                               "  the data leave the interval open: it ends at the %s of "
                               "the range %.4g to %.4g\n",
                               result->low_open[k] && result->high_open[k] ? "limits"
                                                                           : end,
                               key->low, key->high);
    }
    if (result->at_limit[k]) {
        g_string_append_printf(text,
                               "  at the limit of its range %.4g to %.4g: the best value "
                               "may lie beyond\n",
                               key->low, key->high);
    }
}

static void add_correlation(GString *text, const struct gb_calibration *calibration,
                            size_t i, size_t j)
{
    const struct gb_calibrate_result *result = &calibration->result;
    char first[NAME_MAX_BYTES], second[NAME_MAX_BYTES];
    name_of(calibration, i, first);
    name_of(calibration, j, second);
    g_string_append_printf(text, "correlation of %s and %s: %.2f\n", first, second,
                           result->correlation[i][j]);
    if (gb_calibration_confounded(result, i, j)) {
        g_string_append_printf(text,
                               "  the data cannot separate %s and %s: fix one of them, "
                               "or add data that depend on them differently\n",
                               first, second);
    }
}

GString *gb_calibration_text(const struct gb_calibration *calibration)
{
    const struct gb_calibrate_result *result = &calibration->result;
    const size_t n = calibration->keys.count;
    GString *text = g_string_new(NULL);
    for (size_t k = 0; k < n; k++) {
        add_parameter(text, calibration, k);
    }
    for (size_t i = 0; i < n; i++) {
        for (size_t j = i + 1; j < n; j++) {
            add_correlation(text, calibration, i, j);
        }
    }
    add_residuals(text, calibration);
    if (isfinite(result->chi_squared) && result->degrees > 0) {
        g_string_append_printf(text, ", chi-squared %.3g for %zu degrees of freedom",
                               result->chi_squared, result->degrees);
    }
    g_string_append_printf(text, "\n%zu cells simulated, %zu of them failed\n",
                           result->simulated, result->failed);
    if (!result->converged) {
        g_string_append_printf(text, "%s within its rounds: intervals may be too wide\n",
                               not_converged);
    }
    return text;
}
