#include "base/deformation.h"

struct gb_deformation gb_deformation_scaling(const double factor[3])
{
    struct gb_deformation deformation = {{{0.0}}};
    for (int k = 0; k < 3; k++) {
        deformation.f[k][k] = factor[k];
    }
    return deformation;
}

bool gb_deformation_is_scaling(const struct gb_deformation *deformation)
{
    for (int k = 0; k < 9; k++) {
        if (k / 3 != k % 3 && deformation->f[k / 3][k % 3] != 0.0) {
            return false;
        }
    }
    return true;
}
