#include "pack/cell/particles.h"

#include <string.h>

#include "base/alloc.h"
#include "pack/kernel/simd.h"
#include "pack/structure/assign_sizes.h"

static bool assign_diameters(struct gb_particles *particles, const struct gb_model *model,
                             struct gb_error *err)
{
    if (!model->polydisperse) {
        return true;
    }
    particles->diameter =
        gb_alloc_array((size_t)particles->count, sizeof *particles->diameter, err);
    return particles->diameter && gb_assign_sizes_model(model, particles->diameter, err);
}

bool gb_particles_init(struct gb_particles *particles, const struct gb_model *model,
                       const double *position, struct gb_error *err)
{
    const size_t n = (size_t)model->count;
    particles->count = model->count;
    gb_cell_init(&particles->cell, model->dimension, model->edges);
    particles->position = gb_alloc_array(3 * n, sizeof(double), err);
    particles->rotation = gb_alloc_array(3 * n, sizeof(double), err);
    particles->force = gb_alloc_array(3 * n, sizeof(double), err);
    particles->torque = gb_alloc_array(3 * n, sizeof(double), err);
    if (!particles->position || !particles->rotation || !particles->force ||
        !particles->torque || !assign_diameters(particles, model, err)) {
        return false;
    }
    memcpy(particles->position, position, 3 * n * sizeof *position);
    return true;
}

void gb_particles_finish(struct gb_particles *particles)
{
    gb_alloc_free(particles->position);
    gb_alloc_free(particles->rotation);
    gb_alloc_free(particles->force);
    gb_alloc_free(particles->torque);
    gb_alloc_free(particles->diameter);
    *particles = (struct gb_particles){0};
}

GB_SIMD_LOOP void scale_loop(double *restrict position, const double factor[3],
                             int64_t count)
{
    const double x = factor[0], y = factor[1], z = factor[2];
#pragma omp simd
    for (int64_t i = 0; i < count; i++) {
        position[3 * i] *= x;
        position[3 * i + 1] *= y;
        position[3 * i + 2] *= z;
    }
}
GB_SIMD_WIDTHS(scale, (double *position, const double factor[3], int64_t count),
               (position, factor, count))

void gb_particles_strain(struct gb_particles *particles, const double factor[3])
{
    for (int k = 0; k < 3; k++) {
        particles->cell.edge[k] *= factor[k];
    }
    scale(particles->position, factor, particles->count);
}

void gb_particles_replace(struct gb_particles *particles, const struct gb_cell *cell,
                          const double *position)
{
    const size_t n = 3 * (size_t)particles->count;
    particles->cell = *cell;
    memcpy(particles->position, position, n * sizeof *position);
    memset(particles->rotation, 0, n * sizeof *particles->rotation);
}

void gb_particles_wrap(struct gb_particles *particles, int threads)
{
    (void)threads; /* without OpenMP */
#pragma omp parallel for num_threads(threads) schedule(static) if (threads > 1)
    for (int64_t i = 0; i < particles->count; i++) {
        gb_cell_wrap(&particles->cell, particles->position + 3 * i);
    }
}
