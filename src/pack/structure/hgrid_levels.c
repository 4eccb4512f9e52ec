#include "pack/structure/hgrid_levels.h"

#include <math.h>
#include <string.h>

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

double gb_hgrid_levels_reach(const double sphere[4], const double *margin, int64_t i,
                             double skin)
{
    return sphere[3] + 0.5 * skin + (margin ? margin[i] : 0.0);
}

/* Factors of 2 below the largest sphere. */
static int factors_of(const struct gb_hgrid_search *search, double reach)
{
    const double ratio = search->widest / reach;
    const int last = search->hgrid->levels - 1;
    return ratio < (double)(1 << last) ? ilogb(ratio) : last;
}

static int level_of(const struct gb_hgrid_search *search, double reach)
{
    return search->level_of[factors_of(search, reach)];
}

/* The grids cover the box along periodic axes, along others its part with spheres. */
bool gb_hgrid_levels_bounds(struct gb_hgrid_search *search,
                            const struct gb_hgrid_box *box, const double (*sphere)[4],
                            struct gb_error *err)
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

static void shape_level(const struct gb_hgrid_search *search,
                        struct gb_hgrid_level *level)
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
int gb_hgrid_levels_index(const struct gb_hgrid_search *search,
                          const struct gb_hgrid_level *level, int k, double x)
{
    const double at = (x - search->low[k]) * level->per_width[k];
    return (int)clamp(at, 0.0, level->cells[k] - 1);
}

static double wrapped(const struct gb_hgrid_search *search, int k, double x)
{
    const double edge = search->edge[k], low = search->low[k];
    if (isinf(edge) || (x >= low && x < search->high[k])) {
        return x;
    }
    return clamp(x - edge * floor((x - low) / edge), low, search->high[k]);
}

/* Spheres in a cell of a level that has so many. */
static double spheres_per_cell(const struct gb_hgrid_search *search, double widest,
                               int64_t count)
{
    double cells = 1.0;
    for (int k = 0; k < 3; k++) {
        cells *= fmax((search->high[k] - search->low[k]) / (cell_width * widest), 1.0);
    }
    return (double)count / cells;
}

/* Smaller spheres go to the level before while a cell holds few. */
static void merge_levels(struct gb_hgrid_search *search)
{
    int into = 0;
    for (int l = 1; l < GB_HGRID_LEVELS; l++) {
        struct gb_hgrid_level *level = &search->level[l], *before = &search->level[into];
        const int64_t both = before->count + level->count;
        if (level->count > 0 &&
            spheres_per_cell(search, before->widest, both) > per_cell_most) {
            into = l;
        } else {
            before->count = both;
            *level = (struct gb_hgrid_level){0};
        }
        search->level_of[l] = into;
    }
}

/* Levels, their grids, and which cell each sphere lies in. */
void gb_hgrid_levels_assign(struct gb_hgrid_search *search, const double (*sphere)[4],
                            const double *margin, double skin)
{
    struct gb_hgrid *hgrid = search->hgrid;
    for (int64_t i = 0; i < search->count; i++) {
        const double reach = gb_hgrid_levels_reach(sphere[i], margin, i, skin);
        struct gb_hgrid_level *level = &search->level[factors_of(search, reach)];
        level->count++;
        level->widest = fmax(level->widest, reach);
    }
    merge_levels(search);
    int32_t cells = 0;
    for (int l = 0; l < GB_HGRID_LEVELS; l++) {
        struct gb_hgrid_level *level = &search->level[l];
        level->first_cell = cells;
        if (level->count > 0) {
            shape_level(search, level);
            cells += level->cells[0] * level->cells[1] * level->cells[2];
        }
    }
    memset(hgrid->cell_start, 0, ((size_t)cells + 1) * sizeof *hgrid->cell_start);
    for (int64_t i = 0; i < search->count; i++) {
        const double reach = gb_hgrid_levels_reach(sphere[i], margin, i, skin);
        const struct gb_hgrid_level *level = &search->level[level_of(search, reach)];
        int c = 0;
        for (int k = 2; k >= 0; k--) {
            const double x = wrapped(search, k, sphere[i][k]);
            c = c * level->cells[k] + gb_hgrid_levels_index(search, level, k, x);
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
void gb_hgrid_levels_sort(struct gb_hgrid_search *search, const double (*sphere)[4],
                          const double *margin, double skin)
{
    struct gb_hgrid *hgrid = search->hgrid;
    const struct gb_hgrid_level *last = &search->level[GB_HGRID_LEVELS - 1];
    int32_t cells = last->first_cell;
    cells += last->count > 0 ? last->cells[0] * last->cells[1] * last->cells[2] : 0;
    for (int64_t i = 0; i < search->count; i++) {
        const int32_t p = hgrid->cell_start[hgrid->cell[i]]++;
        for (int k = 0; k < 3; k++) {
            hgrid->sorted[k][p] = wrapped(search, k, sphere[i][k]);
        }
        hgrid->sorted[GB_HGRID_REACH][p] =
            gb_hgrid_levels_reach(sphere[i], margin, i, skin);
        hgrid->name[p] = (int32_t)i;
    }
    memmove(hgrid->cell_start + 1, hgrid->cell_start, (size_t)cells * sizeof(int32_t));
    hgrid->cell_start[0] = 0;
}
