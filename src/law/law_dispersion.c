#include "law/law_dispersion.h"

#include "law/real_exact.h"

#include "law/normal.h"

void gb_law_dispersion_init(struct gb_law_dispersion *law, double n_d0_cubed,
                            double epsilon, double alpha, double d0)
{
    law->strength = M_PI * M_PI / 3.0 * n_d0_cubed * n_d0_cubed * epsilon;
    law->shift = alpha * d0;
    law->contact = law->strength > 0.0 ? gb_law_dispersion_force(law, 1.0) : 0.0;
}

double gb_law_dispersion_force(const struct gb_law_dispersion *law, double r)
{
    const struct normal_law constants = {.strength = law->strength, .shift = law->shift};
    const struct pull pull = equal_pull(&constants, r);
    return pull.factor > 0.0 ? pull.factor / pull.sum : 0.0;
}

double gb_law_dispersion_slope(const struct gb_law_dispersion *law, double r)
{
    if (r < 1.0) {
        return 0.0;
    }
    const double s = r + law->shift;
    return -gb_law_dispersion_force(law, r) * (3.0 / s + 4.0 * s / (s * s - 1.0));
}

double gb_law_dispersion_energy(const struct gb_law_dispersion *law, double r)
{
    if (law->strength == 0.0) {
        return 0.0;
    }
    /* With u = s^2 the integrand is u^-2 (u-1)^-2 / 2; its antiderivative below vanishes
     * at infinity. */
    const double s = (r < 1.0 ? 1.0 : r) + law->shift;
    const double u = s * s;
    const double tail = 1.0 / u + 1.0 / (u - 1.0) + 2.0 * gb_portable_log1p(-1.0 / u);
    const double gap = -0.5 * law->strength * tail;
    return r < 1.0 ? gap - law->contact * (1.0 - r) : gap;
}

double gb_law_dispersion_range(const struct gb_law_dispersion *law, double share)
{
    if (law->contact == 0.0) {
        return 1.0;
    }
    double near = 1.0, far = 2.0;
    while (gb_law_dispersion_force(law, far) > share * law->contact && far < 1e3) {
        far *= 2.0;
    }
    for (int i = 0; i < 60; i++) {
        const double middle = 0.5 * (near + far);
        if (gb_law_dispersion_force(law, middle) > share * law->contact) {
            near = middle;
        } else {
            far = middle;
        }
    }
    return far;
}
