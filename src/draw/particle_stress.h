#ifndef GB_DRAW_PARTICLE_STRESS_H
#define GB_DRAW_PARTICLE_STRESS_H

#include "io/state/state.h"

/* Mean stress of each particle from its contacts, Pa, positive in compression: the trace of
 * P1 (16) with half of each contact for either particle, over the particle's part of the
 * cell.  Parts are proportional to the particle volumes; the mean weighted by them is the
 * contact pressure of the cell. */
void gb_particle_stress_mean(const struct gb_state *state, double *stress);

#endif
