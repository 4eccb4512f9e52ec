#include "pack/virial.h"

#include <string.h>

#include "pack/share.h"
#include "pack/world_private.h"

/* Sums of so many parts of the particles, added in their order: the same bits for any
 * number of threads. */
enum { PARTS = 64 };

static void add(double sum[3][3], const double force[3], const double r[3])
{
    for (int a = 0; a < 3; a++) {
        gb_vec_add(sum[a], force[a], r);
    }
}

static void sum_part(const struct gb_world *world, int64_t begin, int64_t end,
                     double sum[3][3])
{
    const struct gb_pair_list *near = &world->pairs.near, *far = &world->pairs.far;
    double force[3], r[3];
    for (int64_t i = begin; i < end; i++) {
        for (int64_t k = near->start[i]; k < near->start[i + 1]; k++) {
            gb_world_arm_of(world, near, i, k, r);
            gb_world_force_of(world, k, force);
            add(sum, force, r);
        }
        for (int64_t k = far->start[i]; k < far->start[i + 1]; k++) {
            gb_world_arm_of(world, far, i, k, r);
            gb_world_pull_of(world, k, force);
            add(sum, force, r);
        }
    }
}

void gb_virial_sum(const struct gb_world *world, double sum[3][3])
{
    double part[PARTS][3][3] = {0};
#pragma omp parallel for num_threads(world->threads)                                     \
    schedule(static) if (world->threads > 1)
    for (int p = 0; p < PARTS; p++) {
        sum_part(world, gb_share(world->count, p, PARTS),
                 gb_share(world->count, p + 1, PARTS), part[p]);
    }
    memset(sum, 0, sizeof part[0]);
    for (int p = 0; p < PARTS; p++) {
        for (int a = 0; a < 3; a++) {
            gb_vec_add(sum[a], 1.0, part[p][a]);
        }
    }
}
