#ifndef GB_IO_STATE_STATE_RADIUS_H
#define GB_IO_STATE_STATE_RADIUS_H

#include "base/record.h"
#include "io/state/state.h"
#include "scene/model.h"

/* Contact radii of pairs, d.
 *
 * Periodic cell: a = sqrt(d' h)/2 with 1/d' the mean of 1/d_i and 1/d_j, of a bridge
 * a_ch = sqrt(d' h_min)/2 (or its printed form); P1 II.A and law/law_unequal.h.
 * Die: Hertz' a^2 = R* h; of a contact that has flowed Storakers' at its deepest overlap,
 * which unloading does not undo.  P3 (2), (17).
 */

/* Of a pair in a periodic cell: distance of the centres, d; deepest > 0: of its bridge. */
double gb_state_radius_of(const struct gb_state *state, const struct gb_model *model,
                          const int32_t pair[2], double distance, double deepest);

/* Of all pairs of a die that was made of this record.  Errors: GB_ERR_MEMORY, GB_ERR_INPUT
 * for an item that is missing. */
bool gb_state_radius_fill(struct gb_state *state, const struct gb_record *record,
                          const struct gb_params *params, struct gb_error *err);

#endif
