#include "pack/virial.h"

#include <string.h>

#include "pack/share.h"
#include "pack/simd.h"
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

/* Near pairs [begin, end) in single precision: forces and arms as the sweep left them,
 * lane by lane. */
GB_SIMD_LOOP void sum_single_loop(const struct gb_world *world, int64_t begin,
                                  int64_t end, double sum[3][3])
{
    const struct gb_contacts *contacts = &world->contacts;
    for (int a = 0; a < 3; a++) {
        const float *restrict force = world->single.push[a];
        for (int b = 0; b < 3; b++) {
            const float *restrict arm = contacts->plane[contacts->arm[b]];
            double lane[GB_LANES] = {0}, all = 0.0;
            int64_t k = begin;
            for (; k + GB_LANES <= end; k += GB_LANES) {
                for (int l = 0; l < GB_LANES; l++) {
                    lane[l] += (double)force[k + l] * (double)arm[k + l];
                }
            }
            for (; k < end; k++) {
                all += (double)force[k] * (double)arm[k];
            }
            for (int l = 0; l < GB_LANES; l++) {
                all += lane[l];
            }
            sum[a][b] += all;
        }
    }
}
GB_SIMD_WIDTHS(sum_single,
               (const struct gb_world *world, int64_t begin, int64_t end,
                double sum[3][3]),
               (world, begin, end, sum))

/* Pairs of particle i in one list or the other. */
static void sum_pairs(const struct gb_world *world, bool near, int64_t i,
                      double sum[3][3])
{
    const struct gb_pair_list *list = near ? &world->pairs.near : &world->pairs.far;
    double force[3], r[3];
    for (int64_t k = list->start[i]; k < list->start[i + 1]; k++) {
        gb_world_arm_of(world, list, i, k, r);
        (near ? gb_world_force_of : gb_world_pull_of)(world, k, force);
        add(sum, force, r);
    }
}

static void sum_part(const struct gb_world *world, int64_t begin, int64_t end,
                     double sum[3][3])
{
    const int64_t *start = world->pairs.near.start;
    if (world->in_single) {
        sum_single(world, start[begin], start[end], sum);
    }
    for (int64_t i = begin; i < end; i++) {
        if (!world->in_single) {
            sum_pairs(world, true, i, sum);
        }
        sum_pairs(world, false, i, sum);
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
