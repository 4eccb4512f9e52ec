#include "measure/cap/cap.h"

#include <math.h>

double gb_cap_depth(const struct gb_cap *cap)
{
    return cap->d + cap->p_a * tan(cap->beta);
}

double gb_cap_flattening(const struct gb_cap *cap)
{
    return 1.0 + cap->a - cap->a / cos(cap->beta);
}

double gb_cap_tangent(const struct gb_cap *cap)
{
    return cap->p_a - cap->a * gb_cap_depth(cap) * sin(cap->beta);
}

double gb_cap_end(const struct gb_cap *cap)
{
    return cap->p_a + cap->r * gb_cap_depth(cap);
}

struct gb_cap gb_cap_with_end(const struct gb_cap *cap, double p_b)
{
    struct gb_cap moved = *cap;
    moved.p_a = (p_b - cap->r * cap->d) / (1.0 + cap->r * tan(cap->beta));
    return moved;
}

double gb_cap_apex(const struct gb_cap *cap)
{
    return cap->beta > 0.0 ? -cap->d / tan(cap->beta) : -INFINITY;
}

double gb_cap_height(const struct gb_cap *cap, double p)
{
    const double depth = gb_cap_depth(cap);
    const double off = p - cap->p_a;
    if (p <= gb_cap_tangent(cap)) {
        return cap->d + p * tan(cap->beta);
    }
    if (p <= cap->p_a) {
        const double radius = cap->a * depth;
        return (1.0 - cap->a / cos(cap->beta)) * depth +
               sqrt(fmax(0.0, radius * radius - off * off));
    }
    const double reach = cap->r * depth;
    const double left = reach * reach - off * off;
    return left > 0.0 ? gb_cap_flattening(cap) / cap->r * sqrt(left) : reach - off;
}

void gb_cap_flow(const struct gb_cap *cap, double p, double q, double *volume,
                 double *shear)
{
    const double k = gb_cap_flattening(cap), off = p - cap->p_a;
    if (off > 0.0) {
        *volume = off;
        *shear = cap->r * cap->r / (k * k) * q;
    } else {
        const double slope = tan(cap->beta);
        *volume = slope * slope * off;
        *shear = q / (k * k);
    }
}
