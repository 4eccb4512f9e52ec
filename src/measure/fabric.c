#include "measure/fabric.h"

#include <math.h>

#include "base/vec.h"
#include "measure/tensor.h"
#include "pack/kernel/pair_forces.h"

struct sums {
    double weight[GB_FABRIC_KINDS];
    double tensor[GB_FABRIC_KINDS][3][3];
};

static void add(struct sums *sums, enum gb_fabric_of kind, double weight,
                const double unit[3])
{
    sums->weight[kind] += weight;
    for (int a = 0; a < 3; a++) {
        gb_vec_add(sums->tensor[kind][a], weight * unit[a], unit);
    }
}

/* Contact k of particle i. */
static void add_contact(struct sums *sums, const struct gb_world *world, int64_t i,
                        int64_t k, struct gb_pair_forces *forces)
{
    double unit[3], force[3];
    gb_world_branch_vector(world, &gb_world_pairs(world)->near, i, k, unit);
    gb_vec_scale(unit, 1.0 / gb_vec_length(unit));
    gb_pair_forces_at(forces, k, force);
    const double normal = gb_vec_dot(force, unit);
    add(sums, GB_FABRIC_ALL, 1.0, unit);
    add(sums, GB_FABRIC_FORCE, fabs(normal), unit);
    if (gb_contacts_deepest(gb_world_contacts(world), k) > 0.0) {
        add(sums, GB_FABRIC_BRIDGED, 1.0, unit);
    }
    if (normal < 0.0) {
        add(sums, GB_FABRIC_TENSION, 1.0, unit);
    }
}

static void finish(struct sums *sums, int dimension, struct gb_fabric *fabric)
{
    static const int row[6] = {0, 1, 2, 0, 0, 1}, column[6] = {0, 1, 2, 1, 2, 2};
    for (int kind = 0; kind < GB_FABRIC_KINDS; kind++) {
        for (int a = 0; a < 3; a++) { /* 0/0 is NaN: no such contact */
            gb_vec_scale(sums->tensor[kind][a], 1.0 / sums->weight[kind]);
        }
        fabric->anisotropy[kind] =
            (dimension == 3 ? 1.5 : 2.0) *
            gb_tensor_largest_deviator((const double(*)[3])sums->tensor[kind], dimension);
    }
    for (int k = 0; k < 6; k++) {
        fabric->all[k] = sums->tensor[GB_FABRIC_ALL][row[k]][column[k]];
    }
}

void gb_fabric_measure(const struct gb_world *world, struct gb_fabric *fabric)
{
    const struct gb_pair_list *pairs = &gb_world_pairs(world)->near;
    struct sums sums = {.weight = {0}};
    struct gb_pair_forces forces;
    gb_pair_forces_init(&forces, world, GB_PAIR_FORCES_NEAR);
    for (int64_t i = 0; i < gb_world_model(world)->count; i++) {
        for (int64_t k = pairs->start[i]; k < pairs->start[i + 1]; k++) {
            if (gb_contacts_touch(gb_world_contacts(world), k)) {
                add_contact(&sums, world, i, k, &forces);
            }
        }
    }
    finish(&sums, gb_world_model(world)->dimension, fabric);
}
