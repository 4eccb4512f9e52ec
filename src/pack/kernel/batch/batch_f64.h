#ifndef GB_PACK_KERNEL_BATCH_F64_H
#define GB_PACK_KERNEL_BATCH_F64_H

/* The loops of batch_*.h in double precision: include this first. */

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "pack/kernel/batch/batch.h"

#define INLINE    static inline __attribute__((always_inline))
#define BATCH     struct gb_batch
#define BELOW_CAP (1.0 - 0x1p-40)
#define PLANE(p)  ((real *)c->plane[p] + slot)

typedef double real;
typedef uint64_t real_bits;

/* Estimate of 1/sqrt(x) from the bits, within 3.5 %, and a step of Newton's iteration.
 * Multiplications and integer shifts are fast in every vector width; root and division
 * share one slow unit. */
INLINE real root_estimate(real x)
{
    real_bits of_x;
    double y;
    memcpy(&of_x, &x, sizeof of_x);
    of_x = UINT64_C(0x5fe6eb50c7b537a9) - (of_x >> 1);
    memcpy(&y, &of_x, sizeof y);
    return y;
}

INLINE real root_newton(real y, real half)
{
    return y * (1.5 - half * y * y);
}

/* 1/sqrt(x) within 4 units in the last place for normal x > 0, finite for 0. */
INLINE real inverse_root(real x)
{
    const double half = 0.5 * x;
    const double rough = root_newton(root_newton(root_estimate(x), half), half);
    return root_newton(root_newton(rough, half), half);
}

/* The same in this precision. */
INLINE real inverse_root_below(real x)
{
    return inverse_root(x);
}

INLINE real root(real x)
{
    return sqrt(x);
}

INLINE real magnitude(real x)
{
    return fabs(x);
}

/* -(h + ln(1 - h)) for 0 <= h <= 1/2 to the last digit, with s = h / (2 - h):
 * 2 (s^2/(1+s) + s^3/3 + s^5/5 + ...), all terms positive; the series behind the first
 * term is fitted by Chebyshev polynomials with a relative error of 3e-17. */
INLINE real log_tail(real h, real s)
{
    const double q = s * s;
    /* a tree of pairs: a chain of ten dependent sums would stall the vector units */
    const double q2 = q * q, q4 = q2 * q2;
    const double p01 = 0.33333333333333331 + q * 0.20000000000007292;
    const double p23 = 0.14285714283554379 + q * 0.11111111358713932;
    const double p45 = 0.090908947180664293 + q * 0.076927850324793115;
    const double p67 = 0.066570721048274675 + q * 0.060005364047953563;
    const double p89 = 0.044003692430723371 + q * 0.080820228059717655;
    const double sum = ((p01 + q2 * p23) + q4 * (p45 + q2 * p67)) + q4 * q4 * p89;
    return 2.0 * q * (1.0 - 0.5 * h + s * sum);
}

/* M(a) of contacts without a bridge is computed by the scalar law, contact by contact. */
#define MOMENT_FITTED false

INLINE real moment_tail(real h)
{
    (void)h;
    return 0.0;
}

#endif
