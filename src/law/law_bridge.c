#include "law/law_bridge.h"

#include <math.h>

double gb_law_bridge_force(const struct gb_law_rod *rod, double h_min, double h)
{
    return gb_law_rod_force(rod, h_min) - gb_law_rod_stiffness(rod, h_min) * (h_min - h);
}

double gb_law_bridge_peel_stress(const struct gb_law_bridge *law,
                                 const struct gb_law_rod *rod, double h)
{
    const double h_min = h + law->length;
    const double drop = gb_law_rod_force(rod, h) - gb_law_bridge_force(rod, h_min, h);
    return drop / (0.25 * M_PI * h_min);
}
