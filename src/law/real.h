#ifndef GB_LAW_REAL_H
#define GB_LAW_REAL_H

/* Helpers of the laws for one precision. law/real_f64.h, law/real_f32.h and
 * law/real_exact.h define `real`, `real_bits` and INLINE, then include this file.
 *
 * The laws run in loops over pairs without branches.  Conditions select between
 * computed values, and masks (1 or 0) multiply.  A hidden branch (&&, or ?: with an
 * expensive side) would stop the compiler from vectorising the loop.
 *
 * Constants are whole numbers where possible, because these convert to the type of the
 * other operand.  Any other constant is cast to real; without the cast the loop would
 * compute in double. */

#include <stdbool.h>
#include <string.h>

INLINE real larger(real a, real b)
{
    return a > b ? a : b;
}

INLINE real smaller(real a, real b)
{
    return a < b ? a : b;
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

/* All bits set where the condition holds, else none.  Use it with `selected` and
 * `masked` instead of ?:, for which the compiler would emit masked loads that not every
 * processor has. */
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

#endif
