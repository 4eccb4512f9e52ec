#ifndef GB_PACK_F32_F32_STATE_H
#define GB_PACK_F32_F32_STATE_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"
#include "pack/f32/wrench_rows.h"
#include "pack/kernel/batch/batch.h"
#include "pack/list/neighbour_list.h"

/* A particle as a sweep in single precision reads it: half the memory traffic of doubles. */
struct gb_f32_particle {
    int32_t position[4]; /* fixed-point (fixed_position.h); the fourth is not used */
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

#endif
