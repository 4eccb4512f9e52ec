#ifndef GB_PACK_STRUCTURE_HGRID_SEARCH_H
#define GB_PACK_STRUCTURE_HGRID_SEARCH_H

#include "pack/structure/hgrid_levels.h"

/* Second half of a build of hgrid.c: the pairs of the sorted spheres, in parts on the team of
 * the grid.  Private to hgrid*.c. */

/* Partners of consecutive sorted spheres, each pair once. */
struct gb_hgrid_part {
    int32_t *found; /* numbers of the partners, sphere by sphere */
    int64_t room, count;
    bool done; /* false: err */
    struct gb_error err;
};

void gb_hgrid_search_finish(struct gb_hgrid *hgrid);

/* Fills parts and partners of the grid; search->found is the number of pairs.
 * Errors: GB_ERR_MEMORY; GB_ERR_GUARD for too many pairs. */
bool gb_hgrid_search_run(struct gb_hgrid_search *search, struct gb_error *err);

/* First sorted sphere of a part; of part hgrid->parts: the number of all. */
int64_t gb_hgrid_search_begin(const struct gb_hgrid_search *search, int part);

#endif
