#ifndef GB_PACK_CELL_NONAFFINE_H
#define GB_PACK_CELL_NONAFFINE_H

#include <stdint.h>

#include "pack/cell/world.h"

/* How the particles have moved since a copy of the world was taken, beside the affine
 * motion of the cell. */
struct gb_nonaffine {
    double farthest;  /* d */
    int64_t particle; /* that went farthest */
    double rms;       /* d */
};

struct gb_nonaffine gb_nonaffine_since(const struct gb_world *world,
                                       const struct gb_world_copy *copy);

#endif
