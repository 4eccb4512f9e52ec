#include "pack/structure/grid.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/portable.h"

/* Grid cells for each point of the capacity: more would cost memory and empty visits. */
static const double cells_per_point = 8.0;

/* Searches reach this much farther than asked, so that a point on the border of a grid
 * cell is not lost to rounding; the exact test follows. */
static const double margin = 1e-9;

static void choose_cells(struct gb_grid *grid, double size)
{
    const int axes = grid->cell.periodic[1] ? 3 : 2;
    const double room =
        gb_cell_volume(&grid->cell) / (cells_per_point * (double)grid->capacity + 64.0);
    const double least = fmax(size, axes == 3 ? gb_portable_cbrt(room) : sqrt(room));
    for (int k = 0; k < 3; k++) {
        const double cells = floor(grid->cell.edge[k] / least);
        const bool many = grid->cell.periodic[k] && cells > 1.0;
        grid->cells[k] = many ? (int)fmin(cells, 1e6) : 1;
        grid->size[k] = grid->cell.edge[k] / grid->cells[k];
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
    grid->capacity = capacity;
    choose_cells(grid, size);
    const size_t points = capacity > 0 ? (size_t)capacity : 1;
    const size_t cells =
        (size_t)grid->cells[0] * (size_t)grid->cells[1] * (size_t)grid->cells[2];
    grid->position = gb_alloc_array(points, 3 * sizeof(double), err);
    if (!grid->position) {
        goto fail;
    }
    grid->first = gb_alloc_array(cells, sizeof(int32_t), err);
    if (!grid->first) {
        goto fail;
    }
    grid->next = gb_alloc_array(points, sizeof(int32_t), err);
    if (!grid->next) {
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
    gb_alloc_free(grid->next);
    gb_alloc_free(grid->first);
    gb_alloc_free(grid->position);
    gb_alloc_free(grid);
}

static size_t cell_index(const struct gb_grid *grid, const int cell[3])
{
    const size_t row = (size_t)cell[0] * (size_t)grid->cells[1] + (size_t)cell[1];
    return row * (size_t)grid->cells[2] + (size_t)cell[2];
}

void gb_grid_insert(struct gb_grid *grid, const double x[3])
{
    double *wrapped = grid->position + 3 * grid->count;
    memcpy(wrapped, x, 3 * sizeof(double));
    gb_cell_wrap(&grid->cell, wrapped);
    int cell[3];
    for (int k = 0; k < 3; k++) {
        const int last = grid->cells[k] - 1;
        const int at = last > 0 ? (int)(wrapped[k] / grid->size[k]) : 0;
        cell[k] = at < last ? at : last;
    }
    int32_t *first = &grid->first[cell_index(grid, cell)];
    grid->next[grid->count] = *first;
    grid->count++;
    *first = (int32_t)grid->count;
}

/* Sets the range of axis k to the grid cells that meet [from, to]. */
static void window_range(struct gb_grid_window *window, const struct gb_grid *grid, int k,
                         double from, double to)
{
    const int cells = grid->cells[k];
    int low = 0;
    int high = 0;
    if (grid->cell.periodic[k]) {
        low = (int)floor(from / grid->size[k] - margin);
        high = (int)floor(to / grid->size[k] + margin);
    }
    const int image = low >= 0 ? low / cells : -((cells - 1 - low) / cells);
    window->low[k] = low;
    window->high[k] = high;
    window->low_image[k] = image;
    window->low_cell[k] = low - image * cells;
}

static void window_rewind(struct gb_grid_window *window, int k)
{
    window->at[k] = window->low[k];
    window->cell[k] = window->low_cell[k];
    window->image[k] = window->low_image[k];
}

static void window_start(struct gb_grid_window *window, const struct gb_grid *grid)
{
    for (int k = 0; k < 3; k++) {
        window_rewind(window, k);
    }
    window->first = grid->first + cell_index(grid, window->cell);
    window->item = *window->first;
}

static bool window_step(struct gb_grid_window *window, const struct gb_grid *grid)
{
    for (int k = 2; k >= 0; k--) {
        if (window->at[k] < window->high[k]) {
            window->at[k]++;
            if (++window->cell[k] == grid->cells[k]) {
                window->cell[k] = 0;
                window->image[k]++;
            }
            return true;
        }
        window_rewind(window, k);
    }
    return false;
}

/* To the next grid cell, mostly the neighbour in memory. */
static bool window_advance(struct gb_grid_window *window, const struct gb_grid *grid)
{
    if (window->at[2] < window->high[2] && window->cell[2] + 1 < grid->cells[2]) {
        window->at[2]++;
        window->cell[2]++;
        window->first++;
        return true;
    }
    if (!window_step(window, grid)) {
        return false;
    }
    window->first = grid->first + cell_index(grid, window->cell);
    return true;
}

/* Index of the next point in the window, or -1. */
static int64_t window_next(struct gb_grid_window *window, const struct gb_grid *grid)
{
    while (window->item == 0) {
        if (!window_advance(window, grid)) {
            return -1;
        }
        window->item = *window->first;
    }
    const int64_t index = window->item - 1;
    window->item = grid->next[index];
    return index;
}

/* r from origin to the image the window stands on; its square. */
static double separation(const struct gb_grid *grid, const struct gb_grid_window *window,
                         int64_t index, const double origin[3], double r[3])
{
    const double *x = grid->position + 3 * index;
    double square = 0.0;
    for (int k = 0; k < 3; k++) {
        r[k] = x[k] + window->image[k] * grid->cell.edge[k] - origin[k];
        square += r[k] * r[k];
    }
    return square;
}

void gb_grid_ball_init(struct gb_grid_ball *ball, const struct gb_grid *grid,
                       const double centre[3], double reach)
{
    ball->grid = grid;
    ball->square = reach * reach;
    memcpy(ball->centre, centre, sizeof(ball->centre));
    for (int k = 0; k < 3; k++) {
        window_range(&ball->window, grid, k, centre[k] - reach, centre[k] + reach);
    }
    window_start(&ball->window, grid);
}

bool gb_grid_ball_next(struct gb_grid_ball *ball, struct gb_grid_hit *hit)
{
    int64_t index;
    while ((index = window_next(&ball->window, ball->grid)) >= 0) {
        const double square =
            separation(ball->grid, &ball->window, index, ball->centre, hit->r);
        if (square <= ball->square) {
            hit->index = index;
            hit->square = square;
            memcpy(hit->image, ball->window.image, sizeof(hit->image));
            return true;
        }
    }
    return false;
}

/* Opens the window on the part of one slab that the cylinder around the ray crosses.  The
 * cylinder cuts a plane across `axis` in an ellipse; its half width along k is
 * reach sqrt(1 + slope^2), slope = direction_k / direction_axis. */
static void open_slab(struct gb_grid_ray *ray)
{
    const struct gb_grid *grid = ray->grid;
    const double from = ray->slab * grid->size[ray->axis];
    const double to = from + grid->size[ray->axis];
    for (int k = 0; k < 3; k++) {
        if (k == ray->axis) {
            /* Half-way in, so that rounding cannot open a neighbour slab as well. */
            const double middle = 0.5 * (from + to);
            window_range(&ray->window, grid, k, middle, middle);
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
    const double size = grid->size[ray->axis];
    const double start = origin[ray->axis];
    const double end = start + length * direction[ray->axis];
    ray->slab = (int)floor((fmin(start, end) - reach) / size - margin);
    ray->last_slab = (int)floor((fmax(start, end) + reach) / size + margin);
    open_slab(ray);
}

bool gb_grid_ray_next(struct gb_grid_ray *ray, struct gb_grid_hit *hit)
{
    for (;;) {
        int64_t index;
        while ((index = window_next(&ray->window, ray->grid)) >= 0) {
            const double square =
                separation(ray->grid, &ray->window, index, ray->origin, hit->r);
            const double along = hit->r[0] * ray->direction[0] +
                                 hit->r[1] * ray->direction[1] +
                                 hit->r[2] * ray->direction[2];
            if (along < 0.0 || along > ray->length ||
                square - along * along > ray->reach * ray->reach) {
                continue;
            }
            hit->index = index;
            hit->square = square;
            hit->along = along;
            memcpy(hit->image, ray->window.image, sizeof(hit->image));
            return true;
        }
        if (ray->slab == ray->last_slab) {
            return false;
        }
        ray->slab++;
        open_slab(ray);
    }
}
