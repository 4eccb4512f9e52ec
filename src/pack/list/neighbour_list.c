/* The neighbour list: which pairs of particles may touch or attract each other soon.
 *
 * Testing all N^2 pairs in every evaluation costs too much.  A Verlet list (L. Verlet, Phys.
 * Rev. 159, 98 (1967)) holds all pairs nearer than the range of the forces plus a skin.  It
 * stays complete until particles have moved by half the skin; list_check.c watches that.
 *
 * A build takes these steps:
 *   1. sort the particles into bins at least as wide as the reach of the list (range of the
 *      forces plus skin), by a counting sort,
 *   2. scan the bins around each particle for partners of a larger index; a pair also notes
 *      through which of the 27 periodic images of the cell it is nearest,
 *   3. lay the pairs out particle after particle: `near` for those that may touch, `far` for
 *      those that can only attract across a gap.
 * Particles of unequal size take their candidates from a hierarchical grid instead of bins.
 *
 * Threads scan disjoint ranges of particles, and the layout follows from the counts alone, so
 * that the lists do not depend on the number of threads.  A single-precision list leaves free
 * slots after every block of particles, into which list_patch.c inserts pairs later. */

#include "pack/list/neighbour_list.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/mat.h"
#include "base/portable.h"
#include "base/team.h"
#include "pack/kernel/lanes.h"
#include "pack/kernel/share.h"
#include "pack/kernel/simd.h"
#include "pack/list/blocks.h"
#include "pack/structure/hgrid.h"
#include "scene/tolerances.h"

/* ---- Storage ---- */

/* Pairs reserved beyond the need whenever a list grows. */
enum { EXTRA = 256 };

/* Pairs that may be inserted between two builds: INSERTED_BASE, plus one for every
 * PARTICLES_PER_INSERTED particles. */
enum { INSERTED_BASE = 64, PARTICLES_PER_INSERTED = 256 };

/* Free slots after every block: a small system never needs more for one block than it
 * may insert at all. */
enum { FREE_SLOTS = INSERTED_BASE + 16 };

/* Image one edge away along every axis. */
enum { IMAGE_AWAY = 26 };

/* Scratch of builds with unequal diameters: the hierarchical grid and its spheres. */
struct gb_list_levels {
    struct gb_hgrid hgrid;
    double (*sphere)[4]; /* x, y, z, radius; d */
};

/* For `count` particles; levels_destroy accepts NULL. */
static bool levels_create(struct gb_list_levels **out, int64_t count,
                          struct gb_error *err)
{
    struct gb_list_levels *levels = gb_alloc_array(1, sizeof *levels, err);
    if (!levels) {
        return false;
    }
    levels->sphere = gb_alloc_array((size_t)count, sizeof *levels->sphere, err);
    if (!levels->sphere || !gb_hgrid_init(&levels->hgrid, count, err)) {
        gb_alloc_free(levels->sphere);
        gb_alloc_free(levels);
        return false;
    }
    *out = levels;
    return true;
}

static void levels_destroy(struct gb_list_levels *levels)
{
    if (levels) {
        gb_hgrid_finish(&levels->hgrid);
        gb_alloc_free(levels->sphere);
        gb_alloc_free(levels);
    }
}

static bool pairs_init(struct gb_pair_list *pairs, int64_t count,
                       enum gb_neighbour_list_layout layout, struct gb_error *err)
{
    const size_t starts = (size_t)count + 1;
    pairs->start = gb_alloc_array(starts, sizeof *pairs->start, err);
    if (layout == GB_NEIGHBOUR_LIST_PATCHABLE) {
        pairs->stop =
            gb_alloc_array((size_t)gb_blocks_count(count), sizeof *pairs->stop, err);
    } else {
        pairs->in_start = gb_alloc_array(starts, sizeof *pairs->in_start, err);
    }
    return pairs->start && (pairs->stop || pairs->in_start);
}

static void free_pairs(struct gb_pair_list *pairs)
{
    gb_alloc_free(pairs->first);
    gb_alloc_free(pairs->other);
    gb_alloc_free(pairs->image);
    gb_alloc_free(pairs->row);
    gb_alloc_free(pairs->in_slot);
    pairs->first = NULL;
    pairs->other = NULL;
    pairs->image = NULL;
    pairs->row = NULL;
    pairs->in_slot = NULL;
    pairs->capacity = 0;
}

static void pairs_finish(struct gb_pair_list *pairs)
{
    gb_alloc_free(pairs->start);
    gb_alloc_free(pairs->stop);
    gb_alloc_free(pairs->in_start);
    free_pairs(pairs);
}

bool gb_neighbour_list_init(struct gb_neighbour_list *list, int64_t count,
                            enum gb_neighbour_list_layout layout, struct gb_error *err)
{
    *list = (struct gb_neighbour_list){.count = count, .largest = 1.0, .layout = layout};
    list->bin_particle =
        gb_alloc_array((size_t)count + GB_LANES_BEYOND, sizeof *list->bin_particle, err);
    list->built_position = gb_alloc_array(3 * (size_t)count + GB_LANES_BEYOND,
                                          sizeof *list->built_position, err);
    list->inserted_max = INSERTED_BASE + count / PARTICLES_PER_INSERTED;
    list->inserted =
        gb_alloc_array((size_t)list->inserted_max, sizeof *list->inserted, err);
    if (!list->bin_particle || !list->built_position || !list->inserted ||
        !pairs_init(&list->near, count, layout, err) ||
        !pairs_init(&list->far, count, layout, err)) {
        gb_neighbour_list_finish(list);
        return false;
    }
    return true;
}

void gb_neighbour_list_finish(struct gb_neighbour_list *list)
{
    pairs_finish(&list->near);
    pairs_finish(&list->far);
    gb_alloc_free(list->bin_start);
    gb_alloc_free(list->bin_particle);
    gb_alloc_free(list->built_position);
    gb_alloc_free(list->inserted);
    levels_destroy(list->levels);
    *list = (struct gb_neighbour_list){0};
}

/* Room for `need` pairs; the contents are lost when it grows. */
static bool reserve_pairs(struct gb_neighbour_list *list, struct gb_pair_list *pairs,
                          int64_t need, struct gb_error *err)
{
    const bool transposed = list->layout == GB_NEIGHBOUR_LIST_TRANSPOSED;
    if (need <= pairs->capacity) {
        return true;
    }
    const size_t room = (size_t)(need + need / 16 + EXTRA);
    free_pairs(pairs);
    pairs->first = gb_alloc_array(room, sizeof *pairs->first, err);
    pairs->other = gb_alloc_array(room, sizeof *pairs->other, err);
    pairs->image = gb_alloc_array(room, sizeof *pairs->image, err);
    int32_t **by_layout = transposed ? &pairs->in_slot : &pairs->row;
    *by_layout = gb_alloc_array(room, sizeof **by_layout, err);
    if (!pairs->first || !pairs->other || !pairs->image || !*by_layout) {
        free_pairs(pairs);
        return false;
    }
    pairs->capacity = (int64_t)room;
    return true;
}

/* Free slots after every block of a patchable list. */
static int64_t free_slots_of(const struct gb_neighbour_list *list)
{
    return list->layout == GB_NEIGHBOUR_LIST_PATCHABLE ? FREE_SLOTS : 0;
}

void gb_neighbour_list_free_slot(struct gb_pair_list *pairs, int64_t slot, int64_t i)
{
    pairs->first[slot] = (int32_t)i;
    pairs->other[slot] = (int32_t)i;
    pairs->image[slot] = IMAGE_AWAY;
    pairs->row[slot] = (int32_t)i;
}

static void pairs_clear(struct gb_pair_list *pairs, int64_t count)
{
    const size_t starts = (size_t)count + 1;
    memset(pairs->start, 0, starts * sizeof *pairs->start);
    if (pairs->in_start) {
        memset(pairs->in_start, 0, starts * sizeof *pairs->in_start);
    }
    if (pairs->stop) {
        memset(pairs->stop, 0, (size_t)gb_blocks_count(count) * sizeof *pairs->stop);
    }
    pairs->pair_count = 0;
}

void gb_neighbour_list_clear(struct gb_neighbour_list *list)
{
    pairs_clear(&list->near, list->count);
    pairs_clear(&list->far, list->count);
    list->inserted_count = 0;
}

/* ---- Periodic images: 27 shifts by -1, 0 or 1 edges along each axis ---- */

/* In a tilted cell an image lies whole edge vectors away. */
static void update_shifts_tilted(struct gb_neighbour_list *list,
                                 const struct gb_cell *cell)
{
    double matrix[3][3];
    gb_cell_matrix(cell, matrix);
    for (int image = 0; image < 27; image++) {
        const int digit[3] = {image % 3, image / 3 % 3, image / 9};
        double s[3];
        for (int k = 0; k < 3; k++) {
            s[k] = cell->periodic[k] ? digit[k] - 1 : 0.0;
        }
        gb_mat_apply((const double(*)[3])matrix, s, list->shift[image]);
    }
}

void gb_neighbour_list_update_shifts(struct gb_neighbour_list *list,
                                     const struct gb_cell *cell)
{
    double along[3][3]; /* -1, 0, 1 edges of each axis */
    if (gb_cell_tilted(cell)) {
        update_shifts_tilted(list, cell);
        return;
    }
    for (int k = 0; k < 3; k++) {
        along[k][2] = cell->periodic[k] ? cell->edge[k] : 0.0;
        along[k][1] = 0.0;
        along[k][0] = 0.0 - along[k][2];
    }
    for (int w = 0; w < 3; w++) {
        for (int v = 0; v < 3; v++) {
            for (int u = 0; u < 3; u++) {
                double *shift = list->shift[9 * w + 3 * v + u];
                shift[0] = along[0][u];
                shift[1] = along[1][v];
                shift[2] = along[2][w];
            }
        }
    }
}

/* Nearest image of x_i - x_j in a tilted cell: returns its index, and the squared distance. */
static uint8_t nearest_image_tilted(const struct gb_cell *cell, const double *xi,
                                    const double *xj, double *squared)
{
    double r[3] = {xi[0] - xj[0], xi[1] - xj[1], xi[2] - xj[2]}, fraction[3];
    int image = 0, weight = 1;
    gb_cell_fraction(cell, r, fraction);
    gb_cell_nearest(cell, r);
    for (int k = 0; k < 3; k++) {
        const int whole = cell->periodic[k] ? (int)gb_cell_whole(fraction[k]) : 0;
        image += (1 - whole) * weight;
        weight *= 3;
    }
    *squared = gb_vec_dot(r, r);
    return (uint8_t)image;
}

/* The same in a cell without a tilt. */
static uint8_t nearest_image(const struct gb_cell *cell, const double *xi,
                             const double *xj, double *squared)
{
    int image = 0, weight = 1;
    double sum = 0.0;
    for (int k = 0; k < 3; k++) {
        double r = xi[k] - xj[k];
        int s = 0;
        if (cell->periodic[k]) {
            const double half = 0.5 * cell->edge[k];
            s = r > half ? -1 : r < -half ? 1 : 0;
            r += s * cell->edge[k];
        }
        sum += r * r;
        image += (s + 1) * weight;
        weight *= 3;
    }
    *squared = sum;
    return (uint8_t)image;
}

/* ---- Bins ---- */

static int clamp(int value, int low, int high)
{
    return value < low ? low : value > high ? high : value;
}

/* Equal edges, reach and count give equal grids.  About one particle per bin at most,
 * however dilute the packing. */
static void grid_init(struct gb_neighbour_grid *grid, const struct gb_cell *cell,
                      double reach, int64_t count)
{
    const int most = (int)fmax(1.0, ceil(gb_portable_cbrt((double)count)) * 2.0);
    grid->plain = true;
    for (int k = 0; k < 3; k++) {
        const double edge = gb_cell_spacing(cell, k);
        grid->n[k] = cell->periodic[k] ? clamp((int)(edge / reach), 1, most * 8) : 1;
        grid->inverse[k] = grid->n[k] / edge;
        /* with one or two bins along an axis, -1 and +1 are the same bin */
        grid->span_low[k] = grid->n[k] > 2 ? -1 : 0;
        grid->span_high[k] = grid->n[k] > 1 ? 1 : 0;
        grid->plain = grid->plain && (grid->n[k] > 2 || !cell->periodic[k]);
    }
    grid->tilted = gb_cell_tilted(cell);
    gb_cell_inverse(cell, grid->to_bin);
    for (int k = 0; k < 3; k++) {
        gb_vec_scale(grid->to_bin[k], grid->n[k]);
    }
}

void gb_neighbour_list_bin(const struct gb_neighbour_grid *grid, const double x[3],
                           int bin[3])
{
    for (int k = 0; k < 3; k++) {
        const double bins =
            grid->tilted ? gb_vec_dot(grid->to_bin[k], x) : x[k] * grid->inverse[k];
        bin[k] = clamp((int)bins, 0, grid->n[k] - 1);
    }
}

/* ---- Scan of the bins around a particle ---- */

struct found {
    int32_t other;
    uint8_t image;
    bool near;
};

/* Upper bounds of the two lists: squared distances for diameters of 1, and the gaps that
 * they are made of. */
struct bounds {
    double near, far; /* squared, d^2 */
    double skin, gap; /* beyond contact: of `near`, of `far`, d */
};

struct scan {
    struct gb_neighbour_grid grid;
    struct bounds bounds;
    const struct gb_cell *cell;
    const double *position; /* count x 3, inside the cell */
    const double
        *sorted[3]; /* coordinates bin by bin: bin c is start[c] .. start[c + 1] */
    const double (*shift)[3];
    const int32_t *start, *particle;
    const double *diameter;            /* NULL: all are 1 */
    const struct gb_hgrid *candidates; /* instead of the bins; NULL: none */
};

static int bin_of(const struct scan *scan, int64_t i)
{
    int bin[3];
    gb_neighbour_list_bin(&scan->grid, scan->position + 3 * i, bin);
    return gb_neighbour_list_bin_index(&scan->grid, bin);
}

/* Counting sort by bins. */
static void sort_into_bins(const struct scan *scan, struct gb_neighbour_list *list,
                           double *const sorted[3], int64_t bins)
{
    int32_t *start = list->bin_start, *particle = list->bin_particle;
    memset(start, 0, ((size_t)bins + 1) * sizeof *start);
    for (int64_t i = 0; i < list->count; i++) {
        start[bin_of(scan, i)]++;
    }
    for (int64_t c = 1; c <= bins; c++) {
        start[c] += start[c - 1];
    }
    for (int64_t i = list->count - 1; i >= 0; i--) {
        const int32_t at = --start[bin_of(scan, i)];
        particle[at] = (int32_t)i;
        for (int k = 0; k < 3; k++) {
            sorted[k][at] = scan->position[3 * i + k];
        }
    }
}

/* Sorts the particles of the list into the bins of `scan->grid`, ascending within each.
 * Uses built_position of the list as scratch. */
static bool scan_sort(struct scan *scan, struct gb_neighbour_list *list,
                      struct gb_error *err)
{
    const struct gb_neighbour_grid *grid = &scan->grid;
    const int64_t bins = (int64_t)grid->n[0] * grid->n[1] * grid->n[2];
    if (bins + 1 > list->bin_capacity) {
        gb_alloc_free(list->bin_start);
        list->bin_capacity = 0;
        list->bin_start = gb_alloc_array((size_t)bins + 1, sizeof *list->bin_start, err);
        if (!list->bin_start) {
            return false;
        }
        list->bin_capacity = bins + 1;
    }
    /* the positions of the last build are not needed any more */
    double *const plane = list->built_position;
    double *const sorted[3] = {plane, plane + list->count, plane + 2 * list->count};
    sort_into_bins(scan, list, sorted, bins);
    for (int k = 0; k < 3; k++) {
        scan->sorted[k] = sorted[k];
    }
    scan->start = list->bin_start;
    scan->particle = list->bin_particle;
    return true;
}

/* Neighbours up to which a branch-free sort is used; most particles have no more. */
enum { FEW = 32 };

/* Bounds of a pair of unequal diameters. */
static struct bounds bounds_of(const struct scan *scan, int64_t i, int32_t j,
                               struct bounds any)
{
    const double contact = 0.5 * (scan->diameter[i] + scan->diameter[j]);
    const double near = contact + any.skin, far = contact + any.gap;
    return (struct bounds){near * near, far * far, any.skin, any.gap};
}

/* Ascending by `other`.  The rank of each is the number of smaller ones, counted without
 * a branch: the order is random, and a mispredicted branch costs more. */
GB_SIMD_LOOP void sort_few(struct found *list, int n)
{
    struct found found[FEW];
    int32_t other[FEW];
    memcpy(found, list, (size_t)n * sizeof *list);
    for (int k = 0; k < FEW; k++) {
        other[k] = k < n ? found[k].other : INT32_MAX;
    }
    for (int k = 0; k < n; k++) {
        int before = 0;
        for (int l = 0; l < FEW; l++) {
            before += other[l] < other[k];
        }
        list[before] = found[k];
    }
}

static void sort_many(struct found *list, int n)
{
    for (int l = 1; l < n; l++) {
        const struct found item = list[l];
        int k = l;
        for (; k > 0 && list[k - 1].other > item.other; k--) {
            list[k] = list[k - 1];
        }
        list[k] = item;
    }
}

/* Finds the particles j > i within the bounds in the bins first .. last.  For unequal diameters
 * and for grids that are not plain. */
static int scan_bins(const struct scan *scan, int64_t i, int first, int last, int image,
                     struct found *list, int n)
{
    const double *x = scan->position + 3 * i, *shift = scan->shift[image];
    const int32_t *particle = scan->particle, end = scan->start[last + 1];
    for (int32_t k = scan->start[first]; k < end && n < GB_NEIGHBOUR_LIST_SCAN_MAX; k++) {
        const double y[3] = {scan->sorted[0][k], scan->sorted[1][k], scan->sorted[2][k]};
        const double r[3] = {x[0] - y[0] + shift[0], x[1] - y[1] + shift[1],
                             x[2] - y[2] + shift[2]};
        double squared = r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
        uint8_t seen = (uint8_t)image;
        if (!scan->grid.plain) {
            seen = scan->grid.tilted ? nearest_image_tilted(scan->cell, x, y, &squared)
                                     : nearest_image(scan->cell, x, y, &squared);
        }
        const int32_t other = particle[k];
        const struct bounds own =
            scan->diameter ? bounds_of(scan, i, other, scan->bounds) : scan->bounds;
        list[n] = (struct found){other, seen, squared < own.near};
        n += (squared < own.far) & (other > i);
    }
    return n;
}

/* The same for equal diameters in a plain grid, where the bins have one image.  Four particles at
 * a time, which is about what three adjacent bins hold. */
GB_SIMD_LOOP int scan_plain(const struct scan *scan, int64_t i, int first, int last,
                            int image, struct found *list, int n)
{
    const double *x = scan->position + 3 * i, *shift = scan->shift[image];
    const double *const *sorted = scan->sorted;
    const int32_t *particle = scan->particle, end = scan->start[last + 1];
    const gb_lanes far = GB_LANES_ALL(scan->bounds.far);
    const gb_lanes near = GB_LANES_ALL(scan->bounds.near);
    const gb_lanes_index lane = {0, 1, 2, 3};
    for (int32_t k = scan->start[first]; k < end && n < GB_NEIGHBOUR_LIST_SCAN_MAX;
         k += 4) {
        const gb_lanes rx =
            GB_LANES_ALL(x[0]) - GB_LANES_AT(sorted[0], k) + GB_LANES_ALL(shift[0]);
        const gb_lanes ry =
            GB_LANES_ALL(x[1]) - GB_LANES_AT(sorted[1], k) + GB_LANES_ALL(shift[1]);
        const gb_lanes rz =
            GB_LANES_ALL(x[2]) - GB_LANES_AT(sorted[2], k) + GB_LANES_ALL(shift[2]);
        const gb_lanes squared = rx * rx + ry * ry + rz * rz;
        const gb_lanes_index behind =
            (GB_LANES_INDEX_AT(particle, k) > GB_LANES_INDEX_ALL((int32_t)i)) &
            (lane < GB_LANES_INDEX_ALL(end - k));
        const gb_lanes_mask found =
            (squared < far) & __builtin_convertvector(behind, gb_lanes_mask);
        const gb_lanes_mask touching = squared < near;
        for (int l = 0; l < 4; l++) {
            list[n] = (struct found){particle[k + l], (uint8_t)image, touching[l] != 0};
            n -= (int)found[l];
        }
    }
    return n;
}

static int wrapped(int bin, int n)
{
    return bin < 0 ? bin + n : bin >= n ? bin - n : bin;
}

/* Image of a neighbouring bin along one axis, as a digit of the index of the image. */
static int image_digit(int bin, int n)
{
    return bin < 0 ? 2 : bin >= n ? 0 : 1;
}

/* Row and image of the bins along x at a bin along the others. */
struct row {
    int first, image;
};

static struct row row_of(const struct gb_neighbour_grid *grid, int y, int z)
{
    const int cy = wrapped(y, grid->n[1]), cz = wrapped(z, grid->n[2]);
    return (struct row){(cz * grid->n[1] + cy) * grid->n[0],
                        9 * image_digit(z, grid->n[2]) + 3 * image_digit(y, grid->n[1])};
}

/* One row of bins along x. */
static int scan_row(const struct scan *scan, int64_t i, int bin, struct row row,
                    struct found *list, int n)
{
    const struct gb_neighbour_grid *grid = &scan->grid;
    const int bins = grid->n[0];
    for (int u = grid->span_low[0]; u <= grid->span_high[0]; u++) {
        const int c = row.first + wrapped(bin + u, bins);
        n = scan_bins(scan, i, c, c, row.image + image_digit(bin + u, bins), list, n);
    }
    return n;
}

/* The same in a plain grid: adjacent bins are one range of particles. */
GB_SIMD_LOOP int scan_row_plain(const struct scan *scan, int64_t i, int bin,
                                struct row row, struct found *list, int n)
{
    const struct gb_neighbour_grid *grid = &scan->grid;
    const int bins = grid->n[0];
    if (bins > 2 && bin > 0 && bin < bins - 1) {
        return scan_plain(scan, i, row.first + bin - 1, row.first + bin + 1,
                          row.image + 1, list, n);
    }
    for (int u = grid->span_low[0]; u <= grid->span_high[0]; u++) {
        const int c = row.first + wrapped(bin + u, bins);
        n = scan_plain(scan, i, c, c, row.image + image_digit(bin + u, bins), list, n);
    }
    return n;
}

/* The candidates of particle i within their bounds; they are sorted. */
static int scan_candidates(const struct scan *scan, int64_t i, struct found *found)
{
    const struct gb_hgrid *pairs = scan->candidates;
    int n = 0;
    for (int64_t k = pairs->start[i]; k < pairs->start[i + 1]; k++) {
        const int32_t other = pairs->other[k];
        double squared;
        const uint8_t image = nearest_image(scan->cell, scan->position + 3 * i,
                                            scan->position + 3 * other, &squared);
        const struct bounds own = bounds_of(scan, i, other, scan->bounds);
        found[n] = (struct found){other, image, squared < own.near};
        n += squared < own.far;
    }
    return n;
}

/* Room that the neighbours j > i of particle i need. */
static int64_t scan_most(const struct scan *scan, int64_t i)
{
    const struct gb_hgrid *pairs = scan->candidates;
    return pairs ? pairs->start[i + 1] - pairs->start[i]
                 : GB_NEIGHBOUR_LIST_SCAN_MAX + GB_LANES_BEYOND;
}

/* Particles in the bins around particle i, sorted. */
GB_SIMD_LOOP void scan_around_loop(const struct scan *scan, int64_t i,
                                   struct found *found, int *count)
{
    const struct gb_neighbour_grid *grid = &scan->grid;
    const bool plain = grid->plain && !scan->diameter;
    int bin[3], n = 0;
    gb_neighbour_list_bin(grid, scan->position + 3 * i, bin);
    for (int w = grid->span_low[2]; w <= grid->span_high[2]; w++) {
        for (int v = grid->span_low[1]; v <= grid->span_high[1]; v++) {
            const struct row row = row_of(grid, bin[1] + v, bin[2] + w);
            n = plain ? scan_row_plain(scan, i, bin[0], row, found, n)
                      : scan_row(scan, i, bin[0], row, found, n);
        }
    }
    n = n < GB_NEIGHBOUR_LIST_SCAN_MAX ? n : GB_NEIGHBOUR_LIST_SCAN_MAX;
    if (n <= FEW) {
        sort_few(found, n);
    } else {
        sort_many(found, n);
    }
    *count = n;
}
GB_SIMD_WIDTHS(scan_around,
               (const struct scan *scan, int64_t i, struct found *found, int *count),
               (scan, i, found, count))

/* Neighbours j > i of particle i, sorted, at most so many; returns their number. */
static int scan_particle(const struct scan *scan, int64_t i, struct found *found)
{
    int count;
    if (scan->candidates) {
        return scan_candidates(scan, i, found);
    }
    scan_around(scan, i, found, &count);
    return count;
}

/* Candidates of all particles of the scan, out to its gap; the scan takes its neighbours
 * from them.  Errors: those of gb_hgrid_build. */
static bool levels_find(struct gb_list_levels *levels, struct scan *scan, int64_t count,
                        struct gb_team *team, struct gb_error *err)
{
    struct gb_hgrid_box box = {.low = {0.0}};
    for (int k = 0; k < 3; k++) {
        box.high[k] = scan->cell->edge[k];
        box.periodic[k] = scan->cell->periodic[k];
    }
    for (int64_t i = 0; i < count; i++) {
        memcpy(levels->sphere[i], scan->position + 3 * i, 3 * sizeof(double));
        levels->sphere[i][3] = 0.5 * scan->diameter[i];
    }
    levels->hgrid.team = team;
    if (!gb_hgrid_build(&levels->hgrid, &box, count, (const double(*)[4])levels->sphere,
                        NULL, scan->bounds.gap, err)) {
        return false;
    }
    scan->candidates = &levels->hgrid;
    return true;
}

/* ---- Build ---- */

/* Particles begin .. end - 1 with all their neighbours, found by one thread. */
struct part {
    int64_t begin, end;
    struct found *found; /* particle after particle, sorted within each */
    int64_t count, capacity;
    int64_t expected;  /* share of the pairs of the last build */
    int64_t near, far; /* number of pairs in each list; then their first slot there */
    struct gb_error err;
};

/* Room for the neighbours of one more particle, `most` of them. */
static bool make_room(struct part *part, int64_t most)
{
    if (part->count + most < part->capacity) {
        return true;
    }
    const int64_t more = part->capacity > 0 ? part->capacity / 4 : part->expected;
    const int64_t room = part->capacity + more + most + 16 * GB_NEIGHBOUR_LIST_SCAN_MAX;
    struct found *found = gb_alloc_grow(part->found, (size_t)part->count, (size_t)room,
                                        sizeof *found, &part->err);
    if (!found) {
        return false;
    }
    part->found = found;
    part->capacity = room;
    return true;
}

/* Leaves in start[i + 1] of both lists the number of pairs of particle i. */
static bool scan_part(struct gb_neighbour_list *list, const struct scan *scan,
                      struct part *part)
{
    for (int64_t i = part->begin; i < part->end; i++) {
        if (!make_room(part, scan_most(scan, i))) {
            return false;
        }
        const struct found *found = part->found + part->count;
        const int n = scan_particle(scan, i, part->found + part->count);
        if (!scan->candidates && n >= GB_NEIGHBOUR_LIST_SCAN_MAX) {
            return gb_error_set(&part->err, GB_ERR_GUARD,
                                "particle %lld has %d or more neighbours within %.3g d: "
                                "the packing has collapsed",
                                (long long)i, n, sqrt(scan->bounds.far));
        }
        int near = 0;
        for (int k = 0; k < n; k++) {
            near += found[k].near;
        }
        list->near.start[i + 1] = near;
        list->far.start[i + 1] = n - near;
        part->near += near;
        part->far += n - near;
        part->count += n;
    }
    return true;
}

/* First slots of every part, and room for all pairs. */
static bool assign_part_slots(struct gb_neighbour_list *list, struct part *part,
                              int parts, struct gb_error *err)
{
    const int64_t size = gb_blocks_size(list->count);
    const int64_t per_block = free_slots_of(list);
    int64_t near = 0, far = 0;
    for (int t = 0; t < parts; t++) {
        if (part[t].err.code != GB_OK) {
            return gb_error_set(err, part[t].err.code, "%s", part[t].err.text);
        }
        const int64_t own_near = part[t].near, own_far = part[t].far;
        const int64_t free_slots = per_block * (part[t].begin / size);
        part[t].near = near + free_slots;
        part[t].far = far + free_slots;
        near += own_near;
        far += own_far;
    }
    list->near.start[0] = list->far.start[0] = 0;
    list->near.pair_count = near;
    list->far.pair_count = far;
    const int64_t free_slots = per_block * gb_blocks_count(list->count);
    return reserve_pairs(list, &list->near, near + free_slots, err) &&
           reserve_pairs(list, &list->far, far + free_slots, err);
}

static void put_pair(struct gb_pair_list *pairs, int64_t i, int64_t k,
                     const struct found *found)
{
    pairs->first[k] = (int32_t)i;
    pairs->other[k] = found->other;
    pairs->image[k] = found->image;
}

/* Free slots after the pairs of block b, whose last particle is i; returns the first slot
 * of the next block. */
static int64_t end_block(struct gb_neighbour_list *list, struct gb_pair_list *pairs,
                         int64_t b, int64_t i, int64_t slot)
{
    const int64_t free_slots = free_slots_of(list);
    pairs->stop[b] = slot;
    for (int64_t k = 0; k < free_slots; k++) {
        gb_neighbour_list_free_slot(pairs, slot++, i);
    }
    return slot;
}

static void fill_part(struct gb_neighbour_list *list, const struct part *part)
{
    const bool patchable = list->layout == GB_NEIGHBOUR_LIST_PATCHABLE;
    const struct found *found = part->found;
    int64_t near = part->near, far = part->far;
    int64_t b = part->begin / gb_blocks_size(list->count);
    int64_t end = gb_blocks_end(list->count, b);
    for (int64_t i = part->begin; i < part->end; i++) {
        int64_t n = list->near.start[i + 1] + list->far.start[i + 1];
        for (; n > 0; n--, found++) {
            if (found->near) {
                put_pair(&list->near, i, near++, found);
            } else {
                put_pair(&list->far, i, far++, found);
            }
        }
        if (patchable && i + 1 == end) {
            near = end_block(list, &list->near, b, i, near);
            far = end_block(list, &list->far, b, i, far);
            end = gb_blocks_end(list->count, ++b);
        }
        list->near.start[i + 1] = near;
        list->far.start[i + 1] = far;
    }
}

struct filling {
    struct gb_neighbour_list *list;
    const struct scan *scan;
    struct part *part;
};

static void scan_item(void *data, int64_t t)
{
    struct filling *filling = data;
    struct part *part = &filling->part[t];
    (void)scan_part(filling->list, filling->scan, part); /* the part keeps the error */
}

static void fill_item(void *data, int64_t t)
{
    struct filling *filling = data;
    fill_part(filling->list, &filling->part[t]);
}

static bool fill_lists(struct gb_neighbour_list *list, const struct scan *scan,
                       struct gb_team *team, struct gb_error *err)
{
    const int parts = gb_team_size(team);
    struct part *part = gb_alloc_array((size_t)parts, sizeof *part, err);
    if (!part) {
        return false;
    }
    struct filling filling = {list, scan, part};
    const int64_t pairs = list->near.pair_count + list->far.pair_count;
    for (int t = 0; t < parts; t++) {
        part[t].expected = (pairs + pairs / 16) / parts;
        part[t].begin = gb_share(list->count, t, parts);
        part[t].end = gb_share(list->count, t + 1, parts);
    }
    gb_team_run(team, parts, scan_item, &filling);
    const bool good = assign_part_slots(list, part, parts, err);
    if (good) {
        gb_team_run(team, parts, fill_item, &filling);
    }
    for (int t = 0; t < parts; t++) {
        gb_alloc_free(part[t].found);
    }
    gb_alloc_free(part);
    return good;
}

/* The transposed list, by counting. */
static void transpose(struct gb_pair_list *pairs, int64_t count)
{
    int64_t *in = pairs->in_start;
    memset(in, 0, ((size_t)count + 1) * sizeof *in);
    for (int64_t k = 0; k < pairs->pair_count; k++) {
        in[pairs->other[k] + 1]++;
    }
    for (int64_t j = 0; j < count; j++) {
        in[j + 1] += in[j];
    }
    for (int64_t k = 0; k < pairs->pair_count; k++) {
        pairs->in_slot[in[pairs->other[k]]++] = (int32_t)k;
    }
    for (int64_t j = count; j > 0; j--) {
        in[j] = in[j - 1];
    }
    in[0] = 0;
}

static void transpose_item(void *data, int64_t far)
{
    struct gb_neighbour_list *list = data;
    transpose(far ? &list->far : &list->near, list->count);
}

/* Notes what the list check compares with until the next build. */
static void record_build(struct gb_neighbour_list *list, const struct gb_cell *cell,
                         const double *position, const struct gb_neighbour_grid *grid)
{
    list->inserted_count = 0;
    list->grid = *grid;
    memcpy(list->built_position, position, 3 * (size_t)list->count * sizeof *position);
    list->built = *cell;
    gb_cell_init(&list->unit, 3, (const double[3]){1.0, 1.0, 1.0});
    list->strain = 0.0;
}

/* Candidates by levels of size for unequal particles, unless the cell is tilted. */
static bool find_candidates(struct gb_neighbour_list *list, struct scan *scan,
                            struct gb_team *team, struct gb_error *err)
{
    if (!list->diameter || scan->grid.tilted) {
        return true;
    }
    return (list->levels || levels_create(&list->levels, list->count, err)) &&
           levels_find(list->levels, scan, list->count, team, err);
}

bool gb_neighbour_list_build(struct gb_neighbour_list *list, const struct gb_cell *cell,
                             const double *position, struct gb_neighbour_list_range range,
                             struct gb_team *team, struct gb_error *err)
{
    const double skin = range.skin, gap = range.cutoff - 1.0 + skin;
    const double reach = list->largest - 1.0 + range.cutoff + skin;
    if (gb_cell_shortest(cell) < GB_EDGE_OVER_RANGE_MIN * reach) {
        return gb_error_set(
            err, GB_ERR_GUARD,
            "the cell has shrunk to %.3g d, less than twice the neighbour "
            "reach %.3g d: take more particles or another structure.base",
            gb_cell_shortest(cell), reach);
    }
    gb_neighbour_list_update_shifts(list, cell);
    struct scan scan = {.bounds = {(1.0 + skin) * (1.0 + skin), reach * reach, skin, gap},
                        .cell = cell,
                        .position = position,
                        .shift = (const double(*)[3])list->shift,
                        .diameter = list->diameter};
    grid_init(&scan.grid, cell, reach, list->count);
    if (!find_candidates(list, &scan, team, err) || !scan_sort(&scan, list, err) ||
        !fill_lists(list, &scan, team, err)) {
        return false;
    }
    if (list->layout == GB_NEIGHBOUR_LIST_TRANSPOSED) {
        gb_team_run(team, 2, transpose_item, list);
    }
    record_build(list, cell, position, &scan.grid);
    return true;
}

/* ---- Motion since the build ---- */

/* Largest squared displacement in excess of the affine motion, in *most.  *total is the sum of
 * all squares: not finite when a coordinate is not. */
GB_SIMD_LOOP void displacement_loop(const double *restrict position,
                                    const double *restrict built, const double scaling[3],
                                    int64_t count, double *restrict total,
                                    double *restrict most)
{
    const double sx = scaling[0], sy = scaling[1], sz = scaling[2];
    double sum = 0.0, longest = 0.0;
#pragma omp simd reduction(+ : sum) reduction(max : longest)
    for (int64_t i = 0; i < count; i++) {
        const double x = position[3 * i] - built[3 * i] * sx;
        const double y = position[3 * i + 1] - built[3 * i + 1] * sy;
        const double z = position[3 * i + 2] - built[3 * i + 2] * sz;
        const double square = x * x + y * y + z * z;
        longest = square > longest ? square : longest;
        sum += square;
    }
    *total = sum;
    *most = longest;
}
GB_SIMD_WIDTHS(displacement,
               (const double *position, const double *built, const double scaling[3],
                int64_t count, double *total, double *most),
               (position, built, scaling, count, total, most))

double gb_neighbour_list_displacement2_tilted(const struct gb_neighbour_list *list,
                                              int64_t i, const double x[3])
{
    double matrix[3][3], moved[3];
    gb_cell_matrix(&list->unit, matrix);
    gb_mat_apply((const double(*)[3])matrix, list->built_position + 3 * i, moved);
    gb_vec_add(moved, -1.0, x);
    return gb_vec_dot(moved, moved);
}

/* displacement() for a cell that was sheared. */
static void displacement_sheared(const struct gb_neighbour_list *list,
                                 const double *position, int64_t begin, int64_t end,
                                 double *total, double *most)
{
    for (int64_t i = begin; i < end; i++) {
        const double square =
            gb_neighbour_list_displacement2_tilted(list, i, position + 3 * i);
        *most = square > *most ? square : *most;
        *total += square;
    }
}

double gb_neighbour_list_displacement(const struct gb_neighbour_list *list,
                                      const double *position, int64_t begin, int64_t end)
{
    double total = 0.0, most = 0.0;
    if (gb_cell_tilted(&list->unit)) {
        displacement_sheared(list, position, begin, end, &total, &most);
    } else {
        displacement(position + 3 * begin, list->built_position + 3 * begin,
                     list->unit.edge, end - begin, &total, &most);
    }
    /* a maximum alone would ignore NaN: comparisons with it are false */
    return isfinite(total) ? sqrt(most) : (double)NAN;
}

/* Bound of |F^-1 r - r| / |r|. */
static double strain_of(const struct gb_deformation *deformation)
{
    double inverse[3][3], sum = 0.0, change = 0.0;
    if (gb_deformation_is_scaling(deformation)) {
        for (int k = 0; k < 3; k++) {
            change = fmax(change, fabs(1.0 / deformation->f[k][k] - 1.0));
        }
        return change;
    }
    gb_mat_inverse(deformation->f, inverse);
    for (int k = 0; k < 3; k++) {
        inverse[k][k] -= 1.0;
        sum += gb_vec_dot(inverse[k], inverse[k]);
    }
    return sqrt(sum);
}

void gb_neighbour_list_deform(struct gb_neighbour_list *list,
                              const struct gb_deformation *deformation)
{
    gb_cell_deform(&list->unit, deformation);
    list->strain = (1.0 + list->strain) * (1.0 + strain_of(deformation)) - 1.0;
}
