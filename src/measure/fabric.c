#include "measure/fabric.h"

#include "measure/tensor.h"
#include "pack/cell/world.h"

/* Sum over weight; NaN without a weight. */
static void mean_tensor(const struct gb_fabric_sums *sums, int kind, double tensor[3][3])
{
    static const int component[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
    for (int a = 0; a < 9; a++) {
        tensor[a / 3][a % 3] =
            sums->tensor[kind][component[a / 3][a % 3]] / sums->weight[kind];
    }
}

void gb_fabric_measure(const struct gb_world *world, double pressure[3][3],
                       struct gb_fabric *fabric)
{
    const int dimension = gb_world_model(world)->dimension;
    struct gb_fabric_sums sums = {.weight = {0}};
    gb_world_tensors(world, pressure, &sums);
    for (int kind = 0; kind < GB_FABRIC_KINDS; kind++) {
        double tensor[3][3];
        mean_tensor(&sums, kind, tensor);
        fabric->anisotropy[kind] =
            (dimension == 3 ? 1.5 : 2.0) *
            gb_tensor_largest_deviator((const double(*)[3])tensor, dimension);
    }
    for (int k = 0; k < 6; k++) {
        fabric->all[k] = sums.tensor[GB_FABRIC_ALL][k] / sums.weight[GB_FABRIC_ALL];
    }
}
