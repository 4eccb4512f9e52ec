#include "pack/cell/nonaffine.h"

#include <math.h>

#include "pack/cell/world_private.h"

struct gb_nonaffine gb_nonaffine_since(const struct gb_world *world,
                                       const struct gb_world_copy *copy)
{
    const struct gb_particles *particles = &world->engine.particles;
    struct gb_nonaffine result = {0};
    double sum = 0.0, most = 0.0;
    for (int64_t i = 0; i < particles->count; i++) {
        double square = 0.0;
        for (int k = 0; k < 3; k++) {
            const double edge = particles->cell.edge[k];
            /* coordinates over the edges do not change in an affine motion */
            const double fraction = particles->position[3 * i + k] / edge -
                                    copy->position[3 * i + k] / copy->cell.edge[k];
            const double moved = edge * (fraction - gb_cell_whole(fraction));
            square += moved * moved;
        }
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
