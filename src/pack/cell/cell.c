#include "pack/cell/cell.h"

#include <math.h>

void gb_cell_init(struct gb_cell *cell, int dimension, const double edge[3])
{
    for (int k = 0; k < 3; k++) {
        const bool periodic = dimension == 3 || k != 1;
        cell->periodic[k] = periodic;
        cell->edge[k] = periodic ? edge[k] : 1.0;
    }
}

void gb_cell_nearest(const struct gb_cell *cell, double r[3])
{
    for (int k = 0; k < 3; k++) {
        if (cell->periodic[k]) {
            r[k] -= cell->edge[k] * gb_cell_whole(r[k] / cell->edge[k]);
        }
    }
}

void gb_cell_wrap(const struct gb_cell *cell, double x[3])
{
    for (int k = 0; k < 3; k++) {
        if (!cell->periodic[k]) {
            continue;
        }
        x[k] -= cell->edge[k] * floor(x[k] / cell->edge[k]);
        /* Rounding: a tiny negative x lands on the far edge, and x just below a multiple
         * of the edge can divide to it and come out negative. */
        if (x[k] >= cell->edge[k] || x[k] < 0.0) {
            x[k] = 0.0;
        }
    }
}

double gb_cell_volume(const struct gb_cell *cell)
{
    return cell->edge[0] * cell->edge[1] * cell->edge[2];
}

double gb_cell_shortest(const struct gb_cell *cell)
{
    double shortest = INFINITY;
    for (int k = 0; k < 3; k++) {
        if (cell->periodic[k]) {
            shortest = fmin(shortest, cell->edge[k]);
        }
    }
    return shortest;
}
