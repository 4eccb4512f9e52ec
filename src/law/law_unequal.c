#include "law/law_unequal.h"

#include "law/real_exact.h"

#include "law/springs.h"

void gb_law_unequal_init(struct gb_law_unequal *law, const struct gb_law_rod *rod,
                         const struct gb_law_bridge *bridge,
                         const struct gb_law_dispersion *dispersion, double first,
                         double second)
{
    const double mean_diameter = 0.5 * (first + second),
                 inverse_diameter = 1.0 / mean_diameter;
    *law = (struct gb_law_unequal){
        .mean_diameter = mean_diameter,
        .diameter_ratio = first * second * inverse_diameter * inverse_diameter,
        .inverse_diameter = {1.0 / first, 1.0 / second},
        .rod = *rod,
        .bridge_length = mean_diameter * bridge->length,
        .strength = dispersion->strength,
        .shift = dispersion->shift,
    };
    law->adhesion = gb_law_unequal_attraction(law, mean_diameter);
}

static struct pair_size size_of(const struct gb_law_unequal *law)
{
    return (struct pair_size){law->mean_diameter, 1.0 / law->mean_diameter,
                              law->diameter_ratio * law->mean_diameter,
                              law->inverse_diameter[0], law->inverse_diameter[1]};
}

static struct normal_law constants_of(const struct gb_law_unequal *law)
{
    return (struct normal_law){.hertz = law->rod.hertz,
                               .rod = law->rod.rod,
                               .strength = law->strength,
                               .shift = law->shift};
}

double gb_law_unequal_elastic(const struct gb_law_unequal *law, double deepest, double h,
                              double *stiffness)
{
    const struct pair_size size = size_of(law);
    const double from = deepest > 0.0 ? deepest : larger(h, 0.0);
    const double x = from * size.inverse_mean, rod = law->rod.rod * size.reduced;
    const double hertz = law->rod.hertz * root(size.reduced * from);
    const double slope = x < 1.0 ? rod_slope(hertz, rod * x / (1.0 - x)) : INFINITY;
    if (stiffness) {
        *stiffness = slope;
    }
    return x < 1.0 ? on_tangent(rod_force(hertz, from, rod * size.mean, x, 0.0), slope,
                                from, deepest > 0.0 ? h : from)
                   : INFINITY;
}

/* The rod law in units of D. */
static struct gb_law_rod rod_in_mean(const struct gb_law_unequal *law)
{
    const double c = law->diameter_ratio;
    return (struct gb_law_rod){.hertz = root(c) * law->rod.hertz,
                               .rod = c * law->rod.rod,
                               .pivot = c * law->rod.pivot};
}

double gb_law_unequal_elastic_energy(const struct gb_law_unequal *law, double deepest,
                                     double h)
{
    const struct gb_law_rod rod = rod_in_mean(law);
    const double mean_diameter = law->mean_diameter;
    const double from = deepest > 0.0 ? deepest : h, x = from / mean_diameter,
                 back = from - h;
    return mean_diameter * mean_diameter * mean_diameter * gb_law_rod_energy(&rod, x) -
           mean_diameter * mean_diameter * gb_law_rod_force(&rod, x) * back +
           0.5 * mean_diameter * gb_law_rod_stiffness(&rod, x) * back * back;
}

double gb_law_unequal_radius(const struct gb_law_unequal *law, double h)
{
    return 0.5 * sqrt(law->diameter_ratio * law->mean_diameter * fmax(h, 0.0));
}

double gb_law_unequal_moment(const struct gb_law_unequal *law, double h)
{
    const struct pair_size size = size_of(law);
    const struct gb_law_slip none = {0};
    const struct slip_law constants = slip_law(&none, &law->rod);
    const double x = h * size.inverse_mean;
    if (!(h > 0.0)) {
        return 0.0;
    }
    return x < 1.0 ? unequal_contact_moment(&constants, size, h, root(size.reduced * h),
                                            moment_tail(x))
                   : INFINITY;
}

double gb_law_unequal_attraction(const struct gb_law_unequal *law, double r)
{
    const struct normal_law constants = constants_of(law);
    const struct pull pull =
        unequal_pull(&constants, size_of(law), law->mean_diameter - r);
    return pull.factor > 0.0 ? pull.factor / pull.sum : 0.0;
}

double gb_law_unequal_attraction_energy(const struct gb_law_unequal *law, double r)
{
    if (law->strength == 0.0) {
        return 0.0;
    }
    /* the integral of s/((s^2-1)^2 (s^2-o)^2) by partial fractions in s^2; s is in D, c
     * = 1-o */
    const double mean_diameter = law->mean_diameter, c = law->diameter_ratio;
    const double s = larger(r / mean_diameter, 1.0) + law->shift / mean_diameter;
    const double near = s * s - 1.0, wide = near + c;
    const double tail =
        (1.0 / near + 1.0 / wide + 2.0 / c * gb_portable_log1p(-c / wide)) / (c * c);
    return -0.5 * c * c * c * law->strength * tail -
           law->adhesion * larger(mean_diameter - r, 0.0);
}

double gb_law_unequal_equilibrium(const struct gb_law_unequal *law)
{
    if (!(law->adhesion > 0.0)) {
        return 0.0;
    }
    /* start at the larger overlap of Hertz' law: Newton's method decreases
     * monotonically from there */
    const double reduced = law->diameter_ratio * law->mean_diameter;
    double x = gb_portable_cbrt(law->adhesion / (law->rod.hertz * root(reduced)));
    double h = x * x, change = 1.0;
    for (int i = 0; i < 50 && h < law->mean_diameter && change > 1e-15; i++) {
        double slope;
        const double less =
            (gb_law_unequal_elastic(law, 0.0, h, &slope) - law->adhesion) / slope;
        change = less / h;
        h -= less;
    }
    return h;
}
