#include "pack/die/bed_walls.h"

#include <math.h>

#include "pack/kernel/simd.h"

/* Particles and walls of a batch. */
struct near_walls {
    _Alignas(64) double x[3][GB_BED_BATCH], radius[GB_BED_BATCH];
    double wall[GB_BED_BATCH]; /* enum gb_die_wall */
};

static void gather_walls(const struct gb_bed *bed, struct gb_bed_batch *b,
                         struct near_walls *near, int64_t slot)
{
    const double speed[GB_DIE_WALLS] = {
        [GB_DIE_PUNCH] = bed->die.punch_velocity, [GB_DIE_SIDE] = bed->die.side_velocity};
    for (int k = 0; k < b->n; k++) {
        const int64_t i = bed->walls.first[slot + k];
        const int32_t wall = bed->walls.other[slot + k];
        const double *x = bed->position[i], radius = x[3];
        near->radius[k] = radius;
        near->wall[k] = wall;
        for (int c = 0; c < 3; c++) {
            near->x[c][k] = x[c];
            b->slip[c][k] = bed->velocity[i][c];
            b->roll[c][k] = radius * bed->spin[i][c];
        }
        b->slip[2][k] -= speed[wall];
    }
}

/* Overlaps with floor, punch and cylinder; the same bits as gb_die_overlap. */
GB_SIMD_LOOP void smooth_overlaps_loop(const struct gb_die *die,
                                       const struct near_walls *near,
                                       struct gb_bed_batch *b)
{
    const double bore = die->radius, punch = die->punch_position;
    const double no_punch = die->punch ? 0.0 : -INFINITY;
    const double upper_end = die->funnel ? die->height : INFINITY;
#pragma omp simd
    for (int k = 0; k < b->n; k++) {
        const double x = near->x[0][k], y = near->x[1][k], z = near->x[2][k];
        const double radius = near->radius[k], rho = sqrt(x * x + y * y);
        const bool side = near->wall[k] == GB_DIE_SIDE;
        const bool above = near->wall[k] == GB_DIE_PUNCH;
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
               (const struct gb_die *die, const struct near_walls *near,
                struct gb_bed_batch *b),
               (die, near, b))

/* The walls of other shapes, one by one. */
static void shaped_overlaps(const struct gb_die *die, const struct near_walls *near,
                            struct gb_bed_batch *b)
{
    const bool ends = die->bore != GB_DIE_BORE_ENDLESS;
    for (int k = 0; k < b->n; k++) {
        const enum gb_die_wall wall = (enum gb_die_wall)near->wall[k];
        if (wall != GB_DIE_FUNNEL && !(ends && wall == GB_DIE_SIDE)) {
            continue;
        }
        const double x[3] = {near->x[0][k], near->x[1][k], near->x[2][k]};
        double unit[3] = {0.0, 0.0, 1.0};
        b->overlap[k] =
            fmax(gb_die_overlap(die, wall, x, near->radius[k], unit), -near->radius[k]);
        for (int c = 0; c < 3; c++) {
            b->unit[c][k] = unit[c];
        }
    }
}

static void wall_geometry(const struct gb_die *die, const struct near_walls *near,
                          struct gb_bed_batch *b)
{
    smooth_overlaps(die, near, b);
    if (die->funnel || die->bore != GB_DIE_BORE_ENDLESS) {
        shaped_overlaps(die, near, b);
    }
    for (int k = 0; k < b->n; k++) {
        b->lever[k] = 1.0 - b->overlap[k] / near->radius[k];
    }
}

static void add_wall_force(struct gb_bed_tally *tally, enum gb_die_wall wall,
                           const double x[3], const double force[3])
{
    switch (wall) {
    case GB_DIE_FLOOR:
        tally->floor += force[2];
        break;
    case GB_DIE_PUNCH:
        tally->punch -= force[2];
        break;
    case GB_DIE_SIDE:
        tally->side[0] -= force[0] * x[0];
        tally->side[1] -= force[1] * x[1];
        tally->drag -= force[2];
        break;
    case GB_DIE_FUNNEL:
    case GB_DIE_WALLS:
        break;
    }
}

static void scatter_walls(struct gb_bed *bed, const struct gb_bed_batch *b, int64_t slot,
                          bool friction)
{
    for (int k = 0; k < b->n; k++) {
        const int64_t i = bed->walls.first[slot + k];
        const double force[3] = {b->force[0][k], b->force[1][k], b->force[2][k]};
        add_wall_force(&bed->tally, (enum gb_die_wall)bed->walls.other[slot + k],
                       bed->position[i], force);
        for (int c = 0; c < 3; c++) {
            bed->force[i][c] += force[c];
            bed->torque[i][c] += friction ? bed->position[i][3] * b->moment[c][k] : 0.0;
        }
    }
}

void gb_bed_walls_sweep(struct gb_bed *bed, struct gb_bed_batch *b)
{
    const bool friction = bed->law.mu_wall > 0.0;
    struct near_walls near;
    b->mu = bed->law.mu_wall;
    for (int64_t slot = 0; slot < bed->walls.count; slot += b->n) {
        const int64_t left = bed->walls.count - slot;
        b->n = left < GB_BED_BATCH ? (int)left : GB_BED_BATCH;
        gather_walls(bed, b, &near, slot);
        wall_geometry(&bed->die, &near, b);
        bed->wall_kernel(&bed->law, b, &bed->walls.contacts, slot);
        scatter_walls(bed, b, slot, friction);
    }
}
