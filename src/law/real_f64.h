#ifndef GB_LAW_REAL_F64_H
#define GB_LAW_REAL_F64_H

/* Double precision for the loops of the kernels: roots, logarithms and powers that
 * vectorise.  Include this before a law. */

#include <math.h>
#include <stdint.h>
#include <string.h>

#define INLINE static inline __attribute__((always_inline))

typedef double real;
typedef uint64_t real_bits;

/* Estimates 1/sqrt(x) from the bits of x, within 3.5 %, and refines it by one Newton
 * step.  Multiplications and integer shifts are fast for every vector width, whereas
 * roots and divisions share one slow unit. */
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

/* No need for a lower bound in double precision: the same as inverse_root. */
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

/* -(h + ln(1 - h)) for 0 <= h <= 1/2 to the last digit, with s = h / (2 - h): 2
 * (s^2/(1+s) + s^3/3 + s^5/5 + ...), where all terms are positive.  The series after
 * the first term is a Chebyshev fit with a relative error of 3e-17. */
INLINE real log_tail(real h, real s)
{
    const double q = s * s;
    /* summed as a tree: a chain of ten dependent additions would stall the vector units
     */
    const double q2 = q * q, q4 = q2 * q2;
    const double p01 = 0.33333333333333331 + q * 0.20000000000007292;
    const double p23 = 0.14285714283554379 + q * 0.11111111358713932;
    const double p45 = 0.090908947180664293 + q * 0.076927850324793115;
    const double p67 = 0.066570721048274675 + q * 0.060005364047953563;
    const double p89 = 0.044003692430723371 + q * 0.080820228059717655;
    const double sum = ((p01 + q2 * p23) + q4 * (p45 + q2 * p67)) + q4 * q4 * p89;
    return 2.0 * q * (1.0 - 0.5 * h + s * sum);
}

INLINE uint64_t bits_of(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

INLINE double of_bits(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* log2 of a positive normal number: u = 2^n m with m in [sqrt(1/2), sqrt 2), and ln m =
 * 2 atanh s, s = (m - 1)/(m + 1), |s| < 0.1716.  The series ends with s^21; the rest is
 * below 2 s^23/(23 (1 - s^2)) = 2.2e-19, less than the rounding error. */
INLINE double log2_of(double u)
{
    const uint64_t least = 0x3fe6a09e667f3bcdU; /* sqrt(1/2) */
    const uint64_t biased = bits_of(u) - least + (UINT64_C(1024) << 52);
    const double n =
        of_bits((biased >> 52) | 0x4330000000000000U) - (4503599627370496.0 + 1024.0);
    const double m = of_bits((biased & 0x000fffffffffffffU) + least);
    const double s = (m - 1.0) / (m + 1.0), q = s * s;
    double sum = 1.0 / 21.0;
    sum = sum * q + 1.0 / 19.0;
    sum = sum * q + 1.0 / 17.0;
    sum = sum * q + 1.0 / 15.0;
    sum = sum * q + 1.0 / 13.0;
    sum = sum * q + 1.0 / 11.0;
    sum = sum * q + 1.0 / 9.0;
    sum = sum * q + 1.0 / 7.0;
    sum = sum * q + 1.0 / 5.0;
    sum = sum * q + 1.0 / 3.0;
    return n + 2.0 * M_LOG2E * (s + s * q * sum);
}

/* 2^t for |t| < 1000: t = n + f with |f| <= 1/2, and Taylor's series of e^(f ln 2) up
 * to the 13th power.  The rest is below 0.3466^14/14! = 4.1e-18. */
INLINE double exp2_of(double t)
{
    const double shift = 6755399441055744.0; /* 1.5 * 2^52: integers in the low bits */
    const double shifted = t + shift;
    const double x = (t - (shifted - shift)) * M_LN2;
    double sum = 1.0 / 6227020800.0;
    sum = sum * x + 1.0 / 479001600.0;
    sum = sum * x + 1.0 / 39916800.0;
    sum = sum * x + 1.0 / 3628800.0;
    sum = sum * x + 1.0 / 362880.0;
    sum = sum * x + 1.0 / 40320.0;
    sum = sum * x + 1.0 / 5040.0;
    sum = sum * x + 1.0 / 720.0;
    sum = sum * x + 1.0 / 120.0;
    sum = sum * x + 1.0 / 24.0;
    sum = sum * x + 1.0 / 6.0;
    sum = sum * x + 0.5;
    sum = sum * x + 1.0;
    sum = sum * x + 1.0;
    return sum * of_bits((bits_of(shifted) << 52) + 0x3ff0000000000000U);
}

#include "law/real.h"

#endif
