#include "io/state/state_stress.h"

#include <math.h>
#include <string.h>

#include "pack/cell/cell.h"

enum { COMPONENTS = 6 };

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

/* A contact, or from pair_count on a pair across a gap. */
struct pair {
    const int32_t *particle;
    const double *force;
};

static struct pair pair_at(const struct gb_state *state, const struct gb_state_gaps *gaps,
                           int64_t k)
{
    const int64_t gap = k - state->pair_count;
    return gap < 0 ? (struct pair){state->pair + 2 * k, state->pair_force + 3 * k}
                   : (struct pair){gaps->pair + 2 * gap, gaps->force + 3 * gap};
}

/* Half of the symmetric product of force and branch vector of a pair, E d^3. */
static void half_of_pair(const struct gb_state *state, const struct gb_cell *cell,
                         struct pair pair, double half[COMPONENTS])
{
    static const int first[COMPONENTS] = {0, 1, 2, 0, 0, 1};
    static const int second[COMPONENTS] = {0, 1, 2, 1, 2, 2};
    const double *a = &state->position[3 * pair.particle[0]];
    const double *b = &state->position[3 * pair.particle[1]];
    const double *f = pair.force;
    double r[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    gb_cell_nearest(cell, r);
    for (int c = 0; c < COMPONENTS; c++) {
        const int i = first[c], j = second[c];
        half[c] = 0.5 * 0.5 * (f[i] * r[j] + f[j] * r[i]);
    }
}

void gb_state_stress_tensor(const struct gb_state *state,
                            const struct gb_state_gaps *gaps, double *stress)
{
    const double volume = volume_ratio(state);
    const struct gb_cell cell = gb_state_cell(state);
    memset(stress, 0, (size_t)state->count * COMPONENTS * sizeof *stress);
    for (int64_t k = 0; k < state->pair_count + gaps->count; k++) {
        const struct pair pair = pair_at(state, gaps, k);
        double half[COMPONENTS];
        half_of_pair(state, &cell, pair, half);
        for (int end = 0; end < 2; end++) {
            const int32_t i = pair.particle[end];
            const double part = volume * pow(state->radius[i], state->dimension);
            for (int c = 0; c < COMPONENTS; c++) {
                stress[COMPONENTS * i + c] += half[c] * state->pascal_per_stress / part;
            }
        }
    }
}

void gb_state_stress_mean(const struct gb_state *state, const struct gb_state_gaps *gaps,
                          double *stress)
{
    const double volume = volume_ratio(state);
    const struct gb_cell cell = gb_state_cell(state);
    memset(stress, 0, (size_t)state->count * sizeof *stress);
    for (int64_t k = 0; k < state->pair_count + gaps->count; k++) {
        const struct pair pair = pair_at(state, gaps, k);
        double half[COMPONENTS];
        half_of_pair(state, &cell, pair, half);
        const double mean =
            (half[0] + half[1] + half[2]) * state->pascal_per_stress / state->dimension;
        for (int end = 0; end < 2; end++) {
            const int32_t i = pair.particle[end];
            stress[i] += mean / (volume * pow(state->radius[i], state->dimension));
        }
    }
}
