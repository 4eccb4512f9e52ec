#include "solve/loading/die_stages.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "pack/die/bed_copy.h"
#include "scene/tolerances.h"
#include "solve/leapfrog.h"
#include "solve/loading/punch.h"

/* Steps between checks of rest, and at most between checks for particles outside the die:
 * a slow escape takes many steps, and a fast one has the lists rebuilt, after which the
 * check runs as well. */
enum { REST_CHECK_STEPS = 256, ESCAPE_CHECK_STEPS = 16 };

/* The part of the state that a guard restores. */
struct progress {
    enum gb_die_stages_stage stage;
    struct gb_leapfrog leapfrog;
    struct gb_punch punch;
    double time, stage_time;
    int64_t steps; /* of the stage */
    int64_t since_point;
    int checks_at_rest; /* checks in a row that found the powder at rest */
    double punch_from;  /* where the flattening began */
    double height0, next_record;
    bool at_point; /* the last step ended in a point */
};

struct gb_die_stages {
    struct gb_die_scene scene;
    struct gb_bed_law law;
    struct progress now, good;
    struct gb_bed_copy *kept;
    int halvings;
    bool have_good;
};

bool gb_die_stages_create(struct gb_die_stages **out, const struct gb_die_scene *scene,
                          const struct gb_bed_law *law, struct gb_error *err)
{
    struct gb_die_stages *stages = gb_alloc_array(1, sizeof *stages, err);
    if (!stages) {
        return false;
    }
    stages->scene = *scene;
    stages->law = *law;
    gb_leapfrog_init(&stages->now.leapfrog, scene->safety, scene->time_step);
    stages->now.leapfrog.gravity = scene->fill_gravity;
    *out = stages;
    return true;
}

void gb_die_stages_destroy(struct gb_die_stages *stages)
{
    if (!stages) {
        return;
    }
    gb_bed_copy_destroy(stages->kept);
    gb_alloc_free(stages);
}

static bool save_good(struct gb_die_stages *stages, const struct gb_bed *bed,
                      struct gb_error *err)
{
    stages->good = stages->now;
    stages->have_good = gb_bed_copy_take(bed, &stages->kept, err);
    return stages->have_good;
}

/* Half the step from the last good state on, or the end. */
static enum gb_step_outcome halve_time_step(struct gb_die_stages *stages,
                                            struct gb_bed *bed, const char *why,
                                            char *text, size_t size, struct gb_error *err)
{
    const double step = stages->now.leapfrog.step;
    if (!gb_bed_copy_restore(bed, stages->kept, err)) {
        return GB_STEP_STOPPED;
    }
    stages->now = stages->good;
    stages->now.leapfrog.limit = 0.5 * step;
    stages->now.leapfrog.step = 0.0;
    if (++stages->halvings > GB_STEP_HALVINGS_MAX) {
        gb_error_set(err, GB_ERR_GUARD, "%s, also with a time step of %.3g ps", why,
                     1e12 * step * stages->scene.second_per_time);
        return GB_STEP_STOPPED;
    }
    snprintf(text, size, "guard: %s; time step halved to %.3g ps", why,
             0.5e12 * step * stages->scene.second_per_time);
    return GB_STEP_MORE;
}

/* True when contacts bear the highest particle; false while it falls. */
static bool top_is_supported(const struct gb_bed *bed, double gravity)
{
    int64_t highest = 0;
    double top = 0.0;
    for (int64_t i = 0; i < bed->count; i++) {
        const double reach = bed->position[i][2] + bed->position[i][3];
        highest = reach > top ? i : highest;
        top = fmax(reach, top);
    }
    return bed->force[highest][2] > GB_REST_SUPPORT_MIN * bed->mass[highest] * gravity;
}

/* Translational kinetic energy over that of a small fall, resultant over contact forces,
 * and support of the highest particle.  Rotation is left out: nothing damps the spin of a
 * smooth sphere. */
static bool at_rest(const struct gb_die_stages *stages, const struct gb_bed *bed)
{
    const bool pours = stages->now.stage == GB_DIE_STAGES_POUR;
    const double gravity = stages->now.leapfrog.gravity;
    const double weight = gravity * gb_bed_solid_volume(bed) / (M_PI / 6.0);
    return gb_bed_kinetic_energy(bed).translational <
               (pours ? GB_POURED_FALL : GB_REST_FALL) * weight &&
           gb_bed_unbalanced_force(bed, gravity) <
               (pours ? GB_POURED_UNBALANCED : GB_REST_UNBALANCED) &&
           top_is_supported(bed, gravity);
}

static int64_t left_in_funnel(const struct gb_bed *bed)
{
    int64_t left = 0;
    for (int64_t i = 0; i < bed->count; i++) {
        left += bed->position[i][2] > bed->die.height;
    }
    return left;
}

static void enter(struct gb_die_stages *stages, enum gb_die_stages_stage stage)
{
    stages->now.stage = stage;
    stages->now.stage_time = 0.0;
    stages->now.steps = 0;
    stages->now.checks_at_rest = 0;
}

/* Speed of the flattening punch (d/T): a particle thrown up at it rises by a quarter of
 * GB_FLATTEN_RISE. */
static double flatten_speed(const struct gb_die_scene *scene)
{
    return 0.5 * sqrt(2.0 * scene->gravity * GB_FLATTEN_RISE);
}

static void begin_flatten(struct gb_die_stages *stages, struct gb_bed *bed)
{
    bed->die.funnel = false;
    bed->die.punch = true;
    bed->die.punch_position = stages->now.punch_from = gb_bed_top(bed);
    bed->die.punch_velocity = -flatten_speed(&stages->scene);
    gb_bed_invalidate_lists(bed);
    enter(stages, GB_DIE_STAGES_FLATTEN);
}

static bool begin_press(struct gb_die_stages *stages, struct gb_bed *bed,
                        struct gb_error *err)
{
    const struct gb_die_scene *scene = &stages->scene;
    struct progress *now = &stages->now;
    now->height0 = gb_bed_top(bed);
    now->punch = (struct gb_punch){.length = scene->ramp_time,
                                   .pressure = scene->pressure,
                                   .quadratic = scene->quadratic};
    gb_bed_set_law(bed, &stages->law);
    gb_punch_begin(&now->punch, &now->leapfrog, bed, now->height0, scene->punch_mass);
    now->leapfrog.drag = now->leapfrog.step = 0.0;
    now->leapfrog.gravity = scene->gravity;
    now->next_record = scene->record;
    enter(stages, GB_DIE_STAGES_PRESS);
    return gb_bed_evaluate(bed, 0.0, 0.0, err); /* so that the first point has forces */
}

bool gb_die_stages_begin(struct gb_die_stages *stages, struct gb_bed *bed,
                         struct gb_error *err)
{
    stages->have_good = false;
    return begin_press(stages, bed, err);
}

static bool stays_at_rest(struct gb_die_stages *stages, const struct gb_bed *bed)
{
    struct progress *now = &stages->now;
    if (now->steps % REST_CHECK_STEPS != 0) {
        return false;
    }
    now->checks_at_rest = at_rest(stages, bed) ? now->checks_at_rest + 1 : 0;
    return now->checks_at_rest >= GB_REST_CHECKS;
}

static void write_stage_event(const struct gb_die_stages *stages, const char *what,
                              char *text, size_t size)
{
    snprintf(text, size, "%s after %.4g us, %lld steps", what,
             1e6 * stages->now.time * stages->scene.second_per_time,
             (long long)stages->now.steps);
}

static bool clogged(const struct gb_bed *bed, struct gb_error *err)
{
    const int64_t left = left_in_funnel(bed);
    return left > 0 &&
           !gb_error_set(err, GB_ERR_GUARD,
                         "the funnel is clogged: %lld particles rest in it; accepted: a "
                         "larger die.outlet or smaller particles",
                         (long long)left);
}

/* The stages before pressing: true when one has ended. */
static bool end_of_stage(struct gb_die_stages *stages, struct gb_bed *bed, char *text,
                         size_t size, struct gb_error *err)
{
    const struct gb_die_scene *scene = &stages->scene;
    struct progress *now = &stages->now;
    switch (now->stage) {
    case GB_DIE_STAGES_POUR:
        if (!stays_at_rest(stages, bed) || clogged(bed, err)) {
            return false;
        }
        write_stage_event(stages, "poured", text, size);
        now->leapfrog.drag = 1.0 / (GB_GRAVITY_RAMP_DRAG * scene->gravity_ramp);
        enter(stages, GB_DIE_STAGES_EASE);
        return true;
    case GB_DIE_STAGES_EASE:
        now->leapfrog.gravity =
            scene->fill_gravity * pow(scene->gravity / scene->fill_gravity,
                                      fmin(now->stage_time / scene->gravity_ramp, 1.0));
        if (now->stage_time < scene->gravity_ramp) {
            return false;
        }
        write_stage_event(stages, "gravity eased", text, size);
        now->leapfrog.drag = 1.0 / (GB_REST_DRAG * scene->gravity_ramp);
        enter(stages, GB_DIE_STAGES_SETTLE);
        return true;
    case GB_DIE_STAGES_SETTLE:
        if (!stays_at_rest(stages, bed)) {
            return false;
        }
        write_stage_event(stages, "settled", text, size);
        begin_flatten(stages, bed);
        return true;
    case GB_DIE_STAGES_FLATTEN:
        if (now->punch_from - bed->die.punch_position < scene->flatten_travel) {
            return false;
        }
        write_stage_event(stages, "flattened", text, size);
        bed->die.punch_velocity = -bed->die.punch_velocity;
        enter(stages, GB_DIE_STAGES_LIFT);
        return true;
    case GB_DIE_STAGES_LIFT:
        if (bed->tally.punch > 0.0 && bed->die.punch_position < now->punch_from) {
            return false; /* elastic powder follows the punch a little */
        }
        bed->die.punch = false;
        bed->die.punch_velocity = 0.0;
        gb_bed_invalidate_lists(bed);
        enter(stages, GB_DIE_STAGES_REST);
        return true;
    case GB_DIE_STAGES_REST:
        if (!stays_at_rest(stages, bed)) {
            return false;
        }
        write_stage_event(stages, "at rest", text, size);
        return begin_press(stages, bed, err);
    case GB_DIE_STAGES_PRESS:
    case GB_DIE_STAGES_OVER:
        break;
    }
    return false;
}

static bool point_due(struct gb_die_stages *stages)
{
    const struct gb_die_scene *scene = &stages->scene;
    struct progress *now = &stages->now;
    const double wanted = gb_punch_wanted(&now->punch, now->punch.time);
    if (now->punch.time >= scene->ramp_time) {
        return true;
    }
    if (wanted < now->next_record) {
        return false;
    }
    now->next_record += scene->record;
    return true;
}

static void write_escape(const struct gb_bed *bed, int64_t i, char *why, size_t size)
{
    const double *x = bed->position[i];
    if (!isfinite(x[0] + x[1] + x[2])) {
        snprintf(why, size, "particle %lld: its position is not a number", (long long)i);
    } else if (bed->die.punch && x[2] >= bed->die.punch_position) {
        snprintf(why, size, "the punch is below the powder: particle %lld is above it",
                 (long long)i);
    } else {
        snprintf(why, size, "particle %lld has left the die at (%.3g, %.3g, %.3g) d",
                 (long long)i, x[0], x[1], x[2]);
    }
}

struct gb_die_stages_report gb_die_stages_report(const struct gb_die_stages *stages,
                                                 const struct gb_bed *bed)
{
    const struct progress *now = &stages->now;
    const struct gb_punch *punch = &now->punch;
    const double weight = punch->weight > 0.0 ? punch->weight : 1.0;
    const double wanted = now->height0 > 0.0 ? gb_punch_wanted(punch, punch->time) : 0.0;
    struct gb_die_stages_report report = {
        .stage = now->stage,
        .time = now->time,
        .pressed = punch->time,
        .steps = now->since_point,
        .height = bed->die.punch ? bed->die.punch_position : gb_bed_top(bed),
        .height0 = now->height0,
        .floor_over_punch = punch->carried > 0.0 ? punch->floor / punch->carried : NAN,
        .wanted = wanted,
        .carried = wanted + (punch->carried - punch->wanted) / weight,
        .side = {punch->side[0] / weight, punch->side[1] / weight},
        .residual = gb_bed_unbalanced_force(bed, now->leapfrog.gravity),
        .time_step = now->leapfrog.step,
    };
    report.progress = now->stage == GB_DIE_STAGES_OVER ? 1.0
                      : now->stage == GB_DIE_STAGES_PRESS
                          ? 0.5 + 0.5 * punch->time / stages->scene.ramp_time
                          : 0.5 * (double)now->stage / GB_DIE_STAGES_PRESS;
    return report;
}

static enum gb_step_outcome step_once(struct gb_die_stages *stages, struct gb_bed *bed,
                                      char *text, size_t size, struct gb_error *err)
{
    struct progress *now = &stages->now;
    const int64_t rebuilds = bed->rebuilds;
    if (!gb_leapfrog_step(&now->leapfrog, bed, err)) {
        char why[sizeof err->text];
        snprintf(why, sizeof why, "%s", err->text);
        return err->code == GB_ERR_GUARD
                   ? halve_time_step(stages, bed, why, text, size, err)
                   : GB_STEP_STOPPED;
    }
    now->time += now->leapfrog.step;
    now->stage_time += now->leapfrog.step;
    now->steps++;
    now->since_point++;
    if (now->steps % ESCAPE_CHECK_STEPS == 0 || bed->rebuilds != rebuilds) {
        const int64_t lost = gb_bed_escaped(bed);
        if (lost >= 0) {
            char why[160];
            write_escape(bed, lost, why, sizeof why);
            return halve_time_step(stages, bed, why, text, size, err);
        }
    }
    if (now->stage == GB_DIE_STAGES_PRESS) {
        gb_punch_follow(&now->punch, &now->leapfrog, bed);
        return point_due(stages) ? GB_STEP_POINT : GB_STEP_MORE;
    }
    err->code = GB_OK;
    if (!end_of_stage(stages, bed, text, size, err)) {
        return err->code == GB_OK ? GB_STEP_MORE : GB_STEP_STOPPED;
    }
    return now->stage == GB_DIE_STAGES_PRESS ? GB_STEP_POINT
           : save_good(stages, bed, err)     ? GB_STEP_MORE
                                             : GB_STEP_STOPPED;
}

/* A recorded point is a state to go back to. */
static bool after_point(struct gb_die_stages *stages, const struct gb_bed *bed,
                        struct gb_error *err)
{
    struct progress *now = &stages->now;
    now->at_point = false;
    now->since_point = 0;
    gb_punch_clear(&now->punch);
    if (now->punch.time >= stages->scene.ramp_time) {
        enter(stages, GB_DIE_STAGES_OVER);
    }
    return save_good(stages, bed, err);
}

enum gb_step_outcome gb_die_stages_advance(struct gb_die_stages *stages,
                                           struct gb_bed *bed, int64_t max_steps,
                                           char *text, size_t size, struct gb_error *err)
{
    struct progress *now = &stages->now;
    text[0] = '\0';
    if (!stages->have_good && !save_good(stages, bed, err)) {
        return GB_STEP_STOPPED;
    }
    if (now->at_point && !after_point(stages, bed, err)) {
        return GB_STEP_STOPPED;
    }
    if (now->stage == GB_DIE_STAGES_OVER) {
        return GB_STEP_DONE;
    }
    for (int64_t k = 0; k < max_steps && text[0] == '\0'; k++) {
        const enum gb_step_outcome outcome = step_once(stages, bed, text, size, err);
        if (outcome != GB_STEP_MORE) {
            now->at_point = outcome == GB_STEP_POINT;
            return outcome;
        }
    }
    return GB_STEP_MORE;
}

bool gb_die_stages_record(struct gb_die_stages *stages, struct gb_record *record,
                          struct gb_error *err)
{
#define AT(member) offsetof(struct gb_die_stages, member)
    static const struct gb_record_member members[] = {
        {"press/stage", GB_RECORD_INT32, 1, AT(now.stage), "1"},
        {"press/time", GB_RECORD_DOUBLE, 1, AT(now.time), "T"},
        {"press/stage_time", GB_RECORD_DOUBLE, 1, AT(now.stage_time), "T"},
        {"press/steps", GB_RECORD_INT64, 1, AT(now.steps), "1"},
        {"press/since_point", GB_RECORD_INT64, 1, AT(now.since_point), "1"},
        {"press/height0", GB_RECORD_DOUBLE, 1, AT(now.height0), "d"},
        {"press/next_record", GB_RECORD_DOUBLE, 1, AT(now.next_record), "E"},
        {"press/halvings", GB_RECORD_INT32, 1, AT(halvings), "1"},
        {"press/limit", GB_RECORD_DOUBLE, 1, AT(now.leapfrog.limit), "T"},
        {"press/gravity", GB_RECORD_DOUBLE, 1, AT(now.leapfrog.gravity), "d/T^2"},
        {"press/drag", GB_RECORD_DOUBLE, 1, AT(now.leapfrog.drag), "1/T"},
        {"press/punch_mass", GB_RECORD_DOUBLE, 1, AT(now.leapfrog.punch_mass), "m"},
        {"press/load", GB_RECORD_DOUBLE, 1, AT(now.leapfrog.load), "E d^2"},
        {"press/step", GB_RECORD_DOUBLE, 1, AT(now.leapfrog.step), "T"},
        {"press/fastest", GB_RECORD_DOUBLE, 1, AT(now.leapfrog.fastest), "d/T"},
        {"press/area", GB_RECORD_DOUBLE, 1, AT(now.punch.area), "d^2"},
        {"press/length", GB_RECORD_DOUBLE, 1, AT(now.punch.length), "T"},
        {"press/pressure", GB_RECORD_DOUBLE, 1, AT(now.punch.pressure), "E"},
        {"press/quadratic", GB_RECORD_BOOL, 1, AT(now.punch.quadratic), "1"},
        {"press/pressed", GB_RECORD_DOUBLE, 1, AT(now.punch.time), "T"},
        {"press/weight", GB_RECORD_DOUBLE, 1, AT(now.punch.weight), "T"},
        {"press/carried", GB_RECORD_DOUBLE, 1, AT(now.punch.carried), "E T"},
        {"press/wanted", GB_RECORD_DOUBLE, 1, AT(now.punch.wanted), "E T"},
        {"press/floor", GB_RECORD_DOUBLE, 1, AT(now.punch.floor), "E T"},
        {"press/side", GB_RECORD_DOUBLE, 2, AT(now.punch.side), "E T"},
    };
#undef AT
    struct progress *now = &stages->now;
    if (!gb_record_members(record, members, sizeof members / sizeof members[0], stages,
                           err)) {
        return false;
    }
    if (now->stage != GB_DIE_STAGES_PRESS && now->stage != GB_DIE_STAGES_OVER) {
        return gb_error_set(err, GB_ERR_INPUT, "press/stage: is out of range");
    }
    now->at_point = true;
    return true;
}
