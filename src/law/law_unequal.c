#include "law/law_unequal.h"

#include <math.h>

#include "base/portable.h"

void gb_law_unequal_init(struct gb_law_unequal *law, const struct gb_law_rod *rod,
                         const struct gb_law_bridge *bridge,
                         const struct gb_law_dispersion *dispersion, double first,
                         double second)
{
    const double mean_diameter = 0.5 * (first + second),
                 inverse_diameter = 1.0 / mean_diameter;
    const double share =
        first * second * inverse_diameter * inverse_diameter; /* d_i d_j/D^2 = c */
    const double offset = 0.5 * (first - second) * inverse_diameter, root = sqrt(share);
    *law = (struct gb_law_unequal){
        .mean_diameter = mean_diameter,
        .diameter_ratio = share,
        .inverse_diameter = {1.0 / first, 1.0 / second},
        .rod = {.hertz = root * rod->hertz,
                .rod = share * rod->rod,
                .pivot = share * rod->pivot},
        .bridge_length = mean_diameter * bridge->length,
        .strength = share * share * share * dispersion->strength * inverse_diameter *
                    inverse_diameter * inverse_diameter,
        .shift = dispersion->shift * inverse_diameter,
        .offset = offset * offset,
    };
    law->adhesion = gb_law_unequal_attraction(law, mean_diameter);
}

double gb_law_unequal_elastic(const struct gb_law_unequal *law, double deepest, double h,
                              double *stiffness)
{
    const double from = deepest > 0.0 ? deepest : h, x = from / law->mean_diameter;
    const double slope = law->mean_diameter * gb_law_rod_stiffness(&law->rod, x);
    if (stiffness) {
        *stiffness = slope;
    }
    return law->mean_diameter * law->mean_diameter * gb_law_rod_force(&law->rod, x) -
           slope * (from - h);
}

double gb_law_unequal_elastic_energy(const struct gb_law_unequal *law, double deepest,
                                     double h)
{
    const double mean_diameter = law->mean_diameter;
    const double from = deepest > 0.0 ? deepest : h, x = from / mean_diameter,
                 back = from - h;
    return mean_diameter * mean_diameter * mean_diameter *
               gb_law_rod_energy(&law->rod, x) -
           mean_diameter * mean_diameter * gb_law_rod_force(&law->rod, x) * back +
           0.5 * mean_diameter * gb_law_rod_stiffness(&law->rod, x) * back * back;
}

double gb_law_unequal_radius(const struct gb_law_unequal *law, double h)
{
    return 0.5 * sqrt(law->diameter_ratio * law->mean_diameter * fmax(h, 0.0));
}

double gb_law_unequal_moment(const struct gb_law_unequal *law, double h)
{
    /* a carries another root of c, in both terms of (9) */
    return law->mean_diameter * law->mean_diameter * law->mean_diameter *
           sqrt(law->diameter_ratio) *
           gb_law_rod_moment(&law->rod, h / law->mean_diameter);
}

double gb_law_unequal_attraction(const struct gb_law_unequal *law, double r)
{
    const double s = fmax(r / law->mean_diameter, 1.0) + law->shift;
    const double near = s * s - 1.0, wide = s * s - law->offset;
    return law->mean_diameter * law->mean_diameter * law->strength * s /
           (near * near * wide * wide);
}

double gb_law_unequal_attraction_energy(const struct gb_law_unequal *law, double r)
{
    if (law->strength == 0.0) {
        return 0.0;
    }
    /* the integral of s/((s^2-1)^2 (s^2-o)^2) by partial fractions in s^2, with c = 1-o
     */
    const double s = fmax(r / law->mean_diameter, 1.0) + law->shift, u = s * s;
    const double c = law->diameter_ratio;
    const double near = u - 1.0, wide = u - law->offset;
    const double tail =
        (1.0 / near + 1.0 / wide + 2.0 / c * gb_portable_log1p(-c / wide)) / (c * c);
    const double mean_diameter = law->mean_diameter;
    return -0.5 * mean_diameter * mean_diameter * mean_diameter * law->strength * tail -
           law->adhesion * fmax(mean_diameter - r, 0.0);
}

double gb_law_unequal_equilibrium(const struct gb_law_unequal *law)
{
    if (!(law->adhesion > 0.0)) {
        return 0.0;
    }
    /* Hertz alone needs more overlap; from there Newton's way down is monotonic */
    const double wanted = law->adhesion / (law->mean_diameter * law->mean_diameter);
    double x = gb_portable_cbrt(wanted / law->rod.hertz), change = 1.0;
    x *= x;
    for (int i = 0; i < 50 && x < 1.0 && change > 1e-15; i++) {
        const double less = (gb_law_rod_force(&law->rod, x) - wanted) /
                            gb_law_rod_stiffness(&law->rod, x);
        change = less / x;
        x -= less;
    }
    return x * law->mean_diameter;
}
