#include "pack/structure/hgrid.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "pack/structure/hgrid_levels.h"
#include "pack/structure/hgrid_search.h"

/* Spheres at most, so that cells can be counted in 32 bits. */
static const int64_t spheres_most = (int64_t)1 << 28;

static void drop_pairs(struct gb_hgrid *hgrid)
{
    gb_alloc_free(hgrid->other);
    gb_alloc_free(hgrid->earlier);
    hgrid->other = hgrid->earlier = NULL;
    hgrid->pair_capacity = 0;
}

void gb_hgrid_finish(struct gb_hgrid *hgrid)
{
    drop_pairs(hgrid);
    gb_hgrid_search_finish(hgrid);
    gb_alloc_free(hgrid->start);
    for (int k = 0; k < GB_HGRID_ROWS; k++) {
        gb_alloc_free(hgrid->sorted[k]);
    }
    gb_alloc_free(hgrid->partners);
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
    bool sorted = true;
    for (int k = 0; k < GB_HGRID_ROWS; k++) {
        hgrid->sorted[k] = gb_alloc_array(n + GB_HGRID_SLACK, sizeof(double), err);
        sorted = sorted && hgrid->sorted[k];
    }
    hgrid->name = gb_alloc_array(n + GB_HGRID_SLACK, sizeof *hgrid->name, err);
    hgrid->partners = gb_alloc_array(n, sizeof *hgrid->partners, err);
    hgrid->cell = gb_alloc_array(n, sizeof *hgrid->cell, err);
    hgrid->cell_start = gb_alloc_array(cells, sizeof *hgrid->cell_start, err);
    if (!hgrid->start || !hgrid->later_start || !sorted || !hgrid->name ||
        !hgrid->partners || !hgrid->cell || !hgrid->cell_start) {
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
    struct gb_team *team = hgrid->team;
    gb_hgrid_finish(hgrid);
    const bool good = gb_hgrid_init(hgrid, count, err);
    hgrid->levels = levels;
    hgrid->team = team;
    return good;
}

/* Room for the pairs that were found. */
static bool reserve(struct gb_hgrid_search *search, struct gb_error *err)
{
    struct gb_hgrid *hgrid = search->hgrid;
    if (search->found <= hgrid->pair_capacity && hgrid->other) {
        return true;
    }
    drop_pairs(hgrid);
    const size_t room = (size_t)(search->found + search->found / 2 + 1);
    hgrid->other = gb_alloc_array(room, sizeof *hgrid->other, err);
    hgrid->earlier = gb_alloc_array(room, sizeof *hgrid->earlier, err);
    if (!hgrid->other || !hgrid->earlier) {
        drop_pairs(hgrid);
        return false;
    }
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

/* From counts at [i + 1] to where each list starts. */
static void add_up(int64_t *start, int64_t count)
{
    for (int64_t i = 0; i < count; i++) {
        start[i + 1] += start[i];
    }
}

/* What is done with a pair of spheres, the earlier one first. */
typedef void pair_work(struct gb_hgrid *hgrid, int32_t earlier, int32_t later);

static void count_pair(struct gb_hgrid *hgrid, int32_t earlier, int32_t later)
{
    hgrid->start[earlier + 1]++;
    hgrid->later_start[later + 1]++;
}

static void sort_by_later(struct gb_hgrid *hgrid, int32_t earlier, int32_t later)
{
    hgrid->earlier[hgrid->later_start[later]++] = earlier;
}

/* Inlined, so that the work is no call. */
static inline __attribute__((always_inline)) void
for_pairs(const struct gb_hgrid_search *search, pair_work *work)
{
    struct gb_hgrid *hgrid = search->hgrid;
    for (int part = 0; part < hgrid->parts; part++) {
        const int64_t end = gb_hgrid_search_begin(search, part + 1);
        const int32_t *found = hgrid->part[part].found;
        for (int64_t p = gb_hgrid_search_begin(search, part); p < end; p++) {
            const int32_t a = hgrid->name[p];
            for (int32_t k = 0; k < hgrid->partners[p]; k++) {
                const int32_t b = *found++;
                work(hgrid, a < b ? a : b, a < b ? b : a);
            }
        }
    }
}

/* Sorts the pairs by their later sphere, then, keeping that order, by the earlier one. */
static void sort_pairs(struct gb_hgrid_search *search)
{
    struct gb_hgrid *hgrid = search->hgrid;
    const int64_t n = search->count;
    int64_t *start = hgrid->start, *later = hgrid->later_start;
    memset(start, 0, ((size_t)n + 1) * sizeof *start);
    memset(later, 0, ((size_t)n + 1) * sizeof *later);
    for_pairs(search, count_pair);
    add_up(start, n);
    add_up(later, n);
    for_pairs(search, sort_by_later);
    int64_t k = 0; /* later[j] has become the end of list j */
    for (int64_t j = 0; j < n; j++) {
        for (; k < later[j]; k++) {
            hgrid->other[start[hgrid->earlier[k]]++] = (int32_t)j;
        }
    }
    memmove(start + 1, start, (size_t)n * sizeof *start);
    start[0] = 0;
    hgrid->pair_count = search->found;
}

bool gb_hgrid_build(struct gb_hgrid *hgrid, const struct gb_hgrid_box *box, int64_t count,
                    const double (*sphere)[4], const double *margin, double skin,
                    struct gb_error *err)
{
    struct gb_hgrid_search search = {.hgrid = hgrid, .count = count};
    hgrid->parts = 0;
    if (!ready(hgrid, count, err) || !check_spheres(&search, sphere, margin, skin, err) ||
        !gb_hgrid_levels_bounds(&search, box, sphere, err)) {
        return false;
    }
    if (search.widest > 0.0) {
        gb_hgrid_levels_assign(&search, sphere, margin, skin);
        gb_hgrid_levels_sort(&search, sphere, margin, skin);
        if (!gb_hgrid_search_run(&search, err) || !reserve(&search, err)) {
            return false;
        }
    }
    sort_pairs(&search);
    return true;
}
