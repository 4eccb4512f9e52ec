#ifndef GB_RUN_PACKING_STATE_H
#define GB_RUN_PACKING_STATE_H

#include "io/state/state.h"
#include "solve/loading/loading.h"

/* Copies a packing for pictures and files: positions, contacts, forces, and its measures
 * as state->point.
 *
 * A die stands in a box from 0: positions are moved there, and the box reaches up to the
 * punch or the highest particle. */
bool gb_packing_state_copy(const struct gb_loading *loading, struct gb_state **out,
                           struct gb_error *err);

#endif
