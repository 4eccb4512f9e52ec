#include "solve/loading/die/die_stages.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/units.h"
#include "pack/die/bed_list.h"
#include "pack/die/bed_welds.h"
#include "scene/tolerances.h"
#include "solve/loading/die/die_cycle.h"
#include "solve/loading/die/die_measure.h"
#include "solve/loading/die/die_state.h"

enum { ESCAPE_TEXT = 160 };

bool gb_die_stages_create(struct gb_die_stages **out, const struct gb_die_scene *scene,
                          const struct gb_bed_law *law, struct gb_error *err)
{
    struct gb_die_stages *stages = gb_alloc_array(1, sizeof *stages, err);
    if (!stages) {
        return false;
    }
    stages->scene = *scene;
    stages->law = *law;
    gb_die_state_leapfrog_init(&stages->now.leapfrog, scene->safety, scene->time_step);
    stages->now.leapfrog.gravity = scene->fill_gravity;
    *out = stages;
    return true;
}

void gb_die_stages_destroy(struct gb_die_stages *stages)
{
    if (!stages) {
        return;
    }
    gb_bed_record_destroy(stages->kept);
    gb_die_state_surface_finish(&stages->side);
    gb_die_state_surface_finish(&stages->top);
    gb_alloc_free(stages);
}

static bool save_good(struct gb_die_stages *stages, const struct gb_bed *bed,
                      struct gb_error *err)
{
    stages->good = stages->now;
    stages->have_good = gb_bed_record_take(bed, &stages->kept, err);
    return stages->have_good;
}

static void write_step(const struct gb_die_stages *stages, double step, char *text,
                       size_t size)
{
    gb_units_format_short(step * stages->scene.second_per_time, GB_DIM_TIME, 3, text,
                          size);
}

/* Half the step from the last good state on, or the end. */
static enum gb_step_outcome halve_time_step(struct gb_die_stages *stages,
                                            struct gb_bed *bed, const char *why,
                                            char *text, size_t size, struct gb_error *err)
{
    const double step = stages->now.leapfrog.step;
    char last[48], half[48];
    write_step(stages, step, last, sizeof last);
    write_step(stages, 0.5 * step, half, sizeof half);
    if (!gb_bed_record_restore(bed, stages->kept, err)) {
        return GB_STEP_STOPPED;
    }
    stages->now = stages->good;
    stages->now.leapfrog.limit = 0.5 * step;
    stages->now.leapfrog.step = 0.0;
    if (++stages->halvings > GB_STEP_HALVINGS_MAX) {
        gb_error_set(err, GB_ERR_GUARD, "%s, also with a time step of %s", why, last);
        return GB_STEP_STOPPED;
    }
    snprintf(text, size, "guard: %s; time step halved to %s", why, half);
    return GB_STEP_MORE;
}

bool gb_die_stages_begin(struct gb_die_stages *stages, struct gb_bed *bed,
                         struct gb_error *err)
{
    stages->have_good = false;
    return gb_die_cycle_begin_press(stages, bed, err);
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

/* The punch far above the powder that it has to press: a light one on stiff contacts is
 * thrown off where the time step is too long for it. */
static bool thrown_off(const struct gb_die_stages *stages, const struct gb_bed *bed)
{
    return stages->now.stage == GB_DIE_STAGES_PRESS &&
           bed->die.punch_position > (1.0 + GB_PUNCH_RISE_MAX) * stages->now.height0;
}

/* Relative density under a pressing punch; 0 elsewhere. */
static double pressed_density(struct gb_die_stages *stages, const struct gb_bed *bed)
{
    const double section = M_PI * bed->die.radius * bed->die.radius;
    if (!gb_die_cycle_presses(stages)) {
        return 0.0;
    }
    if (!(stages->solid_volume > 0.0)) {
        stages->solid_volume = gb_bed_solid_volume(bed);
    }
    return stages->solid_volume / (section * bed->die.punch_position);
}

/* No time step helps against a pressure at which the contact laws do not hold: the end, at
 * the last good state. */
static enum gb_step_outcome stop_dense(struct gb_die_stages *stages, struct gb_bed *bed,
                                       double density, struct gb_error *err)
{
    if (!gb_bed_record_restore(bed, stages->kept, err)) {
        return GB_STEP_STOPPED;
    }
    stages->now = stages->good;
    gb_error_set(err, GB_ERR_GUARD,
                 "relative density %.6g under the punch: the contact laws hold up to %g; "
                 "try a lower loading.until or a higher material.young",
                 density, GB_DENSITY_MAX);
    return GB_STEP_STOPPED;
}

/* No state is kept with a particle outside, or with two of them deep in each other. */
static bool find_escape(const struct gb_bed *bed, char *why, size_t size)
{
    int64_t pair[2] = {-1, -1};
    const int64_t lost = gb_bed_escaped(bed);
    if (lost >= 0) {
        write_escape(bed, lost, why, size);
        return true;
    }
    const double overlap = gb_bed_deepest(bed, pair);
    if (overlap > GB_OVERLAP_MAX) {
        snprintf(why, size,
                 "particles %lld and %lld overlap by %.3g of the smaller one's diameter",
                 (long long)pair[0], (long long)pair[1], overlap);
        return true;
    }
    return false;
}

/* What a step may not leave behind, checked at every step: MORE if nothing does. */
static enum gb_step_outcome check_punch(struct gb_die_stages *stages, struct gb_bed *bed,
                                        char *text, size_t size, struct gb_error *err)
{
    const double density = pressed_density(stages, bed);
    char why[ESCAPE_TEXT];
    if (thrown_off(stages, bed)) {
        return halve_time_step(
            stages, bed,
            "the powder has thrown off the punch, which is light (die.punch_mass)", text,
            size, err);
    }
    if (!(density > GB_DENSITY_MAX)) {
        return GB_STEP_MORE;
    }
    return find_escape(bed, why, sizeof why)
               ? halve_time_step(stages, bed, why, text, size, err)
               : stop_dense(stages, bed, density, err);
}

/* A stage before pressing: pressing begins with a recorded point, every other stage with
 * a state to go back to. */
static enum gb_step_outcome check_stage(struct gb_die_stages *stages, struct gb_bed *bed,
                                        char *text, size_t size, struct gb_error *err)
{
    switch (gb_die_cycle_check(stages, bed, text, size, err)) {
    case GB_DIE_SEQUENCE_CONTINUES:
        return GB_STEP_MORE;
    case GB_DIE_SEQUENCE_ENDED:
        break;
    case GB_DIE_SEQUENCE_FAILED:
        return GB_STEP_STOPPED;
    }
    char why[ESCAPE_TEXT];
    if (find_escape(bed, why, sizeof why)) {
        return halve_time_step(stages, bed, why, text, size, err);
    }
    if (stages->now.stage == GB_DIE_STAGES_PRESS) {
        return GB_STEP_POINT;
    }
    return save_good(stages, bed, err) ? GB_STEP_MORE : GB_STEP_STOPPED;
}

/* The cycle of the punch: a point where one is due. */
static enum gb_step_outcome check_cycle(struct gb_die_stages *stages, struct gb_bed *bed,
                                        char *text, size_t size, struct gb_error *err)
{
    struct gb_die_progress *now = &stages->now;
    char why[ESCAPE_TEXT];
    gb_die_state_punch_follow(&now->punch, &now->leapfrog, bed,
                              gb_die_cycle_wall(stages, bed));
    if (!gb_die_cycle_due(stages, bed)) {
        return GB_STEP_MORE;
    }
    return find_escape(bed, why, sizeof why)
               ? halve_time_step(stages, bed, why, text, size, err)
               : GB_STEP_POINT;
}

/* Powder that is poured mixes: neighbours in space become neighbours in memory again. */
static bool follow_flow(const struct gb_die_stages *stages, struct gb_bed *bed,
                        struct gb_error *err)
{
    return stages->now.stage != GB_DIE_STAGES_POUR ||
           stages->now.steps % GB_RENUMBER_STEPS != 0 || gb_bed_list_renumber(bed, err);
}

static enum gb_step_outcome step_once(struct gb_die_stages *stages, struct gb_bed *bed,
                                      char *text, size_t size, struct gb_error *err)
{
    struct gb_die_progress *now = &stages->now;
    char why[sizeof err->text];
    if (!follow_flow(stages, bed, err)) {
        return GB_STEP_STOPPED;
    }
    if (!gb_die_state_leapfrog_step(&now->leapfrog, bed, err)) {
        snprintf(why, sizeof why, "%s", err->text);
        return err->code == GB_ERR_GUARD
                   ? halve_time_step(stages, bed, why, text, size, err)
                   : GB_STEP_STOPPED;
    }
    now->time += now->leapfrog.step;
    now->stage_time += now->leapfrog.step;
    now->steps++;
    now->since_point++;
    if (now->steps % GB_ESCAPE_CHECK_STEPS == 0 && find_escape(bed, why, sizeof why)) {
        return halve_time_step(stages, bed, why, text, size, err);
    }
    const enum gb_step_outcome punch = check_punch(stages, bed, text, size, err);
    if (punch != GB_STEP_MORE || text[0] != '\0') {
        return punch;
    }
    return gb_die_cycle_contains(now->stage) ? check_cycle(stages, bed, text, size, err)
                                             : check_stage(stages, bed, text, size, err);
}

/* A recorded point is a state to go back to.  The next stage and its lists begin here and not at
 * the end of the last step: a resumed run begins with the state of the point. */
static bool after_point(struct gb_die_stages *stages, struct gb_bed *bed, char *text,
                        size_t size, struct gb_error *err)
{
    struct gb_die_progress *now = &stages->now;
    now->at_point = false;
    now->since_point = 0;
    gb_bed_invalidate_lists(bed);
    if (!gb_die_cycle_after_point(stages, bed, text, size, err)) {
        return false;
    }
    gb_die_state_punch_clear(&now->punch);
    return save_good(stages, bed, err);
}

enum gb_step_outcome gb_die_stages_advance(struct gb_die_stages *stages,
                                           struct gb_bed *bed, int64_t max_steps,
                                           char *text, size_t size, struct gb_error *err)
{
    struct gb_die_progress *now = &stages->now;
    text[0] = '\0';
    if (!stages->have_good && !save_good(stages, bed, err)) {
        return GB_STEP_STOPPED;
    }
    if (now->at_point && !after_point(stages, bed, text, size, err)) {
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

/* Mean pressure carried since the last point, moved on to the pressure of the point as the
 * ramp has risen.  A punch whose inertia takes most of the ramp tells nothing of what the
 * powder would carry at the point: the mean itself. */
static double carried_at_point(const struct gb_punch *punch, double wanted, double weight)
{
    return punch->carried < GB_PUNCH_FOLLOWS_MIN * wanted * weight
               ? punch->carried / weight
               : wanted + (punch->carried - punch->wanted) / weight;
}

struct gb_die_stages_report gb_die_stages_report(const struct gb_die_stages *stages,
                                                 const struct gb_bed *bed)
{
    const struct gb_die_progress *now = &stages->now;
    const struct gb_punch *punch = &now->punch;
    const double weight = punch->weight > 0.0 ? punch->weight : 1.0;
    const double wanted =
        now->height0 > 0.0 ? gb_die_state_punch_wanted(punch, punch->time) : 0.0;
    const bool pressed = now->height0 > 0.0;
    struct gb_die_stages_report report = {
        .stage = now->stage,
        .time = now->time,
        .pressed = punch->time,
        .steps = now->since_point,
        .height = gb_die_cycle_height(stages, bed),
        .height0 = now->height0,
        .floor_over_punch = punch->carried > 0.0 ? punch->floor / punch->carried : NAN,
        .wanted = wanted,
        .carried = carried_at_point(punch, wanted, weight),
        .side = {punch->side[0] / weight, punch->side[1] / weight},
        .floor = pressed ? punch->floor / weight : (double)NAN,
        .contact = pressed ? gb_die_cycle_wall(stages, bed) : (double)NAN,
        .drag = pressed ? punch->drag / weight : (double)NAN,
        .work = pressed ? punch->work : (double)NAN,
        .welded = gb_bed_welds_share(bed),
        .residual = gb_bed_unbalanced_force(bed, now->leapfrog.gravity),
        .time_step = now->leapfrog.step,
    };
    if (now->stage == GB_DIE_STAGES_PRESS && punch->carried > 0.0) {
        /* at the pressure of the point, which is above the mean since the last one */
        const double scale = report.carried * weight / punch->carried;
        report.floor *= scale;
        report.drag *= scale;
    }
    gb_die_cycle_springback(stages, bed, &report.axial, &report.radial);
    report.progress = gb_die_measure_progress(stages, bed);
    return report;
}

bool gb_die_stages_record(struct gb_die_stages *stages, const struct gb_bed *bed,
                          struct gb_record *record, struct gb_error *err)
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
        {"cycle/ramp", GB_RECORD_INT32, 1, AT(now.punch.ramp), "1"},
        {"cycle/work", GB_RECORD_DOUBLE, 1, AT(now.punch.work), "E d^3"},
        {"cycle/position", GB_RECORD_DOUBLE, 1, AT(now.punch.position), "d"},
        {"cycle/force", GB_RECORD_DOUBLE, 1, AT(now.punch.force), "E d^2"},
        {"cycle/drag", GB_RECORD_DOUBLE, 1, AT(now.punch.drag), "E d^2 T"},
        {"cycle/peak", GB_RECORD_DOUBLE, 1, AT(now.peak), "d"},
        {"cycle/height", GB_RECORD_DOUBLE, 1, AT(now.height), "d"},
    };
#undef AT
    struct gb_die_progress *now = &stages->now;
    if (!gb_record_members(record, members, sizeof members / sizeof members[0], stages,
                           err) ||
        !gb_die_state_surface_record(&stages->side, "cycle/side", bed->count, record,
                                     err) ||
        !gb_die_state_surface_record(&stages->top, "cycle/top", bed->count, record,
                                     err)) {
        return false;
    }
    if (now->stage != GB_DIE_STAGES_OVER && !gb_die_cycle_contains(now->stage)) {
        return gb_error_set(err, GB_ERR_INPUT, "press/stage: is out of range");
    }
    now->at_point = true;
    return true;
}
