#include "pack/cell/nonaffine.h"

#include <math.h>

#include "base/mat.h"
#include "pack/cell/world_private.h"

/* Coordinates over the edges do not change in an affine motion. */
static void moved_from_scaled(const double edge[3], const double edge_then[3],
                              const double now[3], const double then[3], double moved[3])
{
    for (int k = 0; k < 3; k++) {
        const double fraction = now[k] / edge[k] - then[k] / edge_then[k];
        moved[k] = edge[k] * (fraction - gb_cell_whole(fraction));
    }
}

static void moved_from_affine(const struct gb_cell *cell,
                              const struct gb_deformation *motion, const double now[3],
                              const double then[3], double moved[3])
{
    double affine[3];
    gb_mat_apply(motion->f, then, affine);
    for (int k = 0; k < 3; k++) {
        moved[k] = now[k] - affine[k];
    }
    gb_cell_nearest(cell, moved);
}

struct gb_nonaffine gb_nonaffine_since(const struct gb_world *world,
                                       const struct gb_world_copy *copy)
{
    const struct gb_particles *particles = &world->engine.particles;
    struct gb_nonaffine result = {0};
    const bool tilted = gb_cell_tilted(&particles->cell) || gb_cell_tilted(&copy->cell);
    const struct gb_deformation motion = gb_cell_motion(&copy->cell, &particles->cell);
    double sum = 0.0, most = 0.0;
    for (int64_t i = 0; i < particles->count; i++) {
        const double *now = particles->position + 3 * i, *then = copy->position + 3 * i;
        double moved[3];
        if (tilted) {
            moved_from_affine(&particles->cell, &motion, now, then, moved);
        } else {
            moved_from_scaled(particles->cell.edge, copy->cell.edge, now, then, moved);
        }
        const double square = gb_vec_dot(moved, moved);
        if (square > most) {
            most = square;
            result.particle = i;
        }
        sum += square;
    }
    result.farthest = sqrt(most);
    result.rms = sqrt(sum / (double)particles->count);
    return result;
}
