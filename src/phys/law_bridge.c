#include "phys/law_bridge.h"

#include <math.h>

double gb_law_bridge_deepest(const struct gb_law_bridge *law, double h_min, double h)
{
    if (h <= 0.0) {
        return 0.0;
    }
    if (h_min <= 0.0) {
        return h > law->length ? h : 0.0;
    }
    if (h >= h_min) {
        return h;
    }
    return h_min - h > law->length ? h + law->length : h_min;
}

double gb_law_bridge_force(const struct gb_law_rod *rod, double h_min, double h)
{
    return gb_law_rod_force(rod, h_min) - gb_law_rod_stiffness(rod, h_min) * (h_min - h);
}

double gb_law_bridge_radius(const struct gb_law_bridge *law, double h_min, double h)
{
    return 0.5 * sqrt(law->radius_current ? h + law->length : h_min);
}

double gb_law_bridge_peel_stress(const struct gb_law_bridge *law,
                                 const struct gb_law_rod *rod, double h)
{
    const double h_min = h + law->length;
    const double drop = gb_law_rod_force(rod, h) - gb_law_bridge_force(rod, h_min, h);
    return drop / (0.25 * M_PI * h_min);
}
