#ifndef GB_PACK_KERNEL_BED_LAWS_H
#define GB_PACK_KERNEL_BED_LAWS_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "pack/kernel/batch/batch_f64.h"
#include "pack/kernel/batch/batch_laws.h"
#include "pack/kernel/bed_batch.h"

/* The laws of P3 without branches, in the style of batch_laws.h. */
struct bed_terms {
    bool storakers, printed, friction, walls;
};

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

/* log2 of a normal positive number: u = 2^n m with m in [sqrt(1/2), sqrt 2), and ln m = 2
 * atanh s, s = (m - 1)/(m + 1), |s| < 0.1716.  The series ends with s^21; the rest is
 * below 2 s^23/(23 (1 - s^2)) = 2.2e-19, below the rounding error. */
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

/* 2^t for |t| < 1000: t = n + f with |f| <= 1/2, Taylor's series of e^(f ln 2) up to the
 * 13th power; the rest is below 0.3466^14/14! = 4.1e-18. */
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

#endif
