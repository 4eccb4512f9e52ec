#include "io/state/state_forces.h"

#include <math.h>

#include "base/vec.h"

/* Angle of a contact's axis to z, degrees, 0 to 90. */
static double angle_to_z(const struct gb_cell *cell, const struct gb_state *state,
                         int64_t pair)
{
    const double *a = &state->position[3 * state->pair[2 * pair]];
    const double *b = &state->position[3 * state->pair[2 * pair + 1]];
    double r[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    gb_cell_nearest(cell, r);
    return acos(fmin(fabs(r[2]) / gb_vec_length(r), 1.0)) * 180.0 / M_PI;
}

void gb_state_forces_by_angle(const struct gb_state *state,
                              double mean[GB_STATE_FORCES_ANGLES])
{
    enum { ANGLES = GB_STATE_FORCES_ANGLES };
    double sum[ANGLES] = {0};
    int64_t count[ANGLES] = {0};
    const double newton =
        state->pascal_per_stress * state->metre_per_length * state->metre_per_length;
    const struct gb_cell cell = gb_state_cell(state);
    for (int64_t k = 0; k < state->pair_count; k++) {
        const int bin =
            (int)fmin(angle_to_z(&cell, state, k) * ANGLES / 90.0, ANGLES - 1);
        sum[bin] += state->pair_normal[k];
        count[bin]++;
    }
    for (int k = 0; k < ANGLES; k++) {
        mean[k] = count[k] > 0 ? 1e9 * newton * sum[k] / (double)count[k] : (double)NAN;
    }
}
