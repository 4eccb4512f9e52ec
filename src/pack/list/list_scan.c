#include "pack/list/list_scan.h"

#include <string.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "pack/structure/hgrid.h"

/* A call for every row of bins would take a third of the time of a scan. */
#define INLINE static inline __attribute__((always_inline))

/* Neighbours up to which a branch-free sort is used; most particles have no more. */
enum { FEW = 32 };

static int bin_of(const struct gb_list_scan *scan, int64_t i)
{
    int bin[3];
    gb_neighbour_grid_bin(&scan->grid, scan->position + 3 * i, bin);
    return gb_neighbour_grid_index(&scan->grid, bin);
}

/* Counting sort by bins. */
static void sort_into_bins(const struct gb_list_scan *scan,
                           struct gb_neighbour_list *list, double (*sorted)[3],
                           int64_t bins)
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
        memcpy(sorted[at], scan->position + 3 * i, sizeof *sorted);
    }
}

bool gb_list_scan_sort(struct gb_list_scan *scan, struct gb_neighbour_list *list,
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
    double(*sorted)[3] = (double(*)[3])list->built_position;
    sort_into_bins(scan, list, sorted, bins);
    scan->sorted = (const double(*)[3])sorted;
    scan->start = list->bin_start;
    scan->particle = list->bin_particle;
    return true;
}

/* The same as nearest_image in a tilted cell. */
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

/* Nearest image of x_i - x_j: returns its index, and the squared distance. */
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

/* Bounds of a pair of unequal diameters. */
static struct gb_list_scan_bounds bounds_of(const struct gb_list_scan *scan, int64_t i,
                                            int32_t j, struct gb_list_scan_bounds any)
{
    const double contact = 0.5 * (scan->diameter[i] + scan->diameter[j]);
    const double near = contact + any.skin, far = contact + any.gap;
    return (struct gb_list_scan_bounds){near * near, far * far, any.skin, any.gap};
}

/* Ascending by `other`.  The rank of each is the number of smaller ones, counted without
 * a branch: the order is random, and a mispredicted branch costs more. */
static void sort_few(struct gb_list_scan_found *list, int n)
{
    struct gb_list_scan_found found[FEW];
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

static void sort_many(struct gb_list_scan_found *list, int n)
{
    for (int l = 1; l < n; l++) {
        const struct gb_list_scan_found item = list[l];
        int k = l;
        for (; k > 0 && list[k - 1].other > item.other; k--) {
            list[k] = list[k - 1];
        }
        list[k] = item;
    }
}

/* Particles of the bins first .. last with a larger index than i and within the bounds.
 * image: the one that all of them have, where the grid is plain. */
INLINE int scan_bins(const struct gb_list_scan *scan, int64_t i, int first, int last,
                     int image, struct gb_list_scan_found *list, int n)
{
    const double *x = scan->position + 3 * i, *shift = scan->shift[image];
    /* copies, which the stores to the list cannot alias */
    const struct gb_list_scan_bounds bounds = scan->bounds;
    const double *diameter = scan->diameter;
    const double(*sorted)[3] = scan->sorted;
    const int32_t *particle = scan->particle, end = scan->start[last + 1];
    const bool plain = scan->grid.plain;
    for (int32_t k = scan->start[first]; k < end && n < GB_LIST_SCAN_MAX; k++) {
        const double *y = sorted[k];
        const double r[3] = {x[0] - y[0] + shift[0], x[1] - y[1] + shift[1],
                             x[2] - y[2] + shift[2]};
        double squared = r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
        uint8_t seen = (uint8_t)image;
        if (!plain) {
            seen = scan->grid.tilted ? nearest_image_tilted(scan->cell, x, y, &squared)
                                     : nearest_image(scan->cell, x, y, &squared);
        }
        const int32_t other = particle[k];
        const struct gb_list_scan_bounds own =
            diameter ? bounds_of(scan, i, other, bounds) : bounds;
        list[n] = (struct gb_list_scan_found){other, seen, squared < own.near};
        n += (squared < own.far) & (other > i);
    }
    return n;
}

/* Image of a neighbouring bin along one axis, as a digit of the index of the image. */
static int image_digit(int bin, int n)
{
    return bin < 0 ? 2 : bin >= n ? 0 : 1;
}

/* One row of bins along x. */
INLINE int scan_row(const struct gb_list_scan *scan, int64_t i, int bin, int row,
                    int image, struct gb_list_scan_found *list, int n)
{
    const struct gb_neighbour_grid *grid = &scan->grid;
    const int bins = grid->n[0];
    if (grid->plain && bins > 2 && bin > 0 && bin < bins - 1) {
        return scan_bins(scan, i, row + bin - 1, row + bin + 1, image + 1, list, n);
    }
    for (int u = grid->span_low[0]; u <= grid->span_high[0]; u++) {
        const int c = row + (bin + u + bins) % bins;
        n = scan_bins(scan, i, c, c, image + image_digit(bin + u, bins), list, n);
    }
    return n;
}

/* The candidates of particle i within their bounds; they are sorted. */
static int scan_candidates(const struct gb_list_scan *scan, int64_t i,
                           struct gb_list_scan_found *found)
{
    const struct gb_hgrid *pairs = scan->candidates;
    int n = 0;
    for (int64_t k = pairs->start[i]; k < pairs->start[i + 1]; k++) {
        const int32_t other = pairs->other[k];
        double squared;
        const uint8_t image = nearest_image(scan->cell, scan->position + 3 * i,
                                            scan->position + 3 * other, &squared);
        const struct gb_list_scan_bounds own = bounds_of(scan, i, other, scan->bounds);
        found[n] = (struct gb_list_scan_found){other, image, squared < own.near};
        n += squared < own.far;
    }
    return n;
}

int64_t gb_list_scan_most(const struct gb_list_scan *scan, int64_t i)
{
    const struct gb_hgrid *pairs = scan->candidates;
    return pairs ? pairs->start[i + 1] - pairs->start[i] : GB_LIST_SCAN_MAX;
}

/* Particles in the bins around particle i. */
static int scan_around(const struct gb_list_scan *scan, int64_t i,
                       struct gb_list_scan_found *found)
{
    const struct gb_neighbour_grid *grid = &scan->grid;
    int bin[3], n = 0;
    gb_neighbour_grid_bin(grid, scan->position + 3 * i, bin);
    for (int w = grid->span_low[2]; w <= grid->span_high[2]; w++) {
        const int cw = (bin[2] + w + grid->n[2]) % grid->n[2];
        for (int v = grid->span_low[1]; v <= grid->span_high[1]; v++) {
            const int cv = (bin[1] + v + grid->n[1]) % grid->n[1];
            const int image = 9 * image_digit(bin[2] + w, grid->n[2]) +
                              3 * image_digit(bin[1] + v, grid->n[1]);
            n = scan_row(scan, i, bin[0], (cw * grid->n[1] + cv) * grid->n[0], image,
                         found, n);
        }
    }
    (n <= FEW ? sort_few : sort_many)(found, n);
    return n;
}

int gb_list_scan_particle(const struct gb_list_scan *scan, int64_t i,
                          struct gb_list_scan_found *found)
{
    return (scan->candidates ? scan_candidates : scan_around)(scan, i, found);
}
