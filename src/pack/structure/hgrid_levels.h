#ifndef GB_PACK_STRUCTURE_HGRID_LEVELS_H
#define GB_PACK_STRUCTURE_HGRID_LEVELS_H

#include "pack/structure/hgrid.h"

/* First half of a build of hgrid.c: sorts spheres into levels of size, and within a level
 * into the cells of its grid.  Private to hgrid*.c. */

/* Levels of size, each at least a factor of 2; spheres smaller than the last share it. */
enum { GB_HGRID_LEVELS = 16 };

/* Grid cells per sphere of a level at most; where spheres are rarer the cells are wider.
 */
enum { GB_HGRID_CELLS_PER_SPHERE = 2, GB_HGRID_CELLS_MIN = 64 };

struct gb_hgrid_level {
    double widest; /* largest reach */
    int64_t count; /* spheres */
    int cells[3];
    double per_width[3]; /* cells per length */
    int32_t first_cell;  /* in cell_start */
};

struct gb_hgrid_search {
    struct gb_hgrid *hgrid;
    double low[3], high[3]; /* of the grids */
    double edge[3];         /* INFINITY where not periodic */
    int64_t count;
    int64_t found; /* pairs so far */
    double widest;
    struct gb_hgrid_level level[GB_HGRID_LEVELS]; /* the largest spheres first */
    int level_of[GB_HGRID_LEVELS]; /* that of the spheres of each factor of 2 */
};

/* Reach of a sphere: radius, half the skin and margin.  Pairs closer than the sum of two
 * reaches are listed. */
double gb_hgrid_levels_reach(const double sphere[4], const double *margin, int64_t i,
                             double skin);

/* Sets the bounds of the grids.  Errors: GB_ERR_GUARD for a periodic edge too short. */
bool gb_hgrid_levels_bounds(struct gb_hgrid_search *search,
                            const struct gb_hgrid_box *box, const double (*sphere)[4],
                            struct gb_error *err);

/* Sets the levels, the cells of their grids and the cell of each sphere; then sorts the
 * spheres. */
void gb_hgrid_levels_assign(struct gb_hgrid_search *search, const double (*sphere)[4],
                            const double *margin, double skin);
void gb_hgrid_levels_sort(struct gb_hgrid_search *search, const double (*sphere)[4],
                          const double *margin, double skin);

/* Cell of coordinate x along axis k, clamped to [0, cells). */
int gb_hgrid_levels_index(const struct gb_hgrid_search *search,
                          const struct gb_hgrid_level *level, int k, double x);

#endif
