#ifndef GB_PACK_BATCH_FAR_H
#define GB_PACK_BATCH_FAR_H

#include "pack/batch_laws.h"

/* Attraction across gaps, in 2D and 3D: force on the first particle of each pair, 0 from
 * the cutoff on.  last: distances and pulls at the last evaluation, in viscous scenes,
 * for the work that the pairs take up (0: none yet). */
INLINE void attract(const struct gb_model *model, struct terms t,
                    struct gb_batch *restrict b, double *restrict last_distance,
                    double *restrict last_pull)
{
    const double cutoff2 = b->cutoff2, shift = model->dispersion.shift;
    const double strength = model->dispersion.strength;
#pragma omp simd
    for (int k = 0; k < b->n; k++) {
        const double rx = b->r[0][k], ry = b->r[1][k], rz = t.planar ? 0.0 : b->r[2][k];
        const double squared = rx * rx + ry * ry + rz * rz;
        const double distance = sqrt(squared);
        const double s = larger(distance, 1.0) + shift, q = s * s - 1.0;
        const double scale =
            mask(squared < cutoff2) * strength / (s * s * s * (q * q) * distance);
        b->force[0][k] = -scale * rx;
        b->force[1][k] = -scale * ry;
        if (!t.planar) {
            b->force[2][k] = -scale * rz;
        }
        if (t.viscous) {
            const double pull = scale * distance, before = last_distance[k];
            b->absorbed[k] =
                mask(before > 0.0) * 0.5 * (last_pull[k] + pull) * (distance - before);
            last_distance[k] = distance;
            last_pull[k] = pull;
        }
    }
}

#endif
