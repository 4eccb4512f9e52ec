#include "many/single_run.h"

#include <string.h>

#include <glib.h>

#include "io/follow.h"
#include "io/preset.h"
#include "io/rundir.h"
#include "io/status_json.h"
#include "many/runset.h"
#include "run/checkpoint.h"
#include "run/run_loop.h"

static const char stopped_text[] = "stopped on request";

struct single_run {
    struct gb_run_loop loop;
    const struct gb_params *first; /* up to the first point; NULL: as the run */
    const struct gb_pool_callbacks *callbacks; /* NULL: none */
};

static bool is_cancelled(void *data)
{
    const struct single_run *run = data;
    return run->callbacks != NULL && run->callbacks->cancelled != NULL &&
           run->callbacks->cancelled(run->callbacks->data);
}

static bool may_continue(void *data, struct gb_error *err)
{
    return !is_cancelled(data) || gb_error_set(err, GB_ERR_CANCELLED, "%s", stopped_text);
}

static void on_end(void *data)
{
    const struct single_run *run = data;
    if (run->callbacks != NULL && run->callbacks->loaded != NULL) {
        run->callbacks->loaded(run->callbacks->data);
    }
}

/* Error text, by which gb_single_run_is_taken recognises the error. */
static const char taken_text[] = "another process does this run or has done it";

/* Attempts at a directory in which other processes start and end runs. */
enum { TRIES = 10 };

/* Locks the directory before the packing is built, so that other processes skip this
 * run. */
static bool claim(struct single_run *run, const struct gb_params *params,
                  const char *directory, enum gb_rundir_mode mode, struct gb_error *err)
{
    const int tries = mode == GB_RUNDIR_MISSING ? TRIES : 1;
    for (int i = 0; i < tries; i++) {
        if (gb_run_recorder_create(&run->loop.recorder, directory, params, mode, err)) {
            return true;
        }
        if (mode == GB_RUNDIR_MISSING &&
            (gb_rundir_busy(directory) ||
             gb_single_run_find(params, directory) == GB_SINGLE_RUN_DONE)) {
            return gb_error_set(err, GB_ERR_INPUT, "%s", taken_text);
        }
    }
    return false;
}

/* Evaluations between two polls of the callbacks. */
enum { SLICE = 1000 };

/* Creates the experiment of params from the first point of a run with other parameters.
 */
static bool create_after(struct gb_experiment **out, struct single_run *run,
                         const struct gb_params *params, struct gb_error *err)
{
    struct gb_experiment *before = NULL;
    struct gb_record record = {0};
    enum gb_step_outcome outcome = GB_STEP_MORE;
    bool good = gb_experiment_create(&before, run->first, is_cancelled, run, err);
    while (good && outcome == GB_STEP_MORE) {
        outcome = gb_experiment_advance(before, SLICE, err);
        good = outcome <= GB_STEP_POINT && may_continue(run, err);
    }
    good = good && gb_checkpoint_take(before, &record, err);
    record.loading = true;
    good = good && gb_experiment_resume(out, params, &record, err);
    gb_record_finish(&record);
    gb_experiment_destroy(before);
    return good;
}

static bool begin(struct single_run *run, const struct gb_params *params,
                  const char *directory, enum gb_rundir_mode mode, struct gb_error *err)
{
    struct gb_experiment *experiment = NULL;
    if (!claim(run, params, directory, mode, err)) {
        return false;
    }
    if (!(run->first != NULL
              ? create_after(&experiment, run, params, err)
              : gb_experiment_create(&experiment, params, is_cancelled, run, err))) {
        /* a failed scene keeps its directory and status, so that other processes do not
         * repeat it */
        const bool of_scene = err->code == GB_ERR_GUARD ||
                              err->code == GB_ERR_NOT_CONVERGED ||
                              err->code == GB_ERR_INPUT;
        if (mode != GB_RUNDIR_MISSING || !of_scene) {
            gb_run_recorder_discard(run->loop.recorder);
            run->loop.recorder = NULL;
        }
        return false;
    }
    gb_run_loop_attach(&run->loop, experiment);
    return true;
}

static bool perform(const struct gb_params *params, const struct gb_params *first,
                    const char *directory, enum gb_rundir_mode mode,
                    const struct gb_pool_callbacks *callbacks, struct gb_error *err)
{
    struct single_run run = {.first = first, .callbacks = callbacks};
    const struct gb_run_loop_hooks hooks = {
        .may_continue = may_continue, .on_end = on_end, .data = &run};
    struct gb_error failure = {0};
    gb_run_loop_init(&run.loop, &hooks);
    const enum gb_run_outcome outcome = begin(&run, params, directory, mode, &failure)
                                            ? gb_run_loop_run(&run.loop)
                                            : gb_run_loop_fail(&run.loop, &failure);
    gb_run_loop_finish(&run.loop);
    return outcome == GB_RUN_OUTCOME_DONE ||
           gb_error_set(err, run.loop.error.code, "%s", run.loop.error.text);
}

bool gb_single_run(const struct gb_params *params, const char *directory,
                   const struct gb_pool_callbacks *callbacks, struct gb_error *err)
{
    return perform(params, NULL, directory, GB_RUNDIR_REPLACE, callbacks, err);
}

bool gb_single_run_after(const struct gb_params *params, const struct gb_params *first,
                         const char *directory, const struct gb_pool_callbacks *callbacks,
                         struct gb_error *err)
{
    return perform(params, first, directory, GB_RUNDIR_REPLACE, callbacks, err);
}

bool gb_single_run_missing(const struct gb_params *params, const char *directory,
                           const struct gb_pool_callbacks *callbacks,
                           struct gb_error *err)
{
    return perform(params, NULL, directory, GB_RUNDIR_MISSING, callbacks, err);
}

bool gb_single_run_is_taken(const struct gb_error *error)
{
    return error->code == GB_ERR_INPUT && strcmp(error->text, taken_text) == 0;
}

bool gb_single_run_failed(const char *directory, struct gb_error *error)
{
    struct gb_snapshot shot = {0};
    struct gb_follow_engine engine;
    struct gb_error ignored;
    if (!gb_follow_status(directory, &shot, &engine, &ignored) ||
        (shot.state != GB_RUN_FAILED && shot.state != GB_RUN_STOPPED) ||
        shot.error.text[0] == '\0' || strcmp(shot.error.text, stopped_text) == 0) {
        return false;
    }
    (void)gb_error_set(error, GB_ERR_GUARD, "%s", shot.error.text);
    return true;
}

enum gb_single_run_found gb_single_run_find(const struct gb_params *params,
                                            const char *directory)
{
    char *status = g_build_filename(directory, "status.json", NULL);
    char *path = g_build_filename(directory, "preset.ini", NULL);
    struct gb_preset *preset = NULL;
    enum gb_single_run_found found = GB_SINGLE_RUN_NOT_DONE;
    if (gb_preset_load(&preset, path, NULL)) {
        if (gb_preset_params(preset)->seed != params->seed ||
            !gb_runset_same(gb_preset_params(preset), params)) {
            found = GB_SINGLE_RUN_OTHER;
        } else if (gb_status_json_is_done(status)) {
            found = GB_SINGLE_RUN_DONE;
        }
        gb_preset_destroy(preset);
    }
    g_free(path);
    g_free(status);
    return found;
}
