#ifndef GB_PACK_CELL_REAL_H
#define GB_PACK_CELL_REAL_H

#include <stddef.h>

/* Precision of forces, contact histories and velocities.  Fixed for the life of a world
 * by numerics.precision. */
enum gb_real {
    GB_REAL_F64,
    GB_REAL_F32, /* quasi-static scenes in 3D */
};

static inline size_t gb_real_size(enum gb_real real)
{
    return real == GB_REAL_F32 ? sizeof(float) : sizeof(double);
}

#endif
