#ifndef GB_PACK_LIST_NEIGHBOUR_GRID_H
#define GB_PACK_LIST_NEIGHBOUR_GRID_H

#include <stdbool.h>
#include <stdint.h>

#include "pack/cell/cell.h"

/* Bins at least as wide as the reach of a neighbour list.  list_scan.c sorts the particles
 * into them, list_check.c looks them up again. */
struct gb_neighbour_grid {
    int n[3];        /* bins along each axis */
    int span_low[3]; /* neighbouring bins to visit: span_low .. span_high */
    int span_high[3];
    double inverse[3];   /* one over the width of a bin, 1/d */
    bool tilted;         /* then, instead: */
    double to_bin[3][3]; /* bins along each edge vector from x, 1/d */
    bool plain;          /* the periodic image of a pair follows from its bins */
};

/* The same grid for the same edges, reach and count.  About one particle per bin at most,
 * however dilute the packing. */
void gb_neighbour_grid_init(struct gb_neighbour_grid *grid, const struct gb_cell *cell,
                            double reach, int64_t count);

/* Bin of a position inside the cell, along each axis. */
void gb_neighbour_grid_bin(const struct gb_neighbour_grid *grid, const double x[3],
                           int bin[3]);

static inline int gb_neighbour_grid_index(const struct gb_neighbour_grid *grid,
                                          const int bin[3])
{
    return (bin[2] * grid->n[1] + bin[1]) * grid->n[0] + bin[0];
}

#endif
