/* State of a bed in motion: the leapfrog step, the punch, and the surface of the powder. */
#include "solve/loading/die/die_state.h"

#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "base/alloc.h"
#include "base/portable.h"
#include "base/record.h"
#include "pack/die/bed.h"
#include "pack/die/bed_sweep.h"
#include "scene/tolerances.h"

void gb_die_state_leapfrog_init(struct gb_leapfrog *leapfrog, double safety, double given)
{
    *leapfrog = (struct gb_leapfrog){.safety = safety, .given = given, .limit = INFINITY};
}

double gb_die_state_leapfrog_critical(const struct gb_bed *bed)
{
    const double smooth = bed->tally.stiffest;
    /* k_t (1/m + R^2/I) of a spring; two across each normal, one of a lone wall's along a mode */
    const double across = bed->law.shear * (1.0 + 1.0 / bed->inertia);
    const int rubbed = bed->law.mu > 0.0 ? 2 : bed->law.mu_wall > 0.0 ? 1 : 0;
    const int springs = rubbed + (bed->welds ? 2 : 0);
    const double rough = smooth * (1.0 + springs * across);
    return sqrt(fmin(2.0 / smooth, 3.0 / rough));
}

double gb_die_state_leapfrog_impact(const struct gb_bed *bed)
{
    const double impact = bed->tally.impact;
    return impact > 0.0
               ? GB_IMPACT_SHARE * M_2_PI * 3.218 * gb_portable_pow(1.0 / impact, 0.2)
               : INFINITY;
}

/* The longest step for what no listed contact bounds. */
static double free_step(const struct gb_leapfrog *leapfrog, const struct gb_bed *bed)
{
    if (!(leapfrog->step > 0.0)) {
        return GB_FREE_STEP_MAX;
    }
    /* a particle at rest may fall by its size before it meets another */
    const double fast =
        fmax(leapfrog->fastest, sqrt(2.0 * leapfrog->gravity * bed->smallest));
    return fmin(GB_STEP_GROWTH_MAX * leapfrog->step,
                GB_STEP_TRAVEL_MAX * bed->smallest / fast);
}

static double next_step(const struct gb_leapfrog *leapfrog, const struct gb_bed *bed)
{
    if (leapfrog->given > 0.0) {
        return fmin(leapfrog->given, leapfrog->limit);
    }
    const double allowed = leapfrog->safety * fmin(gb_die_state_leapfrog_critical(bed),
                                                   gb_die_state_leapfrog_impact(bed));
    return fmin(fmin(allowed, free_step(leapfrog, bed)), leapfrog->limit);
}

/* Velocities by a step, and what holds each particle; returns a bound of the speeds. */
static double kick(const struct gb_leapfrog *leapfrog, struct gb_bed *bed, double step)
{
    const struct gb_bed_batch_kick by = {.force = (const gb_bed_row *)bed->force,
                                         .moment = (const gb_bed_row *)bed->moment,
                                         .inverse_mass = bed->inverse_mass,
                                         .inertia = bed->inertia,
                                         .step = step,
                                         .gravity = leapfrog->gravity,
                                         .drag = leapfrog->drag};
    return gb_bed_sweep_kick(bed, &by);
}

/* The first step: neither forces are known yet nor what holds the particles, which the second
 * evaluation sums over the two of each contact. */
static bool begin(struct gb_leapfrog *leapfrog, struct gb_bed *bed, struct gb_error *err)
{
    if (!gb_bed_evaluate_blocks(bed, 0.0, 0.0, err)) {
        return false;
    }
    (void)kick(leapfrog, bed, 0.0);
    if (!gb_bed_evaluate_blocks(bed, 0.0, 0.0, err)) {
        return false;
    }
    leapfrog->step = next_step(leapfrog, bed);
    return true;
}

bool gb_die_state_leapfrog_step(struct gb_leapfrog *leapfrog, struct gb_bed *bed,
                                struct gb_error *err)
{
    if (!(leapfrog->step > 0.0) && !begin(leapfrog, bed, err)) {
        return false;
    }
    const double deviation2 = gb_bed_sweep_drift(bed, leapfrog->step);
    bed->die.punch_position += leapfrog->step * bed->die.punch_velocity;
    bed->die.top += leapfrog->step * bed->die.side_velocity;
    if (!gb_bed_evaluate_blocks(bed, leapfrog->step, deviation2, err)) {
        return false;
    }
    const double next = next_step(leapfrog, bed), half = 0.5 * (leapfrog->step + next);
    leapfrog->fastest = kick(leapfrog, bed, half);
    if (leapfrog->punch_mass > 0.0) {
        bed->die.punch_velocity +=
            half * (bed->tally.punch - leapfrog->load) / leapfrog->punch_mass;
    }
    leapfrog->step = next;
    return true;
}

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
