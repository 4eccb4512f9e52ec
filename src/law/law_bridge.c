#include "law/law_bridge.h"

#include "law/real_exact.h"

#include "law/springs.h"

double gb_law_bridge_deepest(const struct gb_law_bridge *law, double h_min, double h)
{
    return h > 0.0 ? deepest_after(law->length, larger(h_min, 0.0), h) : 0.0;
}

double gb_law_bridge_force(const struct gb_law_rod *rod, double h_min, double h)
{
    return on_tangent(gb_law_rod_force(rod, h_min), gb_law_rod_stiffness(rod, h_min),
                      h_min, h);
}

double gb_law_bridge_radius(const struct gb_law_bridge *law, double h_min, double h)
{
    const struct terms t = {.bridges = true, .printed = law->radius_current};
    return 0.5 * root(radius_square(t, law->length, h_min, h, 1.0));
}

double gb_law_bridge_peel_stress(const struct gb_law_bridge *law,
                                 const struct gb_law_rod *rod, double h)
{
    const double h_min = h + law->length;
    const double drop = gb_law_rod_force(rod, h) - gb_law_bridge_force(rod, h_min, h);
    return drop / (0.25 * M_PI * h_min);
}
