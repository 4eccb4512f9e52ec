#include "io/state_forces.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "io/state.h"
#include "law/law_unequal.h"
#include "pack/cell/cell.h"
#include "pack/list/neighbour_list.h"

/* Stress of each particle from its pairs, Pa, positive in compression: P1 (16) with
 * half of each pair assigned to either particle, divided by the volume assigned to the
 * particle.  Pairs are contacts and pairs that attract across a gap.  The assigned
 * volumes are proportional to the particle volumes and add up to the cell; the
 * volume-weighted mean stress is the stress of the cell. */

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

/* A contact, or for k >= pair_count a pair across a gap. */
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

/* Half of the symmetrised product of force and branch vector of a pair, E d^3. */
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

void gb_state_forces_stress_tensor(const struct gb_state *state,
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

void gb_state_forces_stress_mean(const struct gb_state *state,
                                 const struct gb_state_gaps *gaps, double *stress)
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

/* Margin beyond the range of attraction (d) for rounding of positions. */
static const double skin = 1e-9;

/* A pair as one number with the same order. */
static uint64_t key_of(int64_t i, int64_t j)
{
    return (uint64_t)(i < j ? i : j) << 32 | (uint64_t)(i < j ? j : i);
}

static int compare(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

/* Keys of the contacts, ascending; gb_alloc_free. */
static uint64_t *contact_keys(const struct gb_state *state, struct gb_error *err)
{
    const size_t count = (size_t)state->pair_count;
    uint64_t *key = gb_alloc_array(count + 1, sizeof *key, err);
    bool sorted = true;
    for (size_t k = 0; key && k < count; k++) {
        key[k] = key_of(state->pair[2 * k], state->pair[2 * k + 1]);
        sorted = sorted && (k == 0 || key[k - 1] < key[k]);
    }
    if (key && !sorted) {
        qsort(key, count, sizeof *key, compare);
    }
    return key;
}

/* Positions wrapped into the cell, then diameters; gb_alloc_free. */
static double *inside(const struct gb_state *state, const struct gb_cell *cell,
                      struct gb_error *err)
{
    const size_t count = (size_t)state->count;
    double *at = gb_alloc_array(4 * count, sizeof *at, err);
    if (at) {
        memcpy(at, state->position, 3 * count * sizeof *at);
    }
    for (size_t i = 0; at && i < count; i++) {
        gb_cell_wrap(cell, at + 3 * i);
        at[3 * count + i] = 2.0 * state->radius[i];
    }
    return at;
}

/* Force on the first of two particles with this branch vector; false beyond the range. */
static bool attract(const struct gb_state *state, const int32_t pair[2],
                    const double r[3], double force[3])
{
    const struct gb_law_rod no_rod = {0};
    const struct gb_law_bridge no_bridge = {0};
    const struct gb_law_dispersion dispersion = {.strength = state->attraction_strength,
                                                 .shift = state->attraction_shift};
    const double first = 2.0 * state->radius[pair[0]];
    const double second = 2.0 * state->radius[pair[1]];
    const double distance = gb_vec_length(r);
    struct gb_law_unequal law;
    if (distance - 0.5 * (first + second) >= state->attraction_cutoff - 1.0) {
        return false;
    }
    gb_law_unequal_init(&law, &no_rod, &no_bridge, &dispersion, first, second);
    const double pull = gb_law_unequal_attraction(&law, distance);
    for (int c = 0; c < 3; c++) {
        force[c] = -pull * r[c] / distance;
    }
    return true;
}

/* Appends the pairs of particle i in a list that are not contacts. */
static void append(const struct gb_state *state, const struct gb_neighbour_list *list,
                   const struct gb_pair_list *pairs, const double *position, int64_t i,
                   const uint64_t *contact, struct gb_state_gaps *gaps)
{
    for (int64_t k = pairs->start[i]; k < pairs->start[i + 1]; k++) {
        const int32_t pair[2] = {(int32_t)i, pairs->other[k]};
        const uint64_t key = key_of(pair[0], pair[1]);
        double r[3], force[3];
        for (int c = 0; c < 3; c++) {
            r[c] = position[3 * i + c] - position[3 * (int64_t)pair[1] + c] +
                   list->shift[pairs->image[k]][c];
        }
        if (!bsearch(&key, contact, (size_t)state->pair_count, sizeof key, compare) &&
            attract(state, pair, r, force)) {
            memcpy(gaps->pair + 2 * gaps->count, pair, sizeof pair);
            memcpy(gaps->force + 3 * gaps->count, force, sizeof force);
            gaps->count++;
        }
    }
}

static bool collect(struct gb_state_gaps *gaps, const struct gb_state *state,
                    const struct gb_neighbour_list *list, const double *position,
                    const uint64_t *contact, struct gb_error *err)
{
    const size_t most = (size_t)(list->near.pair_count + list->far.pair_count);
    gaps->pair = gb_alloc_array(2 * most + 1, sizeof *gaps->pair, err);
    gaps->force = gb_alloc_array(3 * most + 1, sizeof *gaps->force, err);
    if (!gaps->pair || !gaps->force) {
        return false;
    }
    for (int64_t i = 0; i < state->count; i++) {
        append(state, list, &list->near, position, i, contact, gaps);
        append(state, list, &list->far, position, i, contact, gaps);
    }
    return true;
}

bool gb_state_forces_gaps_init(struct gb_state_gaps *gaps, const struct gb_state *state,
                               struct gb_error *err)
{
    *gaps = (struct gb_state_gaps){0};
    if (state->die_radius > 0.0 || state->attraction_cutoff <= 1.0) {
        return true;
    }
    const struct gb_cell cell = gb_state_cell(state);
    const struct gb_neighbour_list_range range = {state->attraction_cutoff, skin};
    struct gb_neighbour_list list = {0};
    uint64_t *contact = contact_keys(state, err);
    double *at = contact ? inside(state, &cell, err) : NULL;
    bool done = at && gb_neighbour_list_init(&list, state->count,
                                             GB_NEIGHBOUR_LIST_TRANSPOSED, err);
    for (int64_t i = 0; done && i < state->count; i++) {
        const double diameter = at[3 * state->count + i];
        list.diameter = diameter == 1.0 ? list.diameter : at + 3 * state->count;
        list.largest = i > 0 && list.largest > diameter ? list.largest : diameter;
    }
    done = done && gb_neighbour_list_build(&list, &cell, at, range, NULL, err) &&
           collect(gaps, state, &list, at, contact, err);
    gb_neighbour_list_finish(&list);
    gb_alloc_free(contact);
    gb_alloc_free(at);
    if (!done) {
        gb_state_forces_gaps_finish(gaps);
    }
    return done;
}

void gb_state_forces_gaps_finish(struct gb_state_gaps *gaps)
{
    gb_alloc_free(gaps->pair);
    gb_alloc_free(gaps->force);
    *gaps = (struct gb_state_gaps){0};
}

/* Angle between a contact's axis and z, degrees, 0 to 90. */
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
