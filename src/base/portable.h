#ifndef GB_BASE_PORTABLE_H
#define GB_BASE_PORTABLE_H

#include <math.h>

/* Functions of the C library whose last bit a processor or a version does not change.
 * glibc has exp, log, pow, sin, cos and more twice, with fused multiply-add and without,
 * and picks by the processor; its functions of long double have one form.  Their 11 bits
 * more make the rounded result the correct one in all but some of a thousand million
 * arguments, so that other libraries agree as well.  sqrt is exact everywhere.
 *
 * They cost 50 to 200 ns: for what results depend on, outside of loops over contacts. */
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
