/* Hierarchical grid: all pairs of spheres of many sizes that are near each other.
 *
 * In a grid whose cells fit the largest sphere each cell holds hundreds of the smallest.  Here
 * spheres are sorted by size into levels, each at least a factor of 2 wide, with a grid each:
 *   levels   bounds of the levels, and the shape of their grids
 *   sort     spheres by level, then by grid cell (a counting sort)
 *   search   partners of each sphere in its own level and in those of larger spheres
 *   pairs    every pair once, sorted by its first sphere and then by its second
 * The work is linear in the number of spheres for any distribution of sizes.  Threads search
 * consecutive parts of the sorted spheres; the pairs do not depend on the number of threads. */

#include "pack/structure/hgrid.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/team.h"
#include "pack/kernel/lanes.h"
#include "pack/kernel/simd.h"
#include "scene/tolerances.h"

/* ---- Levels ---- */

/* Levels of size, each at least a factor of 2; spheres smaller than the last share it. */
enum { GB_HGRID_LEVELS = 16 };

/* Grid cells per sphere of a level at most; where spheres are rarer the cells are wider.
 */
enum { GB_HGRID_CELLS_PER_SPHERE = 2, GB_HGRID_CELLS_MIN = 64 };

struct level {
    double widest; /* largest reach */
    int64_t count; /* spheres */
    int cells[3];
    double per_width[3]; /* cells per length */
    int32_t first_cell;  /* in cell_start */
};

struct search {
    struct gb_hgrid *hgrid;
    double low[3], high[3]; /* of the grids */
    double edge[3];         /* INFINITY where not periodic */
    int64_t count;
    int64_t found; /* pairs so far */
    double widest;
    struct level level[GB_HGRID_LEVELS]; /* the largest spheres first */
    int level_of[GB_HGRID_LEVELS];       /* that of the spheres of each factor of 2 */
};

/* Width of a grid cell over the largest reach of its level; 1.5 and 3 are a tenth slower
 * for one size and for P3's. */
static const double cell_width = 2.0;

/* Spheres in a cell up to which a level takes those of the next.  Four are compared at a time, and
 * a level more is nine rows of cells more for each sphere. */
static const double per_cell_most = 12.0;

static double clamp(double value, double low, double high)
{
    return value < low ? low : value > high ? high : value;
}

/* Reach of a sphere: radius, half the skin and margin.  Pairs closer than the sum of two
 * reaches are listed. */
static double reach_of(const double sphere[4], const double *margin, int64_t i,
                       double skin)
{
    return sphere[3] + 0.5 * skin + (margin ? margin[i] : 0.0);
}

/* Factors of 2 below the largest sphere. */
static int factors_of(const struct search *search, double reach)
{
    const double ratio = search->widest / reach;
    const int last = search->hgrid->levels - 1;
    return ratio < (double)(1 << last) ? ilogb(ratio) : last;
}

static int level_of(const struct search *search, double reach)
{
    return search->level_of[factors_of(search, reach)];
}

/* Sets the bounds of the grids.  Errors: GB_ERR_GUARD for a periodic edge too short. */
/* The grids cover the box along periodic axes, along others its part with spheres. */
static bool bounds(struct search *search, const struct gb_hgrid_box *box,
                   const double (*sphere)[4], struct gb_error *err)
{
    for (int k = 0; k < 3; k++) {
        double low = box->low[k], high = box->high[k];
        search->edge[k] = INFINITY;
        if (box->periodic[k]) {
            search->edge[k] = high - low;
            const double shortest = 4.0 * search->widest;
            if (!(high - low >= shortest) || isinf(high - low)) {
                return gb_error_set(
                    err, GB_ERR_GUARD,
                    "the box is %.3g wide along %c: must be at least twice "
                    "the range of the largest pair, %.3g",
                    high - low, "xyz"[k], shortest);
            }
        } else {
            double least = INFINITY, most = -INFINITY;
            for (int64_t i = 0; i < search->count; i++) {
                const double x = clamp(sphere[i][k], low, high);
                least = x < least ? x : least;
                most = x > most ? x : most;
            }
            low = least;
            high = most;
        }
        search->low[k] = low;
        search->high[k] = high;
    }
    return true;
}

static void shape_level(const struct search *search, struct level *level)
{
    const double most =
        fmax(GB_HGRID_CELLS_MIN, GB_HGRID_CELLS_PER_SPHERE * (double)level->count);
    double extent[3], cells[3] = {1.0, 1.0, 1.0};
    double width = cell_width * level->widest, product = INFINITY;
    for (int k = 0; k < 3; k++) {
        extent[k] = fmax(search->high[k] - search->low[k], 0.0);
        width = fmax(width, extent[k] / most); /* also of points without a reach */
    }
    for (; product > most; width *= 1.25) {
        product = 1.0;
        for (int k = 0; k < 3; k++) {
            cells[k] = fmax(1.0, floor(extent[k] / width));
            product *= cells[k];
        }
    }
    for (int k = 0; k < 3; k++) {
        level->cells[k] = (int)cells[k];
        level->per_width[k] = cells[k] > 1.0 ? cells[k] / extent[k] : 0.0;
    }
}

/* Cell of coordinate x along axis k, clamped to [0, cells). */
/* Cell of coordinate x along axis k, clamped to [0, cells). */
static int cell_index(const struct search *search, const struct level *level, int k,
                      double x)
{
    const double at = (x - search->low[k]) * level->per_width[k];
    return (int)clamp(at, 0.0, level->cells[k] - 1);
}

static double wrapped_cells(const struct search *search, int k, double x)
{
    const double edge = search->edge[k], low = search->low[k];
    if (isinf(edge) || (x >= low && x < search->high[k])) {
        return x;
    }
    return clamp(x - edge * floor((x - low) / edge), low, search->high[k]);
}

/* Spheres in a cell of a level that has so many. */
static double spheres_per_cell(const struct search *search, double widest, int64_t count)
{
    double cells = 1.0;
    for (int k = 0; k < 3; k++) {
        cells *= fmax((search->high[k] - search->low[k]) / (cell_width * widest), 1.0);
    }
    return (double)count / cells;
}

/* Smaller spheres go to the level before while a cell holds few. */
static void merge_levels(struct search *search)
{
    int into = 0;
    for (int l = 1; l < GB_HGRID_LEVELS; l++) {
        struct level *level = &search->level[l], *before = &search->level[into];
        const int64_t both = before->count + level->count;
        if (level->count > 0 &&
            spheres_per_cell(search, before->widest, both) > per_cell_most) {
            into = l;
        } else {
            before->count = both;
            *level = (struct level){0};
        }
        search->level_of[l] = into;
    }
}

/* ---- Sort ---- */

/* Sets the levels, the cells of their grids and the cell of each sphere; then sorts the
 * spheres. */
/* Levels, their grids, and which cell each sphere lies in. */
static void assign(struct search *search, const double (*sphere)[4], const double *margin,
                   double skin)
{
    struct gb_hgrid *hgrid = search->hgrid;
    for (int64_t i = 0; i < search->count; i++) {
        const double reach = reach_of(sphere[i], margin, i, skin);
        struct level *level = &search->level[factors_of(search, reach)];
        level->count++;
        level->widest = fmax(level->widest, reach);
    }
    merge_levels(search);
    int32_t cells = 0;
    for (int l = 0; l < GB_HGRID_LEVELS; l++) {
        struct level *level = &search->level[l];
        level->first_cell = cells;
        if (level->count > 0) {
            shape_level(search, level);
            cells += level->cells[0] * level->cells[1] * level->cells[2];
        }
    }
    memset(hgrid->cell_start, 0, ((size_t)cells + 1) * sizeof *hgrid->cell_start);
    for (int64_t i = 0; i < search->count; i++) {
        const double reach = reach_of(sphere[i], margin, i, skin);
        const struct level *level = &search->level[level_of(search, reach)];
        int c = 0;
        for (int k = 2; k >= 0; k--) {
            const double x = wrapped_cells(search, k, sphere[i][k]);
            c = c * level->cells[k] + cell_index(search, level, k, x);
        }
        hgrid->cell[i] = level->first_cell + c;
        hgrid->cell_start[hgrid->cell[i] + 1]++;
    }
    for (int32_t c = 0; c < cells; c++) {
        hgrid->cell_start[c + 1] += hgrid->cell_start[c];
    }
}

/* Counting sort by cell: each sphere takes the first free slot of its cell, whose start is
 * advanced and restored at the end. */
static void sort(struct search *search, const double (*sphere)[4], const double *margin,
                 double skin)
{
    struct gb_hgrid *hgrid = search->hgrid;
    const struct level *last = &search->level[GB_HGRID_LEVELS - 1];
    int32_t cells = last->first_cell;
    cells += last->count > 0 ? last->cells[0] * last->cells[1] * last->cells[2] : 0;
    for (int64_t i = 0; i < search->count; i++) {
        const int32_t p = hgrid->cell_start[hgrid->cell[i]]++;
        for (int k = 0; k < 3; k++) {
            hgrid->sorted[k][p] = wrapped_cells(search, k, sphere[i][k]);
        }
        hgrid->sorted[GB_HGRID_REACH][p] = reach_of(sphere[i], margin, i, skin);
        hgrid->name[p] = (int32_t)i;
    }
    memmove(hgrid->cell_start + 1, hgrid->cell_start, (size_t)cells * sizeof(int32_t));
    hgrid->cell_start[0] = 0;
}

/* ---- Search ---- */

/* Partners of consecutive sorted spheres, each pair once. */
struct gb_hgrid_part {
    int32_t *found; /* numbers of the partners, sphere by sphere */
    int64_t room, count;
    bool done; /* false: err */
    struct gb_error err;
};

/* Number of pairs that is accepted for any number of spheres. */
static const int64_t pairs_least = 1 << 16;

/* Spheres of a part, at least, and parts at most. */
enum { PART_SPHERES = 128, PARTS_MAX = 64 };

static void search_finish(struct gb_hgrid *hgrid)
{
    for (int k = 0; hgrid->part && k < PARTS_MAX; k++) {
        gb_alloc_free(hgrid->part[k].found);
    }
    gb_alloc_free(hgrid->part);
    hgrid->part = NULL;
}

/* First sorted sphere of a part; of part hgrid->parts: the number of all. */
static int64_t search_begin(const struct search *search, int part)
{
    return search->count * part / search->hgrid->parts;
}

static bool check_number(const struct search *search, int64_t pairs, struct gb_error *err)
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
static bool reserve_parts(const struct search *search, struct gb_hgrid_part *part,
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

GB_SIMD_LOOP struct span span_of(const struct search *search, const struct level *level,
                                 int k, double x, double range)
{
    const int cells = level->cells[k];
    if (isinf(search->edge[k])) {
        return (struct span){cell_index(search, level, k, x - range),
                             cell_index(search, level, k, x + range)};
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
GB_SIMD_LOOP void scan(const struct search *search, struct gb_hgrid_part *part, int64_t p,
                       int64_t from, int64_t to)
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
GB_SIMD_LOOP bool scan_row(const struct search *search, struct gb_hgrid_part *part,
                           const struct level *level, int64_t p, int32_t row,
                           struct span x, enum hgrid_partners partners)
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
            if (!reserve_parts(search, part, to - from + 4)) {
                return false;
            }
            scan(search, part, p, from, to);
        }
    }
    return true;
}

/* Neighbours of sorted sphere p in a level: its own, or one of larger spheres. */
GB_SIMD_LOOP bool scan_level(const struct search *search, struct gb_hgrid_part *part,
                             const struct level *level, int64_t p,
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
GB_SIMD_LOOP bool scan_sphere(const struct search *search, struct gb_hgrid_part *part,
                              int64_t p, int l)
{
    for (int m = 0; m <= l; m++) {
        const struct level *level = &search->level[m];
        const enum hgrid_partners partners = m == l ? BEHIND_IN_LEVEL : ALL_OF_LEVEL;
        if (level->count > 0 && !scan_level(search, part, level, p, partners)) {
            return false;
        }
    }
    return true;
}

GB_SIMD_LOOP void search_part_loop(const struct search *search, int number)
{
    struct gb_hgrid_part *part = &search->hgrid->part[number];
    const int64_t end = search_begin(search, number + 1);
    int64_t p = search_begin(search, number), level_end = 0;
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
GB_SIMD_WIDTHS(search_part, (const struct search *search, int number), (search, number))

static void search_item(void *data, int64_t number)
{
    search_part(data, (int)number);
}

static bool make_parts(struct search *search, struct gb_error *err)
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

/* Fills parts and partners of the grid; search->found is the number of pairs.
 * Errors: GB_ERR_MEMORY; GB_ERR_GUARD for too many pairs. */
static bool search_run(struct search *search, struct gb_error *err)
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

/* ---- Pairs ---- */

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
    search_finish(hgrid);
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
static bool reserve(struct search *search, struct gb_error *err)
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
static bool check_spheres(struct search *search, const double (*sphere)[4],
                          const double *margin, double skin, struct gb_error *err)
{
    for (int64_t i = 0; i < search->count; i++) {
        const double *s = sphere[i];
        const double reach = reach_of(s, margin, i, skin);
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
static inline __attribute__((always_inline)) void for_pairs(const struct search *search,
                                                            pair_work *work)
{
    struct gb_hgrid *hgrid = search->hgrid;
    for (int part = 0; part < hgrid->parts; part++) {
        const int64_t end = search_begin(search, part + 1);
        const int32_t *found = hgrid->part[part].found;
        for (int64_t p = search_begin(search, part); p < end; p++) {
            const int32_t a = hgrid->name[p];
            for (int32_t k = 0; k < hgrid->partners[p]; k++) {
                const int32_t b = *found++;
                work(hgrid, a < b ? a : b, a < b ? b : a);
            }
        }
    }
}

/* Sorts the pairs by their later sphere, then, keeping that order, by the earlier one. */
static void sort_pairs(struct search *search)
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
    struct search search = {.hgrid = hgrid, .count = count};
    hgrid->parts = 0;
    if (!ready(hgrid, count, err) || !check_spheres(&search, sphere, margin, skin, err) ||
        !bounds(&search, box, sphere, err)) {
        return false;
    }
    if (search.widest > 0.0) {
        assign(&search, sphere, margin, skin);
        sort(&search, sphere, margin, skin);
        if (!search_run(&search, err) || !reserve(&search, err)) {
            return false;
        }
    }
    sort_pairs(&search);
    return true;
}
