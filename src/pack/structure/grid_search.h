#ifndef GB_PACK_STRUCTURE_GRID_SEARCH_H
#define GB_PACK_STRUCTURE_GRID_SEARCH_H

#include <stdbool.h>
#include <stdint.h>

#include "pack/structure/grid.h"

/* Points that a search takes from a block at once. */
enum { GB_GRID_WINDOW = 64 };

/* Iteration over the grid cells of a cuboid; private to grid_search.c. */
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

void gb_grid_search_ball_init(struct gb_grid_ball *ball, const struct gb_grid *grid,
                              const double centre[3], double reach);
bool gb_grid_search_ball_next(struct gb_grid_ball *ball, struct gb_grid_hit *hit);

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

void gb_grid_search_ray_init(struct gb_grid_ray *ray, const struct gb_grid *grid,
                             const double origin[3], const double direction[3],
                             double reach, double length);
bool gb_grid_search_ray_next(struct gb_grid_ray *ray, struct gb_grid_hit *hit);

#endif
