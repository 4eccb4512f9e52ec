#include "law/law_rod.h"

#include "law/real_exact.h"

#include "law/springs.h"

void gb_law_rod_init(struct gb_law_rod *law, double poisson)
{
    const double m = (1.0 - poisson) / ((1.0 - 2.0 * poisson) * (1.0 + poisson));
    law->hertz = 1.0 / (3.0 * (1.0 - poisson * poisson));
    law->rod = 0.25 * M_PI * m;
    law->pivot = M_PI / 3.0 * m;
}

double gb_law_rod_force(const struct gb_law_rod *law, double h)
{
    if (h <= 0.0) {
        return 0.0;
    }
    if (h >= 1.0) {
        return INFINITY;
    }
    return rod_force(law->hertz * root(h), h, law->rod, h, 0.0);
}

double gb_law_rod_stiffness(const struct gb_law_rod *law, double h)
{
    if (h <= 0.0) {
        return 0.0;
    }
    if (h >= 1.0) {
        return INFINITY;
    }
    return rod_slope(law->hertz * root(h), law->rod * h / (1.0 - h));
}

/* Integral of -(x + ln(1 - x)) from 0 to h: sum h^(k+1) / (k (k+1)), k >= 2. */
static double log_tail_integral(double h)
{
    static const double even[] = {1.0 / 6.0,   1.0 / 20.0,  1.0 / 42.0, 1.0 / 72.0,
                                  1.0 / 110.0, 1.0 / 156.0, 1.0 / 210.0};
    static const double odd[] = {1.0 / 12.0, 1.0 / 30.0,  1.0 / 56.0,
                                 1.0 / 90.0, 1.0 / 132.0, 1.0 / 182.0};
    if (h > series_border) {
        return h - 0.5 * h * h + (1.0 - h) * gb_portable_log1p(-h);
    }
    /* two independent chains for speed: curve.csv needs this for every contact */
    const double h2 = h * h;
    double a = even[6], b = odd[5];
    for (int k = 5; k >= 0; k--) {
        a = a * h2 + even[k];
    }
    for (int k = 4; k >= 0; k--) {
        b = b * h2 + odd[k];
    }
    return (a + b * h) * h2 * h;
}

double gb_law_rod_energy(const struct gb_law_rod *law, double h)
{
    if (h <= 0.0) {
        return 0.0;
    }
    if (h >= 1.0) {
        return INFINITY;
    }
    return 0.4 * law->hertz * h * h * sqrt(h) + law->rod * log_tail_integral(h);
}

double gb_law_rod_moment(const struct gb_law_rod *law, double h)
{
    if (h <= 0.0) {
        return 0.0;
    }
    if (h >= 1.0) {
        return INFINITY;
    }
    /* a^4 = h^2/16, so (pi/2) a^4/(1-nu^2) = (3 pi/32) hertz h^2; a/d + (4/3) a^3/d^3 =
     * s/2 + s^3/6 with s = 2a = sqrt(h). */
    const struct gb_law_slip none = {0};
    const struct slip_law constants = slip_law(&none, law);
    return contact_moment(&constants, h, root(h), moment_tail(h));
}
