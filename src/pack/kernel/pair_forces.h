#ifndef GB_PACK_KERNEL_PAIR_FORCES_H
#define GB_PACK_KERNEL_PAIR_FORCES_H

#include <stdbool.h>
#include <stdint.h>

#include "pack/kernel/batch.h"

struct gb_world;

/* Forces of the pairs of a list on their first particles (E d^2), as of the last
 * evaluation.  A world in single precision keeps none: they follow from histories and
 * arms, of many pairs at a time, so that pairs are best asked for in their order. */
struct gb_pair_forces {
    const struct gb_world *world;
    bool near;
    int64_t slot; /* those of `count` pairs from here on are here */
    int count;
    double force[3][GB_BATCH];
};

/* near: of that list, else of `far`.  The world must neither move nor be strained as long
 * as they are asked for. */
void gb_pair_forces_init(struct gb_pair_forces *forces, const struct gb_world *world,
                         bool near);

/* Of pair k. */
void gb_pair_forces_at(struct gb_pair_forces *forces, int64_t k, double force[3]);

#endif
