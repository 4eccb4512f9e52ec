#ifndef GB_PACK_STRUCTURE_GRID_H
#define GB_PACK_STRUCTURE_GRID_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"
#include "pack/cell/cell.h"

/* Points of a periodic cell sorted into a grid that can grow point by point.  Searches
 * run over unwrapped grid indices, so that every periodic image is met once, also the
 * images beyond the nearest one and in cells smaller than the search. */
struct gb_grid {
    struct gb_cell cell;
    int cells[3];
    double size[3]; /* of one grid cell */
    int64_t count;
    int64_t capacity;
    double *position; /* capacity x 3, wrapped into the cell */
    int32_t *first;   /* of each grid cell: index + 1 of its last point, 0 when empty */
    int32_t *next;    /* of each point: index + 1 of the next one in its grid cell */
};

/* size       grid cells are at least this wide (wider where points are few)
 * capacity   how many points may be inserted
 * Errors: GB_ERR_MEMORY; GB_ERR_INPUT for more than 2^31 - 2 points. */
bool gb_grid_create(struct gb_grid **out, const struct gb_cell *cell, double size,
                    int64_t capacity, struct gb_error *err);
void gb_grid_destroy(struct gb_grid *grid); /* NULL is fine */

/* Appends a point (finite; wrapped here).  The caller keeps to the capacity. */
void gb_grid_insert(struct gb_grid *grid, const double x[3]);

/* Iteration over a block of grid cells; private to grid.c. */
struct gb_grid_window {
    int low[3], high[3], at[3]; /* unwrapped grid indices */
    int low_cell[3], cell[3];   /* the same wrapped */
    int low_image[3], image[3]; /* and which image of the cell they lie in */
    const int32_t *first;       /* of the grid cell; see gb_grid */
    int32_t item;
};

/* One image of one point. */
struct gb_grid_hit {
    int64_t index;
    int image[3];  /* the image is the point + image[k] edge[k] */
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

/* All images within reach of a ray, with 0 <= along <= length, in no useful order. */
struct gb_grid_ray {
    const struct gb_grid *grid;
    double origin[3];
    double direction[3];
    double reach;
    double length;
    int axis; /* the one the ray is closest to */
    int slab, last_slab;
    struct gb_grid_window window;
};

void gb_grid_ray_init(struct gb_grid_ray *ray, const struct gb_grid *grid,
                      const double origin[3], const double direction[3], double reach,
                      double length);
bool gb_grid_ray_next(struct gb_grid_ray *ray, struct gb_grid_hit *hit);

#endif
