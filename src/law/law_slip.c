#include "law/law_slip.h"

#include "law/real_exact.h"

#include "law/springs.h"

void gb_law_slip_init(struct gb_law_slip *law, double poisson, double mu, double mu_pivot,
                      double strength, double motion)
{
    law->shear = 4.0 / ((2.0 - poisson) * (1.0 + poisson));
    law->pivot = 8.0 / (3.0 * (1.0 + poisson));
    law->roll = 4.0 / (3.0 * (1.0 - poisson * poisson));
    law->mu = mu;
    law->mu_pivot = mu_pivot;
    law->strength = strength;
    law->motion = motion;
}

double gb_law_slip_shear_stiffness(const struct gb_law_slip *law, double a)
{
    return shear_stiffness(law->shear, a);
}

double gb_law_slip_pivot_stiffness(const struct gb_law_slip *law, double a)
{
    return pivot_stiffness(law->pivot, a * a, a);
}

double gb_law_slip_roll_stiffness(const struct gb_law_slip *law, double a)
{
    return roll_stiffness(law->roll, a * a, a);
}

/* Constants of the caps; M(a) comes from the rod law. */
static struct slip_law constants_of(const struct gb_law_slip *law)
{
    const struct gb_law_rod none = {0};
    return slip_law(law, &none);
}

double gb_law_slip_bridge_shear_cap(const struct gb_law_slip *law, double a)
{
    const struct slip_law slip = constants_of(law);
    return shear_cap(&slip, true, a * a, 0.0);
}

double gb_law_slip_bridge_pivot_cap(const struct gb_law_slip *law, double a)
{
    const struct slip_law slip = constants_of(law);
    return pivot_cap(&slip, true, a * a, a, 0.0);
}

double gb_law_slip_roll_cap(double a, double force)
{
    return roll_cap(a, force);
}

double gb_law_slip_shear_cap(const struct gb_law_slip *law, const struct gb_law_rod *rod,
                             double h)
{
    const struct slip_law slip = constants_of(law);
    return shear_cap(&slip, false, 0.25 * larger(h, 0.0), gb_law_rod_force(rod, h));
}

double gb_law_slip_pivot_cap(const struct gb_law_slip *law, const struct gb_law_rod *rod,
                             double h)
{
    const struct slip_law slip = constants_of(law);
    const double a2 = 0.25 * larger(h, 0.0);
    return pivot_cap(&slip, false, a2, root(a2), gb_law_rod_moment(rod, h));
}
