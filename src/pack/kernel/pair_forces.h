#ifndef GB_PACK_KERNEL_PAIR_FORCES_H
#define GB_PACK_KERNEL_PAIR_FORCES_H

#include <stdbool.h>
#include <stdint.h>

#include "pack/kernel/batch/batch.h"

struct gb_pair_list;
struct gb_world;

enum gb_pair_forces_list { GB_PAIR_FORCES_NEAR, GB_PAIR_FORCES_FAR };

/* Forces of the pairs of a list on their first particles (E d^2), as of the last
 * evaluation.  A world in single precision does not store them: they are computed again
 * from the contact records, many pairs at a time, which is fast for ascending slots. */
struct gb_pair_forces {
    const struct gb_world *world;
    const struct gb_pair_list *list;
    int64_t slot; /* first of `count` computed pairs */
    int count;
    double force[3][GB_BATCH];
};

/* Positions and cell must not change while the forces are read. */
void gb_pair_forces_init(struct gb_pair_forces *forces, const struct gb_world *world,
                         enum gb_pair_forces_list list);

/* Force of pair k. */
void gb_pair_forces_at(struct gb_pair_forces *forces, int64_t k, double force[3]);

#endif
