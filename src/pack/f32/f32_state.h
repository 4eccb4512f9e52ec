#ifndef GB_PACK_F32_F32_STATE_H
#define GB_PACK_F32_F32_STATE_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "greenbody/status.h"
#include "pack/cell/cell.h"
#include "pack/kernel/batch/batch.h"
#include "pack/list/neighbour_list.h"

/* Fixed-point positions: 2^32 units to an edge of the cell (f32_state.c).
 *
 * Units per d along axis c of a cell. */
static inline double gb_fixed_position_units(const struct gb_cell *cell, int c)
{
    return 0x1p32 / cell->edge[c];
}

/* Size of a unit along axis c, d. */
static inline double gb_fixed_position_unit(const struct gb_cell *cell, int c)
{
    return cell->edge[c] * 0x1p-32;
}

/* Difference a - b with wrap-around. */
static inline int32_t gb_fixed_position_difference(uint32_t a, uint32_t b)
{
    const uint32_t wide = a - b;
    int32_t difference;
    memcpy(&difference, &wide, sizeof difference);
    return difference;
}

/* Fixed-point coordinate of x (d). */
static inline int32_t gb_fixed_position_of(double x, double units_per_d)
{
    /* the low bits of the sum are the whole number, rounded to even */
    const double sum = x * units_per_d + 0x1.8p52;
    uint64_t bits;
    memcpy(&bits, &sum, sizeof bits);
    const uint32_t low = (uint32_t)bits;
    int32_t fixed;
    memcpy(&fixed, &low, sizeof fixed);
    return fixed;
}

/* Coordinate (d) for a fixed-point coordinate, on the side of the periodic boundary where
 * the last known coordinate is: they differ by up to half an edge.  Its bits depend only
 * on the fixed-point coordinate, the edge and the number of crossed boundaries. */
static inline double gb_fixed_position_follow(double last, int32_t fixed,
                                              double units_per_d, double d_per_unit)
{
    const double sum = last * units_per_d + 0x1.8p52; /* as in gb_fixed_position_of */
    const double whole = sum - 0x1.8p52;
    uint64_t bits;
    memcpy(&bits, &sum, sizeof bits);
    const int32_t moved = gb_fixed_position_difference((uint32_t)fixed, (uint32_t)bits);
    return (whole + (double)moved) * d_per_unit;
}

/* Branch vector x_i - x_j (d), nearest image, as computed by a sweep in single
 * precision. */
static inline void gb_fixed_position_branch(const struct gb_cell *cell,
                                            const double xi[3], const double xj[3],
                                            double r[3])
{
    for (int c = 0; c < 3; c++) {
        const double units = gb_fixed_position_units(cell, c);
        const uint32_t a = (uint32_t)gb_fixed_position_of(xi[c], units);
        const uint32_t b = (uint32_t)gb_fixed_position_of(xj[c], units);
        r[c] = (double)((float)gb_fixed_position_difference(a, b) *
                        (float)gb_fixed_position_unit(cell, c));
    }
}

struct gb_engine;

/* Numbers of a row: force and torque, each with a fourth number that is 0, and where the
 * torque begins; rows that are read at once, the last ones without being used. */
enum { GB_WRENCH_ROWS_WIDTH = 8, GB_WRENCH_ROWS_TORQUE = 4, GB_WRENCH_ROWS_AT_ONCE = 4 };

/* Forces and torques in single precision.  The first rows are those on the particles.  A
 * pair whose second particle lies in a later block than the first ("cross pair") adds to a
 * row of its own, which the block of the second particle adds to it afterwards and sets to
 * 0: between evaluations these rows are 0.  All other pairs add to both particles. */
struct gb_wrench_rows {
    float (*row)[GB_WRENCH_ROWS_WIDTH];
    int64_t room; /* rows */
    /* 2 particles + 1: of each the first row of near cross pairs, then of far ones, both
     * in the order of the lists.  Rows behind those of a block are not used. */
    int32_t *start;
};

/* Gives every pair of the lists its row (gb_pair_list.row); the rows of the particles stay
 * as they are.  On failure nothing may be evaluated. */
bool gb_f32_state_assign_rows(struct gb_wrench_rows *rows, struct gb_neighbour_list *list,
                              struct gb_error *err);

/* Sets the cross rows of particles begin .. end - 1, a whole block, to 0. */
void gb_f32_state_clear_rows(const struct gb_wrench_rows *rows, int64_t begin,
                             int64_t end);

/* A particle as a sweep in single precision reads it: half the memory traffic of doubles. */
struct gb_f32_particle {
    int32_t position[4]; /* fixed-point (f32_state.h); the fourth is not used */
    float rotation[4];   /* increment since the last evaluation, rad */
};

/* Neighbours in memory that share one bound of their displacements; divides a block. */
enum { GB_F32_STATE_GROUP = 32 };

/* Particles from which on the data of a sweep exceed the second cache and are prefetched. */
enum { GB_F32_STATE_PREFETCH = 16384 };

/* Arrays of a world in single precision; owned by f32_state.c. */
struct gb_f32_state {
    struct gb_batch_f32_kernel kernel;
    struct gb_f32_particle *particle; /* count */
    struct gb_wrench_rows rows;       /* forces and torques on them */
    float scale[3]; /* size of a fixed-point unit at the last evaluation, d */
    /* count: velocities of integrate_f32.c, of translation and rotation as in `rows` */
    float (*velocity)[GB_WRENCH_ROWS_WIDTH];
    /* Of every group: upper bound of the displacements since the build, d.  From the margin
     * of the list check on it is the largest displacement itself. */
    float *bound;
    double *speed2; /* of every block: sum of squared velocities, spins by inertia */
};

bool gb_f32_state_init(struct gb_f32_state *f32, const struct gb_model *model,
                       struct gb_error *err);
void gb_f32_state_finish(struct gb_f32_state *f32);

/* Fixed-point positions and rotations of particles begin .. end - 1, from doubles. */
void gb_f32_state_particles(struct gb_engine *engine, int64_t begin, int64_t end);

/* `position` follows the fixed-point positions, if it is stale. */
void gb_f32_state_synchronise(struct gb_engine *engine);

/* Forces and torques as doubles, if they are in f32 only; and back, after a load. */
void gb_f32_state_forces_to_f64(struct gb_engine *engine);

void gb_f32_state_forces_from_f64(struct gb_engine *engine);

#endif
