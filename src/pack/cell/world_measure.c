#include "pack/cell/world_measure.h"

#include <math.h>

#include "base/vec.h"
#include "pack/kernel/virial.h"
#include "scene/tolerances.h"

/* A cell that is filled to the last pore has density 1, whatever the product of its strains
 * is rounded to. */
static double without_rounding(double density)
{
    return density > 1.0 && density < 1.0 + GB_DENSITY_END_TOLERANCE ? 1.0 : density;
}

double gb_world_measure_density(const struct gb_world *world)
{
    const struct gb_model *model = gb_world_model(world);
    const double shape = model->dimension == 3 ? M_PI / 6.0 : M_PI / 4.0;
    return without_rounding(shape * model->mean_power * (double)model->count /
                            gb_cell_volume(gb_world_cell(world)));
}

void gb_world_measure_pressure(const struct gb_world *world, double pressure[3][3])
{
    gb_world_measure_tensors(world, pressure, NULL);
}

void gb_world_measure_tensors(const struct gb_world *world, double pressure[3][3],
                              struct gb_fabric_sums *fabric)
{
    const double volume = gb_cell_volume(gb_world_cell(world));
    gb_virial_sum_fabric(world, pressure, fabric);
    for (int a = 0; a < 3; a++) {
        gb_vec_scale(pressure[a], 1.0 / volume);
    }
}

void gb_world_measure_normal_pressures(const struct gb_world *world, double pressure[3])
{
    double tensor[3][3];
    gb_world_measure_pressure(world, tensor);
    for (int k = 0; k < 3; k++) {
        pressure[k] = tensor[k][k];
    }
}
