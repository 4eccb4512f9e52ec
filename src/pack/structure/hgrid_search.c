#include "pack/structure/hgrid_search.h"

#include <math.h>

#include "base/alloc.h"
#include "base/team/team.h"
#include "pack/kernel/lanes.h"
#include "pack/kernel/simd.h"
#include "scene/tolerances.h"

/* Number of pairs that is accepted for any number of spheres. */
static const int64_t pairs_least = 1 << 16;

/* Spheres of a part, at least, and parts at most. */
enum { PART_SPHERES = 128, PARTS_MAX = 64 };

void gb_hgrid_search_finish(struct gb_hgrid *hgrid)
{
    for (int k = 0; hgrid->part && k < PARTS_MAX; k++) {
        gb_alloc_free(hgrid->part[k].found);
    }
    gb_alloc_free(hgrid->part);
    hgrid->part = NULL;
}

int64_t gb_hgrid_search_begin(const struct gb_hgrid_search *search, int part)
{
    return search->count * part / search->hgrid->parts;
}

static bool check_number(const struct gb_hgrid_search *search, int64_t pairs,
                         struct gb_error *err)
{
    const int64_t by_count = GB_HGRID_PAIRS_PER_SPHERE_MAX * search->count;
    const int64_t most = by_count > pairs_least ? by_count : pairs_least;
    return pairs <= most ||
           gb_error_set(
               err, GB_ERR_GUARD,
               "more than %lld near pairs among %lld spheres: they overlap too much",
               (long long)most, (long long)search->count);
}

/* Room for `more` partners behind those of the part. */
static bool reserve(const struct gb_hgrid_search *search, struct gb_hgrid_part *part,
                    int64_t more)
{
    const int64_t need = part->count + more;
    if (need <= part->room) {
        return true;
    }
    if (!check_number(search, part->count, &part->err)) {
        return false;
    }
    const int64_t room = need + need / 2 + 8 * PART_SPHERES;
    int32_t *found = gb_alloc_grow(part->found, (size_t)part->count, (size_t)room,
                                   sizeof *found, &part->err);
    if (!found) {
        return false;
    }
    part->found = found;
    part->room = room;
    return true;
}

/* Cells from low to high, both included; along periodic axes they may lie one period
 * outside. */
struct span {
    int low, high;
};

GB_SIMD_LOOP struct span span_of(const struct gb_hgrid_search *search,
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

/* Sorted spheres [from, to) against sphere p: names of those that are near behind those of the
 * part, which has room. */
GB_SIMD_LOOP void scan(const struct gb_hgrid_search *search, struct gb_hgrid_part *part,
                       int64_t p, int64_t from, int64_t to)
{
    const struct gb_hgrid *hgrid = search->hgrid;
    const int32_t *restrict name = hgrid->name;
    int32_t *restrict found = part->found;
    int64_t count = part->count;
    const gb_lanes_mask lane = {0, 1, 2, 3};
    for (int64_t q = from; q < to; q += 4) {
        gb_lanes square = GB_LANES_ALL(0.0);
        for (int k = 0; k < 3; k++) {
            const gb_lanes r = GB_LANES_MAGNITUDE(GB_LANES_ALL(hgrid->sorted[k][p]) -
                                                  GB_LANES_AT(hgrid->sorted[k], q));
            const gb_lanes other = GB_LANES_ALL(search->edge[k]) - r;
            const gb_lanes nearest = GB_LANES_SELECTED(r < other, r, other);
            square += nearest * nearest;
        }
        const gb_lanes reach = GB_LANES_ALL(hgrid->sorted[GB_HGRID_REACH][p]) +
                               GB_LANES_AT(hgrid->sorted[GB_HGRID_REACH], q);
        const int64_t left = to - q;
        const gb_lanes_mask near =
            (square < reach * reach) & (lane < (gb_lanes_mask){left, left, left, left});
        for (int l = 0; l < 4; l++) {
            found[count] = name[q + l];
            count -= near[l];
        }
    }
    part->count = count;
}

/* Which spheres of a level are neighbours of sorted sphere p: in its own level only the
 * spheres behind it in the order, so that every pair is found once. */
enum hgrid_partners { ALL_OF_LEVEL, BEHIND_IN_LEVEL };

/* One row of cells along x, which may extend beyond the period once. */
GB_SIMD_LOOP bool scan_row(const struct gb_hgrid_search *search,
                           struct gb_hgrid_part *part, const struct gb_hgrid_level *level,
                           int64_t p, int32_t row, struct span x,
                           enum hgrid_partners partners)
{
    const int32_t *start = search->hgrid->cell_start + level->first_cell + row;
    const int cells = level->cells[0];
    struct span piece[2] = {x, {0, -1}};
    if (x.low < 0) {
        piece[0] = (struct span){0, x.high};
        piece[1] = (struct span){x.low + cells, cells - 1};
    } else if (x.high >= cells) {
        piece[0] = (struct span){0, x.high - cells};
        piece[1] = (struct span){x.low, cells - 1};
    }
    for (int k = 0; k < 2 && piece[k].high >= piece[k].low; k++) {
        int64_t from = start[piece[k].low];
        const int64_t to = start[piece[k].high + 1];
        from = partners == BEHIND_IN_LEVEL && from <= p ? p + 1 : from;
        if (from < to) {
            if (!reserve(search, part, to - from + 4)) {
                return false;
            }
            scan(search, part, p, from, to);
        }
    }
    return true;
}

/* Neighbours of sorted sphere p in a level: its own, or one of larger spheres. */
GB_SIMD_LOOP bool scan_level(const struct gb_hgrid_search *search,
                             struct gb_hgrid_part *part,
                             const struct gb_hgrid_level *level, int64_t p,
                             enum hgrid_partners partners)
{
    double *const *sorted = search->hgrid->sorted;
    const double range = sorted[GB_HGRID_REACH][p] + level->widest;
    const int *cells = level->cells;
    struct span span[3];
    for (int k = 0; k < 3; k++) {
        span[k] = span_of(search, level, k, sorted[k][p], range);
    }
    for (int z = span[2].low; z <= span[2].high; z++) {
        for (int y = span[1].low; y <= span[1].high; y++) {
            const int32_t row =
                (wrapped(z, cells[2]) * cells[1] + wrapped(y, cells[1])) * cells[0];
            if (!scan_row(search, part, level, p, row, span[0], partners)) {
                return false;
            }
        }
    }
    return true;
}

/* Neighbours of sorted sphere p of level l. */
GB_SIMD_LOOP bool scan_sphere(const struct gb_hgrid_search *search,
                              struct gb_hgrid_part *part, int64_t p, int l)
{
    for (int m = 0; m <= l; m++) {
        const struct gb_hgrid_level *level = &search->level[m];
        const enum hgrid_partners partners = m == l ? BEHIND_IN_LEVEL : ALL_OF_LEVEL;
        if (level->count > 0 && !scan_level(search, part, level, p, partners)) {
            return false;
        }
    }
    return true;
}

GB_SIMD_LOOP void search_part_loop(const struct gb_hgrid_search *search, int number)
{
    struct gb_hgrid_part *part = &search->hgrid->part[number];
    const int64_t end = gb_hgrid_search_begin(search, number + 1);
    int64_t p = gb_hgrid_search_begin(search, number), level_end = 0;
    for (int l = 0; l < GB_HGRID_LEVELS && p < end; l++) {
        level_end += search->level[l].count;
        for (; p < level_end && p < end; p++) {
            const int64_t before = part->count;
            if (!scan_sphere(search, part, p, l)) {
                return;
            }
            search->hgrid->partners[p] = (int32_t)(part->count - before);
        }
    }
    part->done = true;
}
GB_SIMD_WIDTHS(search_part, (const struct gb_hgrid_search *search, int number),
               (search, number))

static void search_item(void *data, int64_t number)
{
    search_part(data, (int)number);
}

static bool make_parts(struct gb_hgrid_search *search, struct gb_error *err)
{
    struct gb_hgrid *hgrid = search->hgrid;
    const int64_t parts = search->count / PART_SPHERES;
    hgrid->parts = parts < 1 ? 1 : parts > PARTS_MAX ? PARTS_MAX : (int)parts;
    if (!hgrid->part) {
        hgrid->part = gb_alloc_array(PARTS_MAX, sizeof *hgrid->part, err);
    }
    for (int k = 0; hgrid->part && k < hgrid->parts; k++) {
        hgrid->part[k].count = 0;
        hgrid->part[k].done = false;
    }
    return hgrid->part;
}

bool gb_hgrid_search_run(struct gb_hgrid_search *search, struct gb_error *err)
{
    struct gb_hgrid *hgrid = search->hgrid;
    if (!make_parts(search, err)) {
        return false;
    }
    gb_team_run(hgrid->team, hgrid->parts, search_item, search);
    for (int k = 0; k < hgrid->parts; k++) {
        if (!hgrid->part[k].done) {
            return gb_error_set(err, hgrid->part[k].err.code, "%s",
                                hgrid->part[k].err.text);
        }
        search->found += hgrid->part[k].count;
    }
    return check_number(search, search->found, err);
}
