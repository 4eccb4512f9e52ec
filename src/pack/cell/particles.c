#include "pack/cell/particles.h"

#include <string.h>

#include "base/alloc.h"
#include "base/mat.h"
#include "base/team.h"
#include "pack/kernel/simd.h"
#include "pack/list/blocks.h"
#include "pack/structure/assign_sizes.h"
#include "scene/imported/imported.h"

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

void gb_particles_cell(const struct gb_model *model, struct gb_cell *cell)
{
    gb_cell_init(cell, model->dimension, model->edges);
    if (model->packing) {
        memcpy(cell->tilt, model->packing->tilts, sizeof cell->tilt);
    }
}

bool gb_particles_init(struct gb_particles *particles, const struct gb_model *model,
                       const double *position, struct gb_error *err)
{
    const size_t n = (size_t)model->count;
    particles->count = model->count;
    gb_particles_cell(model, &particles->cell);
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

/* Positions under shear.  The particles turn with the continuum, so that a contact spring
 * sees the symmetric part of F alone: half of F - F^T is a small rotation w, dx = w x r. */
static void shear(struct gb_particles *particles, const double f[3][3])
{
    const double spin[3] = {0.5 * (f[2][1] - f[1][2]), 0.5 * (f[0][2] - f[2][0]),
                            0.5 * (f[1][0] - f[0][1])};
    for (int64_t i = 0; i < particles->count; i++) {
        double *position = particles->position + 3 * i, moved[3];
        gb_mat_apply(f, position, moved);
        memcpy(position, moved, sizeof moved);
        gb_vec_add(particles->rotation + 3 * i,
                   particles->diameter ? particles->diameter[i] : 1.0, spin);
    }
}

void gb_particles_deform(struct gb_particles *particles,
                         const struct gb_deformation *deformation)
{
    const double(*f)[3] = deformation->f;
    gb_cell_deform(&particles->cell, deformation);
    if (gb_deformation_is_scaling(deformation)) {
        scale(particles->position, (const double[3]){f[0][0], f[1][1], f[2][2]},
              particles->count);
    } else {
        shear(particles, f);
    }
}

void gb_particles_replace(struct gb_particles *particles, const struct gb_cell *cell,
                          const double *position)
{
    const size_t n = 3 * (size_t)particles->count;
    particles->cell = *cell;
    memcpy(particles->position, position, n * sizeof *position);
    memset(particles->rotation, 0, n * sizeof *particles->rotation);
}

static void wrap_range(void *data, int64_t begin, int64_t end)
{
    struct gb_particles *particles = data;
    for (int64_t i = begin; i < end; i++) {
        gb_cell_wrap(&particles->cell, particles->position + 3 * i);
    }
}

void gb_particles_wrap(struct gb_particles *particles, struct gb_team *team)
{
    gb_team_run_ranges(team, particles->count, GB_BLOCKS_GRAIN, wrap_range, particles);
}
