#include "pack/list/blocks.h"

#include "pack/cell/engine.h"

/* Cost of a near pair in a sweep; a far pair costs 1. */
enum { NEAR_COST = 4 };

void gb_blocks_weigh(struct gb_engine *engine)
{
    const int64_t count = engine->particles.count, blocks = gb_blocks_count(count);
    const struct gb_pair_list *near = &engine->list.near, *far = &engine->list.far;
    /* block_cost[b + 1]: cost of blocks 0 to b, as start[] counts the pairs before a slot */
    for (int64_t b = 0; b < blocks; b++) {
        const int64_t end = gb_blocks_end(count, b);
        engine->block_cost[b + 1] = NEAR_COST * near->start[end] + far->start[end];
    }
}

void gb_blocks_run(struct gb_engine *engine, gb_team_item *work, void *data)
{
    const int64_t blocks = gb_blocks_count(engine->particles.count);
    gb_team_run_costs(engine->team, blocks, engine->block_cost, work, data);
}
