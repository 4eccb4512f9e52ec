/* The mode `dynamic`: a periodic cell compressed at a rate.  First the motion with its time step and
 * its guard, then the mode. */
#include "solve/loading/loading_dynamic.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/portable.h"
#include "base/record.h"
#include "greenbody/status.h"
#include "law/critical_step.h"
#include "pack/cell/world.h"
#include "scene/tolerances.h"
#include "solve/loading/loading.h"
#include "solve/loading/loading_cell.h"
#include "solve/step_outcome.h"
#include "solve/verlet.h"

/* High-speed pressing of P2: a particle system with inertia is relaxed, compressed at a rate and
 * held.  Time steps of gb_verlet lead from one recorded point to the next.
 *
 * A guard watches the fraction of sliding contacts.  If too many slide, or the critical step is
 * exceeded, the motion goes back to the last recorded point and halves the step. */

/* ---- Time step ---- */

/* The viscous force of a mode is xi = A omega / 2 of the critical damping. */
static double critical_step(const struct gb_dynamic *motion, double frequency)
{
    return gb_critical_step(frequency, 0.5 * motion->model->dynamics.viscous * frequency);
}

/* The given step, or a fraction of the critical one as soon as the given one exceeds it. */
static double bound_given(struct gb_dynamic *motion, double critical, char *text,
                          size_t size)
{
    const double step = fmin(motion->model->dynamics.time_step, motion->limit);
    if (step <= critical) {
        return step;
    }
    motion->limit = GB_STEP_CRITICAL_FRACTION * critical;
    snprintf(text, size,
             "guard: time step %.3g T above the critical %.3g T: %.3g T is taken", step,
             critical, motion->limit);
    return motion->limit;
}

/* Step at which velocity Verlet has the error unit (omega step)^2 that is allowed. */
static double accurate_step(const struct gb_dynamic *motion, double frequency,
                            double unit)
{
    const double share = sqrt(motion->model->dynamics.step_error / unit);
    return share / fmax(frequency, GB_FREQUENCY_MIN);
}

/* The step that strains the cell as much as the work of pressing allows. */
static double straining_step(const struct gb_dynamic *motion)
{
    return GB_STEP_STRAIN_MAX / motion->model->dynamics.rate;
}

/* The automatic step, of accuracy or of stability.  Strong damping bounds it more. */
static double pick_step(struct gb_dynamic *motion, double frequency, double critical,
                        char *text, size_t size)
{
    const bool loading = motion->stage == GB_DYNAMIC_LOAD;
    const double loaded = accurate_step(motion, frequency, GB_STEP_ERROR_UNIT);
    const double accurate =
        loading ? fmin(loaded, straining_step(motion))
                : accurate_step(motion, frequency, GB_STEP_ERROR_UNIT_FREE);
    const double stable = GB_STEP_CRITICAL_FRACTION * critical;
    if (stable < 0.5 * loaded && !motion->limit_reported) {
        motion->limit_reported = true;
        snprintf(
            text, size,
            "guard: contact.viscosity bounds the time step to %.3g T (accuracy alone: "
            "%.3g T)",
            stable, loaded);
    }
    const double crossing = GB_FREE_STEP_MAX * motion->model->diameter_min;
    return fmin(fmin(fmin(accurate, stable), crossing), motion->limit);
}

double gb_loading_dynamic_step_allowed(struct gb_dynamic *motion,
                                       const struct gb_world *world, char *text,
                                       size_t size)
{
    const double frequency = gb_verlet_frequency(world, motion->scratch);
    const double critical = critical_step(motion, frequency);
    return motion->model->dynamics.time_step > 0.0
               ? bound_given(motion, critical, text, size)
               : pick_step(motion, frequency, critical, text, size);
}

/* ---- Guard ---- */

/* The present state is the one to go back to.  Errors: GB_ERR_MEMORY. */
static bool dynamic_guard_save(struct gb_dynamic *motion, const struct gb_world *world,
                               struct gb_error *err)
{
    const size_t bytes = 3 * (size_t)motion->model->count * sizeof(double);
    memcpy(motion->good_velocity, motion->verlet.velocity, bytes);
    memcpy(motion->good_spin, motion->verlet.spin, bytes);
    motion->good_time = motion->time;
    motion->good_density = motion->density;
    motion->good_work = motion->verlet.work;
    motion->good_absorbed = motion->verlet.absorbed;
    motion->good_stage = motion->stage;
    return gb_world_copy_save(world, &motion->good, err);
}

/* Back to the last recorded point. */
static bool restore_good(struct gb_dynamic *motion, struct gb_world *world,
                         struct gb_error *err)
{
    const size_t bytes = 3 * (size_t)motion->model->count * sizeof(double);
    memcpy(motion->verlet.velocity, motion->good_velocity, bytes);
    memcpy(motion->verlet.spin, motion->good_spin, bytes);
    motion->time = motion->good_time;
    motion->density = motion->good_density;
    motion->verlet.work = motion->good_work;
    motion->verlet.absorbed = motion->good_absorbed;
    motion->stage = motion->good_stage;
    motion->left = 0;
    return gb_world_copy_restore(world, motion->good, err) &&
           gb_world_evaluate(world, err);
}

/* Back to the saved state with half the time step: MORE, with a line in text (size
 * bytes) that begins with the reason `why`; STOPPED after GB_STEP_HALVINGS_MAX
 * halvings. */
static enum gb_step_outcome dynamic_guard_halve(struct gb_dynamic *motion,
                                                struct gb_world *world, const char *why,
                                                char *text, size_t size,
                                                struct gb_error *err)
{
    motion->limit = 0.5 * motion->step;
    if (!restore_good(motion, world, err)) {
        return GB_STEP_STOPPED;
    }
    if (++motion->halvings > GB_STEP_HALVINGS_MAX) {
        gb_error_set(err, GB_ERR_GUARD, "%s, also with a time step of %.3g T", why,
                     motion->step);
        return GB_STEP_STOPPED;
    }
    snprintf(text, size, "guard: %s; time step halved to %.3g T", why, motion->limit);
    return GB_STEP_MORE;
}

/* Share of the contacts that slid since the last point. */
static double sliding_share(const struct gb_dynamic *motion)
{
    return motion->contacts > 0 ? (double)motion->sliding / (double)motion->contacts
                                : 0.0;
}

/* Half the step changed nothing: friction is the cause, and the step is restored. */
static void restore_step(struct gb_dynamic *motion, double share, char *text, size_t size)
{
    motion->sliding_most = 0.5 * (1.0 + share);
    motion->limit = motion->limit_before;
    motion->slid = 0.0;
    motion->halvings--;
    snprintf(text, size,
             "guard: %.0f %% of the contacts slide with half the time step as well; the "
             "step is not the cause and is taken as before",
             100.0 * share);
}

/* At the end of the steps to a point: POINT, or as of dynamic_guard_halve when more
 * contacts slid than the time step explains. */
/* Friction caps hide an unstable step from the kinetic energy; the sliding contacts show
 * it.  Many contacts may also slide at any step: half the step decides. */
static enum gb_step_outcome dynamic_guard_judge(struct gb_dynamic *motion,
                                                struct gb_world *world, char *text,
                                                size_t size, struct gb_error *err)
{
    const double share = sliding_share(motion);
    if (motion->slid > 0.0 && share > GB_SLIDING_RATIO_UNCHANGED * motion->slid) {
        restore_step(motion, share, text, size);
        return GB_STEP_POINT;
    }
    if (share > motion->sliding_most) {
        char why[96];
        snprintf(why, sizeof why, "%.0f %% of the contacts slide", 100.0 * share);
        if (motion->slid == 0.0) {
            motion->limit_before = motion->limit;
        }
        motion->slid = share;
        return dynamic_guard_halve(motion, world, why, text, size, err);
    }
    motion->slid = 0.0;
    return GB_STEP_POINT;
}

/* ---- Motion ---- */

bool gb_loading_dynamic_create(struct gb_dynamic **out, struct gb_world *world,
                               struct gb_error *err)
{
    const struct gb_model *model = gb_world_model(world);
    const size_t n = 3 * (size_t)model->count;
    struct gb_dynamic *motion = gb_alloc_array(1, sizeof *motion, err);
    if (!motion) {
        return false;
    }
    motion->model = model;
    motion->limit = INFINITY;
    motion->sliding_most = GB_SLIDING_FRACTION_MAX;
    motion->density = gb_world_density(world);
    motion->stage = motion->recorded = GB_DYNAMIC_RELAX;
    motion->stage_end = model->dynamics.relax;
    motion->good_velocity = gb_alloc_array(n, sizeof *motion->good_velocity, err);
    motion->good_spin = gb_alloc_array(n, sizeof *motion->good_spin, err);
    motion->scratch = gb_alloc_array((size_t)model->count, sizeof *motion->scratch, err);
    if (!motion->good_velocity || !motion->good_spin || !motion->scratch ||
        !gb_verlet_init(&motion->verlet, model, err)) {
        gb_loading_dynamic_destroy(motion);
        return false;
    }
    *out = motion;
    return true;
}

void gb_loading_dynamic_destroy(struct gb_dynamic *motion)
{
    if (!motion) {
        return;
    }
    gb_verlet_finish(&motion->verlet);
    gb_world_copy_destroy(motion->good);
    gb_alloc_free(motion->good_velocity);
    gb_alloc_free(motion->good_spin);
    gb_alloc_free(motion->scratch);
    gb_alloc_free(motion);
}

static void enter(struct gb_dynamic *motion, enum gb_dynamic_stage stage)
{
    motion->stage = stage;
    if (stage == GB_DYNAMIC_HOLD) {
        motion->stage_end = motion->time + motion->model->dynamics.hold;
    }
}

/* Moves on to the stage that has something left to do. */
static void settle_stage(struct gb_dynamic *motion)
{
    if (motion->stage == GB_DYNAMIC_RELAX &&
        motion->time >= motion->stage_end - GB_STAGE_END_TOLERANCE) {
        enter(motion, GB_DYNAMIC_LOAD);
    }
    if (motion->stage == GB_DYNAMIC_LOAD &&
        motion->density >=
            motion->model->until_density * (1.0 - GB_DENSITY_END_TOLERANCE)) {
        enter(motion, GB_DYNAMIC_HOLD);
    }
    if (motion->stage == GB_DYNAMIC_HOLD &&
        motion->time >= motion->stage_end - GB_STAGE_END_TOLERANCE) {
        enter(motion, GB_DYNAMIC_OVER);
    }
}

/* Equal steps to the next point, none longer than allowed. */
static void plan(struct gb_dynamic *motion, double allowed)
{
    const struct gb_dynamics *dynamics = &motion->model->dynamics;
    double interval = fmin(dynamics->record_time, motion->stage_end - motion->time);
    double growth = 1.0;
    if (motion->stage == GB_DYNAMIC_LOAD) {
        const double next = fmin(motion->density * (1.0 + dynamics->record_density),
                                 motion->model->until_density);
        growth = next / motion->density;
        interval = gb_portable_log(growth) / dynamics->rate;
    }
    motion->planned = motion->left =
        (int64_t)fmax(1.0, ceil(interval / allowed - GB_STEP_COUNT_TOLERANCE));
    motion->step = interval / (double)motion->planned;
    const struct gb_compressed_axes axes = gb_loading_cell_of(motion->model);
    gb_loading_cell_scale(
        &axes, gb_portable_pow(growth, -1.0 / (axes.count * (double)motion->planned)),
        motion->factor);
    motion->density *= growth;
    motion->sliding = motion->contacts = 0;
}

static enum gb_step_outcome begin(struct gb_dynamic *motion, struct gb_world *world,
                                  char *text, size_t size, struct gb_error *err)
{
    settle_stage(motion);
    if (motion->stage == GB_DYNAMIC_OVER) {
        return GB_STEP_DONE;
    }
    if (!dynamic_guard_save(motion, world, err)) {
        return GB_STEP_STOPPED;
    }
    plan(motion, gb_loading_dynamic_step_allowed(motion, world, text, size));
    return GB_STEP_MORE;
}

enum gb_step_outcome gb_loading_dynamic_advance(struct gb_dynamic *motion,
                                                struct gb_world *world, int64_t max_steps,
                                                char *text, size_t size,
                                                struct gb_error *err)
{
    text[0] = '\0';
    if (motion->left == 0) {
        const enum gb_step_outcome outcome = begin(motion, world, text, size, err);
        if (outcome != GB_STEP_MORE) {
            return outcome;
        }
    }
    for (int64_t i = 0; i < max_steps && motion->left > 0; i++) {
        if (!gb_verlet_step(&motion->verlet, world, motion->step, motion->factor, err)) {
            char why[sizeof err->text];
            snprintf(why, sizeof why, "%s", err->text);
            return err->code == GB_ERR_GUARD
                       ? dynamic_guard_halve(motion, world, why, text, size, err)
                       : GB_STEP_STOPPED;
        }
        motion->time += motion->step;
        motion->left--;
        motion->sliding += gb_world_tally(world)->sliding;
        motion->contacts += gb_world_tally(world)->contacts;
    }
    if (motion->left > 0) {
        return GB_STEP_MORE;
    }
    motion->recorded = motion->stage;
    return dynamic_guard_judge(motion, world, text, size, err);
}

static double whole_time(const struct gb_dynamic *motion)
{
    const struct gb_model *model = motion->model;
    return model->dynamics.relax + model->dynamics.hold +
           gb_portable_log(model->until_density / model->start_density) /
               model->dynamics.rate;
}

/* Velocities of the particles, valid until the next advance. */
static const struct gb_verlet *dynamic_verlet(const struct gb_dynamic *motion)
{
    return &motion->verlet;
}

struct gb_loading_dynamic_report
gb_loading_dynamic_report(const struct gb_dynamic *motion)
{
    return (struct gb_loading_dynamic_report){
        .stage = motion->recorded,
        .time = motion->time,
        .steps = motion->planned - motion->left,
        .kinetic = gb_verlet_kinetic(&motion->verlet),
        .work = motion->verlet.work,
        .absorbed = motion->verlet.absorbed,
        .time_step = motion->step,
        .progress = fmin(1.0, motion->time / whole_time(motion)),
    };
}

/* The motion at a recorded point into a record, or out of it after gb_loading_dynamic_create
 * with the same world.  Errors: GB_ERR_INPUT naming the member. */
/* At a recorded point the steps to the next one and the state to restore are not set yet.
 */
static bool dynamic_record(struct gb_dynamic *motion, struct gb_record *record,
                           struct gb_error *err)
{
#define AT(member) offsetof(struct gb_dynamic, member)
    static const struct gb_record_member members[] = {
        {"motion/stage", GB_RECORD_INT32, 1, AT(stage), "1"},
        {"motion/recorded", GB_RECORD_INT32, 1, AT(recorded), "1"},
        {"motion/time", GB_RECORD_DOUBLE, 1, AT(time), "T"},
        {"motion/stage_end", GB_RECORD_DOUBLE, 1, AT(stage_end), "T"},
        {"motion/limit", GB_RECORD_DOUBLE, 1, AT(limit), "T"},
        {"motion/halvings", GB_RECORD_INT32, 1, AT(halvings), "1"},
        {"motion/sliding_most", GB_RECORD_DOUBLE, 1, AT(sliding_most), "1"},
        {"motion/slid", GB_RECORD_DOUBLE, 1, AT(slid), "1"},
        {"motion/limit_before", GB_RECORD_DOUBLE, 1, AT(limit_before), "T"},
        {"motion/limit_reported", GB_RECORD_BOOL, 1, AT(limit_reported), "1"},
        {"motion/planned", GB_RECORD_INT64, 1, AT(planned), "1"},
        {"motion/step", GB_RECORD_DOUBLE, 1, AT(step), "T"},
        {"motion/density", GB_RECORD_DOUBLE, 1, AT(density), "1"},
        {"motion/work", GB_RECORD_DOUBLE, 1, AT(verlet.work), "E d^3"},
        {"motion/absorbed", GB_RECORD_DOUBLE, 1, AT(verlet.absorbed), "E d^3"},
    };
#undef AT
    const int64_t count = motion->model->count;
    if (!gb_record_members(record, members, sizeof members / sizeof members[0], motion,
                           err) ||
        !gb_record_array(record, "motion/velocity", GB_RECORD_DOUBLE, count, 3, "d/T",
                         motion->verlet.velocity, err) ||
        !gb_record_array(record, "motion/spin", GB_RECORD_DOUBLE, count, 3, "1/T",
                         motion->verlet.spin, err)) {
        return false;
    }
    if ((int)motion->stage < GB_DYNAMIC_RELAX || motion->stage > GB_DYNAMIC_OVER ||
        (int)motion->recorded < GB_DYNAMIC_RELAX || motion->recorded > GB_DYNAMIC_HOLD) {
        return gb_error_set(err, GB_ERR_INPUT, "motion/stage: is out of range");
    }
    return true;
}

struct dynamic_loading {
    struct gb_loading base;
    struct gb_dynamic *motion;
};

static struct dynamic_loading *own(struct gb_loading *loading)
{
    return (struct dynamic_loading *)(void *)loading;
}

static const struct gb_dynamic *motion_of(const struct gb_loading *loading)
{
    return ((const struct dynamic_loading *)(const void *)loading)->motion;
}

static bool build(struct gb_loading *loading, bool (*cancelled)(void *data), void *data,
                  struct gb_error *err)
{
    return gb_loading_cell_grow(loading, cancelled, data, err) &&
           gb_loading_dynamic_create(&own(loading)->motion, loading->world, err);
}

static bool build_from(struct gb_loading *loading, struct gb_record *record,
                       struct gb_error *err)
{
    return gb_loading_cell_load(loading, record, err) &&
           gb_loading_dynamic_create(&own(loading)->motion, loading->world, err);
}

static void finish(struct gb_loading *loading)
{
    gb_loading_dynamic_destroy(own(loading)->motion);
}

static enum gb_step_outcome advance(struct gb_loading *loading, int64_t max_evaluations,
                                    struct gb_event_queue *events, struct gb_error *err)
{
    char text[GB_EVENT_TEXT];
    const enum gb_step_outcome outcome = gb_loading_dynamic_advance(
        own(loading)->motion, loading->world, max_evaluations, text, sizeof text, err);
    gb_event_queue_add(events, text);
    return outcome;
}

/* The next steps are planned when they begin. */
static enum gb_step_outcome after_point(struct gb_loading *loading,
                                        struct gb_event_queue *events,
                                        struct gb_error *err)
{
    (void)loading;
    (void)events;
    (void)err;
    return GB_STEP_MORE;
}

static bool record_motion(struct gb_loading *loading, struct gb_record *record,
                          struct gb_error *err)
{
    return dynamic_record(own(loading)->motion, record, err);
}

static struct gb_loading_report report(const struct gb_loading *loading)
{
    static const enum gb_loading_stage stages[] = {
        [GB_DYNAMIC_RELAX] = GB_LOADING_RELAX,
        [GB_DYNAMIC_LOAD] = GB_LOADING_LOAD,
        [GB_DYNAMIC_HOLD] = GB_LOADING_HOLD,
        [GB_DYNAMIC_OVER] = GB_LOADING_HOLD,
    };
    const struct gb_loading_dynamic_report motion =
        gb_loading_dynamic_report(motion_of(loading));
    struct gb_loading_report report = gb_loading_empty_report();
    report.stage = stages[motion.stage];
    report.iterations = report.evaluations = motion.steps;
    report.residual = gb_world_residual(loading->world);
    report.time_step = motion.time_step;
    report.time = motion.time;
    report.kinetic = motion.kinetic;
    report.work = motion.work;
    report.absorbed = motion.absorbed;
    return report;
}

static const struct gb_verlet *verlet(const struct gb_loading *loading)
{
    return dynamic_verlet(motion_of(loading));
}

static double progress(const struct gb_loading *loading, double pressure, double density)
{
    (void)pressure;
    (void)density;
    return gb_loading_dynamic_report(motion_of(loading)).progress;
}

const struct gb_loading_mode gb_loading_dynamic = {
    .size = sizeof(struct dynamic_loading),
    .build = build,
    .build_from = build_from,
    .finish = finish,
    .advance = advance,
    .after_point = after_point,
    .record = record_motion,
    .report = report,
    .motion = verlet,
    .progress = progress,
};
