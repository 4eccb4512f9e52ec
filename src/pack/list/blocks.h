#ifndef GB_PACK_LIST_BLOCKS_H
#define GB_PACK_LIST_BLOCKS_H

#include <stdint.h>

/* Blocks of consecutive particles.  Tallies, and in single precision the forces of pairs
 * inside a block, are summed block by block.  The partition follows from the number of
 * particles alone, so the order of the sums, and with it every bit, does not depend on
 * the number of threads.  Larger blocks leave fewer pairs between two blocks; smaller
 * ones distribute better over threads: one block for every automatic thread (world.c),
 * then 64 in all before their size doubles. */
enum { GB_BLOCKS_SIZE = 512, GB_BLOCKS_SIZE_MAX = 8192, GB_BLOCKS_SHARED = 64 };

/* Particles that are worth a thread of their own, in work of which every particle is by itself. */
enum { GB_BLOCKS_GRAIN = 64 };

/* Particles in a block, of `count` in all. */
static inline int64_t gb_blocks_size(int64_t count)
{
    int64_t size = GB_BLOCKS_SIZE;
    while (size < GB_BLOCKS_SIZE_MAX && count >= 2 * size * GB_BLOCKS_SHARED) {
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

#endif
