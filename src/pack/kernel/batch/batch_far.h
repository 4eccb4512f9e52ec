#ifndef GB_PACK_KERNEL_BATCH_BATCH_FAR_H
#define GB_PACK_KERNEL_BATCH_BATCH_FAR_H

#include "pack/kernel/batch/batch_laws.h"

/* Pull over distance of one pair. */
INLINE real equal_scale(const struct normal_law *law, real squared, real distance)
{
    const real s = larger(distance, 1) + law->shift, q = s * s - 1;
    return mask(squared < law->cutoff2) * law->strength /
           (s * s * s * (q * q) * distance);
}

INLINE real unequal_scale(const struct normal_law *law, const BATCH *restrict b, int k,
                          real distance)
{
    const struct pair_size size = unequal_size(b->diameter[0][k], b->diameter[1][k]);
    const struct pull pull = unequal_pull(law, size, size.mean - distance);
    return mask(distance - size.mean < law->gap) * pull.factor / (pull.sum * distance);
}

/* Attraction across gaps, in 2D and 3D: force on the first particle of each pair, 0 from
 * the cutoff on.  last_*: distances and attractions at the last evaluation, in viscous
 * scenes, for the work that the pairs absorb (0: none yet). */
INLINE void attract(const struct gb_model *model, struct terms t, BATCH *restrict b,
                    real *restrict last_distance, real *restrict last_pull)
{
    const struct normal_law law = normal_law(model, b->cutoff2);
#pragma omp simd
    for (int k = 0; k < b->n; k++) {
        const real rx = b->r[0][k], ry = b->r[1][k], rz = t.planar ? 0 : b->r[2][k];
        const real squared = rx * rx + ry * ry + rz * rz;
        const real distance = root(squared);
        const real scale = t.sized ? unequal_scale(&law, b, k, distance)
                                   : equal_scale(&law, squared, distance);
        b->force[0][k] = -scale * rx;
        b->force[1][k] = -scale * ry;
        if (!t.planar) {
            b->force[2][k] = -scale * rz;
        }
        if (t.viscous) {
            const real pull = scale * distance, before = last_distance[k];
            b->absorbed[k] = mask(before > 0) * (real)0.5 * (last_pull[k] + pull) *
                             (distance - before);
            last_distance[k] = distance;
            last_pull[k] = pull;
        }
    }
}

#endif
