#include "tui/session/session.h"

#include <glib.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "run/change.h"
#include "run/cost.h"
#include "runner/runner.h"
#include "scene/field/changes.h"
#include "scene/loading_kind.h"
#include "tui/session/previous.h"
#include "tui/session/run_lifecycle.h"
#include "tui/term/term.h"

/* The session: edited parameters, the run with its quick cell, and the data on display.
 * In this order: the quick cell and the full run after it, results kept in memory,
 * what-ifs, snapshots taken for display, and the session itself. */

enum quick_cell_start {
    QUICK_CELL_STARTED,
    QUICK_CELL_NONE,  /* scenes of this kind have no quick cell */
    QUICK_CELL_FAILED /* the engine cannot be started: err */
};

enum quick_cell_news {
    QUICK_CELL_SAME,    /* nothing new, or the view is frozen */
    QUICK_CELL_CHANGED, /* the view changes */
    QUICK_CELL_ENDED    /* the quick cell has just finished; frozen views too */
};

static void quick_cell_drop(struct gb_quick_cell *quick_cell)
{
    gb_runner_destroy(quick_cell->runner);
    memset(quick_cell, 0, sizeof *quick_cell);
}

/* Starts the quick cell of a scene.  The previous one is destroyed if the outcome is
 * QUICK_CELL_STARTED and stays otherwise.  Errors: see gb_runner_create. */
static enum quick_cell_start quick_cell_start(struct gb_quick_cell *quick_cell,
                                              const struct gb_params *full_params,
                                              struct gb_error *err)
{
    struct gb_params quick;
    struct gb_runner *runner = NULL;
    if (!gb_cost_quick(full_params, &quick)) {
        return QUICK_CELL_NONE;
    }
    if (!gb_runner_create(&runner, &quick, err)) {
        return QUICK_CELL_FAILED;
    }
    quick_cell_drop(quick_cell);
    quick_cell->full_params = *full_params;
    quick_cell->runner = runner;
    gb_runner_send(runner, GB_COMMAND_WATCH);
    quick_cell->state = GB_RUN_PACKING;
    quick_cell->now.seconds_left = -1.0;
    return QUICK_CELL_STARTED;
}

static void take(struct gb_quick_cell *quick_cell, const struct gb_snapshot *snapshot)
{
    quick_cell->now = *snapshot;
    quick_cell->points = gb_curve_count(gb_runner_curve(quick_cell->runner));
    quick_cell->sample = gb_runner_view_sample(quick_cell->runner, NULL);
}

/* Takes over a quick cell that has finished; there must be no other. */
static void quick_cell_adopt(struct gb_quick_cell *quick_cell,
                             const struct gb_params *full_params,
                             struct gb_runner *runner)
{
    const struct gb_snapshot *snapshot = gb_runner_snapshot(runner, NULL);
    quick_cell->full_params = *full_params;
    quick_cell->runner = runner;
    quick_cell->state = snapshot->state;
    take(quick_cell, snapshot);
}

/* Takes the published snapshot; a frozen view does not change. */
static enum quick_cell_news quick_cell_refresh(struct gb_quick_cell *quick_cell,
                                               bool frozen)
{
    bool changed = false;
    if (quick_cell->runner == NULL) {
        return QUICK_CELL_SAME;
    }
    const bool was_live = gb_session_quick_cell_live(quick_cell);
    const struct gb_snapshot *snapshot = gb_runner_snapshot(quick_cell->runner, &changed);
    quick_cell->state = snapshot->state;
    quick_cell->missed = quick_cell->missed || changed;
    const bool shown = quick_cell->missed && !frozen;
    if (shown) {
        quick_cell->missed = false;
        take(quick_cell, snapshot);
    }
    if (was_live && !gb_session_quick_cell_live(quick_cell)) {
        return QUICK_CELL_ENDED;
    }
    return shown ? QUICK_CELL_CHANGED : QUICK_CELL_SAME;
}

bool gb_session_quick_cell_live(const struct gb_quick_cell *quick_cell)
{
    return quick_cell->runner != NULL && quick_cell->state <= GB_RUN_PAUSED;
}

/* The quick cell of a session, and the full run after it. */

/* A live run with more computing time (s), past and future, is not replaced
 * automatically. */
static const double replaced_max_s = 60.0;

/* Does the quick cell belong to these parameters? */
static bool session_quick_matches(const struct gb_session *session,
                                  const struct gb_params *params)
{
    return session->quick_cell.runner != NULL &&
           gb_previous_diff_count(&session->quick_cell.full_params, params) == 0;
}

/* Has the full run of the quick cell been started? */
static bool full_run_started(const struct gb_session *session)
{
    return session->runner != NULL &&
           session_quick_matches(session, gb_runner_params(session->runner));
}

/* Keeps the curve of the quick cell as a previous curve, unless the full run of its
 * scene has been started. */
static void session_quick_keep_curve(struct gb_session *session)
{
    if (session->quick_cell.runner != NULL && !full_run_started(session)) {
        gb_previous_list_keep(session, &session->quick_cell.full_params,
                              session->quick_cell.runner, GB_SESSION_QUICK_CELL);
    }
}

/* Cost of the full run, estimated from the quick cell; NaN: no estimate.  True: it
 * needs a confirmation, with its text in text. */
static bool session_quick_cost(const struct gb_session *session, double *seconds,
                               char *text, size_t size)
{
    const struct gb_quick_cell *quick_cell = &session->quick_cell;
    const struct gb_params *params = gb_preset_params(session->preset);
    *seconds = NAN;
    return quick_cell->runner != NULL && quick_cell->state == GB_RUN_DONE &&
           session_quick_matches(session, params) &&
           gb_run_lifecycle_cost_after_quick(
               params, gb_runner_params(quick_cell->runner),
               gb_runner_snapshot(quick_cell->runner, NULL)->seconds, seconds, text,
               size);
}

/* What the engine of the run does while a quick cell computes. */
enum engine_state { ENGINE_CONTINUES, ENGINE_WAITS };

static void set_engine(struct gb_session *session, enum engine_state wanted)
{
    const bool yielded = wanted == ENGINE_WAITS;
    if (session->yielded != yielded && session->runner != NULL &&
        gb_runner_send(session->runner,
                       yielded ? GB_COMMAND_YIELD : GB_COMMAND_CONTINUE)) {
        session->yielded = yielded;
    }
}

static void session_recall_keep_quick(struct gb_session *session)
{
    struct gb_quick_cell *cell = &session->quick_cell;
    if (cell->runner != NULL && cell->state == GB_RUN_DONE) {
        const struct gb_kept_run run = {
            .params = cell->full_params, .runner = cell->runner, .quick = true};
        cell->runner = NULL;
        gb_past_runs_add(&session->kept, &run);
    }
    quick_cell_drop(cell);
}

struct gb_params *gb_session_params(struct gb_session *session)
{
    return gb_preset_params(session->preset);
}

bool gb_session_quick_start(struct gb_session *session)
{
    const struct gb_params *params = gb_session_params(session);
    struct gb_error err = {0};
    session->start_due = false;
    if (session->runner != NULL && gb_session_changes(session) == 0) {
        session_recall_keep_quick(session);
        set_engine(session, ENGINE_CONTINUES);
        return false;
    }
    if (!gb_params_check(params, NULL)) {
        return false;
    }
    session_quick_keep_curve(session);
    session_recall_keep_quick(session);
    set_engine(session,
               gb_session_run_is_live(session) ? ENGINE_WAITS : ENGINE_CONTINUES);
    session->pause_wanted = false;
    const enum quick_cell_start outcome =
        quick_cell_start(&session->quick_cell, params, &err);
    if (outcome == QUICK_CELL_FAILED) {
        gb_session_note(session, "quick cell: %s", err.text);
    }
    if (outcome != QUICK_CELL_STARTED) {
        quick_cell_drop(&session->quick_cell);
        set_engine(session, ENGINE_CONTINUES);
        return false;
    }
    session->frozen = false;
    gb_previous_list_describe(session, params);
    return true;
}

bool gb_session_quick_take_due(struct gb_session *session)
{
    const bool start_due = session->start_due;
    session->start_due = false;
    return start_due;
}

static void note_estimate(struct gb_session *session)
{
    char question[400];
    char duration[48];
    double seconds = NAN;
    session_quick_cost(session, &seconds, question, sizeof question);
    if (isfinite(seconds)) {
        gb_session_note(session, "full cell of %lld: about %s (estimated)",
                        (long long)gb_session_params(session)->count,
                        gb_cost_duration(seconds, duration, sizeof duration));
    }
}

/* Name of a live run that only r may replace: a what-if or a run that takes long. */
static const char *irreplaceable(const struct gb_session *session)
{
    const bool what_if = session->whatifs > 0 || session->whatif_text[0] != '\0';
    if (!gb_session_run_is_live(session)) {
        return NULL;
    }
    const double whole = session->now.seconds_left >= 0.0
                             ? session->now.seconds + session->now.seconds_left
                             : gb_cost_assumed_s(gb_runner_params(session->runner));
    return what_if ? "the what-if continues"
           : fmax(whole, session->now.seconds) > replaced_max_s
               ? "the current run continues"
               : NULL;
}

/* After the end of the quick cell: reports it and decides on the full run, which
 * follows unless it would replace a run that must continue. */
static void session_quick_finish(struct gb_session *session)
{
    const struct gb_quick_cell *quick_cell = &session->quick_cell;
    const struct gb_snapshot *now = gb_runner_snapshot(quick_cell->runner, NULL);
    set_engine(session, ENGINE_CONTINUES);
    if (quick_cell->state != GB_RUN_DONE) {
        gb_session_note(session, "quick cell: %s", now->error.text);
        return;
    }
    gb_session_note(session, "quick cell of %lld particles: curve in %.1f s",
                    (long long)gb_runner_params(quick_cell->runner)->count, now->seconds);
    if (full_run_started(session)) {
        return;
    }
    const char *running = irreplaceable(session);
    note_estimate(session);
    /* a pause requested during the quick cell also applies to the full run */
    session->start_due = session->auto_start && running == NULL && !session->pause_wanted;
    if (!session->start_due) {
        gb_session_note(session, "%s%sr starts the full cell",
                        running != NULL ? running : "", running != NULL ? "; " : "");
    }
}

static void take_events(struct gb_session *session)
{
    char text[GB_EVENT_TEXT];
    while (session->events_seen < session->now.events) {
        if (gb_runner_event(session->runner, session->events_seen, text, sizeof text)) {
            gb_session_note(session, "%s", text);
        }
        session->events_seen++;
    }
}

/* Takes over a snapshot of the run for display. */
static void session_refresh_show(struct gb_session *session,
                                 const struct gb_snapshot *snapshot)
{
    session->now = *snapshot;
    session->points = gb_curve_count(gb_runner_curve(session->runner));
    session->sample = gb_runner_view_sample(session->runner, NULL);
    take_events(session);
}

/* Measures the speed, for the cost estimate of the next run. */
static void take_rate(struct gb_session *session, const struct gb_snapshot *snapshot)
{
    if (gb_loading_kind_of(gb_runner_params(session->runner))->given_rate &&
        snapshot->particle_evaluations_per_s > 0.0) {
        session->particle_steps_per_s = snapshot->particle_evaluations_per_s;
    }
}

/* Updates the run; true if the screen changes. */
static bool refresh_run(struct gb_session *session)
{
    if (session->runner == NULL) {
        return false;
    }
    bool changed = false;
    const struct gb_snapshot *snapshot = gb_runner_snapshot(session->runner, &changed);
    take_rate(session, snapshot);
    const bool other_state = snapshot->state != session->run_state;
    if (other_state) {
        session->run_state = snapshot->state;
        session->waiting = false;
    }
    if (changed && !session->frozen) {
        session_refresh_show(session, snapshot);
        return true;
    }
    return other_state;
}

/* Updates the child command and the replicas that it computes. *succeeded: it ended
 * without an error. */
static bool refresh_child(struct gb_session *session, bool *succeeded)
{
    char text[GB_EVENT_TEXT];
    bool some = false;
    bool ended = false;
    const bool live = session->child.pid != 0;
    enum gb_child_command_event news = GB_CHILD_COMMAND_NONE;
    while ((news = gb_job_poll(&session->child, text, sizeof text)) !=
           GB_CHILD_COMMAND_NONE) {
        if (news != GB_CHILD_COMMAND_PROGRESS) {
            gb_session_note(session, "%s", text);
        }
        some = true;
        ended = news == GB_CHILD_COMMAND_ENDED;
    }
    *succeeded = ended && session->child.succeeded;
    return (live && gb_job_replicas_refresh(&session->replica_band, ended)) || some;
}

/* Applies the changes to the edited parameters, so that a restart and a saved preset
 * contain them. */
static void note(struct gb_session *session, int64_t step)
{
    const struct gb_curve *curve = gb_runner_curve(session->runner);
    struct gb_params *edited = gb_session_params(session);
    memcpy(edited->changes, gb_runner_params(session->runner)->changes,
           sizeof edited->changes);
    session->points = gb_curve_count(curve);
    if (session->whatifs < GB_SESSION_WHATIFS) {
        session->whatif_at[session->whatifs++] = session->points;
    }
    gb_session_note(session, "changed after step %lld (relative density %.4f): %s",
                    (long long)step, gb_curve_at(curve, session->points - 1)->density,
                    session->whatif_text);
}

/* Starts the continuation when the state of the next point has arrived. */
static void session_whatif_refresh(struct gb_session *session)
{
    struct gb_error err = {0};
    struct gb_runner *runner = NULL;
    int64_t step = 0;
    if (session->whatif_text[0] == '\0' || session->runner == NULL) {
        return;
    }
    if (gb_runner_forked(session->runner, &step)) {
        char *directory = gb_run_lifecycle_directory(session);
        const bool forked = gb_runner_create_fork(&runner, session->whatif_text,
                                                  session->runner, directory, &err);
        g_free(directory);
        if (forked) {
            gb_session_replace(session, runner);
            note(session, step);
        } else {
            gb_session_note(session, "what-if: %s", err.text);
        }
        session->whatif_text[0] = '\0';
    } else if (session->run_state > GB_RUN_PAUSED) {
        session->whatif_text[0] = '\0';
        gb_session_note(session, "the run ended before the what-if");
    }
}

bool gb_session_refresh(struct gb_session *session)
{
    const enum gb_run_state before = session->quick_cell.state;
    gb_past_steps_note(&session->steps, session->preset);
    const enum quick_cell_news news =
        quick_cell_refresh(&session->quick_cell, session->frozen);
    session->waiting = session->waiting && session->quick_cell.state == before;
    const bool ran = refresh_run(session);
    session_whatif_refresh(session);
    bool succeeded = false;
    const bool made = refresh_child(session, &succeeded);
    const bool measured =
        gb_job_moduli_refresh(&session->moduli, session->runner, &session->child, made);
    if (session->moduli.failed.code != GB_OK) {
        gb_session_note(session, "moduli: %s", session->moduli.failed.text);
        session->moduli.failed = (struct gb_error){0};
    }
    const bool charted =
        gb_job_chart_refresh(&session->chart_job, &session->chart, &session->stability);
    if (succeeded) {
        gb_results_take(&session->results, session, session->child.name,
                        session->child.path);
    }
    if (news == QUICK_CELL_ENDED) {
        session_quick_finish(session);
    }
    return news != QUICK_CELL_SAME || ran || made || measured || charted;
}

/* Results that are kept in memory, and the steps of the parameters. */

/* Largest number of parameters named by an undo; more are counted. */
enum { NAMED_MAX = 3 };

/* Moves the run, or the quick cell if it has finished, from the session to the results
 * kept in memory. */
static void session_recall_keep_run(struct gb_session *session)
{
    const char *directory = gb_runner_directory(session->runner);
    const bool followed = session->attached != NULL && directory != NULL &&
                          strcmp(session->attached, directory) == 0;
    struct gb_kept_run run = {.params = *gb_runner_params(session->runner),
                              .runner = session->runner,
                              .stopped = gb_session_run_is_live(session),
                              .label = session->run_label,
                              .whatifs = session->whatifs};
    memcpy(run.whatif_at, session->whatif_at, sizeof run.whatif_at);
    session->runner = NULL;
    if (followed) { /* another process computes it */
        gb_runner_destroy(run.runner);
    } else {
        gb_past_runs_add(&session->kept, &run);
    }
}

/* The same for a run or quick cell that was shown before. */
static void session_adopt(struct gb_session *session, struct gb_runner *runner)
{
    if (session->runner != NULL) {
        gb_previous_list_keep(session, gb_runner_params(session->runner), session->runner,
                              GB_SESSION_FULL_CELL);
        session_recall_keep_run(session);
    }
    session->runner = runner;
    gb_runner_send(runner, GB_COMMAND_WATCH);
    gb_term_crash_set_run(gb_runner_directory(runner));
    session->yielded = false;
    session->start_due = false;
    session->frozen = false;
    session->pause_wanted = false;
    session->waiting = false;
    session->run_state = GB_RUN_PACKING;
    session->points = 0;
    session->sample = NULL;
    session->events_seen = 0;
    memset(&session->now, 0, sizeof session->now);
    session->now.seconds_left = -1.0;
    gb_previous_list_describe(session, gb_runner_params(runner));
}

static void show(struct gb_session *session, struct gb_kept_run *run)
{
    const struct gb_snapshot *now = gb_runner_snapshot(run->runner, NULL);
    session_adopt(session, run->runner);
    session->run_state = now->state;
    session->events_seen = now->events;
    session_refresh_show(session, now);
}

static bool recall_run(struct gb_session *session, const struct gb_params *params)
{
    struct gb_kept_run run;
    struct gb_runner *resumed = NULL;
    struct gb_error err = {0};
    if (!gb_past_runs_take(&session->kept, params, false, &run)) {
        return false;
    }
    if (!session_quick_matches(session, params)) {
        session_quick_keep_curve(session);
        session_recall_keep_quick(session);
    }
    const char *directory = gb_runner_directory(run.runner);
    if (run.stopped && directory != NULL && gb_runner_resume(&resumed, directory, &err)) {
        session_adopt(session, resumed);
        gb_runner_destroy(run.runner);
        gb_session_note(session, "the stopped run continues");
    } else {
        show(session, &run);
        gb_session_note(session, "this run is from memory");
    }
    session->run_label = run.label;
    session->whatifs = run.whatifs;
    memcpy(session->whatif_at, run.whatif_at, sizeof session->whatif_at);
    gb_previous_list_forget(session, params, false);
    gb_previous_list_forget(session, params, true);
    return true;
}

static bool recall_quick(struct gb_session *session, const struct gb_params *params)
{
    struct gb_kept_run run;
    if (!gb_past_runs_take(&session->kept, params, true, &run)) {
        return false;
    }
    session_quick_keep_curve(session);
    session_recall_keep_quick(session);
    quick_cell_adopt(&session->quick_cell, &run.params, run.runner);
    gb_previous_list_forget(session, params, true);
    gb_previous_list_describe(session, params);
    session_quick_finish(session);
    return true;
}

void gb_session_show_edited(struct gb_session *session)
{
    const struct gb_params params = *gb_session_params(session);
    session->start_due = false;
    const bool on_display = session->runner != NULL && gb_session_changes(session) == 0;
    if (on_display ||
        (!recall_run(session, &params) && !recall_quick(session, &params))) {
        gb_previous_list_forget(session, &params, true); /* it is computed again */
        gb_session_quick_start(session);
    }
}

bool gb_session_recall_step(struct gb_session *session, int direction, char *text,
                            size_t size)
{
    const char *verb = direction < 0 ? "undo" : "redo";
    const struct gb_params before = *gb_session_params(session);
    char difference[GB_PARAMS_DIFF_TEXT];
    struct gb_preset *preset = gb_past_steps_move(&session->steps, direction);
    if (preset == NULL) {
        snprintf(text, size, "nothing to %s", verb);
        return false;
    }
    session->preset = preset;
    const int count = gb_previous_diff_count(gb_session_params(session), &before);
    if (count > NAMED_MAX) {
        snprintf(difference, sizeof difference, "%d parameters", count);
    } else {
        gb_previous_diff_text(gb_session_params(session), &before, difference,
                              sizeof difference);
    }
    snprintf(text, size, "%s: %s; %d more", verb, difference,
             gb_past_steps_left(&session->steps, direction));
    return true;
}

/* The changes are checked with a step that is never reached, so that an error is
 * reported now and not at the next point. */
static const int64_t some_step = INT64_C(1000000000);

bool gb_session_whatif_request(struct gb_session *session, const char *text,
                               struct gb_error *err)
{
    if (!gb_session_run_is_live(session)) {
        return gb_error_set(err, GB_ERR_INPUT, "no live run: r starts one");
    }
    struct gb_params probe = *gb_runner_params(session->runner);
    if (strlen(text) >= sizeof session->whatif_text ||
        !gb_changes_add(&probe, some_step, text, err) ||
        !gb_change_allowed(gb_runner_params(session->runner), &probe, some_step, err)) {
        return err->code != GB_OK ? false : gb_error_set(err, GB_ERR_INPUT, "too long");
    }
    if (!gb_runner_send(session->runner, GB_COMMAND_FORK) ||
        (session->run_state == GB_RUN_PAUSED &&
         !gb_runner_send(session->runner, GB_COMMAND_RESUME))) {
        return gb_error_set(err, GB_ERR_INPUT, "the engine is busy: try again");
    }
    session->pause_wanted = false;
    g_strlcpy(session->whatif_text, text, sizeof session->whatif_text);
    return true;
}

void gb_session_init(struct gb_session *session, struct gb_preset *preset)
{
    memset(session, 0, sizeof *session);
    session->preset = preset;
    session->now.seconds_left = -1.0;
    session->auto_start = true;
    gb_past_steps_note(&session->steps, preset);
}

void gb_session_finish(struct gb_session *session)
{
    quick_cell_drop(&session->quick_cell);
    gb_runner_destroy(session->runner);
    for (int i = 0; i < session->previous_count; i++) {
        gb_previous_curve_finish(&session->previous[i]);
    }
    gb_job_replicas_finish(&session->replica_band);
    gb_job_moduli_finish(&session->moduli);
    gb_results_finish(&session->results);
    gb_measured_destroy(session->measured);
    g_free(session->reading);
    gb_job_chart_csv_destroy(session->chart);
    gb_job_stability_destroy(session->stability);
    gb_job_chart_finish(&session->chart_job);
    gb_past_runs_finish(&session->kept);
    gb_past_steps_finish(&session->steps);
    if (session->opened != NULL) {
        g_ptr_array_unref(session->opened);
    }
    session->runner = NULL;
    session->opened = NULL;
}

void gb_session_note(struct gb_session *session, const char *format, ...)
{
    char text[GB_EVENT_TEXT];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    char *line = session->log[session->log_count % GB_SESSION_LOG];
    snprintf(line, sizeof session->log[0], "%.1f s: %s", session->now.seconds, text);
    session->log_count++;
}

const char *gb_session_event_line(const struct gb_session *session, int index)
{
    const int64_t at = session->log_count - 1 - index;
    if (index < 0 || at < 0 || index >= GB_SESSION_LOG) {
        return NULL;
    }
    return session->log[at % GB_SESSION_LOG];
}

bool gb_session_cost_question(struct gb_session *session, char *text, size_t size)
{
    double seconds = NAN;
    if (session_quick_cost(session, &seconds, text, size)) {
        return true;
    }
    return gb_run_lifecycle_cost_question(gb_session_params(session),
                                          session->particle_steps_per_s, text, size);
}

void gb_session_replace(struct gb_session *session, struct gb_runner *runner)
{
    session_adopt(session, runner);
    session->run_label = (struct gb_curve_label){.marker = '\0'};
    session->runs++;
}

bool gb_session_start(struct gb_session *session, struct gb_error *err)
{
    const struct gb_params *params = gb_session_params(session);
    struct gb_runner *runner = NULL;
    if (!gb_run_lifecycle_start(&runner, session, params, err)) {
        return false;
    }
    if (session->quick_cell.runner != NULL && !session_quick_matches(session, params)) {
        session_recall_keep_quick(session);
    }
    gb_session_replace(session, runner);
    session->whatifs = 0;
    gb_session_note(session, "run %d started", session->runs);
    return true;
}

bool gb_session_run_is_live(const struct gb_session *session)
{
    return session->runner != NULL && session->run_state <= GB_RUN_PAUSED;
}

struct gb_session_shown gb_session_shown(const struct gb_session *session)
{
    const struct gb_quick_cell *quick_cell = &session->quick_cell;
    if (quick_cell->runner != NULL &&
        (gb_session_quick_cell_live(quick_cell) || session->runner == NULL)) {
        return (struct gb_session_shown){&quick_cell->now,
                                         gb_runner_params(quick_cell->runner),
                                         gb_runner_curve(quick_cell->runner),
                                         quick_cell->points,
                                         quick_cell->sample,
                                         quick_cell->state,
                                         true};
    }
    if (session->runner == NULL) {
        return (struct gb_session_shown){.now = &session->now,
                                         .params = gb_preset_params(session->preset)};
    }
    return (struct gb_session_shown){&session->now,
                                     gb_runner_params(session->runner),
                                     gb_runner_curve(session->runner),
                                     session->points,
                                     session->sample,
                                     session->run_state,
                                     false};
}

static void destroy_preset(void *preset)
{
    gb_preset_destroy(preset);
}

/* Opens a preset.  Earlier presets stay, because an undo may return to them. */
bool gb_session_open(struct gb_session *session, const char *name, struct gb_error *err)
{
    struct gb_preset *preset = NULL;
    if (!gb_preset_load(&preset, name, err)) {
        return false;
    }
    if (session->opened == NULL) {
        session->opened = g_ptr_array_new_with_free_func(destroy_preset);
    }
    g_ptr_array_add(session->opened, preset);
    session->preset = preset;
    return true;
}

static void set_measured(struct gb_session *session, struct gb_measured *measured,
                         const char *reading)
{
    gb_measured_destroy(session->measured);
    g_free(session->reading);
    session->measured = measured;
    session->measured_dimension = gb_session_shown(session).params->dimension;
    session->reading = g_strdup(reading);
}

enum gb_lab_outcome gb_session_load_data(struct gb_session *session, const char *path,
                                         const char *reading,
                                         struct gb_lab_report *report,
                                         struct gb_error *err)
{
    struct gb_measured *measured = NULL;
    struct gb_chart_csv *chart = NULL;
    struct gb_table *table = NULL;
    struct gb_lab_options options;
    *report = (struct gb_lab_report){.choices = 0};
    if (*path == '\0') {
        set_measured(session, NULL, "");
        return GB_LAB_READ;
    }
    if (gb_job_chart_csv_read(&chart, path, NULL)) {
        gb_job_chart_csv_destroy(session->chart);
        gb_job_chart_finish(&session->chart_job);
        session->chart = chart;
        return GB_LAB_READ;
    }
    gb_lab_options_init(&options);
    if (!gb_lab_options_parse(&options, reading, err)) {
        return GB_LAB_FAILED;
    }
    enum gb_lab_outcome outcome =
        gb_lab_reader_read(&table, path, &options, NULL, report, err);
    if (outcome == GB_LAB_READ && gb_measured_take(&measured, table, false, err)) {
        set_measured(session, measured, reading);
    } else if (outcome == GB_LAB_READ) {
        outcome = GB_LAB_FAILED;
    }
    gb_table_destroy(table);
    return outcome;
}

const struct gb_measured *gb_session_measured(const struct gb_session *session)
{
    const int dimension = gb_session_shown(session).params->dimension;
    return session->measured_dimension == dimension ? session->measured : NULL;
}

const struct gb_runset_view_group *gb_session_replicas(const struct gb_session *session)
{
    const int dimension = gb_session_shown(session).params->dimension;
    return session->replica_band.params.dimension == dimension
               ? gb_job_replicas_group(&session->replica_band)
               : NULL;
}

void gb_session_misfit(const struct gb_session *session, struct gb_measured_misfit *out)
{
    const struct gb_session_shown shown = gb_session_shown(session);
    *out = (struct gb_measured_misfit){.reached = 0};
    const struct gb_measured *measured = gb_session_measured(session);
    if (measured != NULL && shown.curve != NULL) {
        gb_measured_compare(measured, shown.curve, shown.points, out);
    }
}

void gb_session_toggle_pause(struct gb_session *session)
{
    const bool quick = gb_session_quick_cell_live(&session->quick_cell);
    if (!gb_session_live(session)) {
        return;
    }
    const bool wanted = !session->pause_wanted;
    if (gb_runner_send(quick ? session->quick_cell.runner : session->runner,
                       wanted ? GB_COMMAND_PAUSE : GB_COMMAND_RESUME)) {
        session->pause_wanted = wanted;
        session->waiting = true;
    }
}

void gb_session_toggle_freeze(struct gb_session *session)
{
    session->frozen = !session->frozen;
    if (!session->frozen && session->runner != NULL) {
        session_refresh_show(session, gb_runner_snapshot(session->runner, NULL));
    }
}

bool gb_session_live(const struct gb_session *session)
{
    return gb_session_quick_cell_live(&session->quick_cell) ||
           gb_session_run_is_live(session);
}

bool gb_session_busy(const struct gb_session *session)
{
    const enum gb_run_state state = gb_session_shown(session).state;
    return session->child.pid != 0 ||
           ((session->runner != NULL || session->quick_cell.runner != NULL) &&
            (state <= GB_RUN_RUNNING || session->waiting));
}

bool gb_session_differs(struct gb_session *session, const struct gb_field *field)
{
    return session->runner != NULL &&
           !gb_previous_diff_same(gb_session_params(session),
                                  gb_runner_params(session->runner), field);
}

int gb_session_changes(struct gb_session *session)
{
    size_t count = 0;
    int changes = 0;
    const struct gb_field *field = gb_params_fields(&count);
    for (size_t i = 0; i < count; i++) {
        changes += gb_session_differs(session, &field[i]);
    }
    return changes;
}
