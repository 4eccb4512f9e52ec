#include "solve/loading/die/die_measure.h"

#include <math.h>

#include "solve/loading/die/die_cycle.h"

static void set(struct gb_stage_report *report, enum gb_stage_measure measure,
                double value, double goal, double share)
{
    report->measure = measure;
    report->value = value;
    report->goal = goal;
    report->share = fmin(fmax(share, 0.0), 1.0);
}

/* The measure that is further from rest; while checks and the highest particle are waited
 * for, the energy. */
static void set_rest(const struct gb_die_stages *stages, const struct gb_bed *bed,
                     struct gb_stage_report *report)
{
    const struct gb_die_cycle_rest_state rest = gb_die_cycle_rest_state(stages, bed);
    const double kinetic = rest.kinetic / rest.kinetic_limit;
    const double unbalanced = rest.unbalanced / rest.unbalanced_limit;
    const bool forces = kinetic < 1.0 && unbalanced > 1.0 && isfinite(unbalanced);
    set(report, forces ? GB_STAGE_MEASURE_UNBALANCED : GB_STAGE_MEASURE_KINETIC,
        forces ? unbalanced : kinetic, 1.0, stages->now.rest_share);
}

/* One function a stage. */

static void pour(const struct gb_die_stages *stages, const struct gb_bed *bed,
                 struct gb_stage_report *report)
{
    if (report->poured < bed->count) {
        report->stage = GB_STAGE_FILLING;
        set(report, GB_STAGE_MEASURE_POURED, (double)report->poured, (double)bed->count,
            (double)report->poured / (double)bed->count);
        return;
    }
    report->stage = GB_STAGE_SETTLING;
    set_rest(stages, bed, report);
}

/* Coming to rest is three stages: under the gravity of flattening, while it falls, after
 * that.  By their shares of time steps. */
static void set_resting(const struct gb_die_stages *stages, const struct gb_bed *bed,
                        double from, double to, double share,
                        struct gb_stage_report *report)
{
    report->stage = GB_STAGE_RESTING;
    set_rest(stages, bed, report);
    report->share = from + (to - from) * fmin(share, 1.0);
}

static void rest(const struct gb_die_stages *stages, const struct gb_bed *bed,
                 struct gb_stage_report *report)
{
    set_resting(stages, bed, 0.0, 0.8, stages->now.rest_share, report);
}

static void ease(const struct gb_die_stages *stages, const struct gb_bed *bed,
                 struct gb_stage_report *report)
{
    const struct gb_die_cycle_ramp ramp = gb_die_cycle_ramp(stages);
    const double share = stages->now.stage_time / ramp.length;
    if (stages->now.flattened) {
        set_resting(stages, bed, 0.8, 0.97, share, report);
        return;
    }
    report->stage = GB_STAGE_EASING;
    set(report, GB_STAGE_MEASURE_GRAVITY, stages->now.leapfrog.gravity / ramp.to, 1.0,
        share);
}

static void settle(const struct gb_die_stages *stages, const struct gb_bed *bed,
                   struct gb_stage_report *report)
{
    if (stages->now.flattened) {
        set_resting(stages, bed, 0.97, 1.0, stages->now.rest_share, report);
        return;
    }
    report->stage = GB_STAGE_RESETTLING;
    set_rest(stages, bed, report);
}

static void flatten(const struct gb_die_stages *stages, const struct gb_bed *bed,
                    struct gb_stage_report *report)
{
    const double travel = stages->now.punch_from - bed->die.punch_position;
    const double goal = stages->scene.flatten_travel;
    report->stage = GB_STAGE_FLATTENING;
    set(report, GB_STAGE_MEASURE_TRAVEL, travel, goal, travel / goal);
}

/* It ends where the punch comes off, at the latest where flattening has begun. */
static void lift(const struct gb_die_stages *stages, const struct gb_bed *bed,
                 struct gb_stage_report *report)
{
    const double goal = stages->scene.flatten_travel;
    const double left = stages->now.punch_from - bed->die.punch_position;
    report->stage = GB_STAGE_LIFTING;
    set(report, GB_STAGE_MEASURE_TRAVEL, goal - left, goal, 1.0 - left / goal);
}

/* Stages that record points end by the share of their row in die_cycle.c. */
static void of_cycle(const struct gb_die_stages *stages, const struct gb_bed *bed,
                     struct gb_stage_report *report, enum gb_stage stage)
{
    const struct gb_punch *punch = &stages->now.punch;
    const double share = gb_die_cycle_share(stages, bed);
    const bool presses = stage == GB_STAGE_PRESS;
    report->stage = stage;
    if (gb_die_cycle_presses(stages)) {
        set(report, GB_STAGE_MEASURE_PRESSURE,
            gb_die_state_punch_wanted(punch, punch->time),
            presses ? punch->pressure : 0.0, share);
    } else if (stage == GB_STAGE_WITHDRAWAL || stage == GB_STAGE_EJECTION) {
        const double goal =
            stages->now.height0 - (stage == GB_STAGE_EJECTION ? 0.0 : stages->now.peak);
        set(report, GB_STAGE_MEASURE_TRAVEL, share * goal, goal, share);
    } else {
        set(report, GB_STAGE_MEASURE_TIME, stages->now.stage_time,
            stages->scene.rest_time, share);
    }
}

static const struct row {
    void (*measure)(const struct gb_die_stages *stages, const struct gb_bed *bed,
                    struct gb_stage_report *report); /* NULL: of_cycle */
    enum gb_stage stage;
} rows[GB_DIE_STAGES_COUNT] = {
    [GB_DIE_STAGES_POUR] = {pour, GB_STAGE_NONE},
    [GB_DIE_STAGES_EASE] = {ease, GB_STAGE_NONE},
    [GB_DIE_STAGES_SETTLE] = {settle, GB_STAGE_NONE},
    [GB_DIE_STAGES_FLATTEN] = {flatten, GB_STAGE_NONE},
    [GB_DIE_STAGES_LIFT] = {lift, GB_STAGE_NONE},
    [GB_DIE_STAGES_REST] = {rest, GB_STAGE_NONE},
    [GB_DIE_STAGES_PRESS] = {NULL, GB_STAGE_PRESS},
    [GB_DIE_STAGES_UNLOAD] = {NULL, GB_STAGE_UNLOADING},
    [GB_DIE_STAGES_WITHDRAW] = {NULL, GB_STAGE_WITHDRAWAL},
    [GB_DIE_STAGES_CONFINED] = {NULL, GB_STAGE_CONFINED},
    [GB_DIE_STAGES_EJECT] = {NULL, GB_STAGE_EJECTION},
    [GB_DIE_STAGES_FREE] = {NULL, GB_STAGE_EJECTED},
};

/* Simulated time of a stage from pressing on; that of the withdrawal of the punch is short
 * and known only after pressing. */
static double length_of(const struct gb_die_stages *stages,
                        enum gb_die_stages_stage stage)
{
    const struct gb_die_scene *scene = &stages->scene;
    switch (stage) {
    case GB_DIE_STAGES_PRESS:
        return scene->ramp_time;
    case GB_DIE_STAGES_UNLOAD:
        return scene->unload_time;
    case GB_DIE_STAGES_WITHDRAW:
        return stages->now.peak > 0.0
                   ? (stages->now.height0 - stages->now.peak) / scene->eject_speed
                   : 0.0;
    case GB_DIE_STAGES_CONFINED:
    case GB_DIE_STAGES_FREE:
        return scene->rest_time;
    case GB_DIE_STAGES_EJECT:
        return stages->now.height0 / scene->eject_speed;
    default:
        return 0.0;
    }
}

static double timed_share(const struct gb_die_stages *stages)
{
    const enum gb_die_stages_stage stage = stages->now.stage;
    double before = 0.0, all = length_of(stages, GB_DIE_STAGES_PRESS);
    if (stage == GB_DIE_STAGES_OVER) {
        return 1.0;
    }
    if (!gb_die_cycle_contains(stage)) {
        return (double)NAN;
    }
    if (stage != GB_DIE_STAGES_PRESS) {
        before = all;
    }
    for (int k = GB_DIE_STAGES_UNLOAD;
         stages->scene.full_cycle && k < GB_DIE_STAGES_COUNT; k++) {
        const double length = length_of(stages, (enum gb_die_stages_stage)k);
        before += stage != GB_DIE_STAGES_PRESS && k < (int)stage ? length : 0.0;
        all += length;
    }
    return fmin((before + stages->now.stage_time) / all, 1.0);
}

void gb_die_measure_stage(const struct gb_die_stages *stages, const struct gb_bed *bed,
                          struct gb_stage_report *report)
{
    const struct row *row = &rows[stages->now.stage];
    report->poured = bed->count - (bed->die.funnel ? gb_die_cycle_in_funnel(bed) : 0);
    report->timed = timed_share(stages);
    if (row->measure) {
        row->measure(stages, bed, report);
    } else if (row->stage != GB_STAGE_NONE) {
        of_cycle(stages, bed, report, row->stage);
    }
}

/* Shares of the time steps of a whole run at which the stages begin, about those of P3's 1751
 * spheres between `fast` and `balanced`; a full cycle gives pressing a tenth and each
 * later stage its part by the time that it takes. */
double gb_die_measure_progress(const struct gb_die_stages *stages,
                               const struct gb_bed *bed)
{
    static const double pressed[GB_STAGES + 1] = {
        [GB_STAGE_FILLING] = 0.0,     [GB_STAGE_SETTLING] = 0.27,
        [GB_STAGE_EASING] = 0.33,     [GB_STAGE_RESETTLING] = 0.36,
        [GB_STAGE_FLATTENING] = 0.38, [GB_STAGE_LIFTING] = 0.43,
        [GB_STAGE_RESTING] = 0.44,    [GB_STAGE_PRESS] = 0.61,
        [GB_STAGE_UNLOADING] = 1.0,
    };
    static const double full[GB_STAGES + 1] = {
        [GB_STAGE_PRESS] = 0.13,
        [GB_STAGE_UNLOADING] = 0.25,
        [GB_STAGE_WITHDRAWAL] = 0.38,
        [GB_STAGE_CONFINED] = 0.40,
        [GB_STAGE_EJECTION] = 0.50,
        [GB_STAGE_EJECTED] = 0.93,
        [GB_STAGES] = 1.0,
    };
    struct gb_stage_report now = {0};
    if (stages->now.stage == GB_DIE_STAGES_OVER) {
        return 1.0;
    }
    gb_die_measure_stage(stages, bed, &now);
    const bool cycle = stages->scene.full_cycle;
    const double scale = cycle ? full[GB_STAGE_PRESS] / pressed[GB_STAGE_PRESS] : 1.0;
    const bool fills = now.stage < GB_STAGE_PRESS;
    const double *from = cycle && !fills ? full : pressed;
    const double share =
        from[now.stage] + (from[now.stage + 1] - from[now.stage]) * now.share;
    return fills ? scale * share : share;
}
