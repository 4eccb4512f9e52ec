#ifndef GB_PACK_LIST_BLOCKS_H
#define GB_PACK_LIST_BLOCKS_H

#include <stdint.h>

#include "base/team.h"

struct gb_engine;

/* Blocks of consecutive particles.  Tallies, and in single precision the forces of pairs
 * inside a block, are summed block by block.  The partition follows from the number of
 * particles alone, so the order of the sums, and with it every bit, does not depend on
 * the number of threads.  Larger blocks leave fewer pairs between two blocks;
 * smaller ones distribute better over threads.  A block has at least 512 particles, so that
 * every automatic thread has one (world.c).  The size doubles, up to 8192, as long as 64
 * blocks remain. */
enum { GB_BLOCKS_SIZE = 512, GB_BLOCKS_SIZE_MAX = 8192, GB_BLOCKS_COUNT_MIN = 64 };

/* Fewest particles that are worth a thread, in work on independent particles. */
enum { GB_BLOCKS_GRAIN = 64 };

/* Particles in a block, of `count` in all. */
static inline int64_t gb_blocks_size(int64_t count)
{
    int64_t size = GB_BLOCKS_SIZE;
    while (size < GB_BLOCKS_SIZE_MAX && count >= 2 * size * GB_BLOCKS_COUNT_MIN) {
        size *= 2;
    }
    return size;
}

static inline int64_t gb_blocks_count(int64_t count)
{
    const int64_t size = gb_blocks_size(count);
    return (count + size - 1) / size;
}

/* First particle of block b, and one past its last. */
static inline int64_t gb_blocks_begin(int64_t count, int64_t b)
{
    return b * gb_blocks_size(count);
}

static inline int64_t gb_blocks_end(int64_t count, int64_t b)
{
    const int64_t end = gb_blocks_begin(count, b + 1);
    return end < count ? end : count;
}

/* After a build of the lists: notes what a sweep of each block costs, by its pairs. */
void gb_blocks_weigh(struct gb_engine *engine);

/* work(data, b) for every block of particles.  A thread begins with the same consecutive
 * blocks in every phase of a step, so that they stay in its caches.  It gets as many as cost
 * its share of a sweep: a pair belongs to its first particle, so that the first blocks have
 * more of them. */
void gb_blocks_run(struct gb_engine *engine, gb_team_item *work, void *data);

#endif
