#ifndef GB_IO_STATE_STATE_FORCES_H
#define GB_IO_STATE_STATE_FORCES_H

#include "io/state/state.h"

/* Bins of the angle of a contact's axis to z, from 0 to 90 degrees. */
enum { GB_STATE_FORCES_ANGLES = 18 };

/* Mean normal force in the bins, nN; NaN: no contact there.  P1 Fig. 14. */
void gb_state_forces_by_angle(const struct gb_state *state,
                              double mean[GB_STATE_FORCES_ANGLES]);

#endif
