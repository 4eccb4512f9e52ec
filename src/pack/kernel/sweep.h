#ifndef GB_PACK_KERNEL_SWEEP_H
#define GB_PACK_KERNEL_SWEEP_H

#include <stdbool.h>
#include <stdint.h>

struct gb_world;
struct gb_force_sums;

/* Forces and torques of a world whose list still holds; histories advance, turns are used
 * up.  Where it does not, nothing is done and the answer is false.  Pairs are computed in
 * blocks of particles, then every particle collects what the pairs left for it in the
 * order of the list: the same bits for any number of threads.
 *
 * travel   longest way since the list was built; NaN when a place is not finite */
bool gb_sweep_run(struct gb_world *world, double *travel);

/* Is every pair where it belongs in the list of the world? */
bool gb_sweep_list_holds(struct gb_world *world, double *travel);

/* Sums over particles begin .. end - 1, and those over all of them into the world. */
void gb_sweep_sum(const struct gb_world *world, int64_t begin, int64_t end,
                  struct gb_force_sums *sums);
void gb_sweep_conclude(struct gb_world *world, const struct gb_force_sums *sums);

/* Particles whose tallies, and in single precision the forces of pairs among them, are
 * summed as one: in blocks that follow from their number alone, so that the order of the
 * sums, and with it every bit, does not depend on the number of threads.  Larger blocks
 * leave fewer pairs between two of them, smaller ones more of them to share: one for
 * every thread that a world takes by itself (world.c), and then 64 of them. */
enum { GB_SWEEP_BLOCK = 2048, GB_SWEEP_BLOCK_MOST = 8192, GB_SWEEP_BLOCKS_SHARED = 64 };

static inline int64_t gb_sweep_block_size(int64_t count)
{
    int64_t size = GB_SWEEP_BLOCK;
    while (size < GB_SWEEP_BLOCK_MOST && count >= 2 * size * GB_SWEEP_BLOCKS_SHARED) {
        size *= 2;
    }
    return size;
}

/* Blocks that count particles make, and where block b begins and ends. */
static inline int64_t gb_sweep_blocks(int64_t count)
{
    const int64_t size = gb_sweep_block_size(count);
    return (count + size - 1) / size;
}

static inline int64_t gb_sweep_block_begin(int64_t count, int64_t b)
{
    return b * gb_sweep_block_size(count);
}

static inline int64_t gb_sweep_block_end(int64_t count, int64_t b)
{
    const int64_t end = gb_sweep_block_begin(count, b + 1);
    return end < count ? end : count;
}

#endif
