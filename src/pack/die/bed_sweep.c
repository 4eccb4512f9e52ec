/* One evaluation of a bed, and its motion.
 *
 * Blocks of consecutive particles are the unit of work: each computes the pairs whose
 * first particle it holds, and its contacts with the walls.  A pair with a second particle
 * in another block adds to a row of its own (a crossing); these rows are summed afterwards.
 * Drift and kick move the particles by blocks too.  Drift returns a bound of the squared
 * deviation, kick one of the speeds. */

#include "pack/die/bed_sweep.h"

#include <math.h>
#include <string.h>

#include "base/team.h"
#include "pack/die/bed.h"
#include "pack/kernel/bed_batch.h"
#include "pack/kernel/simd.h"

/* ---- Walls ---- */

/* Overlaps with floor, punch and cylinder; the same bits as gb_die_overlap. */
GB_SIMD_LOOP void smooth_overlaps_loop(const struct gb_die *die,
                                       const int32_t *restrict walls,
                                       struct gb_bed_batch *restrict b)
{
    const double bore = die->radius, punch = die->punch_position;
    const double no_punch = die->punch ? 0.0 : -INFINITY;
    const double upper_end = die->funnel ? die->height : INFINITY;
#pragma omp simd
    for (int k = 0; k < b->n; k++) {
        const double x = b->branch[0][k], y = b->branch[1][k], z = b->branch[2][k];
        const double radius = b->reach[k], rho = sqrt(x * x + y * y);
        const double wall = walls[k]; /* as wide as the others */
        const bool side = wall == GB_DIE_SIDE, above = wall == GB_DIE_PUNCH;
        const bool round = side & (z <= upper_end), off_axis = rho > 0.0;
        const double over = off_axis ? rho : 1.0;
        const double plane = radius - (above ? punch - z : z) + (above ? no_punch : 0.0);
        const double beside = round ? rho + radius - bore : -INFINITY;
        const double overlap = side ? beside : plane;
        b->unit[0][k] = round ? (off_axis ? -x / over : -1.0) : 0.0;
        b->unit[1][k] = (round & off_axis) ? -y / over : 0.0;
        b->unit[2][k] = round ? 0.0 : above ? -1.0 : 1.0;
        b->overlap[k] = overlap > -radius ? overlap : -radius;
    }
}
GB_SIMD_WIDTHS(smooth_overlaps,
               (const struct gb_die *die, const int32_t *walls, struct gb_bed_batch *b),
               (die, walls, b))

/* The walls of other shapes, one by one. */
static void shaped_overlaps(const struct gb_die *die, const int32_t *walls,
                            struct gb_bed_batch *b)
{
    const bool ends = die->bore != GB_DIE_BORE_ENDLESS;
    for (int k = 0; k < b->n; k++) {
        const enum gb_die_wall wall = (enum gb_die_wall)walls[k];
        if (wall != GB_DIE_FUNNEL && !(ends && wall == GB_DIE_SIDE)) {
            continue;
        }
        const double x[3] = {b->branch[0][k], b->branch[1][k], b->branch[2][k]};
        double unit[3] = {0.0, 0.0, 1.0};
        b->overlap[k] =
            fmax(gb_die_overlap(die, wall, x, b->reach[k], unit), -b->reach[k]);
        for (int c = 0; c < 3; c++) {
            b->unit[c][k] = unit[c];
        }
    }
}

static void wall_geometry(const struct gb_die *die, const int32_t *walls,
                          struct gb_bed_batch *b)
{
    smooth_overlaps(die, walls, b);
    if (die->funnel || die->bore != GB_DIE_BORE_ENDLESS) {
        shaped_overlaps(die, walls, b);
    }
    for (int k = 0; k < b->n; k++) {
        b->lever[k] = 1.0 - b->overlap[k] / b->reach[k];
    }
}

static void add_side(struct gb_bed_tally *tally, const int32_t *walls,
                     const struct gb_bed_batch *b)
{
    for (int k = 0; k < b->n; k++) {
        const double side = walls[k] == GB_DIE_SIDE ? 1.0 : 0.0;
        for (int c = 0; c < 2; c++) {
            tally->side[c] -= side * (b->force[c][k] * b->branch[c][k]);
        }
    }
}

/* Gives the rows of the walls their velocities. */
static void bed_walls_move(struct gb_bed *bed)
{
    gb_bed_row *velocity = bed->velocity + bed->count;
    velocity[GB_DIE_PUNCH][2] = bed->die.punch_velocity;
    velocity[GB_DIE_SIDE][2] = bed->die.side_velocity;
}

/* Adds the forces of the contacts of a block with die, punch and funnel to its particles and
 * to its tally. */
static void bed_walls_sweep(struct gb_bed *bed, int64_t block, struct gb_bed_batch *b)
{
    const gb_bed_row *wall_force =
        (const gb_bed_row *)bed->force + gb_bed_wall_rows(bed, block);
    struct gb_bed_tally *tally = &bed->blocks.block[block].tally;
    const int64_t end = bed->walls.start[gb_bed_blocks_end(bed->count, block)];
    struct gb_bed_rows rows = {.position = (const gb_bed_row *)bed->position,
                               .velocity = (const gb_bed_row *)bed->velocity,
                               .roll = (const gb_bed_row *)bed->roll,
                               .force = bed->force,
                               .moment = bed->moment,
                               .from = (int32_t)bed->count,
                               .friction = bed->law.mu_wall > 0.0};
    b->mu = bed->law.mu_wall;
    tally->side[0] = tally->side[1] = 0.0;
    for (int64_t slot = bed->walls.start[gb_bed_blocks_begin(bed->count, block)];
         slot < end; slot += b->n) {
        b->n = end - slot < GB_BED_BATCH ? (int)(end - slot) : GB_BED_BATCH;
        rows.first = bed->walls.first + slot;
        rows.other = bed->walls.other + slot;
        rows.target = bed->walls.target + slot;
        bed->transfer.gather(&rows, b);
        wall_geometry(&bed->die, rows.other, b);
        bed->wall_kernel(&bed->law, b, &bed->walls.contacts, slot);
        bed->transfer.scatter(&rows, b);
        add_side(tally, rows.other, b);
    }
    tally->floor = 0.0 - wall_force[GB_DIE_FLOOR][2];
    tally->punch = wall_force[GB_DIE_PUNCH][2];
    tally->drag = wall_force[GB_DIE_SIDE][2];
}

/* ---- Forces ---- */

static int64_t particles_of(const struct gb_bed *bed, int64_t b)
{
    return gb_bed_blocks_end(bed->count, b) - gb_bed_blocks_begin(bed->count, b);
}

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
    bed_walls_sweep(bed, b, &batch);
    bed->blocks.block[b].tally.stiffest = batch.stiffest;
    bed->blocks.block[b].tally.impact = batch.impact;
}

static void sum_block(struct gb_bed *bed, int64_t b)
{
    const struct gb_bed_blocks *blocks = &bed->blocks;
    const int64_t crossings = gb_bed_crossing_rows(bed), entry = blocks->entry[b];
    const int64_t count = blocks->entry[b + 1] - entry;
    const int32_t *particle = blocks->row_particle + entry, *row = blocks->row + entry;
    gb_bed_batch_add_rows(bed->force, particle,
                          (const gb_bed_row *)bed->force + crossings, row, count);
    if (bed->law.mu > 0.0) {
        gb_bed_batch_add_rows(bed->moment, particle,
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
    sum_block(data, b);
}

void gb_bed_sweep_sum(struct gb_bed *bed)
{
    gb_bed_run_blocks(bed, sum_item, bed);
}

void gb_bed_sweep(struct gb_bed *bed, double step)
{
    struct sweep sweep = {bed, step};
    bed_walls_move(bed);
    gb_team_measured_begin(bed->team);
    gb_bed_run_blocks(bed, sweep_block, &sweep);
    gb_team_measured_end(bed->team);
    sum_tallies(bed);
}

/* ---- Motion ---- */

struct motion {
    struct gb_bed *bed;
    double step;
    struct gb_bed_motion_course course; /* of the whole bed */
    struct gb_bed_batch_kick kick;
};

static void drift_block(void *data, int64_t b)
{
    const struct motion *motion = data;
    struct gb_bed *bed = motion->bed;
    const int64_t begin = gb_bed_blocks_begin(bed->count, b);
    struct gb_bed_motion_course course = motion->course;
    course.from += begin;
    course.velocity += begin;
    bed->blocks.block[b].deviation2 = gb_bed_batch_drift(
        bed->position + begin, (const gb_bed_row *)bed->velocity + begin,
        particles_of(bed, b), motion->step, &course);
}

static void kick_block(void *data, int64_t b)
{
    const struct motion *motion = data;
    struct gb_bed *bed = motion->bed;
    const int64_t begin = gb_bed_blocks_begin(bed->count, b);
    struct gb_bed_batch_kick by = motion->kick;
    sum_block(bed, b);
    by.force += begin;
    by.moment += begin;
    by.inverse_mass += begin;
    bed->blocks.block[b].fastest = gb_bed_batch_kick(
        bed->velocity + begin, bed->roll + begin, particles_of(bed, b), &by);
}

/* The larger one; not a number if one of them is not. */
static double larger_or_nan(double a, double b)
{
    return a > b || isnan(a) ? a : b;
}

double gb_bed_sweep_drift(struct gb_bed *bed, double step)
{
    bed->listed_age += step;
    struct motion motion = {
        .bed = bed,
        .step = step,
        .course = {.from = (const gb_bed_row *)bed->listed_position,
                   .velocity = (const gb_bed_row *)bed->listed_velocity,
                   .time = bed->listed_age},
    };
    double deviation2 = 0.0;
    gb_bed_run_blocks(bed, drift_block, &motion);
    for (int64_t b = 0; b < bed->blocks.count; b++) {
        deviation2 = larger_or_nan(bed->blocks.block[b].deviation2, deviation2);
    }
    return deviation2;
}

double gb_bed_sweep_kick(struct gb_bed *bed, const struct gb_bed_batch_kick *by)
{
    struct motion motion = {.bed = bed, .kick = *by};
    double fastest = 0.0;
    gb_bed_run_blocks(bed, kick_block, &motion);
    for (int64_t b = 0; b < bed->blocks.count; b++) {
        fastest = larger_or_nan(bed->blocks.block[b].fastest, fastest);
    }
    return fastest;
}
