#include "solve/loading/die/die_sequence.h"

#include <math.h>
#include <stdio.h>

#include "base/portable.h"
#include "scene/tolerances.h"
#include "solve/loading/die/die_rest.h"

void gb_die_sequence_enter(struct gb_die_stages *stages, enum gb_die_stages_stage stage)
{
    stages->now.stage = stage;
    stages->now.stage_time = 0.0;
    stages->now.steps = 0;
    stages->now.checks_at_rest = 0;
    stages->now.most_kinetic = stages->now.rest_share = 0.0;
}

struct gb_die_sequence_ramp gb_die_sequence_ramp(const struct gb_die_stages *stages)
{
    const struct gb_die_scene *scene = &stages->scene;
    const double middle =
        scene->gravity *
        gb_portable_pow(scene->fill_gravity / scene->gravity, GB_FLATTEN_GRAVITY);
    return stages->now.flattened
               ? (struct gb_die_sequence_ramp){middle, scene->gravity,
                                               GB_FLATTEN_GRAVITY * scene->gravity_ramp}
               : (struct gb_die_sequence_ramp){
                     scene->fill_gravity, middle,
                     (1.0 - GB_FLATTEN_GRAVITY) * scene->gravity_ramp};
}

/* Speed of the flattening punch (d/T): a particle thrown up at it rises by a quarter of
 * GB_FLATTEN_RISE. */
static double flatten_speed(double gravity)
{
    return 0.5 * sqrt(2.0 * gravity * GB_FLATTEN_RISE);
}

/* Drag of powder that comes to rest.  Rigid particles move alike under any gravity, by times
 * that go with its root: so does that of the drag. */
static double rest_drag(const struct gb_die_scene *scene, double gravity)
{
    return sqrt(gravity / scene->gravity) / (GB_REST_DRAG * scene->gravity_ramp);
}

static void begin_ease(struct gb_die_stages *stages)
{
    stages->now.leapfrog.drag =
        1.0 / (GB_GRAVITY_RAMP_DRAG * stages->scene.gravity_ramp);
    gb_die_sequence_enter(stages, GB_DIE_STAGES_EASE);
}

static void begin_flatten(struct gb_die_stages *stages, struct gb_bed *bed)
{
    bed->die.funnel = false;
    bed->die.punch = true;
    bed->die.punch_position = stages->now.punch_from = gb_bed_top(bed);
    bed->die.punch_velocity = -flatten_speed(stages->now.leapfrog.gravity);
    stages->now.leapfrog.drag = rest_drag(&stages->scene, stages->now.leapfrog.gravity);
    stages->now.flattened = true;
    gb_bed_invalidate_lists(bed);
    gb_die_sequence_enter(stages, GB_DIE_STAGES_FLATTEN);
}

bool gb_die_sequence_begin_press(struct gb_die_stages *stages, struct gb_bed *bed,
                                 struct gb_error *err)
{
    const struct gb_die_scene *scene = &stages->scene;
    struct gb_die_progress *now = &stages->now;
    now->height0 = gb_bed_top(bed);
    now->punch = (struct gb_punch){.length = scene->ramp_time,
                                   .pressure = scene->pressure,
                                   .quadratic = scene->quadratic};
    gb_bed_set_law(bed, &stages->law);
    gb_punch_begin(&now->punch, &now->leapfrog, bed, now->height0, scene->punch_mass);
    now->leapfrog.drag = now->leapfrog.step = 0.0;
    now->leapfrog.gravity = scene->gravity;
    now->next_record = scene->record;
    gb_die_sequence_enter(stages, GB_DIE_STAGES_PRESS);
    return gb_bed_evaluate(bed, 0.0, 0.0, err); /* so that the first point has forces */
}

static void write_event(const struct gb_die_stages *stages, const char *what,
                        int64_t steps, char *text, size_t size)
{
    snprintf(text, size, "%s after %.4g us, %lld steps", what,
             1e6 * stages->now.time * stages->scene.second_per_time, (long long)steps);
}

static void write_stage_event(const struct gb_die_stages *stages, const char *what,
                              char *text, size_t size)
{
    write_event(stages, what, stages->now.steps, text, size);
}

static enum gb_die_sequence_state still_moves(const struct gb_die_stages *stages,
                                              const struct gb_bed *bed,
                                              struct gb_error *err)
{
    return gb_die_rest_check_time(stages, bed, err) ? GB_DIE_SEQUENCE_CONTINUES
                                                    : GB_DIE_SEQUENCE_FAILED;
}

/* One function a stage: whether it has ended; the next one has then begun. */

static enum gb_die_sequence_state check_pour(struct gb_die_stages *stages,
                                             struct gb_bed *bed, char *text, size_t size,
                                             struct gb_error *err)
{
    if (!gb_die_rest_lasts(stages, bed)) {
        return still_moves(stages, bed, err);
    }
    if (!gb_die_rest_check_funnel(bed, err)) {
        return GB_DIE_SEQUENCE_FAILED;
    }
    write_stage_event(stages, "poured", text, size);
    begin_ease(stages);
    return GB_DIE_SEQUENCE_ENDED;
}

/* From the gravity of filling to that of flattening, or from there to that of rest.  What
 * belongs to coming to rest has no event of its own. */
static enum gb_die_sequence_state check_ease(struct gb_die_stages *stages,
                                             struct gb_bed *bed, char *text, size_t size,
                                             struct gb_error *err)
{
    struct gb_die_progress *now = &stages->now;
    const struct gb_die_sequence_ramp ramp = gb_die_sequence_ramp(stages);
    (void)bed;
    (void)err;
    now->leapfrog.gravity =
        ramp.from *
        gb_portable_pow(ramp.to / ramp.from, fmin(now->stage_time / ramp.length, 1.0));
    if (now->stage_time < ramp.length) {
        return GB_DIE_SEQUENCE_CONTINUES;
    }
    if (!now->flattened) {
        write_stage_event(stages, "gravity eased", text, size);
    }
    now->leapfrog.drag = rest_drag(&stages->scene, ramp.to);
    gb_die_sequence_enter(stages, GB_DIE_STAGES_SETTLE);
    return GB_DIE_SEQUENCE_ENDED;
}

static enum gb_die_sequence_state check_settle(struct gb_die_stages *stages,
                                               struct gb_bed *bed, char *text,
                                               size_t size, struct gb_error *err)
{
    struct gb_die_progress *now = &stages->now;
    if (!gb_die_rest_lasts(stages, bed)) {
        return still_moves(stages, bed, err);
    }
    if (now->flattened) {
        write_event(stages, "at rest", now->since_point - now->rest_from, text, size);
        return gb_die_sequence_begin_press(stages, bed, err) ? GB_DIE_SEQUENCE_ENDED
                                                             : GB_DIE_SEQUENCE_FAILED;
    }
    write_stage_event(stages, "settled", text, size);
    begin_flatten(stages, bed);
    return GB_DIE_SEQUENCE_ENDED;
}

static enum gb_die_sequence_state check_flatten(struct gb_die_stages *stages,
                                                struct gb_bed *bed, char *text,
                                                size_t size, struct gb_error *err)
{
    const double travel = stages->now.punch_from - bed->die.punch_position;
    (void)err;
    if (travel < stages->scene.flatten_travel) {
        return GB_DIE_SEQUENCE_CONTINUES;
    }
    write_stage_event(stages, "flattened", text, size);
    bed->die.punch_velocity = -bed->die.punch_velocity;
    gb_die_sequence_enter(stages, GB_DIE_STAGES_LIFT);
    return GB_DIE_SEQUENCE_ENDED;
}

/* Elastic powder follows the punch a little: the contact opens after some travel. */
static enum gb_die_sequence_state check_lift(struct gb_die_stages *stages,
                                             struct gb_bed *bed, char *text, size_t size,
                                             struct gb_error *err)
{
    (void)text;
    (void)size;
    (void)err;
    if (bed->tally.punch > 0.0 && bed->die.punch_position < stages->now.punch_from) {
        return GB_DIE_SEQUENCE_CONTINUES;
    }
    bed->die.punch = false;
    bed->die.punch_velocity = 0.0;
    gb_bed_invalidate_lists(bed);
    stages->now.rest_from = stages->now.since_point;
    gb_die_sequence_enter(stages, GB_DIE_STAGES_REST);
    return GB_DIE_SEQUENCE_ENDED;
}

static enum gb_die_sequence_state check_rest(struct gb_die_stages *stages,
                                             struct gb_bed *bed, char *text, size_t size,
                                             struct gb_error *err)
{
    (void)text;
    (void)size;
    if (!gb_die_rest_lasts(stages, bed)) {
        return still_moves(stages, bed, err);
    }
    begin_ease(stages);
    return GB_DIE_SEQUENCE_ENDED;
}

/* By stage; stages that record points are rows of die_cycle.c. */
static enum gb_die_sequence_state (*const checks[GB_DIE_STAGES_COUNT])(
    struct gb_die_stages *stages, struct gb_bed *bed, char *text, size_t size,
    struct gb_error *err) = {
    [GB_DIE_STAGES_POUR] = check_pour,     [GB_DIE_STAGES_EASE] = check_ease,
    [GB_DIE_STAGES_SETTLE] = check_settle, [GB_DIE_STAGES_FLATTEN] = check_flatten,
    [GB_DIE_STAGES_LIFT] = check_lift,     [GB_DIE_STAGES_REST] = check_rest,
};

enum gb_die_sequence_state gb_die_sequence_check(struct gb_die_stages *stages,
                                                 struct gb_bed *bed, char *text,
                                                 size_t size, struct gb_error *err)
{
    const enum gb_die_stages_stage stage = stages->now.stage;
    return checks[stage] ? checks[stage](stages, bed, text, size, err)
                         : GB_DIE_SEQUENCE_CONTINUES;
}
