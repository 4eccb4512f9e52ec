#include "runner/runner.h"
#include "run/change.h"

#include <glib.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/thread.h"
#include "io/follow.h"
#include "io/rundir.h"
#include "run/checkpoint.h"
#include "runner/runner_private.h"
#include "scene/field/changes.h"

static void free_runner(struct gb_runner *runner)
{
    gb_record_finish(&runner->record);
    gb_view_sampling_finish(&runner->view_start);
    gb_simulation_destroy(runner->simulation);
    g_free(runner->directory);
    gb_alloc_free(runner);
}

/* The simulation belongs to the runner, also where there is none. */
static struct gb_runner *wrap(struct gb_simulation *simulation, const char *directory,
                              struct gb_error *err)
{
    struct gb_runner *runner = gb_alloc_array(1, sizeof *runner, err);
    if (runner == NULL) {
        gb_simulation_destroy(simulation);
        return NULL;
    }
    runner->simulation = simulation;
    runner->params = simulation->params;
    runner->directory = g_strdup(directory);
    gb_publish_init(&runner->publish);
    gb_publish_slots_init(&runner->view_slots);
    gb_command_ring_init(&runner->ring);
    return runner;
}

static struct gb_runner *create(const struct gb_params *params, const char *directory,
                                struct gb_error *err)
{
    struct gb_simulation *simulation = NULL;
    return gb_simulation_create_from(&simulation, params, err)
               ? wrap(simulation, directory, err)
               : NULL;
}

struct gb_run_loop *gb_runner_loop(const struct gb_runner *runner)
{
    return &runner->simulation->loop;
}

static bool launch(struct gb_runner **out, struct gb_runner *runner,
                   void *(*work)(void *data), struct gb_error *err)
{
    pthread_mutex_init(&runner->mutex, NULL);
    pthread_cond_init(&runner->wake, NULL);
    gb_runner_publish_state(runner, GB_RUN_PACKING);
    if (!gb_thread_start(&runner->thread, work, runner, "the engine thread", err)) {
        pthread_cond_destroy(&runner->wake);
        pthread_mutex_destroy(&runner->mutex);
        free_runner(runner);
        return false;
    }
    *out = runner;
    return true;
}

bool gb_runner_create(struct gb_runner **out, const struct gb_params *params,
                      struct gb_error *err)
{
    return gb_runner_create_in(out, params, NULL, err);
}

bool gb_runner_forked(struct gb_runner *runner, int64_t *step)
{
    pthread_mutex_lock(&runner->mutex);
    const bool forked = runner->forked;
    pthread_mutex_unlock(&runner->mutex);
    if (forked && step != NULL) {
        *step = gb_checkpoint_step(&runner->record) - 1;
    }
    return forked;
}

bool gb_runner_create_fork(struct gb_runner **out, const char *changes,
                           struct gb_runner *parent, const char *directory,
                           struct gb_error *err)
{
    struct gb_params changed = parent->params;
    int64_t step = 0;
    if (!gb_runner_forked(parent, &step)) {
        return gb_error_set(err, GB_ERR_INPUT, "the run has not handed over its state");
    }
    if (!gb_changes_add(&changed, step, changes, err) ||
        !gb_change_allowed(&parent->params, &changed, step, err)) {
        return false;
    }
    struct gb_simulation *simulation = NULL;
    if (!gb_simulation_create_fork(&simulation, &changed, &parent->record,
                                   gb_runner_curve(parent), parent->forked_points, err)) {
        return false;
    }
    pthread_mutex_lock(&parent->mutex);
    parent->forked = false;
    pthread_mutex_unlock(&parent->mutex);
    struct gb_runner *runner = wrap(simulation, directory, err);
    return runner != NULL && launch(out, runner, gb_engine_thread, err);
}

bool gb_runner_create_in(struct gb_runner **out, const struct gb_params *params,
                         const char *directory, struct gb_error *err)
{
    struct gb_runner *runner = create(params, directory, err);
    return runner != NULL && launch(out, runner, gb_engine_thread, err);
}

bool gb_runner_resume(struct gb_runner **out, const char *directory, struct gb_error *err)
{
    struct gb_params params;
    struct gb_runner *runner = NULL;
    if (!gb_follow_params(directory, &params, err) ||
        (gb_rundir_busy(directory) && !gb_follow_request_stop(directory, err))) {
        return false;
    }
    runner = create(&params, directory, err);
    if (runner == NULL) {
        return false;
    }
    runner->resumed = true;
    return launch(out, runner, gb_engine_thread, err);
}

bool gb_runner_follow(struct gb_runner **out, const char *directory, struct gb_error *err)
{
    struct gb_params params;
    struct gb_runner *runner = gb_follow_params(directory, &params, err)
                                   ? create(&params, directory, err)
                                   : NULL;
    return runner != NULL && launch(out, runner, gb_follow_thread, err);
}

const char *gb_runner_directory(const struct gb_runner *runner)
{
    return runner->directory;
}

void gb_runner_stop(struct gb_runner *runner)
{
    if (runner->joined) {
        return;
    }
    pthread_mutex_lock(&runner->mutex);
    runner->quit = true;
    pthread_cond_signal(&runner->wake);
    pthread_mutex_unlock(&runner->mutex);
    pthread_join(runner->thread, NULL);
    runner->joined = true;
}

void gb_runner_destroy(struct gb_runner *runner)
{
    if (runner == NULL) {
        return;
    }
    gb_runner_stop(runner);
    pthread_cond_destroy(&runner->wake);
    pthread_mutex_destroy(&runner->mutex);
    free_runner(runner);
}

bool gb_runner_send(struct gb_runner *runner, enum gb_command_kind kind)
{
    if (!gb_command_ring_push(&runner->ring, (struct gb_command){kind})) {
        return false;
    }
    /* under the mutex: the engine could miss it between its test and its wait */
    pthread_mutex_lock(&runner->mutex);
    pthread_cond_signal(&runner->wake);
    pthread_mutex_unlock(&runner->mutex);
    return true;
}

int64_t gb_runner_stored(struct gb_runner *runner)
{
    pthread_mutex_lock(&runner->mutex);
    const int64_t stored = runner->stored;
    pthread_mutex_unlock(&runner->mutex);
    return stored;
}

const struct gb_snapshot *gb_runner_snapshot(struct gb_runner *runner, bool *changed)
{
    const bool fresh = gb_publish_take(&runner->publish);
    if (changed != NULL) {
        *changed = fresh;
    }
    return gb_publish_front(&runner->publish);
}

const struct gb_view_sample *gb_runner_view_sample(struct gb_runner *runner,
                                                   bool *changed)
{
    const bool fresh = gb_publish_slots_take(&runner->view_slots);
    if (changed != NULL) {
        *changed = fresh;
    }
    return &runner->view[runner->view_slots.front];
}

const struct gb_curve *gb_runner_curve(const struct gb_runner *runner)
{
    return runner->simulation->curve;
}

const struct gb_params *gb_runner_params(const struct gb_runner *runner)
{
    return &runner->params;
}

bool gb_runner_event(struct gb_runner *runner, int64_t index, char *text, size_t size)
{
    pthread_mutex_lock(&runner->mutex);
    const bool kept = index >= 0 && index < runner->events &&
                      runner->events - index <= GB_RUNNER_EVENTS;
    if (kept) {
        snprintf(text, size, "%s", runner->event[index % GB_RUNNER_EVENTS]);
    }
    pthread_mutex_unlock(&runner->mutex);
    return kept;
}
