#ifndef GB_PACK_STRUCTURE_ROLL_H
#define GB_PACK_STRUCTURE_ROLL_H

#include <stdbool.h>
#include <stdint.h>

#include "pack/structure/grid.h"
#include "scene/model.h"

/* Centres closer than (1 - GB_ROLL_TOLERANCE) r_eq overlap.  Above the rounding of a place on
 * two spheres, so that the hexagons of 2D can close; below any distance that matters. */
#define GB_ROLL_TOLERANCE 1e-9

/* A new particle among those that are there, and where it touches them. */
struct gb_roll {
    const struct gb_grid *grid;
    double r_eq; /* the distance; of unequal sizes: the longest */
    /* unequal sizes: */
    const struct gb_model *model;
    const double *diameter; /* of all, d; NULL: all are equal */
    double own;             /* of the new one */
};

/* The distance at which the new particle rests on particle j. */
double gb_roll_contact_distance(const struct gb_roll *roll, int64_t j);

/* Does a particle at place overlap one that is there already? */
bool gb_roll_overlaps(const struct gb_roll *roll, const double position[3]);

/* Rolls a new particle around particle j until it touches one more, k, as well.
 * k is the particle nearest to the start among those that can be touched together with j;
 * the place is the nearest to the start that touches both.
 *
 * offset   from j to the start; as long as they touch
 * place    result
 * False when there is no such k, or when a third particle is in the way. */
bool gb_roll_onto(const struct gb_roll *roll, int64_t j, const double offset[3],
                  double position[3]);

#endif
