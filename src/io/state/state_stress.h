#ifndef GB_IO_STATE_STATE_STRESS_H
#define GB_IO_STATE_STATE_STRESS_H

#include "io/state/state.h"

/* Stress of each particle from its contacts, Pa, positive in compression: P1 (16) with half
 * of each contact for either particle, over the particle's part of the cell.  Parts are
 * proportional to the particle volumes; the mean weighted by them is the contact stress of
 * the cell. */

/* stress[count]: the mean, a third of the trace (half of it in 2D). */
void gb_state_stress_mean(const struct gb_state *state, double *stress);

/* stress[count x 6]: xx, yy, zz, xy, xz, yz of the symmetric part. */
void gb_state_stress_tensor(const struct gb_state *state, double *stress);

#endif
