#ifndef GB_PACK_STRUCTURE_GRID_H
#define GB_PACK_STRUCTURE_GRID_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "greenbody/status.h"
#include "pack/cell/cell.h"

/* Beside the index of a point: it is not the first one of its grid cell. */
#define GB_GRID_SEVERAL ((uint32_t)1 << 31)

/* Grid cells of a block along one axis, and in all. */
enum { GB_GRID_SIDE = 4, GB_GRID_BLOCK = GB_GRID_SIDE * GB_GRID_SIDE * GB_GRID_SIDE };

/* Points of a periodic cell sorted into a grid that can grow point by point.  Searches
 * run over unwrapped grid indices, so that every periodic image is met once, also the
 * images beyond the nearest one and in cells smaller than the search.
 *
 * Grid cells lie in blocks of 4 x 4 x 4, and one word tells which of a block's 64 cells
 * hold points: a search visits these alone.  In 2D a block has one layer of cells.
 *
 * Grid cells are counted along the heights of the cell, which without tilt are its axes:
 * a ball of radius r spans 2 r of every height. */
struct gb_grid {
    struct gb_cell cell;
    bool tilted;
    double matrix[3][3]; /* of the edge vectors */
    double height[3][3]; /* height[k] x: height of x over the face across edge vector k */
    int blocks[3];
    double per_length[3]; /* grid cells per d of height */
    int64_t count;
    int64_t capacity;
    double *position;   /* capacity x 3, wrapped into the cell */
    uint64_t *occupied; /* of each block: bit 16 x + 4 y + z for the cell x, y, z in it */
    /* block x 64 + bit: the last point in that cell; if others were before it, together
     * with the flag. */
    uint32_t *last;
    uint32_t *previous; /* of each point: the one before it in its cell, the same way */
};

/* size       grid cells are about this wide (wider where points are few, narrower in
 *            cells of few blocks)
 * capacity   how many points may be inserted
 * Errors: GB_ERR_MEMORY; GB_ERR_INPUT for more than 2^31 - 2 points. */
bool gb_grid_create(struct gb_grid **out, const struct gb_cell *cell, double size,
                    int64_t capacity, struct gb_error *err);
void gb_grid_destroy(struct gb_grid *grid); /* NULL is fine */

/* Appends a point (finite; wrapped here).  The caller keeps to the capacity. */
void gb_grid_insert(struct gb_grid *grid, const double x[3]);

/* Heights of x over the faces of the cell, d; x itself without tilt. */
void gb_grid_heights(const struct gb_grid *grid, const double x[3], double height[3]);

/* Of a block with these indices, along every axis from 0 to below `blocks`. */
size_t gb_grid_block_index(const struct gb_grid *grid, const int block[3]);

#endif
