#ifndef GB_SCENE_LATTICE_H
#define GB_SCENE_LATTICE_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/params.h"

/* A lattice as initial structure: a periodic block of whole unit cells. */
struct gb_lattice {
    int dimension;
    int particles;      /* per unit cell */
    double cell[3];     /* edges of the unit cell, in nearest-neighbour distances */
    double point[8][3]; /* positions of the particles, in edges of the unit cell */
};

/* By enum gb_structure; NULL if the structure is not a lattice. */
const struct gb_lattice *gb_lattice_of(int structure);

/* The most nearly cubic block of unit cells: numbers of cells along x, y and z.  False
 * if `count` is not a whole number of unit cells, or if the longest edge exceeds twice
 * the shortest. */
bool gb_lattice_block(const struct gb_lattice *lattice, int64_t count, int64_t cells[3]);

/* The largest valid count that is at most `count`; 0: none. */
int64_t gb_lattice_count_below(const struct gb_lattice *lattice, int64_t count);

/* Edges of the block in d, for an overlap (h/d) of nearest neighbours; 1 along y in 2D.
 */
void gb_lattice_edges(const struct gb_lattice *lattice, int64_t count, double overlap,
                      double edges[3]);

/* Checks count, dimension and sizes of a lattice scene; true for other structures.
 * Errors: GB_ERR_INPUT naming the key and the values that fit. */
bool gb_lattice_check(const struct gb_params *params, struct gb_error *err);

#endif
