#ifndef GB_BASE_MAT_H
#define GB_BASE_MAT_H

#include "base/vec.h"

/* 3x3 matrices as arrays of three rows. */

/* out = a x; out must not be x */
static inline void gb_mat_apply(const double a[3][3], const double x[3], double out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = gb_vec_dot(a[k], x);
    }
}

/* out = a b; out must be neither a nor b */
static inline void gb_mat_product(const double a[3][3], const double b[3][3],
                                  double out[3][3])
{
    for (int k = 0; k < 3; k++) {
        for (int l = 0; l < 3; l++) {
            out[k][l] = a[k][0] * b[0][l] + a[k][1] * b[1][l] + a[k][2] * b[2][l];
        }
    }
}

static inline double gb_mat_determinant(const double a[3][3])
{
    double cross[3];
    gb_vec_cross(a[1], a[2], cross);
    return gb_vec_dot(a[0], cross);
}

/* Inverse of a regular matrix. */
static inline void gb_mat_inverse(const double a[3][3], double out[3][3])
{
    const double scale = 1.0 / gb_mat_determinant(a);
    double column[3];
    for (int k = 0; k < 3; k++) {
        gb_vec_cross(a[(k + 1) % 3], a[(k + 2) % 3], column);
        for (int l = 0; l < 3; l++) {
            out[l][k] = scale * column[l];
        }
    }
}

#endif
