#include "law/law_slip.h"

#include <math.h>

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

double gb_law_slip_shear_cap(const struct gb_law_slip *law, const struct gb_law_rod *rod,
                             double h)
{
    const double area = 0.25 * M_PI * fmax(h, 0.0);
    return fmin(law->mu * gb_law_rod_force(rod, h), area * law->strength);
}

double gb_law_slip_pivot_cap(const struct gb_law_slip *law, const struct gb_law_rod *rod,
                             double h)
{
    const double a = 0.5 * sqrt(fmax(h, 0.0));
    return fmin(law->mu_pivot * gb_law_rod_moment(rod, h),
                gb_law_slip_bridge_pivot_cap(law, a));
}
