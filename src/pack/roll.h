#ifndef GB_PACK_ROLL_H
#define GB_PACK_ROLL_H

#include <stdbool.h>
#include <stdint.h>

#include "pack/grid.h"

/* Centres closer than (1 - GB_ROLL_TOUCH) r_eq overlap.  Above the rounding of a place on
 * two spheres, so that the hexagons of 2D can close; below any distance that matters. */
#define GB_ROLL_TOUCH 1e-9

/* Does a particle at place overlap one that is there already? */
bool gb_roll_overlaps(const struct gb_grid *grid, double r_eq, const double place[3]);

/* Rolls a new particle around particle j until it touches one more, k, at r_eq from both.
 * k is the particle nearest to the start among those that can be touched together with j;
 * the place is the nearest to the start that touches both.
 *
 * offset   from j to the start; as long as r_eq
 * place    result
 * False when there is no such k, or when a third particle is in the way. */
bool gb_roll_onto(const struct gb_grid *grid, double r_eq, int64_t j,
                  const double offset[3], double place[3]);

#endif
