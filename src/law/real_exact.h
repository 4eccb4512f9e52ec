#ifndef GB_LAW_REAL_EXACT_H
#define GB_LAW_REAL_EXACT_H

/* Double precision for single contacts.  It is accurate to the last digit for every
 * overlap up to a whole diameter, whereas the fits of the kernels end at half a
 * diameter.  Include this before a law. */

#include <math.h>
#include <stdint.h>

#include "base/portable.h"

#define INLINE static inline __attribute__((always_inline))

typedef double real;
typedef uint64_t real_bits;

/* Below this overlap the logarithms are summed as power series, because h + ln(1 - h)
 * loses digits to cancellation as h -> 0.  The first omitted term is below 2^-53 of the
 * sum at this overlap. */
static const double series_border = 0.0625;

enum { SERIES_TERMS = 14 };

INLINE real root(real x)
{
    return sqrt(x);
}

INLINE real inverse_root(real x)
{
    return 1.0 / sqrt(x);
}

/* -(h + ln(1 - h)) = sum h^k / k, k >= 2, for 0 <= h < 1. */
INLINE real log_tail(real h, real s)
{
    (void)s;
    if (h > series_border) {
        return -(h + gb_portable_log1p(-h));
    }
    double sum = 0.0;
    for (int k = SERIES_TERMS; k >= 2; k--) {
        sum = sum * h + 1.0 / k;
    }
    return sum * h * h;
}

/* (1/4) ln((1+s)/(1-s)) - s/2 - s^3/6 divided by s h^2 / 2, with s = sqrt(h): 1/5 + h/7
 * + h^2/9 + ..., for 0 <= h < 1. */
INLINE real moment_tail(real h)
{
    if (h > series_border) {
        const double s = sqrt(h);
        return (atanh(s) - s - s * h / 3.0) / (s * h * h);
    }
    double sum = 0.0;
    for (int k = SERIES_TERMS; k >= 2; k--) {
        sum = sum * h + 1.0 / (2 * k + 1);
    }
    return sum;
}

#include "law/real.h"

#endif
