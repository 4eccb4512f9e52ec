#ifndef GB_LAW_SPRINGS_H
#define GB_LAW_SPRINGS_H

/* The springs of a contact in a cell: shear (4), (5), pivoting (6)-(11) and rolling (12) of
 * P1.  This is the only place that has their stiffnesses and caps, as law/normal.h is for
 * the normal force; include it after a law/real_*.h.
 *
 * A spring is stored as half of the relative motion.  It is turned into the present tangent
 * plane keeping its length, lengthened by the motion, and cut back where its load is above
 * its cap.  a: contact radius, a2: its square; f_e: elastic force. */

#include "law/law_slip.h"
#include "law/normal.h"

/* --- kinematics --------------------------------------------------------------------- */

/* A spring rotated into the tangent plane, but shorter by what was normal to it; its squares
 * before and after. */
struct rotated {
    real x, y, z, before, after;
};

INLINE struct rotated rotate_spring(real nx, real ny, real nz, real x, real y, real z)
{
    const real before = x * x + y * y + z * z, along = x * nx + y * ny + z * nz;
    x -= along * nx;
    y -= along * ny;
    z -= along * nz;
    return (struct rotated){x, y, z, before, x * x + y * y + z * z};
}

/* Factor that restores the length of a vector after its normal part was removed, from the
 * squared lengths before and after. */
INLINE real keep_length(real before, real after)
{
    return before * inverse_root(before * after);
}

/* --- contact radius ----------------------------------------------------------------- */

/* Squared overlap whose root is twice the spring radius, P1 section II.A: a_ch of a bridge
 * belongs to its deepest overlap, or to the printed form at the present one.  Of unequal
 * sizes with d' in place of the diameter. */
INLINE real radius_square(struct terms t, real length, real deepest, real h, real reduced)
{
    const real overlap =
        (t.bridges & (deepest > 0)) ? (t.printed ? h + length : deepest) : h;
    return t.sized ? reduced * overlap : overlap;
}

/* Radius of the springs from its square; mostly half the known root of the overlap. */
INLINE real radius(struct terms t, real square, bool live, real root_of_overlap)
{
    return t.printed ? root(larger(square, 0)) : where(live, (real)0.5 * root_of_overlap);
}

/* --- stiffnesses and caps ----------------------------------------------------------- */

/* Constants of shear, pivoting and rolling. */
struct slip_law {
    real shear, pivot, roll, mu, mu_pivot;
    real bond; /* pi sigma_b */
    /* the two terms of M(a) */
    real plate, rod;
};

INLINE struct slip_law slip_law(const struct gb_law_slip *slip,
                                const struct gb_law_rod *rod)
{
    return (struct slip_law){
        .shear = (real)slip->shear,
        .pivot = (real)slip->pivot,
        .roll = (real)slip->roll,
        .mu = (real)slip->mu,
        .mu_pivot = (real)slip->mu_pivot,
        .bond = (real)(M_PI * slip->strength),
        .plate = (real)(3.0 * M_PI / 32.0 * rod->hertz),
        .rod = (real)(0.5 * rod->pivot),
    };
}

/* k_t of (4); a factor is a member of slip_law. */
INLINE real shear_stiffness(real factor, real a)
{
    return factor * a;
}

/* Of (6) and (12). */
INLINE real pivot_stiffness(real factor, real a2, real a)
{
    return factor * a2 * a;
}

INLINE real roll_stiffness(real factor, real a2, real a)
{
    return factor * a2 * a;
}

/* (5): what sigma_b allows, and without a bridge no more than friction. */
INLINE real shear_cap(const struct slip_law *slip, bool bridge, real a2, real elastic)
{
    const real strength = a2 * slip->bond;
    return bridge ? strength : smaller(slip->mu * elastic, strength);
}

/* (8)-(11), alike. */
INLINE real pivot_cap(const struct slip_law *slip, bool bridge, real a2, real a,
                      real moment)
{
    const real strength = (real)0.5 * a2 * a * slip->bond;
    return bridge ? strength : smaller(slip->mu_pivot * moment, strength);
}

/* Of the rolling moment of a bridge, (12). */
INLINE real roll_cap(real a, real elastic)
{
    return a * larger(elastic, 0) * (real)(1.0 / 3.0);
}

/* (5), (11): does shear (v2: square of its spring) or pivoting break a bridge?  Both sides
 * of both caps are squared, and divided by a2 and by the third power of a2. */
INLINE bool breaks(const struct slip_law *slip, real a2, real v2, real twist)
{
    const real tear = slip->bond * slip->bond;
    return (slip->shear * slip->shear * v2 > tear * a2) |
           (slip->pivot * slip->pivot * twist * twist > (real)0.25 * tear);
}

/* M(a) of (9): first moment of the contact pressure; root: of d' h, tail: moment_tail of
 * h/D. */
INLINE real contact_moment(const struct slip_law *slip, real h, real root_of, real tail)
{
    return h * h * (slip->plate + slip->rod * root_of * tail);
}

INLINE real unequal_contact_moment(const struct slip_law *slip, struct pair_size size,
                                   real h, real root_of, real tail)
{
    const real rod = slip->rod * root_of * tail;
    return size.reduced * (h * h) * (slip->plate + rod * size.inverse_mean);
}

/* --- in the plane ------------------------------------------------------------------- */

/* A spring is one number there, so the caps of motions need no root: caps over
 * stiffnesses, without the contact's size. */
struct plane_caps {
    real tear; /* of a bridge, squared: times (2 a)^2 */
    real bond; /* times a */
    real rub;  /* times f_e over a */
    real roll; /* times f_e over a^2 */
};

/* share: 1, or what a spring at its cap is cut to. */
INLINE struct plane_caps plane_caps(const struct gb_law_slip *slip, struct terms t,
                                    real share)
{
    const real bond = (real)(M_PI * slip->strength / slip->shear);
    return (struct plane_caps){(real)0.25 * bond * bond, share * bond,
                               share * (real)slip->mu / (real)slip->shear,
                               t.bridges ? share / (3 * (real)slip->roll) : 0};
}

#endif
