#ifndef GB_IO_STATE_STATE_RADIUS_H
#define GB_IO_STATE_STATE_RADIUS_H

#include "base/record.h"
#include "io/state/state.h"
#include "scene/model.h"

/* Contact radii of the pairs of a state that was made of this record, d.
 *
 * Periodic cell: a = sqrt(d' h)/2 with 1/d' the mean of 1/d_i and 1/d_j, of a bridge
 * a_ch = sqrt(d' h_min)/2 (or its printed form); P1 II.A and law/law_unequal.h.
 * Die: Hertz' a^2 = R* h; of a contact that has flowed Storakers' at its deepest overlap,
 * which unloading does not undo.  P3 (2), (17).
 *
 * Errors: GB_ERR_MEMORY, GB_ERR_INPUT for an item that is missing. */
bool gb_state_radius_fill(struct gb_state *state, const struct gb_record *record,
                          const struct gb_params *params, const struct gb_model *model,
                          struct gb_error *err);

#endif
