#include "pack/structure/grid.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/mat.h"
#include "base/portable.h"

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

void gb_grid_heights(const struct gb_grid *grid, const double x[3], double height[3])
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

size_t gb_grid_block_index(const struct gb_grid *grid, const int block[3])
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
    gb_grid_heights(grid, wrapped, height);
    int block[3], bit = 0;
    for (int k = 0; k < 3; k++) {
        const int last = GB_GRID_SIDE * grid->blocks[k] - 1;
        const int at =
            grid->cell.periodic[k] ? (int)(height[k] * grid->per_length[k]) : 0;
        const int cell = at < last ? at : last;
        block[k] = cell / GB_GRID_SIDE;
        bit = GB_GRID_SIDE * bit + cell % GB_GRID_SIDE;
    }
    const size_t index = gb_grid_block_index(grid, block);
    uint32_t *last = &grid->last[GB_GRID_BLOCK * index + (size_t)bit];
    const bool empty = !(grid->occupied[index] >> bit & 1);
    grid->previous[grid->count] = *last;
    grid->occupied[index] |= (uint64_t)1 << bit;
    *last = (uint32_t)grid->count | (empty ? 0 : GB_GRID_SEVERAL);
    grid->count++;
}
