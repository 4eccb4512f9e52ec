#ifndef GB_PACK_KERNEL_BATCH_BATCH_LAWS_H
#define GB_PACK_KERNEL_BATCH_BATCH_LAWS_H

#include "law/springs.h"
#include "pack/kernel/batch/batch.h"

/* The laws of law/normal.h and law/springs.h in loops over a batch.  One source, compiled
 * once per useful combination of terms and per vector width.  Nothing but the order of
 * lanes differs between the widths (contraction is off), so their results are bit-identical.  And
 * once per precision: batch.c and batch_f32.c, which include it, define `real` before. */

INLINE struct normal_law normal_law(const struct gb_model *model, real cutoff2)
{
    return (struct normal_law){
        .hertz = (real)model->rod.hertz,
        .rod = (real)model->rod.rod,
        .shift = (real)model->dispersion.shift,
        .strength = (real)model->dispersion.strength,
        .adhesion = (real)model->adhesion,
        .cutoff2 = cutoff2,
        .gap = model->terms.attraction ? (real)(model->numerics.cutoff - 1.0)
                                       : -(real)INFINITY,
    };
}

INLINE void store_size(BATCH *restrict b, int k, struct pair_size size)
{
    b->mean[k] = size.mean;
    b->inverse_mean[k] = size.inverse_mean;
    b->reduced[k] = size.reduced;
    b->inverse[0][k] = size.inverse_i;
    b->inverse[1][k] = size.inverse_j;
}

INLINE struct pair_size stored_size(struct terms t, const BATCH *restrict b, int k)
{
    return t.sized ? (struct pair_size){b->mean[k], b->inverse_mean[k], b->reduced[k],
                                        b->inverse[0][k], b->inverse[1][k]}
                   : equal_size();
}

/* Factor that cuts a spring of squared load load2 back to its cap; without viscous forces
 * slightly below it, so that no rounding error makes a spring at rest slide. */
INLINE real cut_to(struct terms t, real cap, real load2, bool over)
{
    const real scale = t.viscous ? 1 : BELOW_CAP;
    return over ? scale * cap * inverse_root_below(load2) : 1;
}

#endif
