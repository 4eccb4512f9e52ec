#include "law/critical_step.h"

#include <math.h>

double gb_critical_step_share(double damping_ratio)
{
    return sqrt(1.0 + damping_ratio * damping_ratio) - damping_ratio;
}

double gb_critical_step(double frequency, double damping_ratio)
{
    return frequency > 0.0 ? 2.0 / frequency * gb_critical_step_share(damping_ratio)
                           : INFINITY;
}
