#include "run/experiment.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "measure/observe.h"
#include "pack/grow.h"
#include "pack/world.h"
#include "solve/guard.h"
#include "solve/load.h"
#include "solve/motion.h"
#include "solve/relax.h"

enum { EVENTS = 32, EVENT_TEXT = 640 };

struct gb_experiment {
    struct gb_params params;
    struct gb_model model;
    struct gb_world *world;
    struct gb_world_copy *good;   /* before the strain step under way */
    struct gb_world_copy *branch; /* where the unloading branch began */
    struct gb_relax *relax;
    struct gb_motion *motion; /* dynamic scenes only, instead of relax and load */
    double elastic_start;     /* elastic energy when the motion began */
    struct gb_load load;
    struct gb_guard guard;
    double factor[3]; /* strain step under way, or to be taken next */
    bool strain_due;  /* it waits for the next slice, so that between slices after
                       * a point forces, places and histories belong together */
    int64_t step;     /* strain steps recorded */
    int64_t spent_iterations, spent_evaluations; /* by attempts that were taken back */
    bool have_good;
    bool over, stopped;
    struct gb_point point;
    char event[EVENTS][EVENT_TEXT];
    int events_first, events_count;
};

static void add_event(struct gb_experiment *experiment, const char *text)
{
    if (text[0] == '\0') {
        return;
    }
    if (experiment->events_count == EVENTS) { /* the oldest gives way */
        experiment->events_first = (experiment->events_first + 1) % EVENTS;
        experiment->events_count--;
    }
    const int at = (experiment->events_first + experiment->events_count++) % EVENTS;
    snprintf(experiment->event[at], EVENT_TEXT, "%s", text);
}

bool gb_experiment_event(struct gb_experiment *experiment, char *text, size_t size)
{
    if (experiment->events_count == 0) {
        return false;
    }
    snprintf(text, size, "%s", experiment->event[experiment->events_first]);
    experiment->events_first = (experiment->events_first + 1) % EVENTS;
    experiment->events_count--;
    return true;
}

static bool grow_world(struct gb_experiment *experiment, bool (*cancelled)(void *data),
                       void *data, struct gb_error *err)
{
    const struct gb_model *model = &experiment->model;
    double *position = gb_alloc_array(3 * (size_t)model->count, sizeof *position, err);
    if (!position) {
        return false;
    }
    struct gb_grow grow = gb_grow_of(model);
    grow.cancelled = cancelled;
    grow.data = data;
    const bool done = gb_grow_place(&grow, position, err) &&
                      gb_world_create(&experiment->world, model, position, err);
    gb_alloc_free(position);
    return done;
}

/* Before the packing is grown, so that an unknown relaxer is told at once.  Dynamic
 * scenes have none. */
static bool create_relaxer(struct gb_experiment *experiment, struct gb_error *err)
{
    return experiment->params.kind == GB_KIND_DYNAMIC ||
           gb_relax_create(&experiment->relax, &experiment->model, err);
}

/* The first relaxation, or the motion. */
static bool begin(struct gb_experiment *experiment, struct gb_error *err)
{
    gb_load_init(&experiment->load, &experiment->model);
    if (experiment->relax) {
        gb_relax_start(experiment->relax, experiment->world);
        return true;
    }
    experiment->elastic_start = gb_observe_elastic(experiment->world);
    return gb_motion_create(&experiment->motion, experiment->world, err);
}

bool gb_experiment_create(struct gb_experiment **out, const struct gb_params *params,
                          bool (*cancelled)(void *data), void *data, struct gb_error *err)
{
    struct gb_experiment *experiment = gb_alloc_array(1, sizeof *experiment, err);
    if (!experiment) {
        return false;
    }
    experiment->params = *params;
    if (!gb_params_check(params, err) ||
        !gb_model_init(&experiment->model, params, err) ||
        !create_relaxer(experiment, err) ||
        !grow_world(experiment, cancelled, data, err) ||
        !gb_world_evaluate(experiment->world, err) || !begin(experiment, err)) {
        gb_experiment_destroy(experiment);
        return false;
    }
    *out = experiment;
    return true;
}

void gb_experiment_destroy(struct gb_experiment *experiment)
{
    if (!experiment) {
        return;
    }
    gb_world_destroy(experiment->world);
    gb_world_copy_destroy(experiment->good);
    gb_world_copy_destroy(experiment->branch);
    gb_relax_destroy(experiment->relax);
    gb_motion_destroy(experiment->motion);
    gb_alloc_free(experiment);
}

/* Normal pressures of the world, E. */
static void pressures(const struct gb_experiment *experiment, double pressure[3])
{
    double tensor[3][3];
    gb_observe_pressure(experiment->world, tensor);
    for (int k = 0; k < 3; k++) {
        pressure[k] = tensor[k][k];
    }
}

static void measure(const struct gb_experiment *experiment, struct gb_point *point)
{
    const double pascal = experiment->model.pascal_per_stress;
    double pressure[3];
    struct gb_contact_counts counts;
    pressures(experiment, pressure);
    gb_observe_contacts(experiment->world, &counts, NULL, 0, NULL);
    const int branch = experiment->load.branch;
    *point = (struct gb_point){
        .branch = branch,
        .branch_from_pa =
            branch > 0 ? experiment->params.unload_from_pa[branch - 1] : 0.0,
        .step = experiment->step,
        .density = gb_observe_density(experiment->world),
        .px_pa = pressure[0] * pascal,
        .py_pa = experiment->model.dimension == 3 ? pressure[1] * pascal : (double)NAN,
        .pz_pa = pressure[2] * pascal,
        .p_pa = gb_load_pressure(&experiment->load, pressure) * pascal,
        .coordination = counts.coordination,
        .bridged =
            counts.contacts > 0 ? (double)counts.bridged / (double)counts.contacts : 0.0,
        .rattlers = (double)counts.rattlers / (double)experiment->model.count,
        .residual = gb_world_residual(experiment->world),
        .time_s = NAN, /* as all that follow: of dynamic runs */
        .kinetic = NAN,
        .work = NAN,
        .elastic = NAN,
        .dissipated = NAN,
        .energy_residual = NAN,
    };
}

static void strain(struct gb_experiment *experiment)
{
    gb_world_strain(experiment->world, experiment->factor);
    gb_relax_start(experiment->relax, experiment->world);
    experiment->strain_due = false;
}

static void unload_event(struct gb_experiment *experiment)
{
    char text[EVENT_TEXT];
    const int branch = experiment->load.branch;
    snprintf(text, sizeof text, "unloading from %.6g MPa (asked for %.6g MPa)",
             1e-6 * experiment->point.p_pa,
             1e-6 * experiment->params.unload_from_pa[branch - 1]);
    add_event(experiment, text);
}

/* After a recorded state: what the programme orders next. */
static bool obey(struct gb_experiment *experiment, struct gb_error *err)
{
    double pressure[3];
    for (;;) {
        pressures(experiment, pressure);
        const double density = gb_observe_density(experiment->world);
        switch (gb_load_next(&experiment->load, pressure, density, experiment->factor)) {
        case GB_LOAD_RESTORE:
            add_event(experiment, "unloaded; loading goes on from the saved state");
            /* the evaluation brings the forces of the restored state, so that the
             * programme sees its pressure */
            if (!gb_world_restore(experiment->world, experiment->branch, err) ||
                !gb_world_evaluate(experiment->world, err)) {
                return false;
            }
            continue;
        case GB_LOAD_END:
            experiment->over = true;
            return true;
        case GB_LOAD_UNLOAD:
            unload_event(experiment);
            if (!gb_world_save(experiment->world, &experiment->branch, err)) {
                return false;
            }
            break;
        case GB_LOAD_STRAIN:
            break;
        }
        experiment->have_good = gb_world_save(experiment->world, &experiment->good, err);
        experiment->strain_due = experiment->have_good;
        return experiment->have_good;
    }
}

/* Back to the state before the strain step under way. */
static bool take_back(struct gb_experiment *experiment, struct gb_error *err)
{
    experiment->spent_iterations += experiment->relax->iterations;
    experiment->spent_evaluations += experiment->relax->evaluations;
    return experiment->have_good &&
           gb_world_restore(experiment->world, experiment->good, err) &&
           gb_world_evaluate(experiment->world, err);
}

static enum gb_advance stop(struct gb_experiment *experiment)
{
    struct gb_error ignored;
    take_back(experiment, &ignored);
    experiment->over = experiment->stopped = true;
    return GB_ADVANCE_STOPPED;
}

/* What a dynamic run knows beside the state: stage, time, energies in J. */
static void measure_motion(const struct gb_experiment *experiment, struct gb_point *point)
{
    static const int branch[] = {GB_BRANCH_RELAX, GB_BRANCH_LOAD, GB_BRANCH_HOLD,
                                 GB_BRANCH_HOLD};
    const struct gb_model *model = &experiment->model;
    const struct gb_motion_report report = gb_motion_report(experiment->motion);
    const double joule = model->newton_per_force * model->metre_per_length;
    const double stored =
        gb_observe_elastic(experiment->world) - experiment->elastic_start;
    const double lost = report.work - report.kinetic - report.absorbed;
    point->branch = branch[report.stage];
    point->branch_from_pa = 0.0;
    point->iterations = report.steps;
    point->evaluations = report.steps;
    point->time_s = report.time * model->dynamics.second_per_time;
    point->kinetic = report.kinetic * joule;
    point->work = report.work * joule;
    point->elastic = stored * joule;
    point->dissipated = (report.absorbed - stored) * joule;
    point->energy_residual = report.work != 0.0 ? lost / fabs(report.work) : (double)NAN;
}

static enum gb_advance record(struct gb_experiment *experiment, struct gb_error *err)
{
    measure(experiment, &experiment->point);
    experiment->point.iterations =
        experiment->spent_iterations + experiment->relax->iterations;
    experiment->point.evaluations =
        experiment->spent_evaluations + experiment->relax->evaluations;
    experiment->spent_iterations = experiment->spent_evaluations = 0;
    experiment->step++;
    gb_load_recover(&experiment->load);
    if (!obey(experiment, err)) {
        experiment->over = experiment->stopped = true;
        return GB_ADVANCE_STOPPED;
    }
    return GB_ADVANCE_POINT;
}

static enum gb_advance advance_motion(struct gb_experiment *experiment, int64_t max_steps,
                                      struct gb_error *err)
{
    char text[EVENT_TEXT];
    const enum gb_motion_outcome outcome = gb_motion_advance(
        experiment->motion, experiment->world, max_steps, text, sizeof text, err);
    add_event(experiment, text);
    switch (outcome) {
    case GB_MOTION_MORE:
        return GB_ADVANCE_MORE;
    case GB_MOTION_POINT:
        measure(experiment, &experiment->point);
        measure_motion(experiment, &experiment->point);
        experiment->step++;
        return GB_ADVANCE_POINT;
    case GB_MOTION_DONE:
        experiment->over = true;
        return GB_ADVANCE_DONE;
    case GB_MOTION_STOPPED:
        break;
    }
    add_event(experiment, err->text);
    experiment->over = experiment->stopped = true;
    return GB_ADVANCE_STOPPED;
}

enum gb_advance gb_experiment_advance(struct gb_experiment *experiment,
                                      int64_t max_evaluations, struct gb_error *err)
{
    if (experiment->over) {
        return GB_ADVANCE_DONE;
    }
    struct gb_error local;
    struct gb_error *why = err ? err : &local;
    if (experiment->motion) {
        return advance_motion(experiment, max_evaluations, why);
    }
    if (experiment->strain_due) {
        strain(experiment);
    }
    const enum gb_relax_outcome outcome =
        gb_relax_advance(experiment->relax, experiment->world, max_evaluations, why);
    if (outcome == GB_RELAX_MORE) {
        return GB_ADVANCE_MORE;
    }
    char text[EVENT_TEXT];
    switch (gb_guard_judge(&experiment->guard, outcome, experiment->relax, text,
                           sizeof text, why)) {
    case GB_GUARD_ACCEPT:
        add_event(experiment, text);
        return record(experiment, why);
    case GB_GUARD_RETRY:
        if (!take_back(experiment, why)) {
            return stop(experiment);
        }
        add_event(experiment, text);
        gb_load_halve(&experiment->load, experiment->factor);
        experiment->strain_due = true;
        return GB_ADVANCE_MORE;
    case GB_GUARD_STOP:
        break;
    }
    add_event(experiment, why->text);
    return stop(experiment);
}

const struct gb_point *gb_experiment_point(const struct gb_experiment *experiment)
{
    return &experiment->point;
}

void gb_experiment_observe(const struct gb_experiment *experiment,
                           struct gb_snapshot *snapshot)
{
    struct gb_contact_counts counts;
    snapshot->now = experiment->point;
    snapshot->now_valid = experiment->step > 0;
    gb_observe_contacts(experiment->world, &counts, snapshot->histogram,
                        GB_SNAPSHOT_HISTOGRAM, NULL);
    gb_observe_rose(experiment->world, GB_SNAPSHOT_ROSE, snapshot->rose);
    snapshot->evaluations = gb_world_evaluations(experiment->world);
    snapshot->live_residual = gb_world_residual(experiment->world);
    const double pressure = experiment->point.p_pa / experiment->model.pascal_per_stress;
    if (experiment->motion) {
        const struct gb_motion_report report = gb_motion_report(experiment->motion);
        snapshot->progress = report.progress;
        snapshot->time_step_s =
            report.time_step * experiment->model.dynamics.second_per_time;
        return;
    }
    snapshot->progress =
        experiment->over && !experiment->stopped
            ? 1.0
            : gb_load_progress(&experiment->load, pressure, experiment->point.density,
                               experiment->model.start_density);
}

static void copy_pairs(const struct gb_world *world, struct gb_state *state)
{
    const struct gb_pair_list *near = &gb_world_pairs(world)->near;
    const double *deepest = gb_world_contacts(world)->deepest;
    int64_t line = 0;
    for (int64_t i = 0; i < state->count; i++) {
        for (int64_t k = near->start[i]; k < near->start[i + 1]; k++) {
            if (deepest[k] < 0.0) {
                continue;
            }
            double r[3];
            gb_world_arm(world, near, i, k, r);
            state->pair[2 * line] = (int32_t)i;
            state->pair[2 * line + 1] = near->other[k];
            double *force = state->pair_force + 3 * line;
            gb_world_force(world, k, force);
            state->pair_normal[line] = gb_vec_dot(force, r) / gb_vec_length(r);
            state->pair_bridged[line++] = deepest[k] > 0.0;
        }
    }
}

bool gb_experiment_state(const struct gb_experiment *experiment, struct gb_state **out,
                         struct gb_error *err)
{
    const struct gb_world *world = experiment->world;
    const struct gb_model *model = &experiment->model;
    struct gb_contact_counts counts;
    gb_observe_contacts(world, &counts, NULL, 0, NULL);
    if (!gb_state_create(out, model->count, counts.contacts, err)) {
        return false;
    }
    struct gb_state *state = *out;
    state->dimension = model->dimension;
    memcpy(state->cell, gb_world_cell(world)->edge, sizeof state->cell);
    gb_observe_contacts(world, &counts, NULL, 0, state->contacts);
    for (int64_t i = 0; i < model->count; i++) {
        memcpy(state->position + 3 * i, gb_world_position(world) + 3 * i,
               3 * sizeof(double));
        gb_cell_wrap(gb_world_cell(world), state->position + 3 * i);
        state->radius[i] = 0.5;
    }
    copy_pairs(world, state);
    measure(experiment, &state->point);
    state->metre_per_length = model->metre_per_length;
    state->pascal_per_stress = model->pascal_per_stress;
    state->seed = model->seed;
    snprintf(state->preset, sizeof state->preset, "%s", experiment->params.title);
    snprintf(state->version, sizeof state->version, "%s", GB_VERSION);
    return true;
}

const struct gb_model *gb_experiment_model(const struct gb_experiment *experiment)
{
    return &experiment->model;
}

const struct gb_params *gb_experiment_params(const struct gb_experiment *experiment)
{
    return &experiment->params;
}

const struct gb_world *gb_experiment_world(const struct gb_experiment *experiment)
{
    return experiment->world;
}
