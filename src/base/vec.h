#ifndef GB_BASE_VEC_H
#define GB_BASE_VEC_H

#include <math.h>

/* Three-vectors as plain arrays; small enough to be inlined everywhere. */

static inline double gb_vec_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline double gb_vec_length(const double a[3])
{
    return sqrt(gb_vec_dot(a, a));
}

static inline void gb_vec_cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* a += s b */
static inline void gb_vec_add(double a[3], double s, const double b[3])
{
    for (int k = 0; k < 3; k++) {
        a[k] += s * b[k];
    }
}

static inline void gb_vec_scale(double a[3], double s)
{
    for (int k = 0; k < 3; k++) {
        a[k] *= s;
    }
}

#endif
