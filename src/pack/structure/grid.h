#ifndef GB_PACK_STRUCTURE_GRID_H
#define GB_PACK_STRUCTURE_GRID_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "greenbody/status.h"
#include "pack/cell/cell.h"

/* Points that a search takes from a block at once. */
enum { GB_GRID_WINDOW = 64 };

/* Iteration over the grid cells of a cuboid; private to grid.c. */
struct gb_grid_window {
    int low[3], high[3];                    /* unwrapped indices of grid cells */
    int low_block[3], high_block[3], at[3]; /* and of their blocks */
    int low_wrapped[3], wrapped[3];         /* blocks again, wrapped */
    int low_image[3], image[3];             /* and which image of the cell they lie in */
    double shift[3];                        /* of that image, d */
    uint64_t mask[3];                       /* cells of a block within low and high */
    uint64_t bits;                          /* cells of the block still to visit */
    const uint32_t *last;                   /* of the block; see gb_grid */
    uint32_t unfinished;                    /* flagged: others of its cell are to come */
    uint32_t point[GB_GRID_WINDOW];         /* of the block at hand */
    int taken, found;                       /* how many of them */
};

/* One image of one point. */
struct gb_grid_hit {
    int64_t index;
    int image[3];  /* the image is the point + image[k] edge vectors k */
    double r[3];   /* from the centre of the ball, or the origin of the ray */
    double square; /* |r|^2 */
    double along;  /* ray only: r along the ray */
};

/* All images within reach of a centre, which may lie outside the cell. */
struct gb_grid_ball {
    const struct gb_grid *grid;
    double centre[3];
    double square;
    struct gb_grid_window window;
};

void gb_grid_ball_init(struct gb_grid_ball *ball, const struct gb_grid *grid,
                       const double centre[3], double reach);

bool gb_grid_ball_next(struct gb_grid_ball *ball, struct gb_grid_hit *hit);

/* In cells without tilt: all images within reach of a ray, with 0 <= along <= length, in no useful order. */
struct gb_grid_ray {
    const struct gb_grid *grid;
    double origin[3];
    double direction[3];
    double reach;
    double length;
    int axis;         /* the one the ray is closest to */
    double thickness; /* of a slab of blocks */
    int slab, last_slab;
    struct gb_grid_window window;
};

void gb_grid_ray_init(struct gb_grid_ray *ray, const struct gb_grid *grid,
                      const double origin[3], const double direction[3], double reach,
                      double length);

bool gb_grid_ray_next(struct gb_grid_ray *ray, struct gb_grid_hit *hit);

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

#endif
