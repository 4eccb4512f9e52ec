#ifndef GB_IO_STATE_STATE_STRESS_H
#define GB_IO_STATE_STATE_STRESS_H

#include "io/state/state_gaps.h"

/* Stress of each particle from its pairs, Pa, positive in compression: P1 (16) with half of
 * each pair for either particle, over the particle's part of the cell.  Pairs are contacts
 * and those that attract across a gap.  Parts are proportional to the particle volumes; the
 * mean weighted by them is the stress of the cell. */

/* stress[count]: the mean, a third of the trace (half of it in 2D). */
void gb_state_stress_mean(const struct gb_state *state, const struct gb_state_gaps *gaps,
                          double *stress);

/* stress[count x 6]: xx, yy, zz, xy, xz, yz of the symmetric part. */
void gb_state_stress_tensor(const struct gb_state *state,
                            const struct gb_state_gaps *gaps, double *stress);

#endif
