#include "draw/particle_stress.h"

#include <math.h>
#include <string.h>

#include "base/vec.h"
#include "pack/cell/cell.h"

/* Volume of the cell or die over the sum of r^3 of the particles (area and r^2 in 2D). */
static double volume_ratio(const struct gb_state *state)
{
    double volume = state->cell[0] * state->cell[2];
    double solid = 0.0;
    if (state->dimension == 3) {
        volume *= state->cell[1];
    }
    if (state->die_radius > 0.0) {
        volume = M_PI * state->die_radius * state->die_radius * state->cell[2];
    }
    for (int64_t i = 0; i < state->count; i++) {
        solid += pow(state->radius[i], state->dimension);
    }
    return volume / solid;
}

void gb_particle_stress_mean(const struct gb_state *state, double *stress)
{
    const double volume = volume_ratio(state);
    const struct gb_cell cell = gb_state_cell(state);
    memset(stress, 0, (size_t)state->count * sizeof *stress);
    for (int64_t k = 0; k < state->pair_count; k++) {
        const int32_t *ends = &state->pair[2 * k];
        const double *a = &state->position[3 * ends[0]];
        const double *b = &state->position[3 * ends[1]];
        double r[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
        gb_cell_nearest(&cell, r);
        const double half = 0.5 * gb_vec_dot(&state->pair_force[3 * k], r) *
                            state->pascal_per_stress / state->dimension;
        for (int end = 0; end < 2; end++) {
            const double solid = pow(state->radius[ends[end]], state->dimension);
            stress[ends[end]] += half / (volume * solid);
        }
    }
}
