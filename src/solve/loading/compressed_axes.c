#include "solve/loading/compressed_axes.h"

struct gb_compressed_axes gb_compressed_axes_of(const struct gb_model *model)
{
    struct gb_compressed_axes axes = {
        .axis = {model->geometry == GB_GEOMETRY_ISOTROPIC,
                 model->dimension == 3 && model->geometry != GB_GEOMETRY_UNIAXIAL, true}};
    for (int k = 0; k < 3; k++) {
        axes.count += axes.axis[k];
    }
    return axes;
}

double gb_compressed_axes_mean(const struct gb_compressed_axes *axes,
                               const double pressure[3])
{
    double sum = 0.0;
    for (int k = 0; k < 3; k++) {
        sum += axes->axis[k] ? pressure[k] : 0.0;
    }
    return sum / axes->count;
}

void gb_compressed_axes_scale(const struct gb_compressed_axes *axes, double along,
                              double factor[3])
{
    for (int k = 0; k < 3; k++) {
        factor[k] = axes->axis[k] ? along : 1.0;
    }
}
