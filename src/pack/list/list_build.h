#ifndef GB_PACK_LIST_LIST_BUILD_H
#define GB_PACK_LIST_LIST_BUILD_H

#include "pack/list/neighbour_list.h"

struct gb_team;

/* Range of the lists, beyond a diameter of 1. */
struct gb_list_build_range {
    double cutoff; /* of the attraction, d */
    double skin;   /* d */
};

/* Builds both lists for positions inside the cell, out to cutoff + skin, by the
 * threads of a team (NULL: the caller); the same lists for any number of them.  Sets
 * `shift`.  Errors: GB_ERR_MEMORY;
 * GB_ERR_GUARD when the cell is too small for the reach or a particle has too many
 * neighbours. */
bool gb_list_build(struct gb_neighbour_list *list, const struct gb_cell *cell,
                   const double *position, struct gb_list_build_range range,
                   struct gb_team *team, struct gb_error *err);

#endif
