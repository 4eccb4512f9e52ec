#include "figures/packings/die_profile.h"

#include <math.h>

#include "pack/die/die.h"

bool gb_die_profile_check(const struct gb_state *state, const char *figure,
                          struct gb_error *err)
{
    return state->die_radius > 0.0 ||
           gb_error_set(err, GB_ERR_INPUT,
                        "%s: a periodic cell has no wall; accepted dies", figure);
}

struct gb_density_map gb_die_profile_density(const struct gb_state *state, int rings,
                                             int bands, double *density)
{
    const struct gb_density_map map = {.rings = rings,
                                       .bands = bands,
                                       .radius = state->die_radius,
                                       .low = 0.0,
                                       .high = state->cell[2]};
    const double centre[2] = {0.5 * state->cell[0], 0.5 * state->cell[1]};
    gb_density_map_fill(&map, state->count, state->position, state->radius, centre,
                        density);
    return map;
}

bool gb_die_profile_wall(const struct gb_state *state, int bands, double *pressure)
{
    const double height = state->cell[2];
    const double area = 2.0 * M_PI * state->die_radius * height / bands;
    for (int b = 0; b < bands; b++) {
        const bool above = state->die_top < height * (b + 1) / bands;
        pressure[b] = above ? (double)NAN : 0.0;
    }
    for (int64_t k = 0; k < state->wall_count; k++) {
        const double *x = state->position + 3 * (int64_t)state->wall[2 * k];
        const double *force = state->wall_force + 3 * k;
        const double r[2] = {x[0] - 0.5 * state->cell[0], x[1] - 0.5 * state->cell[1]};
        const double axis = hypot(r[0], r[1]);
        if (state->wall[2 * k + 1] != GB_DIE_SIDE || !(axis > 0.0)) {
            continue;
        }
        const int b = (int)(x[2] / height * bands);
        pressure[b < bands ? b : bands - 1] -= 1e-6 * state->pascal_per_stress *
                                               (force[0] * r[0] + force[1] * r[1]) /
                                               (axis * area);
    }
    return state->wall_count > 0;
}
