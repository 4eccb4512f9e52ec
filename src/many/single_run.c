#include "many/single_run.h"

#include <string.h>

#include <glib.h>

#include "io/preset.h"
#include "io/status_json.h"
#include "many/runset.h"
#include "run/run_loop.h"

struct single_run {
    struct gb_run_loop loop;
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
    return !is_cancelled(data) ||
           gb_error_set(err, GB_ERR_CANCELLED, "stopped on request");
}

static void on_end(void *data)
{
    const struct single_run *run = data;
    if (run->callbacks != NULL && run->callbacks->loaded != NULL) {
        run->callbacks->loaded(run->callbacks->data);
    }
}

static bool begin(struct single_run *run, const struct gb_params *params,
                  const char *directory, struct gb_error *err)
{
    struct gb_experiment *experiment = NULL;
    if (!gb_experiment_create(&experiment, params, is_cancelled, run, err)) {
        return false;
    }
    gb_run_loop_attach(&run->loop, experiment);
    return gb_run_recorder_create(&run->loop.recorder, directory, params,
                                  GB_RUNDIR_REPLACE, err);
}

bool gb_single_run(const struct gb_params *params, const char *directory,
                   const struct gb_pool_callbacks *callbacks, struct gb_error *err)
{
    struct single_run run = {.callbacks = callbacks};
    const struct gb_run_loop_hooks hooks = {
        .may_continue = may_continue, .on_end = on_end, .data = &run};
    struct gb_error failure = {0};
    gb_run_loop_init(&run.loop, &hooks);
    const enum gb_run_outcome outcome = begin(&run, params, directory, &failure)
                                            ? gb_run_loop_run(&run.loop)
                                            : gb_run_loop_fail(&run.loop, &failure);
    gb_run_loop_finish(&run.loop);
    return outcome == GB_RUN_OUTCOME_DONE ||
           gb_error_set(err, run.loop.error.code, "%s", run.loop.error.text);
}

bool gb_single_run_status_is_done(const char *path)
{
    JsonParser *parser = gb_status_json_open(path, NULL);
    if (parser == NULL) {
        return false;
    }
    JsonObject *status = json_node_get_object(json_parser_get_root(parser));
    const bool done =
        strcmp(json_object_get_string_member_with_default(status, "state", ""), "done") ==
        0;
    g_object_unref(parser);
    return done;
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
        } else if (gb_single_run_status_is_done(status)) {
            found = GB_SINGLE_RUN_DONE;
        }
        gb_preset_destroy(preset);
    }
    g_free(path);
    g_free(status);
    return found;
}
