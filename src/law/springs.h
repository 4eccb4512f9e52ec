#ifndef GB_LAW_SPRINGS_H
#define GB_LAW_SPRINGS_H

/* The springs of a contact in a cell: shear (4), (5), pivoting (6)-(11) and rolling
 * (12) of P1.  Only this file has their stiffnesses and caps, and law/normal.h the
 * normal force.  Include it after a law/real_*.h.
 *
 * A spring stores half of the relative motion.  Each step rotates it into the present
 * tangent plane at constant length, adds the motion, and cuts it back if its load
 * exceeds its cap.
 *
 * a, a2   contact radius and its square
 * f_e     elastic force */

#include "law/law_slip.h"
#include "law/normal.h"

/* --- kinematics --------------------------------------------------------------------- */

/* A spring projected on the tangent plane, not yet restored to its length; its squared
 * length before and after the projection. */
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

/* Factor that restores the length of a vector whose normal part was removed, from the
 * squared lengths before and after. */
INLINE real keep_length(real before, real after)
{
    return before * inverse_root(before * after);
}

/* --- contact radius ----------------------------------------------------------------- */

/* Squared overlap whose root is twice the spring radius, P1 section II.A.  A bridge
 * uses its deepest overlap, or the printed form at the present overlap; unequal sizes
 * multiply by d'. */
INLINE real radius_square(struct terms t, real length, real deepest, real h, real reduced)
{
    const real overlap =
        (t.bridges & (deepest > 0)) ? (t.printed ? h + length : deepest) : h;
    return t.sized ? reduced * overlap : overlap;
}

/* Radius of the springs from its square.  Except for the printed form it is half the
 * root that is already known. */
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

/* k_t of (4); `factor` is a member of slip_law. */
INLINE real shear_stiffness(real factor, real a)
{
    return factor * a;
}

/* Stiffnesses of (6) and (12). */
INLINE real pivot_stiffness(real factor, real a2, real a)
{
    return factor * a2 * a;
}

INLINE real roll_stiffness(real factor, real a2, real a)
{
    return factor * a2 * a;
}

/* (5): the limit by sigma_b; without a bridge also the friction limit. */
INLINE real shear_cap(const struct slip_law *slip, bool bridge, real a2, real elastic)
{
    const real strength = a2 * slip->bond;
    return bridge ? strength : smaller(slip->mu * elastic, strength);
}

/* (8)-(11): the same for pivoting. */
INLINE real pivot_cap(const struct slip_law *slip, bool bridge, real a2, real a,
                      real moment)
{
    const real strength = (real)0.5 * a2 * a * slip->bond;
    return bridge ? strength : smaller(slip->mu_pivot * moment, strength);
}

/* Cap of the rolling moment of a bridge, (12). */
INLINE real roll_cap(real a, real elastic)
{
    return a * larger(elastic, 0) * (real)(1.0 / 3.0);
}

/* (5), (11): does shear (v2: squared length of its spring) or pivoting break a bridge?
 * Both sides of the shear condition are squared and divided by a2, those of the
 * pivoting condition by a2^3. */
INLINE bool breaks(const struct slip_law *slip, real a2, real v2, real twist)
{
    const real tear = slip->bond * slip->bond;
    return (slip->shear * slip->shear * v2 > tear * a2) |
           (slip->pivot * slip->pivot * twist * twist > (real)0.25 * tear);
}

/* M(a) of (9): first moment of the contact pressure. root_of: sqrt(d' h); tail:
 * moment_tail of h/D. */
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

/* --- in 2D ------------------------------------------------------------------- */

/* In 2D a spring is one number, so its caps can be given as motions (cap / stiffness)
 * without a root.  The size of the contact is a separate factor. */
struct plane_caps {
    real tear; /* squared motion that breaks a bridge, over (2 a)^2 */
    real bond; /* sigma_b limit, over a */
    real rub;  /* friction limit, over f_e / a */
    real roll; /* rolling limit, over f_e / a^2 */
};

/* share: 1, or the fraction of its cap to which a sliding spring is cut. */
INLINE struct plane_caps plane_caps(const struct gb_law_slip *slip, struct terms t,
                                    real share)
{
    const real bond = (real)(M_PI * slip->strength / slip->shear);
    return (struct plane_caps){(real)0.25 * bond * bond, share * bond,
                               share * (real)slip->mu / (real)slip->shear,
                               t.bridges ? share / (3 * (real)slip->roll) : 0};
}

#endif
