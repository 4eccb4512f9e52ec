#ifndef GB_PACK_LIST_ENGINE_BLOCKS_H
#define GB_PACK_LIST_ENGINE_BLOCKS_H

#include "base/team/team.h"

struct gb_engine;

/* After a build of the lists: what a sweep of each block costs, by its pairs. */
void gb_engine_blocks_weigh(struct gb_engine *engine);

/* work(data, b) for every block of particles.  A thread begins with the same consecutive
 * blocks in every phase of a step, so that they stay in its caches; they are as many as
 * cost its share of a sweep: a pair belongs to its first particle, and the first blocks have
 * more of them. */
void gb_engine_blocks_run(struct gb_engine *engine, gb_team_item *work, void *data);

#endif
