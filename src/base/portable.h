#ifndef GB_BASE_PORTABLE_H
#define GB_BASE_PORTABLE_H

#include <math.h>

/* Functions of the C library with results that do not depend on the processor or the
 * version of the library. glibc has two versions of exp, log, pow, sin, cos and others,
 * with and without fused multiply-add, and chooses by the processor.  Its long double
 * functions have one version.  Their 11 extra bits make the rounded result correct
 * except for a few arguments in a thousand million, so other libraries agree as well.
 * sqrt is exact everywhere.
 *
 * They take 50 to 200 ns.  Use them for values that affect results, outside loops over
 * contacts. */
static inline double gb_portable_exp(double x)
{
    return (double)expl((long double)x);
}

static inline double gb_portable_log(double x)
{
    return (double)logl((long double)x);
}

static inline double gb_portable_log1p(double x)
{
    return (double)log1pl((long double)x);
}

static inline double gb_portable_pow(double x, double y)
{
    return (double)powl((long double)x, (long double)y);
}

static inline double gb_portable_cbrt(double x)
{
    return (double)cbrtl((long double)x);
}

static inline double gb_portable_sin(double x)
{
    return (double)sinl((long double)x);
}

static inline double gb_portable_cos(double x)
{
    return (double)cosl((long double)x);
}

static inline double gb_portable_hypot(double x, double y)
{
    return (double)hypotl((long double)x, (long double)y);
}

#endif
