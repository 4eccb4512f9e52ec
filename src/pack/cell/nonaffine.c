#include "pack/cell/nonaffine.h"

#include <math.h>

#include "base/mat.h"
#include "base/team.h"
#include "pack/cell/world_private.h"
#include "pack/kernel/share.h"

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

/* Parts of the particles, whose sums are added in order: the bits do not depend on the
 * number of threads. */
enum { PARTS = 64 };

struct comparison {
    const struct gb_particles *particles;
    const struct gb_world_copy *copy;
    struct gb_deformation motion;
    bool tilted;
    struct part {
        double sum, most; /* of squared distances, d^2 */
        int64_t particle; /* with the largest */
    } part[PARTS];
};

static void compare_part(void *data, int64_t p)
{
    struct comparison *comparison = data;
    const struct gb_particles *particles = comparison->particles;
    const struct gb_world_copy *copy = comparison->copy;
    struct part part = {0};
    const int64_t end = gb_share(particles->count, (int)p + 1, PARTS);
    for (int64_t i = gb_share(particles->count, (int)p, PARTS); i < end; i++) {
        const double *now = particles->position + 3 * i, *then = copy->position + 3 * i;
        double moved[3];
        if (comparison->tilted) {
            moved_from_affine(&particles->cell, &comparison->motion, now, then, moved);
        } else {
            moved_from_scaled(particles->cell.edge, copy->cell.edge, now, then, moved);
        }
        const double square = gb_vec_dot(moved, moved);
        if (square > part.most) {
            part.most = square;
            part.particle = i;
        }
        part.sum += square;
    }
    comparison->part[p] = part;
}

struct gb_nonaffine gb_nonaffine_since(const struct gb_world *world,
                                       const struct gb_world_copy *copy)
{
    const struct gb_particles *particles = &world->engine.particles;
    struct comparison comparison = {
        .particles = particles,
        .copy = copy,
        .motion = gb_cell_motion(&copy->cell, &particles->cell),
        .tilted = gb_cell_tilted(&particles->cell) || gb_cell_tilted(&copy->cell)};
    gb_team_run(world->engine.team, PARTS, compare_part, &comparison);
    struct gb_nonaffine result = {0};
    double sum = 0.0, most = 0.0;
    for (int p = 0; p < PARTS; p++) {
        sum += comparison.part[p].sum;
        if (comparison.part[p].most > most) {
            most = comparison.part[p].most;
            result.particle = comparison.part[p].particle;
        }
    }
    result.farthest = sqrt(most);
    result.rms = sqrt(sum / (double)particles->count);
    return result;
}
