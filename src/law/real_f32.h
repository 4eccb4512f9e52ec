#ifndef GB_LAW_REAL_F32_H
#define GB_LAW_REAL_F32_H

/* Single precision for the loops of the kernels: twice the lanes and half the memory.
 * The relative error of forces is 1e-6, far below the tolerance of a relaxation in
 * single precision (gb_model chooses).  Include this before a law. */

#include <math.h>
#include <stdint.h>
#include <string.h>

#define INLINE static inline __attribute__((always_inline))

typedef float real;
typedef uint32_t real_bits;

/* As in real_f64.h. */
INLINE real root_estimate(real x)
{
    real_bits of_x;
    float y;
    memcpy(&of_x, &x, sizeof of_x);
    of_x = UINT32_C(0x5f3759df) - (of_x >> 1);
    memcpy(&y, &of_x, sizeof y);
    return y;
}

INLINE real root_newton(real y, real half)
{
    return y * (1.5F - half * y * y);
}

/* 1/sqrt(x), at most 5e-6 too small.  Springs at their caps are therefore cut slightly
 * below them. */
INLINE real inverse_root_below(real x)
{
    const float half = 0.5F * x;
    return root_newton(root_newton(root_estimate(x), half), half);
}

/* 1/sqrt(x) to nearly full precision. */
INLINE real inverse_root(real x)
{
    return root_newton(inverse_root_below(x), 0.5F * x);
}

INLINE real root(real x)
{
    return sqrtf(x);
}

INLINE real magnitude(real x)
{
    return fabsf(x);
}

/* As in real_f64.h; relative error of the fit 1e-8. */
INLINE real log_tail(real h, real s)
{
    const float q = s * s, q2 = q * q;
    const float p01 = 0.33333334F + q * 0.19999851F;
    const float p23 = 0.14296292F + q * 0.10851658F;
    const float sum = p01 + q2 * (p23 + q2 * 0.11619525F);
    return 2.0F * q * (1.0F - 0.5F * h + s * sum);
}

/* Second term of M(a) of (9) without its factor: (1/4) ln((1+s)/(1-s)) - s/2 - s^3/6
 * divided by s h^2 / 2, with s = sqrt(h).  This is 1/5 + h/7 + h^2/9 + ..., for 0 <= h
 * <= 1/2; the Chebyshev fit has a relative error of 4e-7. */
INLINE real moment_tail(real h)
{
    const float h2 = h * h, h4 = h2 * h2;
    const float p01 = 0.19999993F + h * 0.14287348F;
    const float p23 = 0.11045518F + h * 0.10081395F;
    const float p45 = 0.00494934F + h * 0.34105824F;
    const float p67 = -0.48279017F + h * 0.51957077F;
    return (p01 + h2 * p23) + h4 * (p45 + h2 * p67);
}

#include "law/real.h"

#endif
