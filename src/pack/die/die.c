#include "pack/die/die.h"

#include <math.h>

static double across(const double x[3])
{
    return sqrt(x[0] * x[0] + x[1] * x[1]);
}

/* A direction of the half-plane through the axis and x, in space.  On the axis all
 * directions are alike. */
static void swing(const double x[3], double rho, double out, double up, double unit[3])
{
    unit[0] = rho > 0.0 ? out * x[0] / rho : out;
    unit[1] = rho > 0.0 ? out * x[1] / rho : 0.0;
    unit[2] = up;
}

static double plane_overlap(double distance, double radius, double up, double unit[3])
{
    unit[0] = unit[1] = 0.0;
    unit[2] = up;
    return radius - distance;
}

/* From a point of the wall, (rho, z) away from the centre, to the centre. */
static double point_overlap(const double x[3], double rho, double out, double up,
                            double radius, double unit[3])
{
    const double distance = sqrt(out * out + up * up);
    if (distance > 0.0) {
        swing(x, rho, out / distance, up / distance, unit);
    } else {
        swing(x, rho, -1.0, 0.0, unit);
    }
    return radius - distance;
}

/* Above an open end the nearest point of the block is the rim of the bore, or its flat top
 * further out. */
static double block_overlap(const struct gb_die *die, const double x[3], double rho,
                            double radius, double unit[3])
{
    const double up = x[2] - die->top;
    return rho < die->radius ? point_overlap(x, rho, rho - die->radius, up, radius, unit)
                             : plane_overlap(up, radius, 1.0, unit);
}

static double side_overlap(const struct gb_die *die, const double x[3], double radius,
                           double unit[3])
{
    if ((die->funnel && x[2] > die->height) || die->bore == GB_DIE_BORE_GONE) {
        return -INFINITY;
    }
    const double rho = across(x);
    if (die->bore == GB_DIE_BORE_OPEN && x[2] > die->top) {
        return block_overlap(die, x, rho, radius, unit);
    }
    swing(x, rho, -1.0, 0.0, unit);
    return rho + radius - die->radius;
}

/* In the half-plane (rho, z) the funnel is the ring's segment and the cone's ray, which
 * meet at the outlet. */
static double funnel_overlap(const struct gb_die *die, const double x[3], double radius,
                             double unit[3])
{
    if (!die->funnel) {
        return -INFINITY;
    }
    const double rho = across(x);
    const double out = rho - die->outlet, up = x[2] - die->height;
    const double along = out * die->sine + up * die->cosine;
    if (up > 0.0 &&
        along > 0.0) { /* the signed distance keeps a centre that is through outside */
        swing(x, rho, -die->cosine, die->sine, unit);
        return radius - (up * die->sine - out * die->cosine);
    }
    const double ring = fmin(fmax(out, 0.0), die->radius - die->outlet);
    return point_overlap(x, rho, out - ring, up, radius, unit);
}

double gb_die_overlap(const struct gb_die *die, enum gb_die_wall wall, const double x[3],
                      double radius, double unit[3])
{
    switch (wall) {
    case GB_DIE_FLOOR:
        return plane_overlap(x[2], radius, 1.0, unit);
    case GB_DIE_SIDE:
        return side_overlap(die, x, radius, unit);
    case GB_DIE_PUNCH:
        return die->punch ? plane_overlap(die->punch_position - x[2], radius, -1.0, unit)
                          : -INFINITY;
    case GB_DIE_FUNNEL:
        return funnel_overlap(die, x, radius, unit);
    case GB_DIE_WALLS:
        break;
    }
    return -INFINITY;
}

double gb_die_radius_at(const struct gb_die *die, double z)
{
    return die->funnel && z > die->height
               ? die->outlet + (z - die->height) * die->sine / die->cosine
               : die->radius;
}

bool gb_die_contains(const struct gb_die *die, const double x[3])
{
    const bool below = !die->punch || x[2] < die->punch_position;
    const bool beside = die->bore == GB_DIE_BORE_GONE ||
                        (die->bore == GB_DIE_BORE_OPEN && x[2] > die->top);
    const double rho = across(x);
    const double most = beside ? HUGE_VAL : gb_die_radius_at(die, x[2]);
    return x[2] > 0.0 && below && rho < most && x[2] < HUGE_VAL;
}
