#ifndef GB_PACK_KERNEL_BATCH_LAWS_H
#define GB_PACK_KERNEL_BATCH_LAWS_H

#include <math.h>

#include "pack/kernel/batch/batch.h"

/* These loops have no branches: conditions select between computed values, and masks (1
 * or 0) multiply.  A hidden branch (&&, or an expensive side of ?:) would stop the
 * compiler from vectorising the loop.
 *
 * One source, compiled once per useful combination of terms and per vector width: every
 * `const bool` below is a constant where the function is inlined.  Nothing but the order
 * of lanes differs between the widths (contraction is off), so they give the same bits.
 *
 * And once per precision: batch_f64.h or batch_f32.h, included before, defines `real`.
 * Constants are whole numbers where possible, which convert to the type of the other
 * operand; any other constant is cast to real, or the loop would compute in double. */

struct terms {
    bool planar, friction, bridges, viscous;
    bool printed; /* a_ch follows the printed form at the current r */
    bool plain;   /* a cohesionless law: no rod, no attraction */
    bool sized;   /* unequal sizes */
    /* without springs of pivoting; double precision keeps them, without a force */
    bool unpivoted;
};

INLINE real larger(real a, real b)
{
    return a > b ? a : b;
}

INLINE real smaller(real a, real b)
{
    return a < b ? a : b;
}

/* h_min after the move to overlap h; law_bridge.h without branches. */
INLINE real deepest_after(real length, real before, real h)
{
    const real formed = h > length ? h : 0;
    const real peeled = before - h > length ? h + length : before;
    const real bridged = h >= before ? h : peeled;
    return before <= 0 ? formed : bridged;
}

/* Squared overlap whose root is twice the spring radius; length and result of unequal sizes
 * are those of the pair, with d' in place of the diameter. */
INLINE real radius_square(struct terms t, real length, real deepest, real h, real reduced)
{
    const real overlap =
        (t.bridges & (deepest > 0)) ? (t.printed ? h + length : deepest) : h;
    return t.sized ? reduced * overlap : overlap;
}

/* Lengths of a pair; constants where all sizes are equal. */
struct pair_size {
    real mean, inverse_mean; /* D */
    real reduced;            /* d' */
    real inverse_i, inverse_j;
};

INLINE struct pair_size equal_size(void)
{
    return (struct pair_size){1, 1, 1, 1, 1};
}

/* From two diameters with one division. */
INLINE struct pair_size unequal_size(real i, real j)
{
    const real mean = (real)0.5 * (i + j), product = i * j, all = 1 / (product * mean);
    const real inverse_mean = product * all;
    return (struct pair_size){mean, inverse_mean, product * inverse_mean, j * mean * all,
                              i * mean * all};
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

/* Factor that restores the length of a vector after its normal part was removed, from the
 * squared lengths before and after. */
INLINE real keep_length(real before, real after)
{
    return before * inverse_root(before * after);
}

/* A spring rotated into the tangent plane, but shorter by what was normal to it; its squares
 * before and after. */
struct rotated {
    real x, y, z, before, after;
};

INLINE struct rotated rotate_spring(real nx, real ny, real nz, real x, real y, real z)
{
    const real before = x * x + y * y + z * z, along = x * nx + y * ny + z * nz;
    x -= along * nx;
    y -= along * ny;
    z -= along * nz;
    return (struct rotated){x, y, z, before, x * x + y * y + z * z};
}

/* Factor that cuts a spring of squared load load2 back to its cap; without viscous forces
 * slightly below it, so that no rounding error makes a spring at rest slide. */
INLINE real cut_to(struct terms t, real cap, real load2, bool over)
{
    const real scale = t.viscous ? 1 : BELOW_CAP;
    return over ? scale * cap * inverse_root_below(load2) : 1;
}

INLINE real mask(bool condition)
{
    return condition ? 1 : 0;
}

/* x where the condition holds, else 0: one masked operation. */
INLINE real where(bool condition, real x)
{
    return condition ? x : 0;
}

/* All bits where the condition holds, else none; `where` and ?: for such masks.  Numbers
 * behind a condition the compiler would read from memory under it, which not every
 * processor can. */
INLINE real_bits bit_mask(bool condition)
{
    return condition ? ~(real_bits)0 : 0;
}

INLINE real selected(real_bits condition, real x, real otherwise)
{
    real_bits of_x, of_other;
    memcpy(&of_x, &x, sizeof of_x);
    memcpy(&of_other, &otherwise, sizeof of_other);
    of_x = (of_x & condition) | (of_other & ~condition);
    memcpy(&x, &of_x, sizeof x);
    return x;
}

INLINE real masked(real_bits condition, real x)
{
    return selected(condition, x, 0);
}

/* f_n along the normal: elastic line or rod law minus adhesion, or the pull across a gap.
 */
struct normal {
    real elastic, slope, total;
    real root;     /* overlap of the elastic force, of unequal sizes times d' */
    real adhesion; /* of a contact */
};

/* Constants of the normal force. */
struct normal_law {
    real hertz, rod, shift, strength, adhesion, cutoff2;
    real gap; /* of unequal sizes: the widest across which they attract */
};

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

/* (3): the sum that its denominator is and the factor before it: pull = factor / sum. */
struct pull {
    real factor, sum;
};

INLINE struct pull equal_pull(const struct normal_law *law, real r)
{
    const real s = larger(r, 1) + law->shift, q = s * s - 1;
    return (struct pull){law->strength, s * s * s * q * q};
}

/* Of unequal sizes; law/law_unequal.h. */
INLINE struct pull unequal_pull(const struct normal_law *law, struct pair_size size,
                                real h)
{
    /* s - 1 and not s: their squares differ little from 1 */
    const real apart = (law->shift + larger(-h, 0)) * size.inverse_mean;
    const real share =
        size.reduced * size.inverse_mean; /* c: 1 less the offset squared */
    const real near = apart * (2 + apart), wide = near + share;
    return (struct pull){share * share * share * law->strength * size.inverse_mean *
                             (1 + apart),
                         near * near * (wide * wide)};
}

/* What a normal force needs of roots and divisions. */
struct normal_parts {
    real root;      /* of the overlap, as in normal */
    real tail_at;   /* where log_tail is taken */
    real rod_slope; /* slope of the rod's force */
    real pull;      /* attraction */
};

/* Of equal sizes r counts, of unequal ones size and h. */
INLINE struct normal_parts normal_parts(struct terms t, const struct normal_law *law,
                                        struct pair_size size, real deepest, real h,
                                        real r)
{
    const real overlap = larger(h, 0), from = !t.plain && deepest > 0 ? deepest : overlap;
    const real half_width = root(t.sized ? size.reduced * from : from);
    if (t.plain) {
        return (struct normal_parts){.root = half_width};
    }
    const real x = t.sized ? from * size.inverse_mean : from;
    const real near = 1 - x, wide = 2 - x;
    const struct pull attraction =
        t.sized ? unequal_pull(law, size, h) : equal_pull(law, r);
    const real gap = attraction.sum, rod = t.sized ? law->rod * size.reduced : law->rod;
    /* one division for all */
    const real all = 1 / (near * wide * gap);
    return (struct normal_parts){half_width, x * (near * gap) * all,
                                 rod * (x * (wide * gap)) * all,
                                 attraction.factor * (near * wide * all)};
}

/* The force from its parts. */
INLINE struct normal normal_of(struct terms t, const struct normal_law *law,
                               struct normal_parts of, struct pair_size size,
                               real deepest, real h, real r)
{
    const real overlap = larger(h, 0), hertz = law->hertz * of.root;
    if (t.plain) { /* the sum of these laws: one of them has constants other than 0 */
        const real force = hertz * overlap;
        return (struct normal){force, (real)1.5 * hertz, force, of.root,
                               t.sized ? 0 : law->adhesion};
    }
    const real from = deepest > 0 ? deepest : overlap;
    const real x = t.sized ? from * size.inverse_mean : from;
    const real rod = t.sized ? law->rod * size.reduced * size.mean : law->rod;
    const real slope = (real)1.5 * hertz + of.rod_slope;
    const real force =
        hertz * from + rod * log_tail(x, of.tail_at) - slope * (from - overlap);
    const real_bits near = bit_mask(t.sized ? -h < law->gap : r * r < law->cutoff2);
    /* s of a contact of unequal sizes is that of two that touch: the pull is the adhesion */
    const real adhesion = t.sized ? of.pull : law->adhesion;
    const real apart = masked(near, -of.pull), touching = force - adhesion;
    /* without a contact the overlap is 0, and so are force and slope */
    return (struct normal){force, slope,
                           selected(bit_mask(deepest >= 0), touching, apart), of.root,
                           adhesion};
}

INLINE struct normal normal_force(struct terms t, const struct normal_law *law,
                                  struct pair_size size, real deepest, real h, real r)
{
    const struct normal_parts parts = normal_parts(t, law, size, deepest, h, r);
    return normal_of(t, law, parts, size, deepest, h, r);
}

/* Radius of the springs from its square; mostly half the known root of the overlap. */
INLINE real radius(struct terms t, real square, bool live, real root_of_overlap)
{
    return t.printed ? root(larger(square, 0)) : where(live, (real)0.5 * root_of_overlap);
}

#endif
