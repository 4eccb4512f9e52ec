#ifndef GB_PACK_SWEEP_H
#define GB_PACK_SWEEP_H

#include <stdint.h>

struct gb_world;

/* Forces and torques of a world whose list is fresh; histories advance, turns are used
 * up.  Pairs are computed in blocks of particles, then every particle collects its own in
 * the order of the list: the same bits for any number of threads. */
void gb_sweep_run(struct gb_world *world);

/* Blocks that count particles make. */
int64_t gb_sweep_blocks(int64_t count);

#endif
