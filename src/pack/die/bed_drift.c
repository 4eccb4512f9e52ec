#include "pack/die/bed_drift.h"

#include <math.h>

#include "pack/die/bed_sweep.h"

struct motion {
    struct gb_bed *bed;
    double step;
    struct gb_bed_motion_course course; /* of the whole bed */
    struct gb_bed_motion_kick kick;
};

static int64_t particles_of(const struct gb_bed *bed, int64_t b)
{
    return gb_bed_blocks_end(bed->count, b) - gb_bed_blocks_begin(bed->count, b);
}

static void drift_block(void *data, int64_t b)
{
    const struct motion *motion = data;
    struct gb_bed *bed = motion->bed;
    const int64_t begin = gb_bed_blocks_begin(bed->count, b);
    struct gb_bed_motion_course course = motion->course;
    course.from += begin;
    course.velocity += begin;
    bed->blocks.block[b].deviation2 = gb_bed_motion_drift(
        bed->position + begin, (const gb_bed_row *)bed->velocity + begin,
        particles_of(bed, b), motion->step, &course);
}

static void kick_block(void *data, int64_t b)
{
    const struct motion *motion = data;
    struct gb_bed *bed = motion->bed;
    const int64_t begin = gb_bed_blocks_begin(bed->count, b);
    struct gb_bed_motion_kick by = motion->kick;
    gb_bed_sweep_sum_block(bed, b);
    by.force += begin;
    by.moment += begin;
    by.inverse_mass += begin;
    bed->blocks.block[b].fastest = gb_bed_motion_kick(
        bed->velocity + begin, bed->roll + begin, particles_of(bed, b), &by);
}

/* The larger one; not a number if one of them is not. */
static double larger_or_nan(double a, double b)
{
    return a > b || isnan(a) ? a : b;
}

double gb_bed_drift(struct gb_bed *bed, double step)
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

double gb_bed_drift_kick(struct gb_bed *bed, const struct gb_bed_motion_kick *by)
{
    struct motion motion = {.bed = bed, .kick = *by};
    double fastest = 0.0;
    gb_bed_run_blocks(bed, kick_block, &motion);
    for (int64_t b = 0; b < bed->blocks.count; b++) {
        fastest = larger_or_nan(bed->blocks.block[b].fastest, fastest);
    }
    return fastest;
}
