#include "run/experiment.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "measure/observe.h"
#include "run/change.h"
#include "run/checkpoint.h"
#include "run/experiment_private.h"
#include "run/packing_state.h"
#include "scene/field/changes.h"
#include "scene/imported/imported.h"

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
    gb_packing_state_packing(experiment->loading, &experiment->shown);
    experiment->shown.branch = GB_BRANCH_LOAD;
    experiment->shown.branch_from_pa = 0.0;
    experiment->shown.step = experiment->step;
    experiment->shown.unrelaxed = (double)NAN;
}

static enum gb_step_outcome record(struct gb_experiment *experiment, struct gb_error *err)
{
    struct gb_loading *loading = experiment->loading;
    gb_packing_state_step(loading, experiment->elastic_start, &experiment->point);
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
    gb_packing_state_live(experiment->loading, snapshot);
    snapshot->progress = gb_experiment_progress(experiment);
}

bool gb_experiment_state(const struct gb_experiment *experiment, struct gb_state **out,
                         struct gb_error *err)
{
    if (!gb_packing_state_copy(experiment->loading, out, err)) {
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
