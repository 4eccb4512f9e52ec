#include "tui/session/overlay/compaction_cache.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"

static bool is_current(const struct gb_compaction_cache *cache,
                       const struct gb_curve *curve, size_t points,
                       enum gb_compaction_intervals intervals)
{
    return cache->curve == curve && cache->points == points &&
           cache->intervals == intervals &&
           cache->first == gb_curve_at(curve, 0)->density;
}

/* The loading branch as arrays (MPa, density); D0: density of the last point before. */
static size_t take_loading(const struct gb_curve *curve, size_t points, double *pressure,
                           double *density, double *initial)
{
    size_t count = 0;
    *initial = NAN;
    for (size_t i = 0; i < points; i++) {
        const struct gb_point *point = gb_curve_at(curve, i);
        if (point->branch == GB_BRANCH_LOAD && isfinite(point->p_pa)) {
            pressure[count] = 1e-6 * point->p_pa;
            density[count++] = point->density;
        } else if (point->branch == GB_BRANCH_RELAX && count == 0) {
            *initial = point->density;
        }
    }
    return count;
}

static bool fit(struct gb_compaction_cache *cache, const struct gb_curve *curve,
                size_t points)
{
    const struct gb_compaction_window window = {
        .from = (double)NAN, .to = (double)NAN, .initial = (double)NAN};
    struct gb_error *err = &cache->reason;
    double *pressure = gb_alloc_array(2 * points, sizeof *pressure, err);
    if (pressure == NULL) {
        return false;
    }
    double initial = NAN;
    struct gb_average_curve loading = {.x = pressure, .y = pressure + points};
    loading.count = take_loading(curve, points, pressure, pressure + points, &initial);
    const bool good =
        gb_compaction_data_curves(&cache->data, &loading, 1, initial, &window, err) &&
        gb_compaction_fits(&cache->fits, &cache->data.points, NULL, cache->intervals,
                           err);
    gb_alloc_free(pressure);
    return good;
}

bool gb_compaction_cache_update(struct gb_compaction_cache *cache,
                                const struct gb_curve *curve, size_t points,
                                enum gb_compaction_intervals intervals)
{
    if (!is_current(cache, curve, points, intervals)) {
        gb_compaction_cache_finish(cache);
        *cache = (struct gb_compaction_cache){.curve = curve,
                                              .points = points,
                                              .first = gb_curve_at(curve, 0)->density,
                                              .intervals = intervals};
        cache->fitted = fit(cache, curve, points) && cache->fits.fitted > 0;
    }
    return cache->fitted;
}

void gb_compaction_cache_finish(struct gb_compaction_cache *cache)
{
    gb_compaction_data_finish(&cache->data);
    memset(cache, 0, sizeof *cache);
}
