#include "scene/size/gaussian.h"

#include <math.h>

static const long double half_root = 0.70710678118654752440L; /* 1/sqrt 2 */

static long double above(long double z)
{
    return 0.5L * erfcl(z * half_root);
}

double gb_gaussian_below(double z)
{
    return (double)above(-(long double)z);
}

double gb_gaussian_above(double z)
{
    return (double)above((long double)z);
}

/* Source of the first guess: Abramowitz and Stegun, 26.2.23, error below 4.5e-4; of the
 * rest: Halley's method, which triples the digits. */
double gb_gaussian_quantile_above(double p)
{
    enum { STEPS = 3 };
    if (!(p > 0.0) || !(p < 1.0)) {
        return p >= 1.0 ? -INFINITY : p == 0.0 ? INFINITY : (double)NAN;
    }
    if (p > 0.5) { /* exact: 1 - p has no more digits than p */
        return -gb_gaussian_quantile_above(1.0 - p);
    }
    const long double t = sqrtl(-2.0L * logl((long double)p));
    long double z = t - (2.515517L + t * (0.802853L + t * 0.010328L)) /
                            (1.0L + t * (1.432788L + t * (0.189269L + t * 0.001308L)));
    for (int k = 0; k < STEPS; k++) {
        const long double density =
            0.39894228040143267794L * expl(-0.5L * z * z); /* 1/sqrt(2 pi) */
        const long double step = (above(z) - (long double)p) / density;
        z += step / (1.0L - 0.5L * z * step);
    }
    return (double)z;
}

double gb_gaussian_quantile_below(double p)
{
    return -gb_gaussian_quantile_above(p);
}
