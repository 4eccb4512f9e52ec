#include "run/experiment.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "measure/observe.h"
#include "pack/cell/nonaffine.h"
#include "pack/kernel/pair_forces.h"
#include "pack/structure/chain_growth.h"
#include "pack/structure/hilbert.h"
#include "run/change.h"
#include "run/checkpoint.h"
#include "run/experiment_private.h"
#include "scene/changes.h"

static void add_event(struct gb_experiment *experiment, const char *text)
{
    if (text[0] == '\0') {
        return;
    }
    if (experiment->events_count == GB_EXPERIMENT_EVENTS) { /* the oldest gives way */
        experiment->events_first = (experiment->events_first + 1) % GB_EXPERIMENT_EVENTS;
        experiment->events_count--;
    }
    const int at =
        (experiment->events_first + experiment->events_count++) % GB_EXPERIMENT_EVENTS;
    snprintf(experiment->event[at], GB_EVENT_TEXT, "%s", text);
}

bool gb_experiment_event(struct gb_experiment *experiment, char *text, size_t size)
{
    if (experiment->events_count == 0) {
        return false;
    }
    snprintf(text, size, "%s", experiment->event[experiment->events_first]);
    experiment->events_first = (experiment->events_first + 1) % GB_EXPERIMENT_EVENTS;
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
    struct gb_chain_growth grow = gb_chain_growth_from_model(model);
    grow.cancelled = cancelled;
    grow.data = data;
    const bool done = gb_chain_growth_place(&grow, position, err) &&
                      gb_hilbert_sort(model, position, err) &&
                      gb_world_create(&experiment->world, model, position, err);
    gb_alloc_free(position);
    return done;
}

/* Before the packing is grown, so that an unknown relaxer is told at once.  Dynamic
 * scenes have none. */
static bool create_relaxer(struct gb_experiment *experiment, struct gb_error *err)
{
    return experiment->params.kind != GB_KIND_QUASISTATIC ||
           gb_relax_create(&experiment->relax, &experiment->model, err);
}

/* The first relaxation, or the motion. */
static bool begin(struct gb_experiment *experiment, struct gb_error *err)
{
    if (experiment->die) {
        return true;
    }
    gb_quasistatic_init(&experiment->load, &experiment->model);
    if (experiment->relax) {
        gb_relax_start(experiment->relax, experiment->world);
        return true;
    }
    experiment->elastic_start = gb_observe_elastic(experiment->world);
    return gb_dynamic_create(&experiment->motion, experiment->world, err);
}

/* The model of the parameters that hold behind a recorded step. */
static bool freeze(struct gb_experiment *experiment, int64_t step, struct gb_error *err)
{
    struct gb_params effective;
    gb_changes_effective(&experiment->params, step, &effective);
    return gb_model_init(&experiment->model, &effective, err);
}

static bool build(struct gb_experiment *experiment, bool (*cancelled)(void *data),
                  void *data, struct gb_error *err)
{
    return create_relaxer(experiment, err) &&
           grow_world(experiment, cancelled, data, err) &&
           gb_world_evaluate(experiment->world, err) && begin(experiment, err);
}

static bool fill_die(struct gb_experiment *experiment, bool (*cancelled)(void *data),
                     void *data, struct gb_error *err)
{
    return gb_die_run_create(&experiment->die, &experiment->params, &experiment->model,
                             cancelled, data, err);
}

bool gb_experiment_create(struct gb_experiment **out, const struct gb_params *params,
                          bool (*cancelled)(void *data), void *data, struct gb_error *err)
{
    struct gb_experiment *experiment = gb_alloc_array(1, sizeof *experiment, err);
    if (!experiment) {
        return false;
    }
    experiment->params = *params;
    if (!gb_params_check(params, err) || !freeze(experiment, -1, err) ||
        !(params->kind == GB_KIND_DIE ? fill_die(experiment, cancelled, data, err)
                                      : build(experiment, cancelled, data, err))) {
        gb_experiment_destroy(experiment);
        return false;
    }
    *out = experiment;
    return true;
}

bool gb_experiment_resume(struct gb_experiment **out, const struct gb_params *params,
                          struct gb_record *record, struct gb_error *err)
{
    struct gb_experiment *experiment = gb_alloc_array(1, sizeof *experiment, err);
    if (!experiment) {
        return false;
    }
    experiment->params = *params;
    if (!gb_params_check(params, err) ||
        !freeze(experiment, gb_checkpoint_step(record) - 1, err) ||
        !create_relaxer(experiment, err) ||
        !gb_checkpoint_load_world(experiment, record, err) || !begin(experiment, err) ||
        !gb_checkpoint_load(experiment, record, err) ||
        !gb_change_order(experiment, err)) {
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
    gb_dynamic_destroy(experiment->motion);
    gb_experiment_destroy(experiment->husk);
    gb_die_run_destroy(experiment->die);
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
        .p_pa = gb_quasistatic_pressure(&experiment->load, pressure) * pascal,
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
        .central = NAN, /* and these of dies */
        .height_m = NAN,
        .height_change = NAN,
        .target_pa = NAN,
        .floor_over_punch = NAN,
    };
}

/* The next part of the strain step. */
static void strain(struct gb_experiment *experiment)
{
    const int parts = experiment->model.numerics.parts;
    double factor[3];
    for (int k = 0; k < 3; k++) {
        factor[k] =
            parts > 1 ? pow(experiment->factor[k], 1.0 / parts) : experiment->factor[k];
    }
    experiment->part = experiment->strain_due ? 1 : experiment->part + 1;
    gb_world_strain(experiment->world, factor);
    gb_relax_start(experiment->relax, experiment->world);
    experiment->strain_due = false;
}

/* A part was relaxed and another one is due; what it took counts for the step. */
static bool go_on(struct gb_experiment *experiment)
{
    if (experiment->part == 0 || experiment->part >= experiment->model.numerics.parts) {
        return false;
    }
    experiment->spent_iterations += experiment->relax->iterations;
    experiment->spent_evaluations += experiment->relax->evaluations;
    strain(experiment);
    return true;
}

static void unload_event(struct gb_experiment *experiment)
{
    char text[GB_EVENT_TEXT];
    const int branch = experiment->load.branch;
    snprintf(text, sizeof text, "unloading from %.6g MPa (asked for %.6g MPa)",
             1e-6 * experiment->point.p_pa,
             1e-6 * experiment->params.unload_from_pa[branch - 1]);
    add_event(experiment, text);
}

static void restore_event(struct gb_experiment *experiment)
{
    char text[GB_EVENT_TEXT];
    if (!experiment->load.endless) {
        add_event(experiment, "unloaded; loading goes on from the saved state");
        return;
    }
    snprintf(text, sizeof text,
             "guard: the cell has grown by half and still carries %.3g MPa; unloading is "
             "given up, loading goes on from the saved state",
             1e-6 * experiment->point.p_pa);
    add_event(experiment, text);
}

/* After a recorded state: what the programme orders next. */
static bool obey(struct gb_experiment *experiment, struct gb_error *err)
{
    double pressure[3];
    for (;;) {
        pressures(experiment, pressure);
        const double density = gb_observe_density(experiment->world);
        switch (gb_quasistatic_next(&experiment->load, pressure, density,
                                    experiment->factor)) {
        case GB_QUASISTATIC_RESTORE:
            restore_event(experiment);
            /* the evaluation brings the forces of the restored state, so that the
             * programme sees its pressure */
            if (!gb_world_copy_restore(experiment->world, experiment->branch, err) ||
                !gb_world_evaluate(experiment->world, err)) {
                return false;
            }
            measure(experiment, &experiment->shown);
            continue;
        case GB_QUASISTATIC_END:
            experiment->over = true;
            return true;
        case GB_QUASISTATIC_UNLOAD:
            unload_event(experiment);
            if (!gb_world_copy_save(experiment->world, &experiment->branch, err)) {
                return false;
            }
            break;
        case GB_QUASISTATIC_STRAIN:
            break;
        }
        experiment->have_good =
            gb_world_copy_save(experiment->world, &experiment->good, err);
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
           gb_world_copy_restore(experiment->world, experiment->good, err) &&
           gb_world_evaluate(experiment->world, err);
}

static enum gb_step_outcome stop(struct gb_experiment *experiment)
{
    struct gb_error ignored;
    take_back(experiment, &ignored);
    experiment->over = experiment->stopped = true;
    return GB_STEP_STOPPED;
}

/* What a dynamic run knows beside the state: stage, time, energies in J. */
static void measure_motion(const struct gb_experiment *experiment, struct gb_point *point)
{
    static const int branch[] = {GB_BRANCH_RELAX, GB_BRANCH_LOAD, GB_BRANCH_HOLD,
                                 GB_BRANCH_HOLD};
    const struct gb_model *model = &experiment->model;
    const struct gb_dynamic_report report = gb_dynamic_report(experiment->motion);
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

/* What the parameters change behind this point, told as an event. */
static bool change(struct gb_experiment *experiment, struct gb_error *err)
{
    char text[GB_EVENT_TEXT];
    if (experiment->over || !gb_changes_due(&experiment->params, experiment->step - 1)) {
        return true;
    }
    if (!gb_change_apply(experiment, err)) {
        return false;
    }
    snprintf(text, sizeof text, "changes behind step %" PRId64 ", density %.4f: %s",
             experiment->point.step, experiment->point.density,
             experiment->params.changes);
    add_event(experiment, text);
    return true;
}

static enum gb_step_outcome record(struct gb_experiment *experiment, struct gb_error *err)
{
    measure(experiment, &experiment->point);
    experiment->point.iterations =
        experiment->spent_iterations + experiment->relax->iterations;
    experiment->point.evaluations =
        experiment->spent_evaluations + experiment->relax->evaluations;
    experiment->spent_iterations = experiment->spent_evaluations = 0;
    experiment->shown = experiment->point;
    experiment->step++;
    gb_quasistatic_recover(&experiment->load);
    if (!obey(experiment, err) || !change(experiment, err)) {
        experiment->over = experiment->stopped = true;
        return GB_STEP_STOPPED;
    }
    return GB_STEP_POINT;
}

static enum gb_step_outcome advance_motion(struct gb_experiment *experiment,
                                           int64_t max_steps, struct gb_error *err)
{
    char text[GB_EVENT_TEXT];
    const enum gb_step_outcome outcome = gb_dynamic_advance(
        experiment->motion, experiment->world, max_steps, text, sizeof text, err);
    add_event(experiment, text);
    switch (outcome) {
    case GB_STEP_MORE:
        return GB_STEP_MORE;
    case GB_STEP_POINT:
        measure(experiment, &experiment->point);
        measure_motion(experiment, &experiment->point);
        experiment->shown = experiment->point;
        experiment->step++;
        return GB_STEP_POINT;
    case GB_STEP_DONE:
        experiment->over = true;
        return GB_STEP_DONE;
    case GB_STEP_STOPPED:
        break;
    }
    add_event(experiment, err->text);
    experiment->over = experiment->stopped = true;
    return GB_STEP_STOPPED;
}

static enum gb_step_outcome record_die(struct gb_experiment *experiment)
{
    char text[GB_EVENT_TEXT];
    gb_die_run_measure(experiment->die, &experiment->point);
    experiment->point.step = experiment->step++;
    experiment->shown = experiment->point;
    gb_die_run_judge(experiment->die, &experiment->point, text, sizeof text);
    add_event(experiment, text);
    return GB_STEP_POINT;
}

static enum gb_step_outcome advance_die(struct gb_experiment *experiment,
                                        int64_t max_steps, struct gb_error *err)
{
    char text[GB_EVENT_TEXT];
    const enum gb_step_outcome outcome =
        gb_die_stages_advance(experiment->die->programme, experiment->die->bed, max_steps,
                              text, sizeof text, err);
    add_event(experiment, text);
    switch (outcome) {
    case GB_STEP_MORE:
        return GB_STEP_MORE;
    case GB_STEP_POINT:
        return record_die(experiment);
    case GB_STEP_DONE:
        experiment->over = true;
        return GB_STEP_DONE;
    case GB_STEP_STOPPED:
        break;
    }
    add_event(experiment, err->text);
    experiment->over = experiment->stopped = true;
    return GB_STEP_STOPPED;
}

/* The first relaxation has nothing to be compared with. */
static enum gb_guard_action judge_departure(struct gb_experiment *experiment, char *text,
                                            size_t size)
{
    text[0] = '\0';
    if (!experiment->have_good) {
        return GB_GUARD_ACCEPT;
    }
    const struct gb_nonaffine departure =
        gb_nonaffine_since(experiment->world, experiment->good);
    return gb_guard_departure(&experiment->guard, &departure, text, size);
}

enum gb_step_outcome gb_experiment_advance(struct gb_experiment *experiment,
                                           int64_t max_evaluations, struct gb_error *err)
{
    if (experiment->over) {
        return GB_STEP_DONE;
    }
    struct gb_error local;
    struct gb_error *why = err ? err : &local;
    if (experiment->motion) {
        return advance_motion(experiment, max_evaluations, why);
    }
    if (experiment->die) {
        return advance_die(experiment, max_evaluations, why);
    }
    if (experiment->strain_due) {
        strain(experiment);
    }
    const enum gb_relax_outcome outcome =
        gb_relax_advance(experiment->relax, experiment->world, max_evaluations, why);
    if (outcome == GB_RELAX_MORE) {
        return GB_STEP_MORE;
    }
    char text[GB_EVENT_TEXT];
    enum gb_guard_action action = gb_guard_judge(
        &experiment->guard, outcome, experiment->relax, text, sizeof text, why);
    if (action == GB_GUARD_ACCEPT) {
        add_event(experiment, text);
        if (go_on(experiment)) {
            return GB_STEP_MORE;
        }
        action = judge_departure(experiment, text, sizeof text);
    }
    switch (action) {
    case GB_GUARD_ACCEPT:
        add_event(experiment, text);
        return record(experiment, why);
    case GB_GUARD_RETRY:
        if (!take_back(experiment, why)) {
            return stop(experiment);
        }
        add_event(experiment, text);
        gb_quasistatic_halve(&experiment->load, experiment->factor);
        experiment->strain_due = true;
        return GB_STEP_MORE;
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
    if (experiment->die) {
        gb_die_run_observe(experiment->die, snapshot);
        return;
    }
    gb_observe_contacts(experiment->world, &counts, snapshot->histogram,
                        GB_SNAPSHOT_HISTOGRAM, NULL);
    gb_observe_rose(experiment->world, GB_SNAPSHOT_ROSE, snapshot->rose);
    snapshot->evaluations = gb_world_evaluations(experiment->world);
    snapshot->live_residual = gb_world_residual(experiment->world);
    const double pressure = experiment->point.p_pa / experiment->model.pascal_per_stress;
    if (experiment->motion) {
        const struct gb_dynamic_report report = gb_dynamic_report(experiment->motion);
        snapshot->progress = report.progress;
        snapshot->time_step_s =
            report.time_step * experiment->model.dynamics.second_per_time;
        return;
    }
    snapshot->progress = experiment->over && !experiment->stopped
                             ? 1.0
                             : gb_quasistatic_progress(&experiment->load, pressure,
                                                       experiment->point.density,
                                                       experiment->model.start_density);
}

static void copy_pairs(const struct gb_world *world, struct gb_state *state)
{
    const struct gb_pair_list *near = &gb_world_pairs(world)->near;
    const struct gb_contacts *contacts = gb_world_contacts(world);
    struct gb_pair_forces forces;
    int64_t line = 0;
    gb_pair_forces_init(&forces, world, true);
    for (int64_t i = 0; i < state->count; i++) {
        for (int64_t k = near->start[i]; k < near->start[i + 1]; k++) {
            const double deepest = gb_contacts_deepest(contacts, k);
            if (deepest < 0.0) {
                continue;
            }
            double r[3];
            gb_world_branch_vector(world, near, i, k, r);
            state->pair[2 * line] = (int32_t)i;
            state->pair[2 * line + 1] = near->other[k];
            double *force = state->pair_force + 3 * line;
            gb_pair_forces_at(&forces, k, force);
            state->pair_normal[line] = gb_vec_dot(force, r) / gb_vec_length(r);
            state->pair_bridged[line++] = deepest > 0.0;
        }
    }
}

static bool world_state(const struct gb_experiment *experiment, struct gb_state **out,
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
        state->radius[i] = 0.5 * gb_world_diameter(world, i);
    }
    copy_pairs(world, state);
    measure(experiment, &state->point);
    return true;
}

bool gb_experiment_state(const struct gb_experiment *experiment, struct gb_state **out,
                         struct gb_error *err)
{
    const struct gb_model *model = &experiment->model;
    if (!(experiment->die ? gb_die_run_state(experiment->die, out, err)
                          : world_state(experiment, out, err))) {
        return false;
    }
    struct gb_state *state = *out;
    state->point.step = experiment->step;
    state->metre_per_length = model->metre_per_length;
    state->pascal_per_stress = model->pascal_per_stress;
    state->seed = model->seed;
    snprintf(state->preset, sizeof state->preset, "%s", experiment->params.title);
    snprintf(state->version, sizeof state->version, "%s", GB_VERSION);
    return true;
}

int64_t gb_experiment_evaluations(const struct gb_experiment *experiment)
{
    return experiment->die ? experiment->die->bed->evaluations
                           : gb_world_evaluations(experiment->world);
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
