#include "law/critical_step.h"

#include <math.h>

double gb_critical_step(double frequency, double damping_ratio)
{
    const double share = sqrt(1.0 + damping_ratio * damping_ratio) - damping_ratio;
    return frequency > 0.0 ? 2.0 / frequency * share : INFINITY;
}
