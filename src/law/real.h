#ifndef GB_LAW_REAL_H
#define GB_LAW_REAL_H

/* What the laws need of a precision: included by law/real_f64.h, law/real_f32.h and
 * law/real_exact.h, which define `real`, `real_bits` and INLINE first.
 *
 * The laws run in loops over pairs, which have no branches: conditions select between
 * computed values, and masks (1 or 0) multiply.  A hidden branch (&&, or an expensive side
 * of ?:) would stop the compiler from vectorising the loop.
 *
 * Constants are whole numbers where possible, which convert to the type of the other
 * operand; any other constant is cast to real, or the loop would compute in double. */

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

/* All bits where the condition holds, else none; `where` and ?: for such masks.  The
 * compiler would load the numbers of a condition under a mask, which not every processor
 * can. */
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
