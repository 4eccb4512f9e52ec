#ifndef GB_PACK_CELL_CELL_H
#define GB_PACK_CELL_CELL_H

#include <stdbool.h>

/* Periodic box in reduced units.  In 2D the scene lies in the x-z plane: axis 1 has edge
 * 1 and is not periodic. */
struct gb_cell {
    double edge[3];
    bool periodic[3];
};

/* The whole number nearest to x, |x| < 2^51, the even one of two.  The sum has no digits
 * left behind the point; the C library's functions would be called number by number. */
static inline double gb_cell_whole(double x)
{
    const double large = 0x1.8p52;
    return (x + large) - large;
}

void gb_cell_init(struct gb_cell *cell, int dimension, const double edge[3]);
/* Nearest image of the difference r (in place). */
void gb_cell_nearest(const struct gb_cell *cell, double r[3]);
/* Moves x into [0, edge) along the periodic axes (in place). */
void gb_cell_wrap(const struct gb_cell *cell, double x[3]);
double gb_cell_volume(const struct gb_cell *cell);
/* Shortest periodic edge. */
double gb_cell_shortest(const struct gb_cell *cell);

#endif
