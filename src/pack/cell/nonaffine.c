#include "pack/cell/nonaffine.h"

#include <math.h>

#include "pack/cell/world_private.h"

struct gb_nonaffine gb_nonaffine_since(const struct gb_world *world,
                                       const struct gb_world_copy *copy)
{
    struct gb_nonaffine departure = {0};
    double sum = 0.0, most = 0.0;
    for (int64_t i = 0; i < world->count; i++) {
        double square = 0.0;
        for (int k = 0; k < 3; k++) {
            const double edge = world->cell.edge[k];
            /* shares of the edges are free of the affine motion */
            const double share = world->position[3 * i + k] / edge -
                                 copy->position[3 * i + k] / copy->cell.edge[k];
            const double way = edge * (share - gb_cell_whole(share));
            square += way * way;
        }
        if (square > most) {
            most = square;
            departure.particle = i;
        }
        sum += square;
    }
    departure.farthest = sqrt(most);
    departure.rms = sqrt(sum / (double)world->count);
    return departure;
}
