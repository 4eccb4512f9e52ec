#ifndef GB_PACK_F32_FIXED_POSITION_H
#define GB_PACK_F32_FIXED_POSITION_H

#include <stdint.h>
#include <string.h>

#include "pack/cell/cell.h"

/* Fixed-point coordinates: whole numbers, 2^32 to an edge of the cell.  They resolve 5e-9
 * d in a cell of 20 d, where a float resolves 1e-6 d; and the difference of two, with
 * wrap-around, is the difference to the nearest periodic image. */

/* Units per d along axis c of a cell. */
static inline double gb_fixed_position_units(const struct gb_cell *cell, int c)
{
    return 0x1p32 / cell->edge[c];
}

/* Size of a unit along axis c, d. */
static inline double gb_fixed_position_unit(const struct gb_cell *cell, int c)
{
    return cell->edge[c] * 0x1p-32;
}

/* Difference a - b with wrap-around. */
static inline int32_t gb_fixed_position_difference(uint32_t a, uint32_t b)
{
    const uint32_t wide = a - b;
    int32_t difference;
    memcpy(&difference, &wide, sizeof difference);
    return difference;
}

/* Fixed-point coordinate of x (d). */
static inline int32_t gb_fixed_position_of(double x, double units_per_d)
{
    /* the low bits of the sum are the whole number, rounded to even */
    const double sum = x * units_per_d + 0x1.8p52;
    uint64_t bits;
    memcpy(&bits, &sum, sizeof bits);
    const uint32_t low = (uint32_t)bits;
    int32_t fixed;
    memcpy(&fixed, &low, sizeof fixed);
    return fixed;
}

/* Coordinate (d) for a fixed-point coordinate, on the side of the periodic boundary where
 * the last known coordinate is: they differ by up to half an edge.  Its bits depend only
 * on the fixed-point coordinate, the edge and the number of crossed boundaries. */
static inline double gb_fixed_position_follow(double last, int32_t fixed,
                                              double units_per_d, double d_per_unit)
{
    const double sum = last * units_per_d + 0x1.8p52; /* as in gb_fixed_position_of */
    const double whole = sum - 0x1.8p52;
    uint64_t bits;
    memcpy(&bits, &sum, sizeof bits);
    const int32_t moved = gb_fixed_position_difference((uint32_t)fixed, (uint32_t)bits);
    return (whole + (double)moved) * d_per_unit;
}

/* Branch vector x_i - x_j (d), nearest image, as computed by a sweep in single
 * precision. */
static inline void gb_fixed_position_branch(const struct gb_cell *cell,
                                            const double xi[3], const double xj[3],
                                            double r[3])
{
    for (int c = 0; c < 3; c++) {
        const double units = gb_fixed_position_units(cell, c);
        const uint32_t a = (uint32_t)gb_fixed_position_of(xi[c], units);
        const uint32_t b = (uint32_t)gb_fixed_position_of(xj[c], units);
        r[c] = (double)((float)gb_fixed_position_difference(a, b) *
                        (float)gb_fixed_position_unit(cell, c));
    }
}

#endif
