#ifndef GB_PACK_F32_INTEGRATE_F32_TILE_H
#define GB_PACK_F32_INTEGRATE_F32_TILE_H

/* The loops of integrate_f32.c over one tile of particles.  In memory a particle is three
 * consecutive numbers of an array, which vectors of any width can load; the sweep reads
 * rows of four.  A tile at a time is converted in the cache. */

#include <math.h>
#include <string.h>

#include "pack/f32/f32_state.h"
#include "pack/kernel/register_rows.h"
#include "pack/kernel/simd.h"

/* Particles of a tile, few enough for the first cache, and their numbers; particles whose
 * squares are summed as floats; lanes of these sums, whatever the vector width. */
enum { TILE = 64, NUMBERS = 3 * TILE, SUMMED = 256, LANES = 16 };
enum { GROUPS = TILE / GB_F32_STATE_GROUP };

/* Constants of one pass over all blocks. */
struct pass {
    float keep, back, step;
    float kick, kick_rotation;
    float inertia;
    float margin; /* d; a bound from here on is replaced by the displacement itself */
    bool bounds_known; /* from the updates before */
    float speed2_max;  /* squared velocity of the largest displacement */
    float rounding;    /* d; upper bound of the rounding to fixed point */
    float *rotation_total;
    const double *diameter; /* of all particles; NULL: all are 1 */
    /* for every number of a tile, by its axis: fixed-point units per d, and d per unit */
    float units[NUMBERS], unit[NUMBERS];
};

/* One tile; rows of four are read and written at its last particle. */
struct tile {
    float force[NUMBERS + 1], torque[NUMBERS + 1];
    float displacement[NUMBERS], rotation[NUMBERS + 1];
    float square[NUMBERS];
    int32_t position[NUMBERS + 1];
    float kept[TILE]; /* factors of velocities that are too large; set where one is */
};

struct sum {
    float lane[LANES];
    double rest; /* of the last numbers, fewer than a vector has lanes */
};

/* Sums over some tiles. */
struct motion {
    struct sum speed2, spin2;
    float displacement; /* largest bound, d */
};

/* Forces over the masses, which are the diameters (NULL: all 1). */
GB_SIMD_LOOP void load_forces(float (*wrench)[GB_WRENCH_ROWS_WIDTH],
                              const double *diameter, int particles,
                              struct tile *restrict tile)
{
    float inverse[TILE];
    for (int i = 0; diameter && i < particles; i++) {
        inverse[i] = 1.0F / (float)diameter[i];
    }
    for (int i = 0; diameter && i < particles; i++) {
        gb_row_store(tile->force + 3 * i, gb_row_load(wrench[i]) * inverse[i]);
        gb_row_store(tile->torque + 3 * i, gb_row_load(wrench[i] + 4) * inverse[i]);
    }
    for (int i = 0; !diameter && i < particles; i++) {
        gb_row_store(tile->force + 3 * i, gb_row_load(wrench[i]));
        gb_row_store(tile->torque + 3 * i, gb_row_load(wrench[i] + 4));
    }
}

GB_SIMD_LOOP void load_positions(const struct gb_f32_particle *particle, int particles,
                                 struct tile *restrict tile)
{
    for (int i = 0; i < particles; i++) {
        memcpy(tile->position + 3 * i, particle[i].position, 4 * sizeof *tile->position);
    }
}

/* The fourth number of a row is not used. */
GB_SIMD_LOOP void store_particles(const struct tile *restrict tile, int particles,
                                  struct gb_f32_particle *restrict particle)
{
    for (int i = 0; i < particles; i++) {
        memcpy(particle[i].position, tile->position + 3 * i, sizeof particle[i].position);
        memcpy(particle[i].rotation, tile->rotation + 3 * i, sizeof particle[i].rotation);
    }
}

/* Velocities from forces, and their displacements. */
GB_SIMD_LOOP void update_velocity(const struct pass *pass, float kick, int n,
                                  const float *restrict force, float *restrict v,
                                  float *restrict displacement, float *restrict square)
{
    const float keep = pass->keep, back = pass->back, step = pass->step;
    for (int k = 0; k < n; k++) {
        const float before = v[k], after = keep * before + kick * force[k];
        v[k] = after;
        displacement[k] = step * after - back * before;
        square[k] = after * after;
    }
}

GB_SIMD_LOOP void add_to_sum(struct sum *restrict sum, const float *restrict number,
                             int n)
{
    int k = 0;
    for (; k + LANES <= n; k += LANES) {
        for (int l = 0; l < LANES; l++) {
            sum->lane[l] += number[k + l];
        }
    }
    for (; k < n; k++) {
        sum->rest += (double)number[k];
    }
}

static inline double sum_total(const struct sum *sum)
{
    double all = sum->rest;
    for (int l = 0; l < LANES; l++) {
        all += (double)sum->lane[l];
    }
    return all;
}

/* Largest sum of the three numbers of a particle. */
GB_SIMD_LOOP float largest_of(const float *restrict number, int particles)
{
    float most = 0.0F;
#pragma omp simd reduction(max : most)
    for (int i = 0; i < particles; i++) {
        const float sum = number[3 * i] + number[3 * i + 1] + number[3 * i + 2];
        most = sum > most ? sum : most;
    }
    return most;
}

/* Square root of the largest squared displacement of every group. */
GB_SIMD_LOOP void largest_of_groups(const float *restrict square, int particles,
                                    float *restrict largest)
{
    for (int i = 0; i < particles; i += GB_F32_STATE_GROUP) {
        const int left = particles - i;
        const int n = left < GB_F32_STATE_GROUP ? left : GB_F32_STATE_GROUP;
        *largest++ = sqrtf(largest_of(square + 3 * i, n));
    }
}

GB_SIMD_LOOP void square_all(const float *restrict number, int n, float *restrict square)
{
    for (int k = 0; k < n; k++) {
        square[k] = number[k] * number[k];
    }
}

/* Moves fixed-point positions, rounding to the nearest unit.  The result for a
 * displacement that is not finite is undefined; the sum of squared velocities reports
 * it. */
GB_SIMD_LOOP void move_positions(const struct pass *pass, int n,
                                 const float *restrict displacement,
                                 int32_t *restrict position)
{
    const float most = 0x1p30F;
    for (int k = 0; k < n; k++) {
        const float exact = displacement[k] * pass->units[k];
        const float bounded = exact < most ? exact > -most ? exact : -most : most;
        const uint32_t units =
            (uint32_t)(int32_t)(bounded + (bounded < 0.0F ? -0.5F : 0.5F));
        position[k] = (int32_t)((uint32_t)position[k] + units);
    }
}

/* Squared components of the displacements since the list build. */
GB_SIMD_LOOP void displacements_since_build(const struct pass *pass, int n,
                                            const int32_t *restrict position,
                                            const uint32_t *restrict built,
                                            float *restrict square)
{
    for (int k = 0; k < n; k++) {
        const uint32_t wide = (uint32_t)position[k] - built[k];
        const float moved = (float)(int32_t)wide * pass->unit[k];
        square[k] = moved * moved;
    }
}

/* Bounds of the groups of a tile; returns the largest.  A bound grows by the largest
 * displacement of its group and an allowance for rounding.  Only when one reaches
 * the margin of the list check are the true displacements computed. */
GB_SIMD_LOOP float update_bounds(const struct pass *pass, int particles,
                                 const uint32_t *built, struct tile *tile, float *bound)
{
    const float slack = 1.0F + 0x1p-16F;
    const int count = (particles + GB_F32_STATE_GROUP - 1) / GB_F32_STATE_GROUP;
    float step[GROUPS], most = 0.0F;
    bool inside = pass->bounds_known;
    if (inside) {
        square_all(tile->displacement, 3 * particles, tile->square);
        largest_of_groups(tile->square, particles, step);
        for (int g = 0; g < count; g++) {
            bound[g] = (bound[g] + step[g] + pass->rounding) * slack;
            inside = inside && bound[g] < pass->margin;
        }
    }
    if (!inside) {
        displacements_since_build(pass, 3 * particles, tile->position, built,
                                  tile->square);
        largest_of_groups(tile->square, particles, bound);
    }
    for (int g = 0; g < count; g++) {
        most = fmaxf(most, bound[g]);
    }
    return most;
}

GB_SIMD_LOOP void add_all(float *restrict sum, const float *restrict number, int n)
{
    for (int k = 0; k < n; k++) {
        sum[k] += number[k];
    }
}

/* Factors for velocities above the limit; returns true if there are any. */
GB_SIMD_LOOP bool find_too_fast(const struct pass *pass, int particles, struct tile *tile)
{
    if (!(largest_of(tile->square, particles) > pass->speed2_max)) {
        return false;
    }
    for (int i = 0; i < particles; i++) {
        const float *square = tile->square + 3 * i;
        const float speed2 = square[0] + square[1] + square[2];
        tile->kept[i] =
            speed2 > pass->speed2_max ? sqrtf(pass->speed2_max / speed2) : 1.0F;
    }
    return true;
}

/* Scales velocities, their squares and displacements by these factors. */
GB_SIMD_LOOP void slow_down(const struct pass *pass, int particles, struct tile *tile,
                            float *v, float *displacement)
{
    for (int k = 0; k < 3 * particles; k++) {
        const float kept = tile->kept[k / 3];
        displacement[k] -= pass->step * (1.0F - kept) * v[k];
        v[k] *= kept;
        tile->square[k] *= kept * kept;
    }
}

#endif
