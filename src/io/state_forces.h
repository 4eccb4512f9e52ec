#ifndef GB_IO_STATE_FORCES_H
#define GB_IO_STATE_FORCES_H

#include "io/state.h"

/* Forces between the particles of a state: pairs across gaps, stresses, angles. */

/* Pairs that attract across a gap, found from the positions of a state: P1 (3) up to
 * the range of attraction.  A state lists only contacts, so stresses need these pairs
 * as well. */
struct gb_state_gaps {
    int64_t count;
    int32_t *pair; /* count x 2 particle indices, sorted by the first */
    double *force; /* count x 3: force on the first, E d^2 */
};

/* Finds the pairs; none without attraction and in a die.  Errors: GB_ERR_MEMORY,
 * GB_ERR_GUARD for a cell narrower than twice the range. */
bool gb_state_forces_gaps_init(struct gb_state_gaps *gaps, const struct gb_state *state,
                               struct gb_error *err);

void gb_state_forces_gaps_finish(struct gb_state_gaps *gaps);

/* stress[count]: mean stress, a third of the trace (half in 2D). */
void gb_state_forces_stress_mean(const struct gb_state *state,
                                 const struct gb_state_gaps *gaps, double *stress);

/* stress[count x 6]: xx, yy, zz, xy, xz, yz of the symmetric part. */
void gb_state_forces_stress_tensor(const struct gb_state *state,
                                   const struct gb_state_gaps *gaps, double *stress);

/* Number of bins of the angle between a contact's axis and z, from 0 to 90 degrees. */
enum { GB_STATE_FORCES_ANGLES = 18 };

/* Mean normal force in the bins, nN; NaN: no contact there.  P1 Fig. 14. */
void gb_state_forces_by_angle(const struct gb_state *state,
                              double mean[GB_STATE_FORCES_ANGLES]);

#endif
