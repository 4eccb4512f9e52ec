#include "many/single_run.h"

#include <string.h>

#include <glib.h>
#include <json-glib/json-glib.h>

#include "base/clock.h"
#include "io/preset.h"
#include "many/runset.h"
#include "run/experiment.h"
#include "run/pace.h"
#include "run/run_recorder.h"

/* Others look at status.json at most this much later than it happened. */
static const double status_every_s = 1.5;

enum { EVENT_MAX = 640 };

struct solo {
    struct gb_pool_callbacks boss;
    struct gb_run_recorder *keep;
    struct gb_experiment *experiment;
    struct gb_pace pace;
    struct gb_snapshot shot;
    double count;
    double started, packed, status_at;
};

static double elapsed(const struct solo *solo)
{
    return gb_clock_s() - solo->started;
}

static bool is_cancelled(void *data)
{
    const struct solo *solo = data;
    return solo->boss.cancelled != NULL && solo->boss.cancelled(solo->boss.data);
}

static void observe(struct solo *solo, enum gb_run_state state)
{
    struct gb_snapshot *shot = &solo->shot;
    gb_experiment_observe(solo->experiment, shot);
    shot->state = (int)state;
    shot->seconds = elapsed(solo);
    gb_pace_add(&solo->pace, shot->seconds - solo->packed, shot->evaluations,
                shot->progress);
    shot->evaluations_per_s = gb_pace_rate(&solo->pace);
    shot->particle_evaluations_per_s = shot->evaluations_per_s * solo->count;
    shot->seconds_left = state == GB_RUN_RUNNING ? gb_pace_left(&solo->pace)
                         : state == GB_RUN_DONE  ? 0.0
                                                 : -1.0;
}

static bool keep_events(struct solo *solo, struct gb_error *err)
{
    char text[EVENT_MAX];
    while (gb_experiment_event(solo->experiment, text, sizeof text)) {
        observe(solo, GB_RUN_RUNNING); /* for the step */
        solo->shot.events++;
        g_strlcpy(solo->shot.event, text, sizeof solo->shot.event);
        if (!gb_run_recorder_event(solo->keep, solo->shot.now.step, text, err)) {
            return false;
        }
    }
    return true;
}

static bool keep_point(struct solo *solo, struct gb_error *err)
{
    struct gb_point point = *gb_experiment_point(solo->experiment);
    point.seconds = elapsed(solo);
    return gb_run_recorder_point(solo->keep, solo->experiment, &point, err);
}

/* Status and state, when it is time. */
static bool keep_due(struct solo *solo, struct gb_error *err)
{
    const double now = elapsed(solo);
    if (!gb_run_recorder_tick(solo->keep, now, false, err)) {
        return false;
    }
    if (now - solo->status_at < status_every_s) {
        return true;
    }
    solo->status_at = now;
    observe(solo, GB_RUN_RUNNING);
    return gb_run_recorder_status(solo->keep, &solo->shot, err);
}

static bool begin(struct solo *solo, const struct gb_params *params,
                  const char *directory, struct gb_error *err)
{
    solo->started = gb_clock_s();
    solo->count = (double)params->count;
    if (!gb_experiment_create(&solo->experiment, params, is_cancelled, solo, err) ||
        !gb_run_recorder_create(&solo->keep, directory, params, true, err)) {
        return false;
    }
    solo->packed = elapsed(solo);
    gb_pace_init(&solo->pace);
    observe(solo, GB_RUN_RUNNING);
    return gb_store_status(gb_run_recorder_store(solo->keep), &solo->shot, err);
}

/* Presses to the end of the programme, a guard or a signal; the last two are told in
 * *stopped.  False only when the results cannot be kept. */
static bool press(struct solo *solo, struct gb_error *stopped, struct gb_error *err)
{
    while (!is_cancelled(solo)) {
        const double from = elapsed(solo);
        const enum gb_step_outcome how =
            gb_experiment_advance(solo->experiment, gb_pace_slice(&solo->pace), stopped);
        gb_pace_sliced(&solo->pace, elapsed(solo) - from, how == GB_STEP_MORE);
        if (!keep_events(solo, err) || (how == GB_STEP_POINT && !keep_point(solo, err))) {
            return false;
        }
        if (how == GB_STEP_DONE || how == GB_STEP_STOPPED) {
            return true;
        }
        if (!keep_due(solo, err)) {
            return false;
        }
    }
    gb_error_set(stopped, GB_ERR_CANCELLED, "stopped on request");
    return true;
}

/* The last files; what went wrong is told there too, where it still can be. */
static bool conclude(struct solo *solo, const struct gb_error *stopped,
                     struct gb_error *err)
{
    observe(solo, stopped->code == GB_OK ? GB_RUN_DONE : GB_RUN_STOPPED);
    solo->shot.error = *stopped;
    if (solo->boss.loaded != NULL) {
        solo->boss.loaded(solo->boss.data);
    }
    return gb_run_recorder_conclude(solo->keep, &solo->shot, err);
}

static void give_up(struct solo *solo, const struct gb_error *err)
{
    solo->shot.state = GB_RUN_FAILED;
    solo->shot.error = *err;
    gb_run_recorder_fail(solo->keep, &solo->shot);
}

bool gb_single_run(const struct gb_params *params, const char *directory,
                   const struct gb_pool_callbacks *boss, struct gb_error *err)
{
    struct solo solo = {.boss = boss != NULL ? *boss : (struct gb_pool_callbacks){0}};
    struct gb_error stopped = {0};
    struct gb_error failure = {0};
    const bool kept = begin(&solo, params, directory, &failure) &&
                      press(&solo, &stopped, &failure) &&
                      conclude(&solo, &stopped, &failure);
    if (!kept) {
        give_up(&solo, &failure);
        stopped = failure;
    }
    gb_run_recorder_destroy(solo.keep);
    gb_experiment_destroy(solo.experiment);
    return stopped.code == GB_OK || gb_error_set(err, stopped.code, "%s", stopped.text);
}

bool gb_single_run_says_done(const char *path)
{
    JsonParser *parser = json_parser_new_immutable();
    bool done = false;
    if (json_parser_load_from_file(parser, path, NULL)) {
        JsonNode *root = json_parser_get_root(parser);
        if (root != NULL && JSON_NODE_HOLDS_OBJECT(root)) {
            done = strcmp(json_object_get_string_member_with_default(
                              json_node_get_object(root), "state", ""),
                          "done") == 0;
        }
    }
    g_object_unref(parser);
    return done;
}

bool gb_single_run_done(const struct gb_params *params, const char *directory, bool *same)
{
    char *status = g_build_filename(directory, "status.json", NULL);
    char *path = g_build_filename(directory, "preset.ini", NULL);
    struct gb_preset *preset = NULL;
    *same = true;
    bool done = false;
    if (gb_preset_load(&preset, path, NULL)) {
        *same = gb_preset_params(preset)->seed == params->seed &&
                gb_runset_same(gb_preset_params(preset), params);
        done = *same && gb_single_run_says_done(status);
        gb_preset_destroy(preset);
    }
    g_free(path);
    g_free(status);
    return done;
}
