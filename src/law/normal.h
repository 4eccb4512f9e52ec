#ifndef GB_LAW_NORMAL_H
#define GB_LAW_NORMAL_H

/* The normal force between two particles of a cell, P1 (1)-(3), for equal and unequal
 * sizes.  Only this file has these formulas.  Cells in double and in single precision,
 * discs and the laws of single contacts (law_*.h) include it after a law/real_*.h.
 *
 *   f_n = f_e - f_a
 *   f_e      rod model (1): Hertz' law and the compression of a rod between the centres,
 *              hertz sqrt(d' h) h + rod d' D (-(x + ln(1 - x))),  x = h/D
 *   bridge   below its deepest overlap f_e follows the tangent (2) of that curve
 *   f_a      attraction (3), constant while the particles touch
 *
 * Two particles touch at the distance D = (d_i + d_j)/2; d' = d_i d_j/D.  Equal
 * particles have D = d' = 1, and the compiler removes both.
 *
 * Forces are in E d^2, lengths in the reference diameter d, stiffnesses in E d. */

#include "law/law_bridge.h"
#include "law/law_dispersion.h"
#include "law/law_rod.h"

/* The terms of a scene.  They are constants where a law is inlined, so the compiler
 * removes the terms that are off. */
struct terms {
    bool planar, friction, bridges, viscous;
    bool printed; /* a_ch follows the printed form at the current r */
    bool plain;   /* a cohesionless law: no rod, no attraction */
    bool sized;   /* unequal sizes */
    /* no pivoting springs; double precision keeps them, with a force of 0 */
    bool unpivoted;
};

INLINE bool same_terms(struct terms a, struct terms b)
{
    return a.planar == b.planar && a.friction == b.friction && a.bridges == b.bridges &&
           a.viscous == b.viscous && a.printed == b.printed && a.plain == b.plain &&
           a.sized == b.sized && a.unpivoted == b.unpivoted;
}

/* --- sizes -------------------------------------------------------------------------- */

/* Lengths of a pair. */
struct pair_size {
    real mean, inverse_mean; /* D */
    real reduced;            /* d' */
    real inverse_i, inverse_j;
};

INLINE struct pair_size equal_size(void)
{
    return (struct pair_size){1, 1, 1, 1, 1};
}

/* From two diameters, with one division. */
INLINE struct pair_size unequal_size(real i, real j)
{
    const real mean = (real)0.5 * (i + j), product = i * j, all = 1 / (product * mean);
    const real inverse_mean = product * all;
    return (struct pair_size){mean, inverse_mean, product * inverse_mean, j * mean * all,
                              i * mean * all};
}

/* --- bridge ------------------------------------------------------------------------- */

/* h_min after a move to overlap h > 0: the deepest overlap of a bridge, 0 without one.
 * A bridge forms beyond `length`, and breaks partly when the contact opens by more than
 * that. */
INLINE real deepest_after(real length, real before, real h)
{
    const real formed = h > length ? h : 0;
    const real peeled = before - h > length ? h + length : before;
    const real bridged = h >= before ? h : peeled;
    return before <= 0 ? formed : bridged;
}

/* h_min of a bridge after its shear or pivoting cap broke it; P1 below (5), (11). */
INLINE real deepest_left(real length, real h)
{
    return h > length ? h : 0;
}

/* --- elastic force ------------------------------------------------------------------ */

/* Constants of the normal force. */
struct normal_law {
    real hertz, rod, shift, strength, adhesion, cutoff2;
    real gap; /* unequal sizes: the widest gap with attraction */
};

/* (1) at overlap h, x = h/D. hertz: the constant times sqrt(d' h); rod: the constant
 * times d' D. */
INLINE real rod_force(real hertz, real h, real rod, real x, real tail_at)
{
    return hertz * h + rod * log_tail(x, tail_at);
}

/* The slope of (1); quotient: rod d' x/(1 - x). */
INLINE real rod_slope(real hertz, real quotient)
{
    return (real)1.5 * hertz + quotient;
}

/* The tangent (2) of the bridge at `deepest`, evaluated at the smaller overlap h. */
INLINE real on_tangent(real force, real slope, real deepest, real h)
{
    return force - slope * (deepest - h);
}

/* --- attraction --------------------------------------------------------------------- */

/* (3) as numerator and denominator: attraction = factor / sum. */
struct pull {
    real factor, sum;
};

INLINE struct pull equal_pull(const struct normal_law *law, real r)
{
    const real s = larger(r, 1) + law->shift, q = s * s - 1;
    return (struct pull){law->strength, s * s * s * q * q};
}

/* (3) for unequal sizes, after Hamaker: d_i^3 d_j^3 s/((s^2 - D^2)^2 (s^2 - (d_i -
 * d_j)^2/4)^2) with s = r + alpha d0. */
INLINE struct pull unequal_pull(const struct normal_law *law, struct pair_size size,
                                real h)
{
    /* s - 1 instead of s: s^2 - 1 would lose digits */
    const real apart = (law->shift + larger(-h, 0)) * size.inverse_mean;
    const real share =
        size.reduced * size.inverse_mean; /* c: 1 less the offset squared */
    const real near = apart * (2 + apart), wide = near + share;
    return (struct pull){share * share * share * law->strength * size.inverse_mean *
                             (1 + apart),
                         near * near * (wide * wide)};
}

/* --- the whole force ---------------------------------------------------------------- */

/* f_n along the normal: in contact, f_e (rod law or bridge tangent) minus adhesion;
 * across a gap, the attraction. */
struct normal {
    real elastic, slope, total;
    real root;     /* sqrt of the overlap that f_e uses, times d' for unequal sizes */
    real adhesion; /* f_a in contact */
};

/* The roots and divisions that a normal force needs. */
struct normal_parts {
    real root;      /* as in struct normal */
    real tail_at;   /* second argument of log_tail */
    real rod_slope; /* slope of the rod term */
    real pull;      /* attraction */
};

/* deepest: h_min of a bridge, 0 for a contact without one, negative for a gap.  Equal
 * sizes use r, unequal sizes use size and h. */
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
    /* one division for all parts */
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
    if (t.plain) { /* rod and attraction are off: Hertz only */
        const real force = hertz * overlap;
        return (struct normal){force, rod_slope(hertz, 0), force, of.root,
                               t.sized ? 0 : law->adhesion};
    }
    const real from = deepest > 0 ? deepest : overlap;
    const real x = t.sized ? from * size.inverse_mean : from;
    const real rod = t.sized ? law->rod * size.reduced * size.mean : law->rod;
    const real slope = rod_slope(hertz, of.rod_slope);
    const real force =
        on_tangent(rod_force(hertz, from, rod, x, of.tail_at), slope, from, overlap);
    const real_bits near = bit_mask(t.sized ? -h < law->gap : r * r < law->cutoff2);
    /* unequal sizes: in contact unequal_pull is evaluated at touching distance, so it
     * is the adhesion */
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

#endif
