#ifndef GB_LAW_STORAKERS_H
#define GB_LAW_STORAKERS_H

/* The contact laws of dies, P3 (1)-(22): Hertz, and Storakers with Hertz' unloading.
 * Only this file has these formulas.  The code for beds (packings in a die) and for
 * single contacts includes it after one of law/real_*.h, which define `real`.
 *
 * The force is Hertz' force at the elastic part y of the overlap.  With h_x the overlap
 * where (2) and (16) are equal, the loading curve (16) is
 *     y = h_x (h/h_x)^((2+m)/3),
 * which needs one power of a ratio near 1 instead of two powers of h.  Below h_x Hertz'
 * force is the smaller one and y = h; the printed law uses (16) there too.  During
 * unloading and reloading the permanent part h - y keeps the value that it had at the
 * deepest overlap; this is (19) with (20), integrated. */

#include "law/law_hertz.h"

/* (4/3) E* sqrt R*: force over y^1.5. */
INLINE real hertz_factor(real modulus, real root_of_radius)
{
    return (real)(4.0 / 3.0) * modulus * root_of_radius;
}

/* (2) and (9) at the elastic part y; root_of is sqrt(y). */
INLINE real hertz_force(real factor, real y, real root_of)
{
    return factor * y * root_of;
}

INLINE real hertz_slope(real factor, real root_of)
{
    return (real)1.5 * factor * root_of;
}

/* Exponent of h/h_x in y. */
INLINE real elastic_power(real exponent)
{
    return (2 + exponent) / 3;
}

/* y on the loading curve. ratio: h/h_x; on_16: y of (16). */
INLINE real loaded_part(bool printed, real ratio, real on_16, real h)
{
    return selected(bit_mask(printed | (ratio > 1)), on_16, h);
}

/* dF/dh on the plastic branch, (22). */
INLINE real plastic_slope(real exponent, real force, real h)
{
    return (1 + (real)0.5 * exponent) * force / larger(h, (real)1e-300);
}

/* (6), (1): a dry contact never pulls. dashpot: the force to subtract. */
INLINE real damped_force(real elastic, real dashpot)
{
    return larger(elastic - dashpot, 0);
}

/* Largest damping that the step integrates stably (gb_law_hertz_damping_borne).
 * step_over_share: step / GB_LAW_HERTZ_BORNE; frequency2: squared frequency of the contact. */
INLINE real borne_damping(real stiffness, real step_over_share, real frequency2)
{
    return stiffness / larger(step_over_share * frequency2, (real)1e-300);
}

#endif
