#ifndef GB_RUN_PACKING_STATE_H
#define GB_RUN_PACKING_STATE_H

#include "greenbody/curve.h"
#include "greenbody/snapshot.h"
#include "io/state.h"
#include "measure/observe.h"
#include "solve/loading/loading.h"

/* What the packing is: density, pressures, contacts.  In a periodic cell iterations,
 * evaluations, time and energies are left empty. */
void gb_packing_state_packing(const struct gb_loading *loading, struct gb_point *point);

/* A recorded point: also what it took to get there, time and energies.  elastic_start:
 * elastic energy at the start of the run, E d^3. */
void gb_packing_state_step(const struct gb_loading *loading, double elastic_start,
                           struct gb_point *point);

/* Contacts, forces and solver as they are now, for the screen. */
void gb_packing_state_live(const struct gb_loading *loading,
                           struct gb_snapshot *snapshot);

/* Copies a packing for pictures and files: positions, contacts, forces, and its measures
 * as state->point.
 *
 * A die stands in a box from 0: positions are moved there, and the box reaches up to the
 * punch or the highest particle. */
bool gb_packing_state_copy(const struct gb_loading *loading, struct gb_state **out,
                           struct gb_error *err);

#endif
