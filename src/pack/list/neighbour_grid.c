#include "pack/list/neighbour_grid.h"

#include <math.h>

#include "base/mat.h"
#include "base/portable.h"

static int clamp(int value, int low, int high)
{
    return value < low ? low : value > high ? high : value;
}

void gb_neighbour_grid_init(struct gb_neighbour_grid *grid, const struct gb_cell *cell,
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

void gb_neighbour_grid_bin(const struct gb_neighbour_grid *grid, const double x[3],
                           int bin[3])
{
    for (int k = 0; k < 3; k++) {
        const double bins =
            grid->tilted ? gb_vec_dot(grid->to_bin[k], x) : x[k] * grid->inverse[k];
        bin[k] = clamp((int)bins, 0, grid->n[k] - 1);
    }
}
