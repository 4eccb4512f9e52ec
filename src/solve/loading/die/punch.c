#include "solve/loading/die/punch.h"

#include <math.h>

void gb_punch_begin(struct gb_punch *punch, struct gb_leapfrog *leapfrog,
                    struct gb_bed *bed, double height, double mass)
{
    bed->die.punch = true;
    bed->die.punch_position = height;
    bed->die.punch_velocity = 0.0;
    leapfrog->punch_mass = mass * gb_bed_solid_volume(bed) / (M_PI / 6.0);
    leapfrog->load = 0.0;
    gb_bed_invalidate_lists(bed);
    punch->area = M_PI * bed->die.radius * bed->die.radius;
    punch->time = 0.0;
    punch->ramp = GB_PUNCH_RISES;
    punch->work = punch->force = 0.0;
    punch->position = height;
    gb_punch_clear(punch);
}

double gb_punch_wanted(const struct gb_punch *punch, double time)
{
    const double passed = fmin(time / punch->length, 1.0);
    const double share = punch->ramp == GB_PUNCH_RISES ? passed : 1.0 - passed;
    if (punch->ramp == GB_PUNCH_OFF) {
        return 0.0;
    }
    return punch->pressure * (punch->quadratic ? share * share : share);
}

static void add_work(struct gb_punch *punch, const struct gb_bed *bed)
{
    const double position = bed->die.punch_position, force = bed->tally.punch;
    punch->work += 0.5 * (punch->force + force) * (punch->position - position);
    punch->position = position;
    punch->force = force;
}

void gb_punch_follow(struct gb_punch *punch, struct gb_leapfrog *leapfrog,
                     const struct gb_bed *bed, double height)
{
    const struct gb_bed_tally *tally = &bed->tally;
    const double volume = punch->area * height, step = leapfrog->step;
    if (bed->die.punch) {
        add_work(punch, bed);
    }
    punch->weight += step;
    punch->carried += step * tally->punch / punch->area;
    punch->wanted += step * leapfrog->load / punch->area;
    punch->floor += step * tally->floor / punch->area;
    for (int k = 0; k < 2; k++) {
        punch->side[k] += step * tally->side[k] / volume;
    }
    punch->drag += step * tally->drag;
    punch->time += step;
    leapfrog->load = gb_punch_wanted(punch, punch->time) * punch->area;
}

void gb_punch_clear(struct gb_punch *punch)
{
    punch->weight = punch->carried = punch->wanted = punch->floor = 0.0;
    punch->side[0] = punch->side[1] = punch->drag = 0.0;
}
