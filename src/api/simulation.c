/* Simulations: creation, recording, callbacks and advances; simulation_read.c has
 * points, arrays and states.  A simulation wraps the run loop (run/run_loop.h), which
 * has the experiment and the recorder, and adds a curve of all points.  The first
 * advance builds the packing, unless the simulation was resumed.  `advancing` rejects a
 * second advance at the same time.  `process` rejects most calls in a child of fork,
 * which has neither the threads nor the files. */
#include <string.h>
#include <unistd.h>

#include <glib.h>

#include "api/arguments.h"
#include "api/parameters_private.h"
#include "api/simulation_private.h"
#include "base/alloc.h"
#include "base/clock.h"
#include "io/curve_csv.h"

/* --- hooks of the loop ----------------------------------------------------------- */

static bool may_continue(void *data, struct gb_error *err)
{
    struct gb_simulation *simulation = data;
    if (simulation->hooks.between_slices) {
        simulation->hooks.between_slices(simulation->hooks.data);
    }
    const char *reason = atomic_load(&simulation->reason);
    return reason == NULL || gb_error_set(err, GB_ERR_CANCELLED, "%s", reason);
}

static bool on_point(void *data, const struct gb_point *point, struct gb_error *err)
{
    struct gb_simulation *simulation = data;
    gb_array_forget(&simulation->packing);
    if (!gb_curve_append(simulation->curve, point, err)) {
        return false;
    }
    if (simulation->on_point) {
        simulation->on_point(simulation->point_data, simulation, point);
    }
    return true;
}

static void on_event(void *data, int64_t step, const char *text)
{
    struct gb_simulation *simulation = data;
    if (simulation->on_event) {
        simulation->on_event(simulation->event_data, simulation, step, text);
    }
}

static void call_progress(struct gb_simulation *simulation)
{
    if (simulation->on_progress &&
        gb_clock_s() - simulation->called_s >= simulation->interval) {
        gb_array_forget(&simulation->packing);
        simulation->on_progress(simulation->progress_data, simulation,
                                gb_simulation_progress(simulation));
        simulation->called_s = gb_clock_s();
    }
}

static void on_tick(void *data)
{
    call_progress(data);
}

static void on_end(void *data)
{
    struct gb_simulation *simulation = data;
    if (simulation->hooks.on_end) {
        simulation->hooks.on_end(simulation->hooks.data);
    }
}

static bool on_record_error(void *data, const struct gb_error *err)
{
    const struct gb_simulation_hooks *hooks = &((struct gb_simulation *)data)->hooks;
    return hooks->on_record_error && hooks->on_record_error(hooks->data, err);
}

/* Polled while the packing is built. */
static bool packing_cancelled(void *data)
{
    struct gb_simulation *simulation = data;
    call_progress(simulation);
    return atomic_load(&simulation->reason) != NULL;
}

/* --- creation -------------------------------------------------------------------- */

static struct gb_simulation *allocate(struct gb_error *err)
{
    struct gb_simulation *simulation = gb_alloc_array(1, sizeof *simulation, err);
    if (!simulation) {
        return NULL;
    }
    const struct gb_run_loop_hooks hooks = {.may_continue = may_continue,
                                            .on_event = on_event,
                                            .on_point = on_point,
                                            .on_tick = on_tick,
                                            .on_end = on_end,
                                            .on_record_error = on_record_error,
                                            .data = simulation};
    gb_run_loop_init(&simulation->loop, &hooks);
    atomic_init(&simulation->reason, NULL);
    atomic_init(&simulation->advancing, false);
    simulation->process = getpid();
    if (!gb_curve_create(&simulation->curve, err)) {
        gb_simulation_destroy(simulation);
        return NULL;
    }
    return simulation;
}

static void attach(struct gb_simulation *simulation, struct gb_experiment *experiment)
{
    gb_run_loop_attach(&simulation->loop, experiment);
    simulation->packing.experiment = experiment;
}

bool gb_simulation_create_from(struct gb_simulation **out, const struct gb_params *params,
                               struct gb_error *err)
{
    struct gb_model model;
    if (!gb_params_check(params, err) || !gb_model_init(&model, params, err)) {
        return false;
    }
    struct gb_simulation *simulation = allocate(err);
    if (!simulation) {
        return false;
    }
    simulation->params = *params;
    *out = simulation;
    return true;
}

bool gb_simulation_create(struct gb_simulation **out,
                          const struct gb_parameters *parameters, struct gb_error *err)
{
    return gb_arguments_given(out, "out", err) &&
           gb_arguments_given(parameters, "parameters", err) &&
           gb_simulation_create_from(out, gb_preset_params(parameters->preset), err);
}

bool gb_simulation_create_fork(struct gb_simulation **out, const struct gb_params *params,
                               struct gb_record *record, const struct gb_curve *curve,
                               size_t points, struct gb_error *err)
{
    struct gb_simulation *simulation = NULL;
    if (!gb_simulation_create_from(&simulation, params, err)) {
        return false;
    }
    bool good = true;
    for (size_t i = 0; good && i < points; i++) {
        good = gb_curve_append(simulation->curve, gb_curve_at(curve, i), err);
    }
    simulation->begin = good ? gb_alloc_array(1, sizeof *record, err) : NULL;
    if (!simulation->begin) {
        gb_simulation_destroy(simulation);
        return false;
    }
    simulation->origin = GB_SIMULATION_LOADED;
    *simulation->begin = *record;
    memset(record, 0, sizeof *record);
    *out = simulation;
    return true;
}

void gb_simulation_set_hooks(struct gb_simulation *simulation,
                             const struct gb_simulation_hooks *hooks)
{
    simulation->hooks = *hooks;
}

static void drop_begin(struct gb_simulation *simulation)
{
    if (simulation->begin) {
        gb_record_finish(simulation->begin);
        gb_alloc_free(simulation->begin);
        simulation->begin = NULL;
    }
}

/* Without a checkpoint the first advance builds the packing. */
bool gb_simulation_open(struct gb_simulation *simulation, const char *directory,
                        enum gb_run_recorder_from from, struct gb_error *err)
{
    struct gb_experiment *experiment = NULL;
    struct gb_run_loop *loop = &simulation->loop;
    simulation->origin = GB_SIMULATION_RESUMED;
    if (!gb_run_recorder_resume(&loop->recorder, &experiment, directory, from, err)) {
        return false;
    }
    simulation->params = *gb_run_recorder_params(loop->recorder);
    if (!experiment) {
        return true;
    }
    const double seconds = gb_run_recorder_seconds(loop->recorder);
    gb_run_loop_set_seconds(loop, seconds);
    attach(simulation, experiment);
    g_snprintf(simulation->resumed, sizeof simulation->resumed,
               "resumed from the checkpoint of step %" G_GINT64_FORMAT ", after %.1f s",
               gb_experiment_point(experiment)->step, seconds);
    return gb_curve_csv_read(directory, &simulation->params, simulation->curve, err);
}

static bool create_resumed(struct gb_simulation **out, const char *directory,
                           enum gb_run_recorder_from from, struct gb_error *err)
{
    if (!gb_arguments_given(out, "out", err) ||
        !gb_arguments_given(directory, "directory", err)) {
        return false;
    }
    struct gb_simulation *simulation = allocate(err);
    if (!simulation || !gb_simulation_open(simulation, directory, from, err)) {
        gb_simulation_destroy(simulation);
        return false;
    }
    *out = simulation;
    return true;
}

bool gb_simulation_resume(struct gb_simulation **out, const char *directory,
                          struct gb_error *err)
{
    return create_resumed(out, directory, GB_RUN_RECORDER_LAST, err);
}

bool gb_simulation_resume_before(struct gb_simulation **out, const char *directory,
                                 struct gb_error *err)
{
    return create_resumed(out, directory, GB_RUN_RECORDER_BEFORE, err);
}

void gb_simulation_release(struct gb_simulation *simulation)
{
    gb_array_forget(&simulation->packing);
    simulation->packing.experiment = NULL;
    drop_begin(simulation);
    gb_run_loop_finish(&simulation->loop);
}

bool gb_simulation_usable(const struct gb_simulation *simulation, bool within,
                          struct gb_error *err)
{
    if (!gb_arguments_given(simulation, "simulation", err)) {
        return false;
    }
    if (simulation->process != getpid()) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "the simulation belongs to process %ld, which has its threads "
            "and files; expected one of this process",
            (long)simulation->process);
    }
    return within || !atomic_load(&simulation->advancing) ||
           gb_error_set(err, GB_ERR_INPUT,
                        "an advance is under way; expected this call after it");
}

/* Frees what a child of fork has inherited; threads and locks belong to the parent. */
static void destroy_inherited(struct gb_simulation *simulation)
{
    if (atomic_load(&simulation->advancing)) {
        return; /* fork interrupted a change; its memory is inconsistent */
    }
    gb_simulation_release(simulation);
    gb_curve_destroy(simulation->curve);
    g_free(simulation->directory);
    gb_alloc_free(simulation);
}

void gb_simulation_destroy(struct gb_simulation *simulation)
{
    if (!simulation) {
        return;
    }
    if (simulation->process != getpid()) {
        destroy_inherited(simulation);
        return;
    }
    simulation->on_point = NULL;
    simulation->on_event = NULL;
    simulation->on_progress = NULL;
    simulation->hooks = (struct gb_simulation_hooks){0};
    gb_run_loop_leave(&simulation->loop);
    gb_simulation_release(simulation);
    gb_curve_destroy(simulation->curve);
    g_free(simulation->directory);
    gb_alloc_free(simulation);
}

/* --- the record ------------------------------------------------------------------ */

bool gb_simulation_start_record(struct gb_simulation *simulation, const char *directory,
                                enum gb_rundir_mode mode, struct gb_error *err)
{
    return gb_run_recorder_create(&simulation->loop.recorder, directory,
                                  &simulation->params, mode, err);
}

bool gb_simulation_record(struct gb_simulation *simulation, const char *directory,
                          bool replace, struct gb_error *err)
{
    const enum gb_rundir_mode mode = replace ? GB_RUNDIR_REPLACE : GB_RUNDIR_KEEP;
    if (!gb_simulation_usable(simulation, false, err) ||
        !gb_arguments_given(directory, "directory", err)) {
        return false;
    }
    if (simulation->loop.experiment || simulation->origin != GB_SIMULATION_NEW) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%s: a run is recorded from its beginning, before the first "
                            "advance",
                            directory);
    }
    if (!gb_rundir_check(directory, mode, err)) {
        return false;
    }
    g_free(simulation->directory);
    simulation->directory = g_strdup(directory);
    simulation->mode = mode;
    return true;
}

/* --- callbacks ------------------------------------------------------------------- */

void gb_simulation_on_point(struct gb_simulation *simulation,
                            void (*call)(void *data, struct gb_simulation *simulation,
                                         const struct gb_point *point),
                            void *data)
{
    if (simulation) {
        simulation->on_point = call;
        simulation->point_data = data;
    }
}

void gb_simulation_on_event(struct gb_simulation *simulation,
                            void (*call)(void *data, struct gb_simulation *simulation,
                                         int64_t step, const char *text),
                            void *data)
{
    if (simulation) {
        simulation->on_event = call;
        simulation->event_data = data;
    }
}

void gb_simulation_on_progress(struct gb_simulation *simulation,
                               void (*call)(void *data, struct gb_simulation *simulation,
                                            double share),
                               void *data, double interval)
{
    if (simulation) {
        simulation->on_progress = call;
        simulation->progress_data = data;
        simulation->interval = interval > 0.0 ? interval : 0.0;
    }
}

void gb_simulation_cancel(struct gb_simulation *simulation, const char *reason)
{
    if (simulation) {
        atomic_store(&simulation->reason, reason ? reason : "cancelled");
    }
}

/* --- advances -------------------------------------------------------------------- */

bool gb_simulation_build(struct gb_simulation *simulation, struct gb_error *err)
{
    struct gb_experiment *experiment = NULL;
    if (simulation->loop.experiment) {
        return true;
    }
    const bool good = simulation->begin
                          ? gb_experiment_resume(&experiment, &simulation->params,
                                                 simulation->begin, err)
                          : gb_experiment_create(&experiment, &simulation->params,
                                                 packing_cancelled, simulation, err);
    drop_begin(simulation);
    if (good) {
        attach(simulation, experiment);
    }
    return good;
}

static bool begin(struct gb_simulation *simulation, struct gb_error *err)
{
    return gb_simulation_build(simulation, err) &&
           (!simulation->directory || simulation->loop.recorder ||
            gb_simulation_start_record(simulation, simulation->directory,
                                       simulation->mode, err));
}

static bool has_ended(const struct gb_simulation *simulation)
{
    return simulation->outcome == GB_RUN_OUTCOME_DONE ||
           simulation->outcome == GB_RUN_OUTCOME_STOPPED ||
           simulation->outcome == GB_RUN_OUTCOME_FAILED;
}

void gb_simulation_leave(struct gb_simulation *simulation)
{
    if (!gb_simulation_usable(simulation, false, NULL)) {
        return;
    }
    struct gb_run_loop *loop = &simulation->loop;
    gb_run_loop_leave(loop);
    gb_run_recorder_destroy(loop->recorder);
    loop->recorder = NULL;
    if (!has_ended(simulation)) {
        simulation->outcome = GB_RUN_OUTCOME_FAILED;
        gb_error_set(&loop->error, GB_ERR_INPUT, "the run was left; no advance follows");
    }
}

/* Excludes the time between two advances from the run's time. */
static void go_on(struct gb_simulation *simulation)
{
    if (simulation->returned_s > 0.0) {
        gb_run_loop_exclude(&simulation->loop, gb_clock_s() - simulation->returned_s);
    }
}

static enum gb_run_outcome advance(struct gb_simulation *simulation, int64_t points)
{
    struct gb_error why = {0};
    struct gb_run_loop *loop = &simulation->loop;
    if (!begin(simulation, &why)) {
        (void)gb_run_loop_fail(loop, &why);
        return gb_run_loop_outcome(&why);
    }
    if (simulation->resumed[0] != '\0') {
        gb_run_loop_event(loop, simulation->resumed);
        simulation->resumed[0] = '\0';
    }
    const enum gb_run_outcome outcome = gb_run_loop_advance(loop, points);
    /* cancelled during the last of the points: let the loop report it */
    return outcome == GB_RUN_OUTCOME_NONE && atomic_load(&simulation->reason)
               ? gb_run_loop_advance(loop, 1)
               : outcome;
}

enum gb_run_outcome gb_simulation_advance(struct gb_simulation *simulation,
                                          int64_t points, struct gb_error *err)
{
    if (!gb_simulation_usable(simulation, true, err)) {
        return GB_RUN_OUTCOME_FAILED;
    }
    if (points < 0) {
        gb_error_set(err, GB_ERR_INPUT,
                     "points = %" G_GINT64_FORMAT ": expected 0 or more", points);
        return GB_RUN_OUTCOME_FAILED;
    }
    if (atomic_exchange(&simulation->advancing, true)) {
        gb_error_set(err, GB_ERR_INPUT,
                     "an advance is under way; expected one at a time");
        return GB_RUN_OUTCOME_FAILED;
    }
    if (!has_ended(simulation)) {
        go_on(simulation);
        gb_array_forget(&simulation->packing);
        simulation->outcome = advance(simulation, points);
        gb_array_forget(&simulation->packing);
        simulation->returned_s = gb_clock_s();
        if (simulation->outcome == GB_RUN_OUTCOME_CANCELLED) {
            atomic_store(&simulation->reason, NULL);
        }
    }
    const struct gb_error *why = &simulation->loop.error;
    const enum gb_run_outcome outcome = simulation->outcome;
    if (outcome != GB_RUN_OUTCOME_NONE && why->code != GB_OK) {
        gb_error_set(err, why->code, "%s", why->text);
    }
    atomic_store(&simulation->advancing, false);
    return outcome;
}
