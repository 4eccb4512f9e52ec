#ifndef GB_PACK_CELL_NEIGHBOUR_GRID_H
#define GB_PACK_CELL_NEIGHBOUR_GRID_H

#include <stdbool.h>
#include <stdint.h>

#include "pack/cell/cell.h"

/* Grid cells at least as wide as the reach of a neighbour list, for pairs.c, which sorts
 * the particles into them, and strays.c, which looks them up again. */
struct gb_neighbour_grid {
    int n[3];        /* grid cells along each axis */
    int span_low[3]; /* neighbouring cells to visit: span_low .. span_high */
    int span_high[3];
    double inverse[3]; /* of their edges */
    bool plain;        /* which image is meant follows from the grid cells */
};

/* The same for the same edges, reach and count.  About one particle per grid cell at
 * most, however dilute the packing. */
void gb_neighbour_grid_init(struct gb_neighbour_grid *grid, const struct gb_cell *cell,
                            double reach, int64_t count);

/* The grid cell of a place inside the cell, along each axis. */
void gb_neighbour_grid_home(const struct gb_neighbour_grid *grid, const double x[3],
                            int home[3]);

static inline int gb_neighbour_grid_index(const struct gb_neighbour_grid *grid,
                                          const int home[3])
{
    return (home[2] * grid->n[1] + home[1]) * grid->n[0] + home[0];
}

#endif
