#ifndef GB_PACK_LIST_LIST_LEVELS_H
#define GB_PACK_LIST_LIST_LEVELS_H

#include "pack/list/list_scan.h"
#include "pack/structure/hgrid.h"

/* Candidates of a list of unequal particles, by levels of size: bins that fit the largest
 * particle hold hundreds of the smallest.  Cells without tilts. */
struct gb_list_levels {
    struct gb_hgrid hgrid;
    double (*sphere)[4]; /* x, y, z, radius; d */
};

/* For `count` particles; gb_list_levels_destroy accepts NULL. */
bool gb_list_levels_create(struct gb_list_levels **out, int64_t count,
                           struct gb_error *err);
void gb_list_levels_destroy(struct gb_list_levels *levels);

/* Candidates of all particles of the scan, out to its gap; the scan takes its neighbours
 * from them.  Errors: those of gb_hgrid_build. */
bool gb_list_levels_find(struct gb_list_levels *levels, struct gb_list_scan *scan,
                         int64_t count, struct gb_team *team, struct gb_error *err);

#endif
