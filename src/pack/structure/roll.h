#ifndef GB_PACK_STRUCTURE_ROLL_H
#define GB_PACK_STRUCTURE_ROLL_H

#include <stdbool.h>
#include <stdint.h>

#include "pack/structure/grid_search.h"
#include "scene/model.h"

/* Centres closer than (1 - GB_ROLL_TOLERANCE) r_eq overlap.  Above the rounding of a
 * position on two spheres, so that the hexagons of 2D can close; below any distance that
 * matters. */
#define GB_ROLL_TOLERANCE 1e-9

/* A new particle and the existing ones, with its distances of contact. */
struct gb_roll {
    const struct gb_grid *grid;
    double r_eq; /* the distance; of unequal sizes: the longest */
    /* unequal sizes: */
    const struct gb_model *model;
    const double *diameter; /* of all, d; NULL: all are equal */
    double own;             /* of the new one */
};

/* Distance of the new particle to particle j in contact. */
double gb_roll_contact_distance(const struct gb_roll *roll, int64_t j);

/* What is farther from the new particle does not overlap it, d. */
double gb_roll_clearance(const struct gb_roll *roll);

/* True if it overlaps the particle hit. */
bool gb_roll_overlaps_hit(const struct gb_roll *roll, const struct gb_grid_hit *hit);

/* True if a particle at this position overlaps an existing one. */
bool gb_roll_overlaps(const struct gb_roll *roll, const double position[3]);

/* Rolls a new particle around particle j until it touches one more, k, as well.
 * k is the particle nearest to the start among those that can be touched together with j;
 * the position is the nearest to the start that touches both.
 *
 * offset    from j to the start; as long as they touch
 * position  result
 * False when there is no such k, or when it would overlap a third particle. */
bool gb_roll_onto(const struct gb_roll *roll, int64_t j, const double offset[3],
                  double position[3]);

#endif
