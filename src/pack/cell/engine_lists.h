#ifndef GB_PACK_CELL_ENGINE_LISTS_H
#define GB_PACK_CELL_ENGINE_LISTS_H

#include <stdbool.h>

#include "greenbody/status.h"

struct gb_cell;
struct gb_engine;

/* Builds the neighbour lists from the positions, which lie inside `cell`, and makes room
 * for all that belongs to their pairs; contact records are undefined afterwards.  Errors:
 * those of gb_list_build; there are no lists then. */
bool gb_engine_lists_build(struct gb_engine *engine, const struct gb_cell *cell,
                           struct gb_error *err);

#endif
