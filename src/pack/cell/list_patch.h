#ifndef GB_PACK_CELL_LIST_PATCH_H
#define GB_PACK_CELL_LIST_PATCH_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"
#include "pack/cell/neighbour_list.h"

struct gb_world;

/* Pairs put into lists that are good but for them: of a million particles there is always
 * one that meets somebody it was far from, and to build the lists anew costs as much as
 * several sweeps. */

/* Puts the pairs that the last look at the strays missed into the lists, without a
 * history; those that come to touch leave the far list.  Nothing is done where the lists
 * have to be built anew: too many are missing, or it is not known who is.  Errors:
 * GB_ERR_MEMORY; the lists are then to be built anew before anything else.
 *
 * travel: longest way since the lists were built */
bool gb_list_patch_lists(struct gb_world *world, double travel, bool *done,
                         struct gb_error *err);

/* Amends lists that were just built by the pairs that a checkpoint kept.  Errors:
 * GB_ERR_INPUT where they are out of order or range, or in the lists; GB_ERR_MEMORY. */
bool gb_list_patch_again(struct gb_world *world, const struct gb_amendment *kept,
                         int64_t count, struct gb_error *err);

#endif
