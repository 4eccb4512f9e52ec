#ifndef GB_PACK_CELL_WORLD_RECORD_H
#define GB_PACK_CELL_WORLD_RECORD_H

#include <stdbool.h>

#include "base/record.h"
#include "pack/cell/world.h"

/* Saves a world into a record, or loads it: to the last bit the state right after an
 * evaluation, so that the next one gives the same forces and the neighbour lists are
 * rebuilt at the same moment.
 *
 * Loading: the world was just created with the same model.  Errors: GB_ERR_INPUT naming
 * the array for what does not fit or is out of range. */
bool gb_world_record(struct gb_world *world, struct gb_record *record,
                     struct gb_error *err);

#endif
