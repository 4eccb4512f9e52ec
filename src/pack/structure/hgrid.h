#ifndef GB_PACK_STRUCTURE_HGRID_H
#define GB_PACK_STRUCTURE_HGRID_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"

/* Hierarchical grid: neighbour search for spheres of many sizes.
 *
 * In a grid whose cells fit the largest sphere each cell holds hundreds of the smallest:
 * with a size ratio of 12 most candidates are far away.  Here spheres are sorted by size
 * into levels, each at least a factor of 2 wide with its own grid; the neighbours of a sphere are
 * searched in its own level and in those of larger spheres.  The work is linear in the
 * number of spheres for any size distribution, as long as most of them lie in the box and
 * fill it evenly.  Lengths in any one unit. */

/* Region that the grids cover.  Along axes that are not periodic spheres may lie outside:
 * the result is the same, the search slower. */
struct gb_hgrid_box {
    double low[3], high[3];
    bool periodic[3];
};

/* Rows of the sorted spheres: x, y, z, wrapped into the box, and reach; and how far beyond the
 * last sphere they are read. */
enum { GB_HGRID_REACH = 3, GB_HGRID_ROWS = 4, GB_HGRID_SLACK = 4 };

/* The pairs: (i, other[k]) with i < other[k] for k in [start[i], start[i + 1]),
 * ascending.  The other members are scratch of hgrid.c. */
struct gb_hgrid {
    int64_t pair_count;
    int64_t *start; /* capacity + 1 */
    int32_t *other;
    int levels; /* at most; 1: the plain grid, to compare with */
    /* That searches, not owned; NULL: one thread.  The pairs are the same. */
    struct gb_team *team;

    int64_t capacity, pair_capacity, cell_capacity;
    double *sorted[GB_HGRID_ROWS]; /* spheres by level, then by grid cell */
    int32_t *name, *partners; /* of each sorted sphere: its index; pairs found for it */
    int32_t *cell;            /* of each sphere */
    int32_t *cell_start;
    int64_t *later_start;       /* pairs by their later sphere */
    struct gb_hgrid_part *part; /* pairs in the order of the search */
    int parts;
    int32_t *earlier; /* of the pairs sorted by the later one */
};

/* Room for `capacity` spheres; a build with more allocates memory.
 * Errors: GB_ERR_MEMORY; GB_ERR_INPUT for more than 2^31 - 2. */
bool gb_hgrid_init(struct gb_hgrid *hgrid, int64_t capacity, struct gb_error *err);
void gb_hgrid_finish(struct gb_hgrid *hgrid);

/* All pairs whose gap is below skin + margin_i + margin_j; along periodic axes the gap to
 * the nearest image.  Nothing is allocated once there is room for the pairs.
 *
 * sphere   count rows of x, y, z, radius
 * margin   one per sphere, 0 or more: fast ones need more than others; NULL: none
 * skin     0 or more
 * Errors: GB_ERR_MEMORY; GB_ERR_GUARD naming a sphere that is not finite or has a negative
 * radius, when a periodic edge is shorter than two reaches of the largest sphere, or when
 * spheres overlap so much that there are more than GB_HGRID_PAIRS_PER_SPHERE_MAX pairs a
 * sphere on average.  The list is empty then.
 *
 * Deterministic.  Whether a pair on the very edge of the skin is listed may depend on
 * rounding; no force depends on such a pair. */
bool gb_hgrid_build(struct gb_hgrid *hgrid, const struct gb_hgrid_box *box, int64_t count,
                    const double (*sphere)[4], const double *margin, double skin,
                    struct gb_error *err);

#endif
