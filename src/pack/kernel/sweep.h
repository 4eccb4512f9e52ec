#ifndef GB_PACK_KERNEL_SWEEP_H
#define GB_PACK_KERNEL_SWEEP_H

#include <stdbool.h>

#include "pack/kernel/tally.h"

struct gb_engine;

enum gb_sweep_outcome {
    GB_SWEEP_DONE,
    GB_SWEEP_LIST_INVALID, /* nothing was computed: a pair is missing from the lists */
    GB_SWEEP_NOT_FINITE,   /* nothing was computed: a coordinate is not finite */
};

/* Forces and torques from lists that are still valid; contact histories advance,
 * rotation increments are set to 0.  Pairs are computed in blocks of particles, then
 * every particle adds the forces of pairs of other blocks, in the order of the list: the
 * same bits for any number of threads. */
enum gb_sweep_outcome gb_sweep_run(struct gb_engine *engine, struct gb_sweep_along along);

#endif
