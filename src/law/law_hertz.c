#include "law/law_hertz.h"

#include "law/critical_step.h"
#include "law/real_exact.h"

#include "law/storakers.h"

/* Greatest contact pressure over yield stress when a sphere starts to flow; von Mises,
 * nu = 0.3.  Source: P3 (30). */
static const double pressure_over_yield = 1.61;

static double plane_compliance(const struct gb_elastic *material)
{
    return (1.0 - material->poisson * material->poisson) / material->young;
}

/* (2 - nu)/G with G = E / (2 (1 + nu)). */
static double shear_compliance(const struct gb_elastic *material)
{
    return (2.0 - material->poisson) * 2.0 * (1.0 + material->poisson) / material->young;
}

void gb_law_hertz_init(struct gb_law_hertz *law, const struct gb_elastic *i,
                       const struct gb_elastic *j)
{
    law->modulus = 1.0 / (plane_compliance(i) + plane_compliance(j));
    law->shear = 1.0 / (shear_compliance(i) + shear_compliance(j));
}

double gb_law_hertz_radius(double ri, double rj)
{
    if (isinf(rj)) {
        return ri;
    }
    return isinf(ri) ? rj : ri * rj / (ri + rj);
}

double gb_law_hertz_force(const struct gb_law_hertz *law, double radius, double h)
{
    const double factor = hertz_factor(law->modulus, root(radius));
    return h > 0.0 ? hertz_force(factor, h, root(h)) : 0.0;
}

double gb_law_hertz_stiffness(const struct gb_law_hertz *law, double radius, double h)
{
    const double factor = hertz_factor(law->modulus, root(radius));
    return h > 0.0 ? hertz_slope(factor, root(h)) : 0.0;
}

double gb_law_hertz_energy(const struct gb_law_hertz *law, double radius, double h)
{
    return 0.4 * gb_law_hertz_force(law, radius, h) * h;
}

double gb_law_hertz_overlap(const struct gb_law_hertz *law, double radius, double force)
{
    if (!(force > 0.0)) {
        return 0.0;
    }
    const double root = gb_portable_cbrt(0.75 * force / (law->modulus * sqrt(radius)));
    return root * root;
}

double gb_law_hertz_shear_stiffness(const struct gb_law_hertz *law, double radius,
                                    double h)
{
    return h > 0.0 ? 8.0 * law->shear * sqrt(radius * h) : 0.0;
}

double gb_law_hertz_yield_force(const struct gb_law_hertz *law, double radius,
                                double yield)
{
    const double pressure = M_PI * pressure_over_yield * yield;
    const double slope = radius / law->modulus;
    return pressure * pressure * pressure * slope * slope / 6.0;
}

double gb_law_hertz_damping(double stiffness, double reduced_mass, double xi)
{
    return 2.0 * xi * sqrt(reduced_mass * stiffness);
}

double gb_law_hertz_damping_borne(double damping, double stiffness, double square,
                                  double step)
{
    return smaller(damping, borne_damping(stiffness, step / GB_LAW_HERTZ_BORNE, square));
}

double gb_law_hertz_damped_force(double elastic, double damping, double approach)
{
    return damped_force(elastic, -damping * approach);
}

double gb_law_hertz_critical_step(double stiffness, double mass, double xi)
{
    return stiffness > 0.0 ? gb_critical_step(sqrt(stiffness / mass), xi) : INFINITY;
}
