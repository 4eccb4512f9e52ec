#ifndef GB_PACK_BATCH_LAWS_H
#define GB_PACK_BATCH_LAWS_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "pack/batch.h"

/* How these loops are written: conditions choose between values that are there already
 * and masks (1 or 0) multiply, so that no lane needs a branch; a hidden one (&&, or an
 * expensive branch of ?:) would send the whole loop back to one contact at a time.
 *
 * One source, compiled once per useful combination of terms and per vector width: every
 * `const bool` below is a constant where the function is inlined.  Nothing but the order
 * of lanes differs between the widths (contraction is off), so they give the same bits.
 */
#define INLINE static inline __attribute__((always_inline))

struct terms {
    bool planar, friction, bridges, viscous;
    bool printed; /* a_ch follows the printed form at the current r */
};

/* 1/sqrt(x) within 4 units in the last place for normal x > 0, finite for 0: a guess from
 * the bits, good to 3.5 %, and Newton's iteration.  Multiplications and integer shifts
 * run in every vector width, where root and division wait for one slow unit. */
INLINE double inverse_root(double x)
{
    const double half = 0.5 * x;
    uint64_t bits;
    double y;
    memcpy(&bits, &x, sizeof bits);
    bits = UINT64_C(0x5fe6eb50c7b537a9) - (bits >> 1);
    memcpy(&y, &bits, sizeof y);
    y *= 1.5 - half * y * y;
    y *= 1.5 - half * y * y;
    y *= 1.5 - half * y * y;
    y *= 1.5 - half * y * y;
    return y;
}

/* -(h + ln(1 - h)) for 0 <= h <= 1/2 to the last digit, with s = h / (2 - h):
 * 2 (s^2/(1+s) + s^3/3 + s^5/5 + ...), all terms positive; the series behind the first
 * term is fitted by Chebyshev polynomials, which leaves 3e-17 of the whole. */
INLINE double log_tail(double h, double s)
{
    const double q = s * s;
    /* pairs first and then pairs of these: a chain of ten would keep the vector units
     * waiting */
    const double q2 = q * q, q4 = q2 * q2;
    const double p01 = 0.33333333333333331 + q * 0.20000000000007292;
    const double p23 = 0.14285714283554379 + q * 0.11111111358713932;
    const double p45 = 0.090908947180664293 + q * 0.076927850324793115;
    const double p67 = 0.066570721048274675 + q * 0.060005364047953563;
    const double p89 = 0.044003692430723371 + q * 0.080820228059717655;
    const double sum = ((p01 + q2 * p23) + q4 * (p45 + q2 * p67)) + q4 * q4 * p89;
    return 2.0 * q * (1.0 - 0.5 * h + s * sum);
}

INLINE double larger(double a, double b)
{
    return a > b ? a : b;
}

INLINE double smaller(double a, double b)
{
    return a < b ? a : b;
}

/* h_min after the move to overlap h; law_bridge.h without branches. */
INLINE double deepest_after(double length, double before, double h)
{
    const double fresh = h > length ? h : 0.0;
    const double peeled = before - h > length ? h + length : before;
    const double bridged = h >= before ? h : peeled;
    return before <= 0.0 ? fresh : bridged;
}

/* Squared overlap whose root is twice the spring radius. */
INLINE double radius_square(struct terms t, double length, double deepest, double h)
{
    return (t.bridges & (deepest > 0.0)) ? (t.printed ? h + length : deepest) : h;
}

/* Factor that keeps the length of a vector when its normal part is taken away; of the
 * squared lengths. */
INLINE double keep_length(double before, double after)
{
    return before * inverse_root(before * after);
}

/* Factor that cuts a spring of squared load load2 back to its cap; where nothing moves by
 * itself to a hair below it, so that no rounding error makes a spring at rest slide. */
INLINE double cut_to(struct terms t, double cap, double load2, bool over)
{
    const double hair = t.viscous ? 1.0 : 1.0 - 0x1p-40;
    return over ? hair * cap * inverse_root(load2) : 1.0;
}

INLINE double mask(bool condition)
{
    return condition ? 1.0 : 0.0;
}

/* x where the condition holds, else 0: one masked operation. */
INLINE double where(bool condition, double x)
{
    return condition ? x : 0.0;
}

/* f_n along the normal: elastic line or rod law minus adhesion, or the pull across a gap.
 */
struct normal {
    double elastic, slope, total;
    double root; /* of the overlap that the elastic force comes from */
};

INLINE struct normal normal_force(const struct gb_model *model, double cutoff2,
                                  double deepest, double h, double r)
{
    const double overlap = larger(h, 0.0);
    const double from = deepest > 0.0 ? deepest : overlap;
    /* one division for all: D = 1 / ((1 - h) (2 - h) s^3 q^2) */
    const double s = larger(r, 1.0) + model->dispersion.shift, q = s * s - 1.0;
    const double near = 1.0 - from, wide = 2.0 - from, gap = s * s * s * q * q;
    const double all = 1.0 / (near * wide * gap);
    const double root = sqrt(from), tail = log_tail(from, from * (near * gap) * all);
    const double hertz = model->rod.hertz * root;
    const double slope = 1.5 * hertz + model->rod.rod * (from * (wide * gap)) * all;
    const double force = hertz * from + model->rod.rod * tail - slope * (from - overlap);
    const double pull = model->dispersion.strength * (near * wide * all);
    const double touching = force - model->adhesion;
    const double apart = where(r * r < cutoff2, -pull);
    /* without a contact the overlap is none, and so are force and slope */
    return (struct normal){force, slope, deepest >= 0.0 ? touching : apart, root};
}

/* Radius of the springs from its square; mostly half the root that is there already. */
INLINE double radius(struct terms t, double square, double live, double root)
{
    return t.printed ? sqrt(larger(square, 0.0)) : live * 0.5 * root;
}

#endif
