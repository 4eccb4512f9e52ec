#ifndef GB_BASE_DEFORMATION_H
#define GB_BASE_DEFORMATION_H

#include <stdbool.h>

/* Deformation gradient F of a step: x' = F x for positions and cell vectors. */
struct gb_deformation {
    double f[3][3];
};

/* F that scales each axis by its factor. */
struct gb_deformation gb_deformation_scaling(const double factor[3]);
/* True if F is diagonal. */
bool gb_deformation_is_scaling(const struct gb_deformation *deformation);

#endif
