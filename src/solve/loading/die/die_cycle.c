/* The stages of a die scene: when one ends, and how the next one begins.
 *
 * Powder is poured, gravity falls and the powder settles; the punch presses it, unloads and
 * withdraws; the compact is ejected and springs back (GB_DIE_... of die_stages.h).  A stage of
 * filling ends when the powder is at rest; a stage of pressing ends when its ramp is over and the
 * powder is at rest.  Limits of rest: GB_REST_... and GB_POURED_... of scene/tolerances.h. */

#include "solve/loading/die/die_cycle.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>

#include "base/portable.h"
#include "pack/die/bed_welds.h"
#include "scene/tolerances.h"
#include "solve/loading/die/die_state.h"

/* ---- Is the powder at rest? ---- */

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

struct gb_die_cycle_rest_state gb_die_cycle_rest_state(const struct gb_die_stages *stages,
                                                       const struct gb_bed *bed)
{
    const bool pours = stages->now.stage == GB_DIE_STAGES_POUR;
    const double gravity = stages->now.leapfrog.gravity;
    const double weight = gravity * gb_bed_solid_volume(bed) / (M_PI / 6.0);
    return (struct gb_die_cycle_rest_state){
        .kinetic = gb_bed_kinetic_energy(bed).translational,
        .kinetic_limit = (pours ? GB_POURED_FALL : GB_REST_FALL) * weight,
        .unbalanced = gb_bed_unbalanced_force(bed, gravity),
        .unbalanced_limit = pours ? GB_POURED_UNBALANCED : GB_REST_UNBALANCED,
    };
}

/* Motion decays about exponentially: the share of its logarithm. */
static double share_of(const struct gb_die_cycle_rest_state *rest, double most)
{
    const double kinetic = rest->kinetic / rest->kinetic_limit;
    return most > 1.0 && kinetic < most
               ? fmin(1.0 - log(fmax(kinetic, 1.0)) / log(most), 1.0)
               : 0.0;
}

static void note_share(struct gb_die_progress *now,
                       const struct gb_die_cycle_rest_state *rest)
{
    now->most_kinetic = fmax(now->most_kinetic, rest->kinetic / rest->kinetic_limit);
    now->rest_share = fmax(now->rest_share, share_of(rest, now->most_kinetic));
}

static bool at_rest(struct gb_die_stages *stages, const struct gb_bed *bed)
{
    const struct gb_die_cycle_rest_state rest = gb_die_cycle_rest_state(stages, bed);
    note_share(&stages->now, &rest);
    return rest.kinetic < rest.kinetic_limit && rest.unbalanced < rest.unbalanced_limit &&
           top_is_supported(bed, stages->now.leapfrog.gravity);
}

int64_t gb_die_cycle_in_funnel(const struct gb_bed *bed)
{
    int64_t left = 0;
    for (int64_t i = 0; i < bed->count; i++) {
        left += bed->position[i][2] > bed->die.height;
    }
    return left;
}

/* Duration of a fall through the die, free or with drag (T). */
static double fall_time(const struct gb_leapfrog *leapfrog, double height)
{
    const double square = height / leapfrog->gravity;
    return sqrt(2.0 * square) + leapfrog->drag * square;
}

/* Fails with GB_ERR_GUARD when the powder has moved for GB_REST_FALLS_MAX falls through the
 * die in a stage that ends at rest: its steps are unstable, say. */
static bool die_rest_check_time(const struct gb_die_stages *stages,
                                const struct gb_bed *bed, struct gb_error *err)
{
    const struct gb_die_progress *now = &stages->now;
    return now->stage_time <=
               GB_REST_FALLS_MAX * fall_time(&now->leapfrog, bed->die.height) ||
           gb_error_set(
               err, GB_ERR_GUARD,
               "the powder does not come to rest: it has moved for %.3g us, "
               "%.0f falls through the die; try a smaller numerics.safety, more contact.damping",
               1e6 * now->stage_time * stages->scene.second_per_time, GB_REST_FALLS_MAX);
}

/* Checks every GB_REST_CHECK_STEPS steps; true when the last GB_REST_CHECKS checks have
 * found the powder at rest. */
static bool die_rest_lasts(struct gb_die_stages *stages, const struct gb_bed *bed)
{
    struct gb_die_progress *now = &stages->now;
    if (now->steps % GB_REST_CHECK_STEPS != 0) {
        return false;
    }
    now->checks_at_rest = at_rest(stages, bed) ? now->checks_at_rest + 1 : 0;
    return now->checks_at_rest >= GB_REST_CHECKS;
}

/* Checks that all particles at rest lie in the die.  Errors: GB_ERR_GUARD naming how many are
 * left in the funnel. */
static bool die_rest_check_funnel(const struct gb_bed *bed, struct gb_error *err)
{
    const int64_t left = gb_die_cycle_in_funnel(bed);
    return left == 0 ||
           gb_error_set(err, GB_ERR_GUARD,
                        "the funnel is clogged: %lld particle%s in it; try a larger "
                        "die.outlet or smaller particles",
                        (long long)left, left == 1 ? " rests" : "s rest");
}

/* ---- From filling to pressing ---- */

static void die_sequence_enter(struct gb_die_stages *stages,
                               enum gb_die_stages_stage stage)
{
    stages->now.stage = stage;
    stages->now.stage_time = 0.0;
    stages->now.steps = 0;
    stages->now.checks_at_rest = 0;
    stages->now.most_kinetic = stages->now.rest_share = 0.0;
}

struct gb_die_cycle_ramp gb_die_cycle_ramp(const struct gb_die_stages *stages)
{
    const struct gb_die_scene *scene = &stages->scene;
    const double middle =
        scene->gravity *
        gb_portable_pow(scene->fill_gravity / scene->gravity, GB_FLATTEN_GRAVITY);
    return stages->now.flattened
               ? (struct gb_die_cycle_ramp){middle, scene->gravity,
                                            GB_FLATTEN_GRAVITY * scene->gravity_ramp}
               : (struct gb_die_cycle_ramp){scene->fill_gravity, middle,
                                            (1.0 - GB_FLATTEN_GRAVITY) *
                                                scene->gravity_ramp};
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
    stages->now.leapfrog.drag = 1.0 / (GB_GRAVITY_RAMP_DRAG * stages->scene.gravity_ramp);
    die_sequence_enter(stages, GB_DIE_STAGES_EASE);
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
    die_sequence_enter(stages, GB_DIE_STAGES_FLATTEN);
}

bool gb_die_cycle_begin_press(struct gb_die_stages *stages, struct gb_bed *bed,
                              struct gb_error *err)
{
    const struct gb_die_scene *scene = &stages->scene;
    struct gb_die_progress *now = &stages->now;
    now->height0 = gb_bed_top(bed);
    now->punch = (struct gb_punch){.length = scene->ramp_time,
                                   .pressure = scene->pressure,
                                   .quadratic = scene->quadratic};
    gb_bed_set_law(bed, &stages->law);
    gb_die_state_punch_begin(&now->punch, &now->leapfrog, bed, now->height0,
                             scene->punch_mass);
    now->leapfrog.drag = now->leapfrog.step = 0.0;
    now->leapfrog.gravity = scene->gravity;
    now->next_record = scene->record;
    die_sequence_enter(stages, GB_DIE_STAGES_PRESS);
    return gb_bed_evaluate(bed, 0.0, 0.0, err); /* so that the first point has forces */
}

static void die_sequence_write_event(const struct gb_die_stages *stages, const char *what,
                                     int64_t steps, char *text, size_t size)
{
    snprintf(text, size, "%s after %.4g us, %lld steps", what,
             1e6 * stages->now.time * stages->scene.second_per_time, (long long)steps);
}

static void write_stage_event(const struct gb_die_stages *stages, const char *what,
                              char *text, size_t size)
{
    die_sequence_write_event(stages, what, stages->now.steps, text, size);
}

static enum gb_die_sequence_state still_moves(const struct gb_die_stages *stages,
                                              const struct gb_bed *bed,
                                              struct gb_error *err)
{
    return die_rest_check_time(stages, bed, err) ? GB_DIE_SEQUENCE_CONTINUES
                                                 : GB_DIE_SEQUENCE_FAILED;
}

static enum gb_die_sequence_state check_pour(struct gb_die_stages *stages,
                                             struct gb_bed *bed, char *text, size_t size,
                                             struct gb_error *err)
{
    if (!die_rest_lasts(stages, bed)) {
        return still_moves(stages, bed, err);
    }
    if (!die_rest_check_funnel(bed, err)) {
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
    const struct gb_die_cycle_ramp ramp = gb_die_cycle_ramp(stages);
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
    die_sequence_enter(stages, GB_DIE_STAGES_SETTLE);
    return GB_DIE_SEQUENCE_ENDED;
}

static enum gb_die_sequence_state check_settle(struct gb_die_stages *stages,
                                               struct gb_bed *bed, char *text,
                                               size_t size, struct gb_error *err)
{
    struct gb_die_progress *now = &stages->now;
    if (!die_rest_lasts(stages, bed)) {
        return still_moves(stages, bed, err);
    }
    if (now->flattened) {
        die_sequence_write_event(stages, "at rest", now->since_point - now->rest_from,
                                 text, size);
        return gb_die_cycle_begin_press(stages, bed, err) ? GB_DIE_SEQUENCE_ENDED
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
    die_sequence_enter(stages, GB_DIE_STAGES_LIFT);
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
    die_sequence_enter(stages, GB_DIE_STAGES_REST);
    return GB_DIE_SEQUENCE_ENDED;
}

static enum gb_die_sequence_state check_rest(struct gb_die_stages *stages,
                                             struct gb_bed *bed, char *text, size_t size,
                                             struct gb_error *err)
{
    (void)text;
    (void)size;
    if (!die_rest_lasts(stages, bed)) {
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

enum gb_die_sequence_state gb_die_cycle_check(struct gb_die_stages *stages,
                                              struct gb_bed *bed, char *text, size_t size,
                                              struct gb_error *err)
{
    const enum gb_die_stages_stage stage = stages->now.stage;
    return checks[stage] ? checks[stage](stages, bed, text, size, err)
                         : GB_DIE_SEQUENCE_CONTINUES;
}

/* ---- From pressing to springback ---- */

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
    return gb_die_state_surface_take(&stages->side, bed, GB_DIE_SIDE, err) &&
           gb_die_state_surface_take(&stages->top, bed, GB_DIE_PUNCH, err) &&
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
    const double wanted = gb_die_state_punch_wanted(&now->punch, now->punch.time);
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
            die_sequence_enter(stages, GB_DIE_STAGES_OVER);
            return true;
        }
        write_event(stages, text, size);
        if (row->begin_next && !row->begin_next(stages, bed, err)) {
            return false;
        }
        die_sequence_enter(stages, row->next);
    }
    stages->now.height = gb_die_cycle_height(stages, bed);
    return true;
}

void gb_die_cycle_springback(const struct gb_die_stages *stages, const struct gb_bed *bed,
                             double *axial, double *radial)
{
    *axial = *radial = (double)NAN;
    if (stages->now.peak > 0.0) {
        *axial = gb_die_state_surface_height(&stages->top, bed) / stages->now.peak - 1.0;
        *radial = gb_die_state_surface_radius(&stages->side, bed) / bed->die.radius - 1.0;
    }
}

double gb_die_cycle_share(const struct gb_die_stages *stages, const struct gb_bed *bed)
{
    return row_of(stages)->share(stages, bed);
}
