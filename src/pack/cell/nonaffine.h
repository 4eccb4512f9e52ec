#ifndef GB_PACK_CELL_NONAFFINE_H
#define GB_PACK_CELL_NONAFFINE_H

#include <stdint.h>

#include "pack/cell/world.h"

/* Non-affine displacements since a copy of the world was taken: without the affine
 * motion of the cell. */
struct gb_nonaffine {
    double farthest;  /* largest one, d */
    int64_t particle; /* that it belongs to */
    double rms;       /* d */
};

struct gb_nonaffine gb_nonaffine_since(const struct gb_world *world,
                                       const struct gb_world_copy *copy);

#endif
