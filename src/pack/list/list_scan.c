#include "pack/list/list_scan.h"

#include <string.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "pack/kernel/lanes.h"
#include "pack/kernel/simd.h"
#include "pack/structure/hgrid.h"

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
                           struct gb_neighbour_list *list, double *const sorted[3],
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
        for (int k = 0; k < 3; k++) {
            sorted[k][at] = scan->position[3 * i + k];
        }
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
GB_SIMD_LOOP void sort_few(struct gb_list_scan_found *list, int n)
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

/* Particles of the bins first .. last with a larger index than i and within the bounds, in a grid
 * that is not plain or of unequal diameters. */
static int scan_bins(const struct gb_list_scan *scan, int64_t i, int first, int last,
                     int image, struct gb_list_scan_found *list, int n)
{
    const double *x = scan->position + 3 * i, *shift = scan->shift[image];
    const int32_t *particle = scan->particle, end = scan->start[last + 1];
    for (int32_t k = scan->start[first]; k < end && n < GB_LIST_SCAN_MAX; k++) {
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
        const struct gb_list_scan_bounds own =
            scan->diameter ? bounds_of(scan, i, other, scan->bounds) : scan->bounds;
        list[n] = (struct gb_list_scan_found){other, seen, squared < own.near};
        n += (squared < own.far) & (other > i);
    }
    return n;
}

/* The same four at a time in a plain grid, where all of them have one image, and of one diameter:
 * bins that are beside each other have about as many. */
GB_SIMD_LOOP int scan_plain(const struct gb_list_scan *scan, int64_t i, int first,
                            int last, int image, struct gb_list_scan_found *list, int n)
{
    const double *x = scan->position + 3 * i, *shift = scan->shift[image];
    const double *const *sorted = scan->sorted;
    const int32_t *particle = scan->particle, end = scan->start[last + 1];
    const gb_lanes far = GB_LANES_ALL(scan->bounds.far);
    const gb_lanes near = GB_LANES_ALL(scan->bounds.near);
    const gb_lanes_index lane = {0, 1, 2, 3};
    for (int32_t k = scan->start[first]; k < end && n < GB_LIST_SCAN_MAX; k += 4) {
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
            list[n] = (struct gb_list_scan_found){particle[k + l], (uint8_t)image,
                                                  touching[l] != 0};
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
static int scan_row(const struct gb_list_scan *scan, int64_t i, int bin, struct row row,
                    struct gb_list_scan_found *list, int n)
{
    const struct gb_neighbour_grid *grid = &scan->grid;
    const int bins = grid->n[0];
    for (int u = grid->span_low[0]; u <= grid->span_high[0]; u++) {
        const int c = row.first + wrapped(bin + u, bins);
        n = scan_bins(scan, i, c, c, row.image + image_digit(bin + u, bins), list, n);
    }
    return n;
}

/* The same of a plain grid: bins that are beside each other are one range. */
GB_SIMD_LOOP int scan_row_plain(const struct gb_list_scan *scan, int64_t i, int bin,
                                struct row row, struct gb_list_scan_found *list, int n)
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
    return pairs ? pairs->start[i + 1] - pairs->start[i]
                 : GB_LIST_SCAN_MAX + GB_LANES_BEYOND;
}

/* Particles in the bins around particle i, sorted. */
GB_SIMD_LOOP void scan_around_loop(const struct gb_list_scan *scan, int64_t i,
                                   struct gb_list_scan_found *found, int *count)
{
    const struct gb_neighbour_grid *grid = &scan->grid;
    const bool plain = grid->plain && !scan->diameter;
    int bin[3], n = 0;
    gb_neighbour_grid_bin(grid, scan->position + 3 * i, bin);
    for (int w = grid->span_low[2]; w <= grid->span_high[2]; w++) {
        for (int v = grid->span_low[1]; v <= grid->span_high[1]; v++) {
            const struct row row = row_of(grid, bin[1] + v, bin[2] + w);
            n = plain ? scan_row_plain(scan, i, bin[0], row, found, n)
                      : scan_row(scan, i, bin[0], row, found, n);
        }
    }
    n = n < GB_LIST_SCAN_MAX ? n : GB_LIST_SCAN_MAX;
    if (n <= FEW) {
        sort_few(found, n);
    } else {
        sort_many(found, n);
    }
    *count = n;
}
GB_SIMD_WIDTHS(scan_around,
               (const struct gb_list_scan *scan, int64_t i,
                struct gb_list_scan_found *found, int *count),
               (scan, i, found, count))

int gb_list_scan_particle(const struct gb_list_scan *scan, int64_t i,
                          struct gb_list_scan_found *found)
{
    int count;
    if (scan->candidates) {
        return scan_candidates(scan, i, found);
    }
    scan_around(scan, i, found, &count);
    return count;
}
