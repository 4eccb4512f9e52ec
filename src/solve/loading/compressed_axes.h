#ifndef GB_SOLVE_LOADING_COMPRESSED_AXES_H
#define GB_SOLVE_LOADING_COMPRESSED_AXES_H

#include <stdbool.h>

#include "scene/model.h"

/* The axes of a periodic cell that its loading strains. */
struct gb_compressed_axes {
    bool axis[3];
    int count;
};

struct gb_compressed_axes gb_compressed_axes_of(const struct gb_model *model);

/* Mean over these axes of the normal pressures in x, y, z. */
double gb_compressed_axes_mean(const struct gb_compressed_axes *axes,
                               const double pressure[3]);

/* factor along these axes, 1 along the others. */
void gb_compressed_axes_scale(const struct gb_compressed_axes *axes, double along,
                              double factor[3]);

#endif
