#ifndef GB_PACK_DIE_BED_BLOCKS_H
#define GB_PACK_DIE_BED_BLOCKS_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"

/* Consecutive particles of a bed, which one thread computes with the pairs that they are
 * the first of.  Blocks follow from the number of particles alone, not from that of the threads.
 * Larger ones have fewer pairs with a particle in another block, each of which has a row of its
 * own; smaller ones distribute better over threads: the size doubles while this many are left. */
enum { GB_BED_BLOCKS_SIZE = 128, GB_BED_BLOCKS_SIZE_MAX = 512, GB_BED_BLOCKS_LEFT = 12 };

/* Forces on the walls, and what limits the time step. */
struct gb_bed_tally {
    /* Bound of omega^2 of the modes without friction: the largest (2 k/m* + L)/3 of a contact,
     * where L is the stiffness of all contacts over the mass, summed over its two bodies.  It
     * is omega^2 of a lone pair, and what others add where they point in all directions; a
     * straight chain has 1.5 times it. */
    double stiffest;
    /* Largest closing speed times (H/m*)^2 of a listed contact, H its force over h^1.5: by it
     * the shortest collision that is under way or may begin (gb_leapfrog_impact).  Both bounds
     * are those of the pairs that the list has, which resumed runs make at the same steps. */
    double impact;
    double floor, punch; /* force on them, positive in compression */
    double side[2];      /* sum of f_x x, f_y y over the side's contacts */
    double drag;         /* of the side on the powder, along -z */
};

struct gb_bed_block {
    _Alignas(64) struct gb_bed_tally tally;
    double deviation2, fastest; /* of the last step, pack/die/bed_drift.h */
    int64_t crossings;          /* listed pairs with a second particle in another block */
};

/* A pair of two blocks adds the force on its second particle to a row of its own, its
 * crossing; the block of that particle sums those rows, in the order of the pairs. */
struct gb_bed_blocks {
    int64_t count, size; /* blocks, and particles in one */
    struct gb_bed_block *block;
    int64_t *cost;     /* of all blocks before, count + 1 */
    int64_t *crossing; /* first one of each block, count + 1 */
    int64_t *entry;    /* first one that leads into each block, count + 1 */
    int64_t room;
    int32_t *target;             /* second particle of a crossing */
    int32_t *row, *row_particle; /* by entry: the crossing, and its second particle */
};

bool gb_bed_blocks_init(struct gb_bed_blocks *blocks, int64_t particles,
                        struct gb_error *err);
void gb_bed_blocks_finish(struct gb_bed_blocks *blocks);

/* Particles in a block, of so many in all. */
int64_t gb_bed_blocks_size(int64_t particles);

/* Particles of block b: those from begin on, before end. */
int64_t gb_bed_blocks_begin(int64_t particles, int64_t b);
int64_t gb_bed_blocks_end(int64_t particles, int64_t b);

/* Room for the crossings that the blocks have counted; `crossing` follows.
 * Errors: GB_ERR_MEMORY. */
bool gb_bed_blocks_number(struct gb_bed_blocks *blocks, struct gb_error *err);

/* Entries of the crossings, whose targets are known. */
void gb_bed_blocks_enter(struct gb_bed_blocks *blocks);

#endif
