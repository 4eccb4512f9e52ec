#include "pack/structure/hgrid.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "pack/structure/hgrid_levels.h"
#include "scene/tolerances.h"

/* Spheres at most, so that cells can be counted in 32 bits. */
static const int64_t spheres_most = (int64_t)1 << 28;

/* Number of pairs that is accepted for any number of spheres. */
static const int64_t pairs_least = 1 << 16;

static void drop_pairs(struct gb_hgrid *hgrid)
{
    gb_alloc_free(hgrid->other);
    gb_alloc_free(hgrid->found);
    gb_alloc_free(hgrid->earlier);
    hgrid->other = hgrid->found = hgrid->earlier = NULL;
    hgrid->pair_capacity = 0;
}

void gb_hgrid_finish(struct gb_hgrid *hgrid)
{
    drop_pairs(hgrid);
    gb_alloc_free(hgrid->start);
    gb_alloc_free(hgrid->sphere);
    gb_alloc_free(hgrid->name);
    gb_alloc_free(hgrid->cell);
    gb_alloc_free(hgrid->cell_start);
    gb_alloc_free(hgrid->later_start);
    *hgrid = (struct gb_hgrid){0};
}

bool gb_hgrid_init(struct gb_hgrid *hgrid, int64_t capacity, struct gb_error *err)
{
    *hgrid = (struct gb_hgrid){.capacity = capacity, .levels = GB_HGRID_LEVELS};
    if (capacity < 0 || capacity > spheres_most) {
        return gb_error_set(err, GB_ERR_INPUT, "%lld spheres: must be at most %lld",
                            (long long)capacity, (long long)spheres_most);
    }
    const size_t n = (size_t)capacity;
    const size_t cells =
        GB_HGRID_CELLS_PER_SPHERE * n + GB_HGRID_LEVELS * GB_HGRID_CELLS_MIN + 1;
    hgrid->start = gb_alloc_array(n + 1, sizeof *hgrid->start, err);
    hgrid->later_start = gb_alloc_array(n + 1, sizeof *hgrid->later_start, err);
    hgrid->sphere = gb_alloc_array(n, sizeof *hgrid->sphere, err);
    hgrid->name = gb_alloc_array(n, sizeof *hgrid->name, err);
    hgrid->cell = gb_alloc_array(n, sizeof *hgrid->cell, err);
    hgrid->cell_start = gb_alloc_array(cells, sizeof *hgrid->cell_start, err);
    if (!hgrid->start || !hgrid->later_start || !hgrid->sphere || !hgrid->name ||
        !hgrid->cell || !hgrid->cell_start) {
        gb_hgrid_finish(hgrid);
        return false;
    }
    return true;
}

static bool ready(struct gb_hgrid *hgrid, int64_t count, struct gb_error *err)
{
    hgrid->pair_count = 0;
    if (count <= hgrid->capacity && hgrid->start) {
        return true;
    }
    const int levels = hgrid->start ? hgrid->levels : GB_HGRID_LEVELS;
    gb_hgrid_finish(hgrid);
    const bool good = gb_hgrid_init(hgrid, count, err);
    hgrid->levels = levels;
    return good;
}

/* Room for `need` pairs; the pairs found so far are kept. */
static bool reserve(struct gb_hgrid_search *search, int64_t need, struct gb_error *err)
{
    struct gb_hgrid *hgrid = search->hgrid;
    const int64_t most = GB_HGRID_PAIRS_PER_SPHERE_MAX * search->count;
    if (search->found > (most > pairs_least ? most : pairs_least)) {
        return gb_error_set(
            err, GB_ERR_GUARD,
            "more than %lld near pairs among %lld spheres: they overlap too much",
            (long long)search->found, (long long)search->count);
    }
    const size_t room = (size_t)(need + need / 2);
    int32_t *found = gb_alloc_array(2 * room, sizeof *found, err);
    int32_t *other = found ? gb_alloc_array(room, sizeof *other, err) : NULL;
    int32_t *earlier = other ? gb_alloc_array(room, sizeof *earlier, err) : NULL;
    if (!earlier) {
        gb_alloc_free(found);
        gb_alloc_free(other);
        return false;
    }
    if (search->found > 0) {
        memcpy(found, hgrid->found, 2 * (size_t)search->found * sizeof *found);
    }
    drop_pairs(hgrid);
    hgrid->found = found;
    hgrid->other = other;
    hgrid->earlier = earlier;
    hgrid->pair_capacity = (int64_t)room;
    return true;
}

/* Checks that the spheres are finite and not negative; finds the largest reach. */
static bool check_spheres(struct gb_hgrid_search *search, const double (*sphere)[4],
                          const double *margin, double skin, struct gb_error *err)
{
    for (int64_t i = 0; i < search->count; i++) {
        const double *s = sphere[i];
        const double reach = gb_hgrid_levels_reach(s, margin, i, skin);
        /* 0 times a number that is not finite is not 0; squares must be finite too */
        const double squares = s[0] * s[0] + s[1] * s[1] + s[2] * s[2] + reach * reach;
        if (0.0 * squares != 0.0 || s[3] < 0.0 || reach < 0.0) {
            return gb_error_set(
                err, GB_ERR_GUARD,
                "sphere %lld: must be finite with a radius of at least 0: "
                "position (%.3g, %.3g, %.3g), radius %.3g, margin %.3g",
                (long long)i, s[0], s[1], s[2], s[3], margin ? margin[i] : 0.0);
        }
        search->widest = reach > search->widest ? reach : search->widest;
    }
    return true;
}

/* Cells from low to high, both included; along periodic axes they may lie one period
 * outside. */
struct span {
    int low, high;
};

static struct span span_of(const struct gb_hgrid_search *search,
                           const struct gb_hgrid_level *level, int k, double x,
                           double range)
{
    const int cells = level->cells[k];
    if (isinf(search->edge[k])) {
        return (struct span){gb_hgrid_levels_index(search, level, k, x - range),
                             gb_hgrid_levels_index(search, level, k, x + range)};
    }
    /* shifted by a period, so that the conversion rounds down */
    const double at = (x - search->low[k]) * level->per_width[k] + cells;
    const double wide = range * level->per_width[k];
    const struct span span = {(int)(at - wide) - cells, (int)(at + wide) - cells};
    return span.high - span.low + 1 < cells ? span : (struct span){0, cells - 1};
}

static int wrapped(int index, int cells)
{
    return index < 0 ? index + cells : index >= cells ? index - cells : index;
}

/* Sorted spheres [from, to) against sphere p. */
static bool scan(struct gb_hgrid_search *search, int64_t p, int64_t from, int64_t to,
                 struct gb_error *err)
{
    struct gb_hgrid *hgrid = search->hgrid;
    if (search->found + (to - from) > hgrid->pair_capacity &&
        !reserve(search, search->found + (to - from) + 8 * search->count, err)) {
        return false;
    }
    const struct gb_hgrid_sphere a = hgrid->sphere[p];
    const int32_t name = hgrid->name[p];
    int64_t found = search->found;
    for (int64_t q = from; q < to; q++) {
        const struct gb_hgrid_sphere *b = &hgrid->sphere[q];
        double square = 0.0;
        for (int k = 0; k < 3; k++) {
            const double r = fabs(a.x[k] - b->x[k]), other = search->edge[k] - r;
            const double nearest = r < other ? r : other;
            square += nearest * nearest;
        }
        const double reach = a.reach + b->reach;
        const int32_t met = hgrid->name[q];
        hgrid->found[2 * found] = met < name ? met : name;
        hgrid->found[2 * found + 1] = met < name ? name : met;
        found += square < reach * reach;
    }
    search->found = found;
    return true;
}

/* Which spheres of a level are neighbours of sorted sphere p: in its own level only the
 * spheres behind it in the order, so that every pair is found once. */
enum hgrid_partners { ALL_OF_LEVEL, BEHIND_IN_LEVEL };

/* One row of cells along x, which may extend beyond the period once. */
static bool scan_row(struct gb_hgrid_search *search, const struct gb_hgrid_level *level,
                     int64_t p, int32_t row, struct span x, enum hgrid_partners partners,
                     struct gb_error *err)
{
    const int32_t *start = search->hgrid->cell_start + level->first_cell + row;
    const int cells = level->cells[0];
    struct span part[2] = {x, {0, -1}};
    if (x.low < 0) {
        part[0] = (struct span){0, x.high};
        part[1] = (struct span){x.low + cells, cells - 1};
    } else if (x.high >= cells) {
        part[0] = (struct span){0, x.high - cells};
        part[1] = (struct span){x.low, cells - 1};
    }
    for (int k = 0; k < 2; k++) {
        if (part[k].high < part[k].low) {
            continue;
        }
        int64_t from = start[part[k].low];
        const int64_t to = start[part[k].high + 1];
        from = partners == BEHIND_IN_LEVEL && from <= p ? p + 1 : from;
        if (from < to && !scan(search, p, from, to, err)) {
            return false;
        }
    }
    return true;
}

/* Neighbours of sorted sphere p in a level: its own, or one of larger spheres. */
static bool scan_level(struct gb_hgrid_search *search, const struct gb_hgrid_level *level,
                       int64_t p, enum hgrid_partners partners, struct gb_error *err)
{
    const struct gb_hgrid_sphere *s = &search->hgrid->sphere[p];
    const double range = s->reach + level->widest;
    const int *cells = level->cells;
    struct span span[3];
    for (int k = 0; k < 3; k++) {
        span[k] = span_of(search, level, k, s->x[k], range);
    }
    for (int z = span[2].low; z <= span[2].high; z++) {
        for (int y = span[1].low; y <= span[1].high; y++) {
            const int32_t row =
                (wrapped(z, cells[2]) * cells[1] + wrapped(y, cells[1])) * cells[0];
            if (!scan_row(search, level, p, row, span[0], partners, err)) {
                return false;
            }
        }
    }
    return true;
}

static bool find_pairs(struct gb_hgrid_search *search, struct gb_error *err)
{
    int64_t p = 0;
    for (int l = 0; l < GB_HGRID_LEVELS; l++) {
        for (const int64_t end = p + search->level[l].count; p < end; p++) {
            for (int m = 0; m <= l; m++) {
                const struct gb_hgrid_level *level = &search->level[m];
                const enum hgrid_partners partners =
                    m == l ? BEHIND_IN_LEVEL : ALL_OF_LEVEL;
                if (level->count > 0 && !scan_level(search, level, p, partners, err)) {
                    return false;
                }
            }
        }
    }
    return true;
}

/* From counts at [i + 1] to where each list starts. */
static void add_up(int64_t *start, int64_t count)
{
    for (int64_t i = 0; i < count; i++) {
        start[i + 1] += start[i];
    }
}

/* Sorts the pairs by their later sphere, then, keeping that order, by the earlier one. */
static void sort_pairs(struct gb_hgrid_search *search)
{
    struct gb_hgrid *hgrid = search->hgrid;
    const int64_t n = search->count, pairs = search->found;
    int64_t *start = hgrid->start, *later = hgrid->later_start;
    memset(start, 0, ((size_t)n + 1) * sizeof *start);
    memset(later, 0, ((size_t)n + 1) * sizeof *later);
    for (int64_t k = 0; k < pairs; k++) {
        start[hgrid->found[2 * k] + 1]++;
        later[hgrid->found[2 * k + 1] + 1]++;
    }
    add_up(start, n);
    add_up(later, n);
    for (int64_t k = 0; k < pairs; k++) {
        hgrid->earlier[later[hgrid->found[2 * k + 1]]++] = hgrid->found[2 * k];
    }
    int64_t k = 0; /* later[j] has become the end of list j */
    for (int64_t j = 0; j < n; j++) {
        for (; k < later[j]; k++) {
            hgrid->other[start[hgrid->earlier[k]]++] = (int32_t)j;
        }
    }
    memmove(start + 1, start, (size_t)n * sizeof *start);
    start[0] = 0;
    hgrid->pair_count = pairs;
}

bool gb_hgrid_build(struct gb_hgrid *hgrid, const struct gb_hgrid_box *box, int64_t count,
                    const double (*sphere)[4], const double *margin, double skin,
                    struct gb_error *err)
{
    struct gb_hgrid_search search = {.hgrid = hgrid, .count = count};
    if (!ready(hgrid, count, err) || !check_spheres(&search, sphere, margin, skin, err) ||
        !gb_hgrid_levels_bounds(&search, box, sphere, err)) {
        return false;
    }
    if (search.widest > 0.0) {
        gb_hgrid_levels_assign(&search, sphere, margin, skin);
        gb_hgrid_levels_sort(&search, sphere, margin, skin);
        if (!find_pairs(&search, err)) {
            return false;
        }
    }
    sort_pairs(&search);
    return true;
}
