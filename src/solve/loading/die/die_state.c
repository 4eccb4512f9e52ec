#include "solve/loading/die/die_state.h"

#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "base/alloc.h"
#include "base/portable.h"
#include "base/record.h"
#include "pack/die/bed.h"
#include "solve/leapfrog.h"

void gb_die_state_punch_begin(struct gb_punch *punch, struct gb_leapfrog *leapfrog,
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
    gb_die_state_punch_clear(punch);
}

double gb_die_state_punch_wanted(const struct gb_punch *punch, double time)
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

void gb_die_state_punch_follow(struct gb_punch *punch, struct gb_leapfrog *leapfrog,
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
    leapfrog->load = gb_die_state_punch_wanted(punch, punch->time) * punch->area;
}

void gb_die_state_punch_clear(struct gb_punch *punch)
{
    punch->weight = punch->carried = punch->wanted = punch->floor = 0.0;
    punch->side[0] = punch->side[1] = punch->drag = 0.0;
}

void gb_die_state_surface_finish(struct gb_die_surface *surface)
{
    gb_alloc_free(surface->particle);
    gb_alloc_free(surface->value);
    *surface = (struct gb_die_surface){0};
}

static bool allocate(struct gb_die_surface *surface, int64_t count, struct gb_error *err)
{
    const size_t size = (size_t)count + 1;
    gb_die_state_surface_finish(surface);
    surface->particle = gb_alloc_array(size, sizeof *surface->particle, err);
    surface->value = gb_alloc_array(size, sizeof *surface->value, err);
    return surface->particle && surface->value;
}

static bool touches(const struct gb_bed *bed, int64_t slot, enum gb_die_wall wall)
{
    return bed->walls.other[slot] == (int32_t)wall &&
           bed->walls.contacts.normal[slot] > 0.0;
}

bool gb_die_state_surface_take(struct gb_die_surface *surface, const struct gb_bed *bed,
                               enum gb_die_wall wall, struct gb_error *err)
{
    int64_t count = 0;
    for (int64_t slot = 0; slot < bed->walls.count; slot++) {
        count += touches(bed, slot, wall);
    }
    if (!allocate(surface, count, err)) {
        return false;
    }
    for (int64_t slot = 0; slot < bed->walls.count; slot++) {
        if (touches(bed, slot, wall)) {
            surface->particle[surface->count++] = bed->walls.first[slot];
        }
    }
    return true;
}

static double median(const struct gb_die_surface *surface)
{
    const size_t count = (size_t)surface->count;
    if (count == 0) {
        return (double)NAN;
    }
    gsl_sort(surface->value, 1, count);
    return gsl_stats_median_from_sorted_data(surface->value, 1, count);
}

double gb_die_state_surface_height(const struct gb_die_surface *surface,
                                   const struct gb_bed *bed)
{
    for (int64_t k = 0; k < surface->count; k++) {
        const double *x = bed->position[surface->particle[k]];
        surface->value[k] = x[2] + x[3];
    }
    return median(surface);
}

double gb_die_state_surface_radius(const struct gb_die_surface *surface,
                                   const struct gb_bed *bed)
{
    for (int64_t k = 0; k < surface->count; k++) {
        const double *x = bed->position[surface->particle[k]];
        surface->value[k] = gb_portable_hypot(x[0], x[1]) + x[3];
    }
    return median(surface);
}

bool gb_die_state_surface_record(struct gb_die_surface *surface, const char *name,
                                 int64_t particles, struct gb_record *record,
                                 struct gb_error *err)
{
    if (record->loading) {
        int64_t count = 0;
        gb_die_state_surface_finish(surface);
        if (!gb_record_find(record, name)) {
            return true;
        }
        if (!gb_record_rows(record, name, GB_RECORD_INT32, 1, &count, err) ||
            !allocate(surface, count, err)) {
            return false;
        }
        surface->count = count;
    }
    if (surface->count > 0 &&
        !gb_record_array(record, name, GB_RECORD_INT32, surface->count, 1, "1",
                         surface->particle, err)) {
        return false;
    }
    for (int64_t k = 0; k < surface->count; k++) {
        if (surface->particle[k] < 0 || surface->particle[k] >= particles) {
            return gb_error_set(err, GB_ERR_INPUT, "%s: is out of range", name);
        }
    }
    return true;
}
