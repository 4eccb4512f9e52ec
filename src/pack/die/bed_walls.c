#include "pack/die/bed_walls.h"

#include <math.h>

static void gather_walls(const struct gb_bed *bed, struct gb_bed_batch *b, int64_t slot)
{
    for (int k = 0; k < b->n; k++) {
        const int64_t i = bed->walls.first[slot + k];
        const enum gb_die_wall wall = (enum gb_die_wall)bed->walls.other[slot + k];
        const double *x = bed->position[i], radius = x[3];
        double unit[3] = {0.0, 0.0, 1.0};
        b->overlap[k] = fmax(gb_die_overlap(&bed->die, wall, x, radius, unit), -radius);
        b->lever[k] = 1.0 - b->overlap[k] / radius;
        for (int c = 0; c < 3; c++) {
            b->unit[c][k] = unit[c];
            b->slip[c][k] = bed->velocity[i][c];
            b->roll[c][k] = radius * bed->spin[i][c];
        }
        b->slip[2][k] -= wall == GB_DIE_PUNCH  ? bed->die.punch_velocity
                         : wall == GB_DIE_SIDE ? bed->die.side_velocity
                                               : 0.0;
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
    b->mu = bed->law.mu_wall;
    for (int64_t slot = 0; slot < bed->walls.count; slot += b->n) {
        const int64_t left = bed->walls.count - slot;
        b->n = left < GB_BED_BATCH ? (int)left : GB_BED_BATCH;
        gather_walls(bed, b, slot);
        bed->wall_kernel(&bed->law, b, &bed->walls.contacts, slot);
        scatter_walls(bed, b, slot, friction);
    }
}
