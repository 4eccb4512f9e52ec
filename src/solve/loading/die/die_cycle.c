#include "solve/loading/die/die_cycle.h"

#include <math.h>
#include <stdio.h>

#include "pack/die/bed_welds.h"
#include "scene/tolerances.h"
#include "solve/loading/die/die_sequence.h"

enum {
    EJECT_POINTS = 100, /* recorded while the compact is pushed out */
    REST_POINTS = 10    /* and in each rest */
};

/* A stage that records points. */
struct row {
    const char *ended; /* event at its end */
    /* Share of it that is done, 1 from its end on. */
    double (*share)(const struct gb_die_stages *stages, const struct gb_bed *bed);
    /* Share at which the next point is recorded; NULL: at the end only. */
    double (*interval)(const struct gb_die_stages *stages);
    enum gb_die_stages_stage next; /* in a full cycle */
    bool (*begin_next)(struct gb_die_stages *stages, struct gb_bed *bed,
                       struct gb_error *err);
};

static double ramp_share(const struct gb_die_stages *stages, const struct gb_bed *bed)
{
    (void)bed;
    return fmin(stages->now.punch.time / stages->now.punch.length, 1.0);
}

static double withdraw_share(const struct gb_die_stages *stages, const struct gb_bed *bed)
{
    const struct gb_die_progress *now = &stages->now;
    const double travel = now->height0 - now->peak;
    const double left = now->height0 - bed->die.punch_position;
    if (bed->tally.punch > 0.0) {
        return 0.0;
    }
    return left > 0.0 ? fmax(1.0 - left / travel, 0.0) : 1.0;
}

static double rest_share(const struct gb_die_stages *stages, const struct gb_bed *bed)
{
    (void)bed;
    return fmin(stages->now.stage_time / stages->scene.rest_time, 1.0);
}

static double eject_share(const struct gb_die_stages *stages, const struct gb_bed *bed)
{
    return fmin(1.0 - bed->die.top / stages->now.height0, 1.0);
}

static double rest_interval(const struct gb_die_stages *stages)
{
    (void)stages;
    return 1.0 / REST_POINTS;
}

static double eject_interval(const struct gb_die_stages *stages)
{
    (void)stages;
    return 1.0 / EJECT_POINTS;
}

static bool begin_unload(struct gb_die_stages *stages, struct gb_bed *bed,
                         struct gb_error *err)
{
    struct gb_die_progress *now = &stages->now;
    now->peak = bed->die.punch_position;
    now->punch.ramp = GB_PUNCH_FALLS;
    now->punch.time = 0.0;
    now->punch.length = stages->scene.unload_time;
    now->next_record = stages->scene.pressure - stages->scene.record;
    return gb_die_surface_take(&stages->side, bed, GB_DIE_SIDE, err) &&
           gb_die_surface_take(&stages->top, bed, GB_DIE_PUNCH, err) &&
           (!(stages->scene.weld_strength > 0.0) ||
            gb_bed_welds_form(bed, stages->scene.weld_strength, err));
}

/* From here on the punch has no mass: it keeps its speed. */
static bool begin_withdraw(struct gb_die_stages *stages, struct gb_bed *bed,
                           struct gb_error *err)
{
    struct gb_die_progress *now = &stages->now;
    (void)err;
    now->punch.ramp = GB_PUNCH_OFF;
    now->leapfrog.punch_mass = now->leapfrog.load = 0.0;
    now->leapfrog.drag = 1.0 / (GB_CYCLE_DRAG * stages->scene.rest_time);
    bed->die.punch_velocity = stages->scene.eject_speed;
    return true;
}

static bool begin_confined(struct gb_die_stages *stages, struct gb_bed *bed,
                           struct gb_error *err)
{
    (void)err;
    bed->die.punch = false;
    bed->die.punch_velocity = 0.0;
    stages->now.next_record = 1.0 / REST_POINTS;
    gb_bed_invalidate_lists(bed);
    return true;
}

static bool begin_eject(struct gb_die_stages *stages, struct gb_bed *bed,
                        struct gb_error *err)
{
    (void)err;
    bed->die.bore = GB_DIE_BORE_OPEN;
    bed->die.top = stages->now.height0;
    bed->die.side_velocity = -stages->scene.eject_speed;
    stages->now.next_record = 1.0 / EJECT_POINTS;
    gb_bed_invalidate_lists(bed);
    return true;
}

static bool begin_free(struct gb_die_stages *stages, struct gb_bed *bed,
                       struct gb_error *err)
{
    (void)err;
    bed->die.bore = GB_DIE_BORE_GONE;
    bed->die.side_velocity = 0.0;
    stages->now.next_record = 1.0 / REST_POINTS;
    gb_bed_invalidate_lists(bed);
    return true;
}

/* THE table.  Points of the ramps are due by pressure, see ramp_due. */
static const struct row rows[GB_DIE_STAGES_COUNT] = {
    [GB_DIE_STAGES_PRESS] = {"pressed", ramp_share, NULL, GB_DIE_STAGES_UNLOAD,
                             begin_unload},
    [GB_DIE_STAGES_UNLOAD] = {"unloaded", ramp_share, NULL, GB_DIE_STAGES_WITHDRAW,
                              begin_withdraw},
    [GB_DIE_STAGES_WITHDRAW] = {"punch off", withdraw_share, NULL, GB_DIE_STAGES_CONFINED,
                                begin_confined},
    [GB_DIE_STAGES_CONFINED] = {"rested in the die", rest_share, rest_interval,
                                GB_DIE_STAGES_EJECT, begin_eject},
    [GB_DIE_STAGES_EJECT] = {"ejected", eject_share, eject_interval, GB_DIE_STAGES_FREE,
                             begin_free},
    [GB_DIE_STAGES_FREE] = {"rested outside the die", rest_share, rest_interval,
                            GB_DIE_STAGES_OVER, NULL},
};

static const struct row *row_of(const struct gb_die_stages *stages)
{
    return &rows[stages->now.stage];
}

bool gb_die_cycle_contains(enum gb_die_stages_stage stage)
{
    return (int)stage >= 0 && stage < GB_DIE_STAGES_COUNT && rows[stage].share != NULL;
}

bool gb_die_cycle_presses(const struct gb_die_stages *stages)
{
    return row_of(stages)->share == ramp_share;
}

double gb_die_cycle_height(const struct gb_die_stages *stages, const struct gb_bed *bed)
{
    double axial = 0.0, radial = 0.0;
    const bool left =
        stages->now.punch.ramp != GB_PUNCH_RISES && !(bed->tally.punch > 0.0);
    if (bed->die.punch && stages->now.stage != GB_DIE_STAGES_WITHDRAW && !left) {
        return bed->die.punch_position;
    }
    if (!(stages->now.peak > 0.0)) {
        return gb_bed_top(bed);
    }
    gb_die_cycle_springback(stages, bed, &axial, &radial);
    return stages->now.peak * (1.0 + axial);
}

double gb_die_cycle_wall(const struct gb_die_stages *stages, const struct gb_bed *bed)
{
    const enum gb_die_stages_stage stage = stages->now.stage;
    if (gb_die_cycle_presses(stages)) {
        return bed->die.punch_position;
    }
    const double height = stages->now.height;
    return stage == GB_DIE_STAGES_EJECT
               ? fmax(fmin(height, bed->die.top), height / EJECT_POINTS)
               : height;
}

/* A point whenever the pressure has changed by scene.record, and at the end. */
static bool ramp_due(struct gb_die_stages *stages)
{
    struct gb_die_progress *now = &stages->now;
    const double wanted = gb_punch_wanted(&now->punch, now->punch.time);
    const double sign = now->punch.ramp == GB_PUNCH_RISES ? 1.0 : -1.0;
    if (now->punch.time >= now->punch.length) {
        return true;
    }
    if (sign * (wanted - now->next_record) < 0.0) {
        return false;
    }
    now->next_record += sign * stages->scene.record;
    return true;
}

bool gb_die_cycle_due(struct gb_die_stages *stages, const struct gb_bed *bed)
{
    struct gb_die_progress *now = &stages->now;
    const struct row *row = row_of(stages);
    if (gb_die_cycle_presses(stages)) {
        return ramp_due(stages);
    }
    const double share = row->share(stages, bed);
    if (share >= 1.0) {
        return true;
    }
    if (!row->interval || share < now->next_record) {
        return false;
    }
    now->next_record += row->interval(stages);
    return true;
}

static void write_event(const struct gb_die_stages *stages, char *text, size_t size)
{
    snprintf(text, size, "%s after %.4g us, %lld steps", row_of(stages)->ended,
             1e6 * stages->now.time * stages->scene.second_per_time,
             (long long)stages->now.steps);
}

bool gb_die_cycle_after_point(struct gb_die_stages *stages, struct gb_bed *bed,
                              char *text, size_t size, struct gb_error *err)
{
    const struct row *row = row_of(stages);
    if (gb_die_cycle_contains(stages->now.stage) && row->share(stages, bed) >= 1.0) {
        if (!stages->scene.full_cycle) {
            gb_die_sequence_enter(stages, GB_DIE_STAGES_OVER);
            return true;
        }
        write_event(stages, text, size);
        if (row->begin_next && !row->begin_next(stages, bed, err)) {
            return false;
        }
        gb_die_sequence_enter(stages, row->next);
    }
    stages->now.height = gb_die_cycle_height(stages, bed);
    return true;
}

void gb_die_cycle_springback(const struct gb_die_stages *stages, const struct gb_bed *bed,
                             double *axial, double *radial)
{
    *axial = *radial = (double)NAN;
    if (stages->now.peak > 0.0) {
        *axial = gb_die_surface_height(&stages->top, bed) / stages->now.peak - 1.0;
        *radial = gb_die_surface_radius(&stages->side, bed) / bed->die.radius - 1.0;
    }
}

double gb_die_cycle_share(const struct gb_die_stages *stages, const struct gb_bed *bed)
{
    return row_of(stages)->share(stages, bed);
}
