#include "study/calibrate/calibrate_samples.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"

enum { FREE = GB_CALIBRATE_FREE, DESIGN_MAX = 32 };

/* Points within this many half widths of the centre are used again. */
static const double near_half_widths = 1.25;

static bool reserve(struct gb_calibrate_samples *samples, size_t more,
                    struct gb_error *err)
{
    const struct gb_calibrate_problem *problem = samples->problem;
    const size_t need = samples->count + more;
    if (need <= samples->capacity) {
        return true;
    }
    const size_t capacity = 2 * need;
    const size_t cells = problem->replicas * problem->data;
    struct gb_calibrate_samples next = {
        .problem = problem, .count = samples->count, .capacity = capacity};
    next.at = gb_alloc_array(capacity * problem->free, sizeof *next.at, err);
    next.value =
        next.at ? gb_alloc_array(capacity * cells, sizeof *next.value, err) : NULL;
    next.stage = next.value ? gb_alloc_array(capacity, sizeof *next.stage, err) : NULL;
    if (next.stage == NULL) {
        gb_calibrate_samples_finish(&next);
        return false;
    }
    if (samples->count > 0) {
        memcpy(next.at, samples->at, samples->count * problem->free * sizeof *next.at);
        memcpy(next.value, samples->value, samples->count * cells * sizeof *next.value);
        memcpy(next.stage, samples->stage, samples->count * sizeof *next.stage);
    }
    gb_calibrate_samples_finish(samples);
    *samples = next;
    return true;
}

void gb_calibrate_samples_finish(struct gb_calibrate_samples *samples)
{
    gb_alloc_free(samples->at);
    gb_alloc_free(samples->value);
    gb_alloc_free(samples->stage);
    *samples = (struct gb_calibrate_samples){0};
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
                          const struct gb_calibrate_region *region, double *design)
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

static bool is_known(const struct gb_calibrate_samples *samples,
                     enum gb_calibrate_stage stage, const double *at)
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
static size_t add_points(struct gb_calibrate_samples *samples,
                         enum gb_calibrate_stage stage, const double *design,
                         size_t points)
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

bool gb_calibrate_samples_add(struct gb_calibrate_samples *samples,
                              const struct gb_calibrate_region *region,
                              enum gb_calibrate_stage stage,
                              struct gb_calibrate_result *result, struct gb_error *err)
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

static bool is_near(const struct gb_calibrate_samples *samples,
                    const struct gb_calibrate_region *region, size_t point)
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

size_t gb_calibrate_samples_near(const struct gb_calibrate_samples *samples,
                                 const struct gb_calibrate_region *region,
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
