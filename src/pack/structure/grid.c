/* A search grid in a periodic cell.  Points are added one by one.
 *
 * Chain growth places one particle after the other and asks after each which particles lie in
 * a ball or along a ray.  Grid cells lie in blocks of 4 x 4 x 4, and one word tells which of
 * the 64 cells of a block hold points, so that a search visits these alone.  Points of a cell
 * form a list.
 *
 * A search runs over unwrapped indices of grid cells (a window).  It therefore meets every
 * periodic image once, also in cells smaller than the search.  A ray is searched slab by slab,
 * along the axis that it is closest to. */

#include "pack/structure/grid.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "base/alloc.h"
#include "base/mat.h"
#include "base/portable.h"

/* ---- Grid ---- */

/* Grid cells for each point of the capacity: more would cost memory and empty visits. */
static const double cells_per_point = 8.0;

static void choose_cells(struct gb_grid *grid, double size)
{
    const int axes = grid->cell.periodic[1] ? 3 : 2;
    const double room =
        gb_cell_volume(&grid->cell) / (cells_per_point * (double)grid->capacity + 64.0);
    const double least = fmax(size, axes == 3 ? gb_portable_cbrt(room) : sqrt(room));
    for (int k = 0; k < 3; k++) {
        const double spacing = gb_cell_spacing(&grid->cell, k);
        const double blocks = floor(spacing / (GB_GRID_SIDE * least));
        const bool many = grid->cell.periodic[k] && blocks > 1.0;
        grid->blocks[k] = many ? (int)fmin(blocks, 1e6) : 1;
        grid->per_length[k] = GB_GRID_SIDE * grid->blocks[k] / spacing;
    }
}

static void set_heights(struct gb_grid *grid)
{
    double inverse[3][3];
    gb_cell_matrix(&grid->cell, grid->matrix);
    gb_cell_inverse(&grid->cell, inverse);
    for (int k = 0; k < 9; k++) {
        grid->height[k / 3][k % 3] =
            gb_cell_spacing(&grid->cell, k / 3) * inverse[k / 3][k % 3];
    }
}

/* Heights of x over the faces of the cell, d; x itself without tilt. */
static void heights(const struct gb_grid *grid, const double x[3], double height[3])
{
    if (grid->tilted) {
        gb_mat_apply((const double(*)[3])grid->height, x, height);
    } else {
        memcpy(height, x, 3 * sizeof *height);
    }
}

bool gb_grid_create(struct gb_grid **out, const struct gb_cell *cell, double size,
                    int64_t capacity, struct gb_error *err)
{
    *out = NULL;
    if (capacity < 0 || capacity > INT32_MAX - 1) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "particles.count = %lld: a grid holds at most %d",
                            (long long)capacity, INT32_MAX - 1);
    }
    struct gb_grid *grid = gb_alloc_array(1, sizeof(*grid), err);
    if (!grid) {
        return false;
    }
    grid->cell = *cell;
    grid->tilted = gb_cell_tilted(cell);
    set_heights(grid);
    grid->capacity = capacity;
    choose_cells(grid, size);
    const size_t points = capacity > 0 ? (size_t)capacity : 1;
    const size_t blocks =
        (size_t)grid->blocks[0] * (size_t)grid->blocks[1] * (size_t)grid->blocks[2];
    grid->position = gb_alloc_array(points, 3 * sizeof(double), err);
    if (!grid->position) {
        goto fail;
    }
    grid->occupied = gb_alloc_array(blocks, sizeof(uint64_t), err);
    if (!grid->occupied) {
        goto fail;
    }
    grid->last = gb_alloc_array(blocks, GB_GRID_BLOCK * sizeof(uint32_t), err);
    if (!grid->last) {
        goto fail;
    }
    grid->previous = gb_alloc_array(points, sizeof(uint32_t), err);
    if (!grid->previous) {
        goto fail;
    }
    *out = grid;
    return true;
fail:
    gb_grid_destroy(grid);
    return false;
}

void gb_grid_destroy(struct gb_grid *grid)
{
    if (!grid) {
        return;
    }
    gb_alloc_free(grid->previous);
    gb_alloc_free(grid->last);
    gb_alloc_free(grid->occupied);
    gb_alloc_free(grid->position);
    gb_alloc_free(grid);
}

/* Of a block with these indices, along every axis from 0 to below `blocks`. */
static size_t block_index(const struct gb_grid *grid, const int block[3])
{
    const size_t row = (size_t)block[0] * (size_t)grid->blocks[1] + (size_t)block[1];
    return row * (size_t)grid->blocks[2] + (size_t)block[2];
}

void gb_grid_insert(struct gb_grid *grid, const double x[3])
{
    double *wrapped = grid->position + 3 * grid->count;
    memcpy(wrapped, x, 3 * sizeof(double));
    gb_cell_wrap(&grid->cell, wrapped);
    double height[3];
    heights(grid, wrapped, height);
    int block[3], bit = 0;
    for (int k = 0; k < 3; k++) {
        const int last = GB_GRID_SIDE * grid->blocks[k] - 1;
        const int at =
            grid->cell.periodic[k] ? (int)(height[k] * grid->per_length[k]) : 0;
        const int cell = at < last ? at : last;
        block[k] = cell / GB_GRID_SIDE;
        bit = GB_GRID_SIDE * bit + cell % GB_GRID_SIDE;
    }
    const size_t index = block_index(grid, block);
    uint32_t *last = &grid->last[GB_GRID_BLOCK * index + (size_t)bit];
    const bool empty = !(grid->occupied[index] >> bit & 1);
    grid->previous[grid->count] = *last;
    grid->occupied[index] |= (uint64_t)1 << bit;
    *last = (uint32_t)grid->count | (empty ? 0 : GB_GRID_SEVERAL);
    grid->count++;
}

/* ---- Window: the grid cells of a cuboid, block by block ---- */

/* Searches reach this much farther than asked, so that a point on the border of a grid
 * cell is not lost to rounding; the exact test follows. */
static const double margin = 1e-9;

/* The next lower whole number; |x| < 2^31. */
static int lower(double x)
{
    const int toward_zero = (int)x;
    return toward_zero - (x < toward_zero);
}

/* The block of a grid cell, both unwrapped. */
static int block_of(int cell)
{
    return (cell - (cell & (GB_GRID_SIDE - 1))) / GB_GRID_SIDE;
}

/* Sets the range of axis k to the grid cells that meet [from, to]. */
static void window_range(struct gb_grid_window *window, const struct gb_grid *grid, int k,
                         double from, double to)
{
    const int blocks = grid->blocks[k];
    int low = 0;
    int high = 0;
    if (grid->cell.periodic[k]) {
        low = lower(from * grid->per_length[k] - margin);
        high = lower(to * grid->per_length[k] + margin);
    }
    const int block = block_of(low);
    const int image = block >= 0 ? block / blocks : -((blocks - 1 - block) / blocks);
    window->low[k] = low;
    window->high[k] = high;
    window->low_block[k] = block;
    window->high_block[k] = block_of(high);
    window->low_image[k] = image;
    window->low_wrapped[k] = block - image * blocks;
}

/* The cells of the block at hand that lie within the range of axis k. */
static uint64_t axis_mask(const struct gb_grid_window *window, int k)
{
    static const uint64_t all = UINT64_MAX;
    static const uint64_t repeated[3] = {1, 0x0001000100010001, 0x1111111111111111};
    const int block = GB_GRID_SIDE * window->at[k];
    const int low = window->low[k] > block ? window->low[k] - block : 0;
    const int over = block + GB_GRID_SIDE - 1 - window->high[k];
    const int high = over > 0 ? over : 0;
    /* Bits that one cell of the axis stands for, and all of the axis. */
    const int width = k == 0 ? GB_GRID_SIDE * GB_GRID_SIDE : k == 1 ? GB_GRID_SIDE : 1;
    const int length = GB_GRID_SIDE * width;
    const uint64_t whole = all >> (GB_GRID_BLOCK - length);
    return ((whole << (low * width)) & (whole >> (high * width))) * repeated[k];
}

static void window_update(struct gb_grid_window *window, const struct gb_grid *grid,
                          int k)
{
    window->shift[k] = window->image[k] * grid->cell.edge[k];
    window->mask[k] = axis_mask(window, k);
}

static void window_rewind(struct gb_grid_window *window, const struct gb_grid *grid,
                          int k)
{
    window->at[k] = window->low_block[k];
    window->wrapped[k] = window->low_wrapped[k];
    window->image[k] = window->low_image[k];
    window_update(window, grid, k);
}

/* Cells of the block at hand that hold points. */
static uint64_t window_open(struct gb_grid_window *window, const struct gb_grid *grid)
{
    const size_t index = block_index(grid, window->wrapped);
    if (grid->tilted) {
        const double whole[3] = {window->image[0], window->image[1], window->image[2]};
        gb_mat_apply((const double(*)[3])grid->matrix, whole, window->shift);
    }
    window->last = grid->last + GB_GRID_BLOCK * index;
    return grid->occupied[index] & window->mask[0] & window->mask[1] & window->mask[2];
}

static void window_start(struct gb_grid_window *window, const struct gb_grid *grid)
{
    for (int k = 0; k < 3; k++) {
        window_rewind(window, grid, k);
    }
    window->bits = window_open(window, grid);
    window->unfinished = 0;
    window->taken = 0;
    window->found = 0;
}

/* To the next block. */
static bool window_step(struct gb_grid_window *window, const struct gb_grid *grid)
{
    for (int k = 2; k >= 0; k--) {
        if (window->at[k] < window->high_block[k]) {
            window->at[k]++;
            if (++window->wrapped[k] == grid->blocks[k]) {
                window->wrapped[k] = 0;
                window->image[k]++;
            }
            window_update(window, grid, k);
            return true;
        }
        if (window->at[k] > window->low_block[k]) {
            window_rewind(window, grid, k);
        }
    }
    return false;
}

/* Takes points of the next block that has some, not more than the window keeps. */
static bool window_fill(struct gb_grid_window *window, const struct gb_grid *grid)
{
    uint64_t bits = window->bits;
    uint32_t last = window->unfinished;
    int found = 0;
    for (;;) {
        while ((last & GB_GRID_SEVERAL) && found < GB_GRID_WINDOW) {
            last = grid->previous[last & ~GB_GRID_SEVERAL];
            window->point[found++] = last & ~GB_GRID_SEVERAL;
        }
        if (found == GB_GRID_WINDOW) {
            break;
        }
        if (bits == 0) {
            if (found > 0 || !window_step(window, grid)) {
                break;
            }
            bits = window_open(window, grid);
            continue;
        }
        last = window->last[__builtin_ctzll(bits)];
        bits &= bits - 1;
        __builtin_prefetch(grid->position + 3 * (last & ~GB_GRID_SEVERAL));
        window->point[found++] = last & ~GB_GRID_SEVERAL;
    }
    window->bits = bits;
    window->unfinished = last;
    window->taken = 0;
    window->found = found;
    return found > 0;
}

/* r from origin to an image of a point; its square. */
static double separation(const struct gb_grid *grid, int64_t index, const double shift[3],
                         const double origin[3], double r[3])
{
    const double *x = grid->position + 3 * index;
    double square = 0.0;
    for (int k = 0; k < 3; k++) {
        r[k] = x[k] + shift[k] - origin[k];
        square += r[k] * r[k];
    }
    return square;
}

/* The next point of the window, near or not; r from origin. */
static bool window_next(struct gb_grid_window *window, const struct gb_grid *grid,
                        const double origin[3], struct gb_grid_hit *hit)
{
    if (window->taken == window->found && !window_fill(window, grid)) {
        return false;
    }
    hit->index = window->point[window->taken++];
    hit->square = separation(grid, hit->index, window->shift, origin, hit->r);
    memcpy(hit->image, window->image, sizeof(hit->image));
    return true;
}

/* ---- Ball ---- */

void gb_grid_ball_init(struct gb_grid_ball *ball, const struct gb_grid *grid,
                       const double centre[3], double reach)
{
    ball->grid = grid;
    ball->square = reach * reach;
    memcpy(ball->centre, centre, sizeof(ball->centre));
    double height[3];
    heights(grid, centre, height);
    for (int k = 0; k < 3; k++) {
        window_range(&ball->window, grid, k, height[k] - reach, height[k] + reach);
    }
    window_start(&ball->window, grid);
}

bool gb_grid_ball_next(struct gb_grid_ball *ball, struct gb_grid_hit *hit)
{
    while (window_next(&ball->window, ball->grid, ball->centre, hit)) {
        if (hit->square <= ball->square) {
            return true;
        }
    }
    return false;
}

/* ---- Ray ---- */

/* Opens the window on the part of one slab of blocks that the cylinder around the ray crosses.  The
 * cylinder cuts a plane across `axis` in an ellipse; its half width along k is
 * reach sqrt(1 + slope^2), slope = direction_k / direction_axis. */
static void open_slab(struct gb_grid_ray *ray)
{
    const struct gb_grid *grid = ray->grid;
    const double from = ray->slab * ray->thickness;
    const double to = from + ray->thickness;
    for (int k = 0; k < 3; k++) {
        if (k == ray->axis) {
            /* Off its borders, so that rounding cannot open a neighbour slab as well. */
            const double inside = 0.1 * ray->thickness;
            window_range(&ray->window, grid, k, from + inside, to - inside);
            continue;
        }
        const double slope = ray->direction[k] / ray->direction[ray->axis];
        const double half = ray->reach * sqrt(1.0 + slope * slope);
        const double a = ray->origin[k] + slope * (from - ray->origin[ray->axis]);
        const double b = ray->origin[k] + slope * (to - ray->origin[ray->axis]);
        window_range(&ray->window, grid, k, fmin(a, b) - half, fmax(a, b) + half);
    }
    window_start(&ray->window, grid);
}

void gb_grid_ray_init(struct gb_grid_ray *ray, const struct gb_grid *grid,
                      const double origin[3], const double direction[3], double reach,
                      double length)
{
    ray->grid = grid;
    ray->reach = reach;
    ray->length = length;
    memcpy(ray->origin, origin, sizeof(ray->origin));
    memcpy(ray->direction, direction, sizeof(ray->direction));
    ray->axis = 0;
    for (int k = 1; k < 3; k++) {
        if (fabs(direction[k]) > fabs(direction[ray->axis])) {
            ray->axis = k;
        }
    }
    ray->thickness = GB_GRID_SIDE / grid->per_length[ray->axis];
    const double start = origin[ray->axis];
    const double end = start + length * direction[ray->axis];
    ray->slab = (int)floor((fmin(start, end) - reach) / ray->thickness - margin);
    ray->last_slab = (int)floor((fmax(start, end) + reach) / ray->thickness + margin);
    open_slab(ray);
}

/* False when the ray ends. */
static bool next_slab(struct gb_grid_ray *ray)
{
    if (ray->slab == ray->last_slab) {
        return false;
    }
    ray->slab++;
    open_slab(ray);
    return true;
}

bool gb_grid_ray_next(struct gb_grid_ray *ray, struct gb_grid_hit *hit)
{
    do {
        while (window_next(&ray->window, ray->grid, ray->origin, hit)) {
            const double along = hit->r[0] * ray->direction[0] +
                                 hit->r[1] * ray->direction[1] +
                                 hit->r[2] * ray->direction[2];
            if (along >= 0.0 && along <= ray->length &&
                hit->square - along * along <= ray->reach * ray->reach) {
                hit->along = along;
                return true;
            }
        }
    } while (next_slab(ray));
    return false;
}
