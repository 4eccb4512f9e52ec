#include "solve/loading/path/leg_end.h"

#include <math.h>

#include "base/portable.h"
#include "scene/tolerances.h"

double gb_leg_end_mean(const double stress[6], int dimension)
{
    return dimension == 3 ? (stress[0] + stress[1] + stress[2]) / 3.0
                          : 0.5 * (stress[0] + stress[2]);
}

double gb_leg_end_q(const double stress[6], int dimension)
{
    if (dimension == 2) {
        return gb_portable_hypot(stress[0] - stress[2], 2.0 * stress[4]);
    }
    const double xy = stress[0] - stress[1], yz = stress[1] - stress[2],
                 zx = stress[2] - stress[0];
    const double shear =
        stress[3] * stress[3] + stress[4] * stress[4] + stress[5] * stress[5];
    return sqrt(0.5 * (xy * xy + yz * yz + zx * zx) + 3.0 * shear);
}

bool gb_leg_end_is_stress(const struct gb_leg_end *end)
{
    return end->kind >= GB_LEG_END_PRESSURE;
}

/* Mean over the axes that strain leads. */
static double led_pressure(const struct gb_leg *leg, const double stress[6])
{
    double sum = 0.0;
    int count = 0;
    for (int k = 0; k < 3; k++) {
        const bool led =
            leg->component[k].control == GB_LEG_STRAIN && leg->component[k].value != 0.0;
        sum += led ? stress[k] : 0.0;
        count += led;
    }
    return count > 0 ? sum / count : 0.0;
}

double gb_leg_end_value(const struct gb_leg *leg, const struct gb_leg_end *end,
                        const double stress[6], const double strain[6], double density,
                        int steps, int dimension)
{
    const double p = gb_leg_end_mean(stress, dimension);
    switch (end->kind) {
    case GB_LEG_END_STEPS:
        return steps;
    case GB_LEG_END_STRAIN:
        return strain[leg->leading];
    case GB_LEG_END_DENSITY:
        return gb_portable_log(density);
    case GB_LEG_END_PRESSURE:
        return led_pressure(leg, stress);
    case GB_LEG_END_STRESS:
        return stress[end->of];
    case GB_LEG_END_MEAN:
        return p;
    case GB_LEG_END_Q:
        return gb_leg_end_q(stress, dimension);
    case GB_LEG_END_RATIO:
        return p != 0.0 ? gb_leg_end_q(stress, dimension) / p : 0.0;
    }
    return 0.0;
}

double gb_leg_end_target(const struct gb_leg_end *end)
{
    return end->kind == GB_LEG_END_DENSITY ? gb_portable_log(end->value) : end->value;
}

double gb_leg_end_tolerance(const struct gb_leg_end *end, double largest)
{
    switch (end->kind) {
    case GB_LEG_END_STEPS:
    case GB_LEG_END_STRAIN:
    case GB_LEG_END_DENSITY:
        return GB_PATH_STRAIN_TOLERANCE;
    case GB_LEG_END_RATIO:
        return GB_PATH_END_SHARE * end->value;
    default:
        return fmax(GB_PATH_END_SHARE * fabs(end->value), GB_PATH_END_SCALE * largest);
    }
}
