#include "law/law_unequal.h"

#include <math.h>

void gb_law_unequal_init(struct gb_law_unequal *law, const struct gb_law_rod *rod,
                         const struct gb_law_bridge *bridge,
                         const struct gb_law_dispersion *dispersion, double first,
                         double second)
{
    const double span = 0.5 * (first + second), inverse = 1.0 / span;
    const double share = first * second * inverse * inverse; /* d_i d_j/D^2 = c */
    const double offset = 0.5 * (first - second) * inverse, root = sqrt(share);
    *law = (struct gb_law_unequal){
        .span = span,
        .round = share,
        .inverse = {1.0 / first, 1.0 / second},
        .rod = {.hertz = root * rod->hertz,
                .rod = share * rod->rod,
                .pivot = share * rod->pivot},
        .bridge_length = span * bridge->length,
        .strength =
            share * share * share * dispersion->strength * inverse * inverse * inverse,
        .shift = dispersion->shift * inverse,
        .offset = offset * offset,
    };
    law->adhesion = gb_law_unequal_pull(law, span);
}

double gb_law_unequal_elastic(const struct gb_law_unequal *law, double deepest, double h,
                              double *stiffness)
{
    const double from = deepest > 0.0 ? deepest : h, x = from / law->span;
    const double slope = law->span * gb_law_rod_stiffness(&law->rod, x);
    if (stiffness) {
        *stiffness = slope;
    }
    return law->span * law->span * gb_law_rod_force(&law->rod, x) - slope * (from - h);
}

double gb_law_unequal_energy(const struct gb_law_unequal *law, double deepest, double h)
{
    const double span = law->span;
    const double from = deepest > 0.0 ? deepest : h, x = from / span, back = from - h;
    return span * span * span * gb_law_rod_energy(&law->rod, x) -
           span * span * gb_law_rod_force(&law->rod, x) * back +
           0.5 * span * gb_law_rod_stiffness(&law->rod, x) * back * back;
}

double gb_law_unequal_radius(const struct gb_law_unequal *law, double h)
{
    return 0.5 * sqrt(law->round * law->span * fmax(h, 0.0));
}

double gb_law_unequal_moment(const struct gb_law_unequal *law, double h)
{
    /* a carries another root of c, in both terms of (9) */
    return law->span * law->span * law->span * sqrt(law->round) *
           gb_law_rod_moment(&law->rod, h / law->span);
}

double gb_law_unequal_pull(const struct gb_law_unequal *law, double r)
{
    const double s = fmax(r / law->span, 1.0) + law->shift;
    const double near = s * s - 1.0, wide = s * s - law->offset;
    return law->span * law->span * law->strength * s / (near * near * wide * wide);
}

double gb_law_unequal_depth(const struct gb_law_unequal *law, double r)
{
    if (law->strength == 0.0) {
        return 0.0;
    }
    /* the integral of s/((s^2-1)^2 (s^2-o)^2) by partial fractions in s^2, with c = 1-o
     */
    const double s = fmax(r / law->span, 1.0) + law->shift, u = s * s;
    const double c = law->round;
    const double near = u - 1.0, wide = u - law->offset;
    const double tail = (1.0 / near + 1.0 / wide + 2.0 / c * log1p(-c / wide)) / (c * c);
    const double span = law->span;
    return -0.5 * span * span * span * law->strength * tail -
           law->adhesion * fmax(span - r, 0.0);
}

double gb_law_unequal_rest(const struct gb_law_unequal *law)
{
    if (!(law->adhesion > 0.0)) {
        return 0.0;
    }
    /* Hertz alone needs more overlap; from there Newton's way down is monotonic */
    const double wanted = law->adhesion / (law->span * law->span);
    double x = cbrt(wanted / law->rod.hertz), change = 1.0;
    x *= x;
    for (int i = 0; i < 50 && x < 1.0 && change > 1e-15; i++) {
        const double less = (gb_law_rod_force(&law->rod, x) - wanted) /
                            gb_law_rod_stiffness(&law->rod, x);
        change = less / x;
        x -= less;
    }
    return x * law->span;
}
