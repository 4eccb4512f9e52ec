/* One simulation: a loading of a packing (solve/loading), measured after every step.
 *
 * An experiment advances in slices, each of a number of force evaluations, so that its
 * thread can answer requests between slices.  After each step the packing is measured
 * and recorded as a point: a row of curve.csv in SI.  A checkpoint copies everything
 * that a resumed run needs.
 *
 * Below: the measures of a point, copies of the packing for pictures and files, then
 * the life of an experiment. */
#include "run/experiment.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/portable.h"
#include "base/vec.h"
#include "greenbody/curve.h"
#include "greenbody/snapshot.h"
#include "io/point_columns.h"
#include "io/state.h"
#include "io/state_record.h"
#include "measure/observe.h"
#include "pack/cell/world.h"
#include "pack/kernel/fabric_sums.h"
#include "pack/kernel/pair_forces.h"
#include "run/change.h"
#include "run/checkpoint.h"
#include "run/experiment_private.h"
#include "scene/field/changes.h"
#include "scene/imported/imported.h"
#include "solve/loading/loading.h"
#include "solve/loading/loading_cell.h"

/* ---- Measures of a point; its members step and seconds are the caller's. ---- */

static int branch_of(const struct gb_loading_report *report)
{
    static const int branch[] = {[GB_LOADING_RELAX] = GB_BRANCH_RELAX,
                                 [GB_LOADING_LOAD] = GB_BRANCH_LOAD,
                                 [GB_LOADING_HOLD] = GB_BRANCH_HOLD,
                                 [GB_LOADING_UNLOAD] = GB_BRANCH_UNLOAD,
                                 [GB_LOADING_CONFINED] = GB_BRANCH_CONFINED,
                                 [GB_LOADING_EJECT] = GB_BRANCH_EJECT,
                                 [GB_LOADING_EJECTED] = GB_BRANCH_EJECTED};
    return report->unloading > 0 ? report->unloading
           : report->begun > 1   ? GB_BRANCH_LEG - report->begun
                                 : branch[report->stage];
}

static double second_per_time(const struct gb_loading *loading)
{
    return loading->bed ? loading->model->die.second_per_time
                        : loading->model->dynamics.second_per_time;
}

/* Shear pressures, strain of the cell, fabric of the contacts. */
static void measure_tensors(const struct gb_loading *loading, const double pressure[3][3],
                            const struct gb_fabric *fabric, struct gb_point *point)
{
    const struct gb_model *model = loading->model;
    const struct gb_cell *cell = gb_world_cell(loading->world);
    const double pascal = model->pascal_per_stress;
    static const int row[3] = {0, 0, 1}, column[3] = {1, 2, 2};
    for (int k = 0; k < 3; k++) {
        point->shear_pa[k] =
            0.5 * pascal * (pressure[row[k]][column[k]] + pressure[column[k]][row[k]]);
        point->strain[k] = gb_portable_log(model->edges[k] / cell->edge[k]);
        point->strain[3 + k] = cell->shear[k];
    }
    point->q_pa = pascal * gb_observe_deviatoric(pressure, model->dimension);
    point->asymmetry = gb_observe_asymmetry(pressure, model->dimension);
    memcpy(point->fabric, fabric->all, sizeof point->fabric);
    memcpy(point->anisotropy, fabric->anisotropy, sizeof point->anisotropy);
    if (model->dimension == 2) {
        point->shear_pa[0] = point->shear_pa[2] = NAN;
        point->strain[1] = point->strain[3] = point->strain[5] = NAN;
        point->fabric[1] = point->fabric[3] = point->fabric[5] = NAN;
    }
}

/* state.h5 does not name the stages of a run at a given rate. */
static int branch_in_cell(const struct gb_loading *loading,
                          const struct gb_loading_report *report)
{
    return gb_loading_kind_of(loading->params)->given_rate ? GB_BRANCH_RELAX
                                                           : branch_of(report);
}

static void measure_cell(const struct gb_loading *loading, struct gb_point *point)
{
    const struct gb_model *model = loading->model;
    const struct gb_loading_report report = loading->mode->report(loading);
    const struct gb_compressed_axes axes = gb_loading_cell_of(model);
    const double pascal = model->pascal_per_stress;
    double tensor[3][3];
    struct gb_contact_counts counts;
    struct gb_fabric fabric;
    gb_observe_fabric(loading->world, tensor, &fabric);
    const double pressure[3] = {tensor[0][0], tensor[1][1], tensor[2][2]};
    gb_observe_contacts(loading->world, &counts, NULL, 0, NULL);
    *point = (struct gb_point){
        .branch = branch_in_cell(loading, &report),
        .branch_from_pa = report.unloading > 0
                              ? loading->params->unload_from_pa[report.unloading - 1]
                              : 0.0,
        .density = gb_observe_density(loading->world),
        .px_pa = pressure[0] * pascal,
        .py_pa = model->dimension == 3 ? pressure[1] * pascal : (double)NAN,
        .pz_pa = pressure[2] * pascal,
        .p_pa = gb_loading_cell_mean(&axes, pressure) * pascal,
        .coordination = counts.coordination,
        .bridged =
            counts.contacts > 0 ? (double)counts.bridged / (double)counts.contacts : 0.0,
        .rattlers = (double)counts.rattlers / (double)model->count,
        .residual = report.residual,
    };
    gb_point_columns_clear(point);
    measure_tensors(loading, (const double(*)[3])tensor, &fabric, point);
    point->unrelaxed = report.unrelaxed;
    point->leg = report.leg > 0 ? report.leg : (double)NAN;
}

/* Forces on the die and what the compact has sprung back. */
static void measure_cycle(const struct gb_loading *loading,
                          const struct gb_loading_report *report, struct gb_point *point)
{
    const struct gb_model *model = loading->model;
    const double pascal = model->pascal_per_stress;
    double third[3], whole = 0.0;
    gb_observe_die_wall(loading->bed, report->contact, 1, &whole);
    gb_observe_die_wall(loading->bed, report->contact, 3, third);
    for (int k = 0; k < 3; k++) {
        point->wall_third_pa[k] = third[k] * pascal;
    }
    point->floor_pa = report->floor * pascal;
    point->wall_pa = whole * pascal;
    point->wall_friction_n = report->drag * model->newton_per_force;
    point->punch_work = report->work * model->newton_per_force * model->metre_per_length;
    point->axial_springback = report->axial;
    point->radial_springback = report->radial;
    point->welded = report->welded;
}

static void measure_die(const struct gb_loading *loading, struct gb_point *point)
{
    const struct gb_model *model = loading->model;
    const struct gb_loading_report report = loading->mode->report(loading);
    const double pascal = model->pascal_per_stress;
    struct gb_contact_counts counts;
    gb_observe_die_contacts(loading->bed, &counts, NULL, 0, NULL);
    *point = (struct gb_point){
        .branch = branch_of(&report),
        .density = gb_observe_die_density(loading->bed, report.height),
        .px_pa = report.pressure[0] * pascal,
        .py_pa = report.pressure[1] * pascal,
        .pz_pa = report.pressure[2] * pascal,
        .p_pa = report.pressure[2] * pascal,
        .coordination = counts.coordination,
        .bridged = NAN,
        .rattlers = (double)counts.rattlers / (double)model->count,
        .residual = report.residual,
        .iterations = report.iterations,
        .evaluations = report.evaluations,
    };
    gb_point_columns_clear(point);
    point->time_s = report.time * model->die.second_per_time;
    point->central =
        gb_observe_die_central(loading->bed, report.height, model->die.central_radius);
    point->height_m = report.height * model->metre_per_length;
    point->height_change = report.height0 > 0.0
                               ? (report.height - report.height0) / report.height0
                               : (double)NAN;
    point->target_pa = report.target_pressure * pascal;
    point->floor_over_punch = report.floor_over_punch;
    measure_cycle(loading, &report, point);
    if (report.stage == GB_LOADING_EJECTED) { /* out of the bore */
        point->density /= (1.0 + report.radial) * (1.0 + report.radial);
    }
}

/* What the packing is: density, pressures, contacts.  In a periodic cell iterations,
 * evaluations, time and energies are left empty. */
static void measure_packing(const struct gb_loading *loading, struct gb_point *point)
{
    if (loading->bed) {
        measure_die(loading, point);
    } else {
        measure_cell(loading, point);
    }
}

/* Energies in J; elastic and dissipated since the start. */
static void measure_energies(const struct gb_loading *loading,
                             const struct gb_loading_report *report, double elastic_start,
                             struct gb_point *point)
{
    const struct gb_model *model = loading->model;
    const double joule = model->newton_per_force * model->metre_per_length;
    const double elastic = gb_observe_elastic(loading->world) - elastic_start;
    const double lost = report->work - report->kinetic - report->absorbed;
    point->kinetic = report->kinetic * joule;
    point->work = report->work * joule;
    point->elastic = elastic * joule;
    point->dissipated = (report->absorbed - elastic) * joule;
    point->energy_residual =
        report->work != 0.0 ? lost / fabs(report->work) : (double)NAN;
}

/* A recorded point: also what it took to get there, time and energies.  elastic_start:
 * elastic energy at the start of the run, E d^3. */
static void measure_step(const struct gb_loading *loading, double elastic_start,
                         struct gb_point *point)
{
    const struct gb_loading_kind *kind = gb_loading_kind_of(loading->params);
    const struct gb_loading_report report = loading->mode->report(loading);
    measure_packing(loading, point);
    point->branch = branch_of(&report);
    point->iterations = report.iterations;
    point->evaluations = report.evaluations;
    if (kind->follows_time) {
        point->time_s = report.time * second_per_time(loading);
    }
    if (kind->columns == GB_COLUMNS_ENERGY) {
        measure_energies(loading, &report, elastic_start, point);
    }
}

/* Before its first point a run in a die is known by these alone. */
static void measure_stage(const struct gb_loading *loading, double coordination,
                          struct gb_stage_report *report)
{
    const double none = (double)NAN;
    *report = (struct gb_stage_report){.value = none,
                                       .goal = none,
                                       .share = none,
                                       .timed = none,
                                       .time_s = none,
                                       .height_m = none,
                                       .kinetic_j = none,
                                       .coordination = coordination};
    if (loading->mode->stage == NULL) {
        return;
    }
    loading->mode->stage(loading, report);
    if (loading->bed->die.funnel) {
        report->height_m =
            gb_observe_die_filled(loading->bed) * loading->model->metre_per_length;
    }
}

/* Contacts, forces and solver as they are now, for the screen. */
static void measure_live(const struct gb_loading *loading, struct gb_snapshot *snapshot)
{
    const struct gb_loading_report report = loading->mode->report(loading);
    struct gb_contact_counts counts;
    if (loading->bed) {
        gb_observe_die_contacts(loading->bed, &counts, snapshot->histogram,
                                GB_SNAPSHOT_HISTOGRAM, NULL);
        gb_observe_die_rose(loading->bed, GB_SNAPSHOT_ROSE, snapshot->rose);
    } else {
        gb_observe_contacts(loading->world, &counts, snapshot->histogram,
                            GB_SNAPSHOT_HISTOGRAM, NULL);
        gb_observe_rose(loading->world, GB_SNAPSHOT_ROSE, snapshot->rose);
    }
    measure_stage(loading, counts.coordination, &snapshot->stage);
    snapshot->evaluations = gb_loading_evaluations(loading);
    snapshot->live_residual = report.residual;
    if (gb_loading_kind_of(loading->params)->follows_time) {
        snapshot->time_step_s = report.time_step * second_per_time(loading);
    }
}

static void copy_world_pairs(const struct gb_world *world, struct gb_state *state)
{
    const struct gb_pair_list *near = &gb_world_pairs(world)->near;
    const struct gb_contacts *contacts = gb_world_contacts(world);
    struct gb_pair_forces forces;
    int64_t line = 0;
    gb_pair_forces_init(&forces, world, GB_PAIR_FORCES_NEAR);
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

static bool copy_world(const struct gb_loading *loading, struct gb_state **out,
                       struct gb_error *err)
{
    const struct gb_world *world = loading->world;
    const struct gb_model *model = loading->model;
    struct gb_contact_counts counts;
    gb_observe_contacts(world, &counts, NULL, 0, NULL);
    if (!gb_state_create(out, model->count, counts.contacts, err)) {
        return false;
    }
    struct gb_state *state = *out;
    state->dimension = model->dimension;
    memcpy(state->cell, gb_world_cell(world)->edge, sizeof state->cell);
    memcpy(state->tilt, gb_world_cell(world)->tilt, sizeof state->tilt);
    gb_observe_contacts(world, &counts, NULL, 0, state->contacts);
    for (int64_t i = 0; i < model->count; i++) {
        memcpy(state->position + 3 * i, gb_world_position(world) + 3 * i,
               3 * sizeof(double));
        gb_cell_wrap(gb_world_cell(world), state->position + 3 * i);
        state->radius[i] = 0.5 * gb_world_diameter(world, i);
    }
    copy_world_pairs(world, state);
    return true;
}

static void copy_bed_pairs(const struct gb_bed *bed, struct gb_state *state)
{
    int64_t line = 0;
    for (int64_t slot = 0; slot < bed->pairs.count; slot++) {
        if (bed->pairs.contacts.normal[slot] < 0.0) {
            continue;
        }
        double unit[3];
        gb_observe_die_force(bed, slot, unit, state->pair_force + 3 * line);
        state->pair[2 * line] = bed->pairs.first[slot];
        state->pair[2 * line + 1] = bed->pairs.other[slot];
        state->pair_normal[line++] = bed->pairs.contacts.normal[slot];
    }
}

static bool copy_walls(const struct gb_bed *bed, struct gb_state *state,
                       struct gb_error *err)
{
    const struct gb_bed_list *walls = &bed->walls;
    int64_t line = 0;
    for (int64_t slot = 0; slot < walls->count; slot++) {
        line += walls->contacts.normal[slot] >= 0.0;
    }
    if (!gb_state_allocate_walls(state, line, err)) {
        return false;
    }
    line = 0;
    for (int64_t slot = 0; slot < walls->count; slot++) {
        if (walls->contacts.normal[slot] < 0.0) {
            continue;
        }
        const double *x = bed->position[walls->first[slot]];
        double unit[3];
        gb_die_overlap(&bed->die, (enum gb_die_wall)walls->other[slot], x, x[3], unit);
        for (int k = 0; k < 3; k++) {
            state->wall_force[3 * line + k] =
                walls->contacts.normal[slot] * unit[k] + walls->contacts.shear[k][slot];
        }
        state->wall[2 * line] = walls->first[slot];
        state->wall[2 * line++ + 1] = walls->other[slot];
    }
    return true;
}

static bool copy_bed(const struct gb_loading *loading, struct gb_state **out,
                     struct gb_error *err)
{
    const struct gb_bed *bed = loading->bed;
    const double radius = gb_state_record_half_width((const double(*)[4])bed->position,
                                                     bed->count, &bed->die);
    struct gb_contact_counts counts;
    gb_observe_die_contacts(bed, &counts, NULL, 0, NULL);
    if (!gb_state_create(out, bed->count, counts.contacts, err)) {
        return false;
    }
    struct gb_state *state = *out;
    const double top =
        fmax(gb_bed_top(bed), bed->die.punch ? bed->die.punch_position : 0.0);
    gb_state_record_walls(state, &bed->die);
    state->cell[0] = state->cell[1] = 2.0 * radius;
    state->cell[2] = top;
    gb_observe_die_contacts(bed, &counts, NULL, 0, state->contacts);
    for (int64_t i = 0; i < bed->count; i++) {
        const double position[3] = {bed->position[i][0] + radius,
                                    bed->position[i][1] + radius, bed->position[i][2]};
        memcpy(state->position + 3 * i, position, sizeof position);
        state->radius[i] = bed->position[i][3];
    }
    copy_bed_pairs(bed, state);
    return copy_walls(bed, state, err);
}

/* Copies a packing for pictures and files: positions, contacts, forces, and its measures
 * as state->point.
 *
 * A die stands in a box from 0: positions are moved there, and the box reaches up to the
 * punch or the highest particle. */
static bool copy_state(const struct gb_loading *loading, struct gb_state **out,
                       struct gb_error *err)
{
    const struct gb_model *model = loading->model;
    if (!(loading->bed ? copy_bed(loading, out, err) : copy_world(loading, out, err))) {
        return false;
    }
    struct gb_state *state = *out;
    measure_packing(loading, &state->point);
    gb_state_record_model(state, model);
    state->metre_per_length = model->metre_per_length;
    state->pascal_per_stress = model->pascal_per_stress;
    state->seed = model->seed;
    snprintf(state->preset, sizeof state->preset, "%s", loading->params->title);
    snprintf(state->version, sizeof state->version, "%s", GB_VERSION);
    return true;
}

bool gb_experiment_event(struct gb_experiment *experiment, int64_t *step, char *text,
                         size_t size)
{
    return gb_event_queue_take(&experiment->events, step, text, size);
}

/* Checks the parameters and freezes those that hold after a recorded step. */
static struct gb_experiment *allocate(const struct gb_params *params, int64_t step,
                                      struct gb_error *err)
{
    struct gb_params effective;
    struct gb_experiment *experiment = gb_alloc_array(1, sizeof *experiment, err);
    if (!experiment) {
        return NULL;
    }
    experiment->params = *params;
    experiment->model = gb_alloc_array(1, sizeof *experiment->model, err);
    if (!experiment->model || !gb_params_check(params, err)) {
        gb_experiment_destroy(experiment);
        return NULL;
    }
    gb_changes_effective(&experiment->params, step, &effective);
    if (!gb_model_init(experiment->model, &effective, err)) {
        gb_experiment_destroy(experiment);
        return NULL;
    }
    return experiment;
}

bool gb_experiment_create(struct gb_experiment **out, const struct gb_params *params,
                          bool (*cancelled)(void *data), void *data, struct gb_error *err)
{
    struct gb_experiment *experiment = allocate(params, -1, err);
    if (!experiment) {
        return false;
    }
    struct gb_error why = {0};
    if (!gb_change_check_all(&experiment->params, experiment->model, &why) ||
        !gb_loading_create(&experiment->loading, &experiment->params, experiment->model,
                           cancelled, data, &why)) {
        gb_experiment_destroy(experiment);
        if (why.code == GB_ERR_GUARD && gb_imported_given(params)) {
            /* no run has made this packing: the file is what is wrong */
            return gb_error_set(err, GB_ERR_INPUT, "structure.from: %s", why.text);
        }
        return gb_error_set(err, why.code, "%s", why.text);
    }
    if (gb_loading_kind_of(params)->columns == GB_COLUMNS_ENERGY) {
        experiment->elastic_start = gb_observe_elastic(experiment->loading->world);
    }
    *out = experiment;
    return true;
}

bool gb_experiment_resume(struct gb_experiment **out, const struct gb_params *params,
                          struct gb_record *record, struct gb_error *err)
{
    struct gb_experiment *experiment =
        allocate(params, gb_checkpoint_step(record) - 1, err);
    if (!experiment) {
        return false;
    }
    if (!gb_loading_create_from(&experiment->loading, &experiment->params,
                                experiment->model, record, err) ||
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
    gb_loading_destroy(experiment->loading);
    gb_alloc_free(experiment->model);
    gb_alloc_free(experiment);
}

/* What the parameters change after this point, as an event. */
static bool change(struct gb_experiment *experiment, struct gb_error *err)
{
    char text[GB_EVENT_TEXT];
    if (experiment->over || !gb_changes_due(&experiment->params, experiment->step - 1)) {
        return true;
    }
    if (!gb_change_apply(experiment, err)) {
        return false;
    }
    snprintf(text, sizeof text, "changed after step %" PRId64 ", density %.4f: %.256s",
             experiment->point.step, experiment->point.density,
             experiment->params.changes);
    gb_event_queue_add(&experiment->events, text);
    return true;
}

static enum gb_step_outcome stop(struct gb_experiment *experiment)
{
    experiment->over = experiment->stopped = true;
    return GB_STEP_STOPPED;
}

/* The packing is back where an unloading branch began, on the loading branch. */
static void measure_restored(struct gb_experiment *experiment)
{
    measure_packing(experiment->loading, &experiment->shown);
    experiment->shown.branch = GB_BRANCH_LOAD;
    experiment->shown.branch_from_pa = 0.0;
    experiment->shown.step = experiment->step;
    experiment->shown.unrelaxed = (double)NAN;
}

static enum gb_step_outcome record(struct gb_experiment *experiment, struct gb_error *err)
{
    struct gb_loading *loading = experiment->loading;
    measure_step(loading, experiment->elastic_start, &experiment->point);
    experiment->point.step = experiment->step++;
    experiment->unrelaxed += experiment->point.unrelaxed > 0.0;
    experiment->shown = experiment->point;
    const enum gb_step_outcome next =
        loading->mode->after_point(loading, &experiment->events, err);
    if (loading->restored) {
        measure_restored(experiment);
    }
    experiment->over = next == GB_STEP_DONE;
    if (next == GB_STEP_STOPPED || !change(experiment, err)) {
        gb_event_queue_add(&experiment->events, err->text);
        return stop(experiment);
    }
    return GB_STEP_POINT;
}

static enum gb_step_outcome advance(struct gb_experiment *experiment,
                                    int64_t max_evaluations, struct gb_error *err)
{
    struct gb_loading *loading = experiment->loading;
    struct gb_error local;
    struct gb_error *why = err ? err : &local;
    if (experiment->over) {
        return GB_STEP_DONE;
    }
    const enum gb_step_outcome outcome =
        loading->mode->advance(loading, max_evaluations, &experiment->events, why);
    switch (outcome) {
    case GB_STEP_MORE:
        break;
    case GB_STEP_POINT:
        return record(experiment, why);
    case GB_STEP_DONE:
        experiment->over = true;
        break;
    case GB_STEP_STOPPED:
        gb_event_queue_add(&experiment->events, why->text);
        return stop(experiment);
    }
    return outcome;
}

enum gb_step_outcome gb_experiment_advance(struct gb_experiment *experiment,
                                           int64_t max_evaluations, struct gb_error *err)
{
    const int64_t step = experiment->step;
    const enum gb_step_outcome outcome = advance(experiment, max_evaluations, err);
    gb_event_queue_set_step(&experiment->events, step);
    return outcome;
}

bool gb_experiment_missed(const struct gb_experiment *experiment, char *text, size_t size)
{
    const struct gb_loading *loading = experiment->loading;
    char goals[GB_EVENT_TEXT] = "", points[64] = "";
    if (experiment->over && !experiment->stopped && loading->mode->missed != NULL &&
        !loading->mode->missed(loading, goals, sizeof goals)) {
        goals[0] = '\0';
    }
    if (experiment->unrelaxed > 0) {
        snprintf(points, sizeof points, "%" PRId64 " of %" PRId64 " points %s",
                 experiment->unrelaxed, experiment->step, "are not in equilibrium");
    }
    snprintf(text, size, "%s%s%s", goals,
             goals[0] != '\0' && points[0] != '\0' ? "; " : "", points);
    return text[0] != '\0';
}

bool gb_experiment_over(const struct gb_experiment *experiment)
{
    return experiment->over;
}

const struct gb_point *gb_experiment_point(const struct gb_experiment *experiment)
{
    return &experiment->point;
}

double gb_experiment_progress(const struct gb_experiment *experiment)
{
    const struct gb_loading *loading = experiment->loading;
    const struct gb_point *point = &experiment->point;
    if (experiment->over && !experiment->stopped) {
        return 1.0;
    }
    return loading->mode->progress(
        loading, point->p_pa / experiment->model->pascal_per_stress, point->density);
}

void gb_experiment_observe(const struct gb_experiment *experiment,
                           struct gb_snapshot *snapshot)
{
    snapshot->now = experiment->point;
    snapshot->now_valid = experiment->step > 0;
    measure_live(experiment->loading, snapshot);
    snapshot->progress = gb_experiment_progress(experiment);
}

bool gb_experiment_state(const struct gb_experiment *experiment, struct gb_state **out,
                         struct gb_error *err)
{
    if (!copy_state(experiment->loading, out, err)) {
        return false;
    }
    (*out)->point.step = experiment->step;
    return true;
}

int64_t gb_experiment_evaluations(const struct gb_experiment *experiment)
{
    return gb_loading_evaluations(experiment->loading);
}

const struct gb_model *gb_experiment_model(const struct gb_experiment *experiment)
{
    return experiment->model;
}

const struct gb_params *gb_experiment_params(const struct gb_experiment *experiment)
{
    return &experiment->params;
}

const struct gb_world *gb_experiment_world(const struct gb_experiment *experiment)
{
    return experiment->loading->world;
}

const struct gb_bed *gb_experiment_bed(const struct gb_experiment *experiment)
{
    return experiment->loading->bed;
}
