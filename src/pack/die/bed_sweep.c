#include "pack/die/bed_sweep.h"

#include <math.h>
#include <string.h>

#include "base/team/team.h"
#include "pack/die/bed_walls.h"
#include "pack/kernel/bed_motion.h"

struct sweep {
    struct gb_bed *bed;
    double step;
};

static void clear_rows(const struct gb_bed *bed, int64_t begin, int64_t end)
{
    const size_t bytes = (size_t)(end - begin) * sizeof(gb_bed_row);
    memset(bed->force + begin, 0, bytes);
    memset(bed->moment + begin, 0, bytes);
}

static void clear_block(const struct gb_bed *bed, int64_t b)
{
    const struct gb_bed_blocks *blocks = &bed->blocks;
    const int64_t walls = gb_bed_wall_rows(bed, b), crossings = gb_bed_crossing_rows(bed);
    clear_rows(bed, gb_bed_blocks_begin(bed->count, b), gb_bed_blocks_end(bed->count, b));
    clear_rows(bed, walls, walls + GB_DIE_WALLS);
    clear_rows(bed, crossings + blocks->crossing[b], crossings + blocks->crossing[b + 1]);
}

static void sweep_pairs(struct gb_bed *bed, int64_t b, struct gb_bed_batch *batch)
{
    struct gb_bed_rows rows = {.position = (const gb_bed_row *)bed->position,
                               .velocity = (const gb_bed_row *)bed->velocity,
                               .roll = (const gb_bed_row *)bed->roll,
                               .force = bed->force,
                               .moment = bed->moment,
                               .friction = bed->law.mu > 0.0};
    const int64_t end = bed->pairs.start[gb_bed_blocks_end(bed->count, b)];
    batch->mu = bed->law.mu;
    for (int64_t slot = bed->pairs.start[gb_bed_blocks_begin(bed->count, b)]; slot < end;
         slot += batch->n) {
        batch->n = end - slot < GB_BED_BATCH ? (int)(end - slot) : GB_BED_BATCH;
        rows.first = bed->pairs.first + slot;
        rows.other = bed->pairs.other + slot;
        rows.target = bed->pairs.target + slot;
        bed->transfer.gather_pairs(&rows, batch);
        bed->pair_kernel(&bed->law, batch, &bed->pairs.contacts, slot);
        bed->transfer.scatter(&rows, batch);
    }
}

static void sweep_block(void *data, int64_t b)
{
    const struct sweep *sweep = data;
    struct gb_bed *bed = sweep->bed;
    struct gb_bed_batch batch;
    batch.step = sweep->step;
    batch.stiffest = batch.impact = 0.0;
    clear_block(bed, b);
    sweep_pairs(bed, b, &batch);
    gb_bed_walls_sweep(bed, b, &batch);
    bed->blocks.block[b].tally.stiffest = batch.stiffest;
    bed->blocks.block[b].tally.impact = batch.impact;
}

void gb_bed_sweep_sum_block(struct gb_bed *bed, int64_t b)
{
    const struct gb_bed_blocks *blocks = &bed->blocks;
    const int64_t crossings = gb_bed_crossing_rows(bed), entry = blocks->entry[b];
    const int64_t count = blocks->entry[b + 1] - entry;
    const int32_t *particle = blocks->row_particle + entry, *row = blocks->row + entry;
    gb_bed_motion_add_rows(bed->force, particle,
                           (const gb_bed_row *)bed->force + crossings, row, count);
    if (bed->law.mu > 0.0) {
        gb_bed_motion_add_rows(bed->moment, particle,
                               (const gb_bed_row *)bed->moment + crossings, row, count);
    }
}

static void sum_tallies(struct gb_bed *bed)
{
    struct gb_bed_tally sum = {0};
    for (int64_t b = 0; b < bed->blocks.count; b++) {
        const struct gb_bed_tally *tally = &bed->blocks.block[b].tally;
        sum.stiffest = fmax(sum.stiffest, tally->stiffest);
        sum.impact = fmax(sum.impact, tally->impact);
        sum.floor += tally->floor;
        sum.punch += tally->punch;
        sum.side[0] += tally->side[0];
        sum.side[1] += tally->side[1];
        sum.drag += tally->drag;
    }
    bed->tally = sum;
}

static void sum_item(void *data, int64_t b)
{
    gb_bed_sweep_sum_block(data, b);
}

void gb_bed_sweep_sum(struct gb_bed *bed)
{
    gb_bed_run_blocks(bed, sum_item, bed);
}

void gb_bed_sweep(struct gb_bed *bed, double step)
{
    struct sweep sweep = {bed, step};
    gb_bed_walls_move(bed);
    gb_team_measured_begin(bed->team);
    gb_bed_run_blocks(bed, sweep_block, &sweep);
    gb_team_measured_end(bed->team);
    sum_tallies(bed);
}
