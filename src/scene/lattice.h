#ifndef GB_SCENE_LATTICE_H
#define GB_SCENE_LATTICE_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/params.h"

/* Lattices as structures: whole unit cells in a periodic block. */
struct gb_lattice {
    int dimension;
    int particles;      /* of a unit cell */
    double cell[3];     /* edges of the unit cell, in distances of nearest neighbours */
    double point[8][3]; /* its particles, in edges of the unit cell */
};

/* By enum gb_structure; NULL where it is no lattice. */
const struct gb_lattice *gb_lattice_of(int structure);

/* The block of unit cells whose edges differ least: cells along x, y and z.  False if it
 * takes no whole unit cells, or if the longest edge is more than twice the shortest. */
bool gb_lattice_block(const struct gb_lattice *lattice, int64_t count, int64_t cells[3]);

/* The largest count of at most `count` that fits; 0: none. */
int64_t gb_lattice_count_below(const struct gb_lattice *lattice, int64_t count);

/* Edges of the block at an overlap (h/d), d; 1 along y in 2D. */
void gb_lattice_edges(const struct gb_lattice *lattice, int64_t count, double overlap,
                      double edges[3]);

/* Checks count, dimension and sizes of a scene with a lattice; true without one.  Errors:
 * GB_ERR_INPUT naming the key and the numbers that fit. */
bool gb_lattice_check(const struct gb_params *params, struct gb_error *err);

#endif
