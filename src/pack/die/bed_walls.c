#include "pack/die/bed_walls.h"

#include <math.h>

#include "pack/kernel/simd.h"

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

void gb_bed_walls_move(struct gb_bed *bed)
{
    gb_bed_row *velocity = bed->velocity + bed->count;
    velocity[GB_DIE_PUNCH][2] = bed->die.punch_velocity;
    velocity[GB_DIE_SIDE][2] = bed->die.side_velocity;
}

void gb_bed_walls_sweep(struct gb_bed *bed, int64_t block, struct gb_bed_batch *b)
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
