#include "tui/session/session.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "run/cost.h"
#include "scene/loading_kind.h"
#include "tui/session/cost_confirm.h"
#include "tui/session/run_lifecycle.h"
#include "tui/session/whatif.h"
#include "tui/term/crash.h"

/* A live run is not replaced automatically after this computing time, s. */
static const double replaced_max_s = 60.0;

void gb_session_init(struct gb_session *session, struct gb_preset *preset)
{
    memset(session, 0, sizeof *session);
    session->preset = preset;
    session->now.seconds_left = -1.0;
    session->auto_start = true;
}

void gb_session_finish(struct gb_session *session)
{
    gb_quick_cell_drop(&session->quick_cell);
    gb_runner_destroy(session->runner);
    for (int i = 0; i < session->previous_count; i++) {
        gb_previous_curve_finish(&session->previous[i]);
    }
    gb_replica_band_finish(&session->replica_band);
    gb_measured_destroy(session->measured);
    gb_chart_csv_destroy(session->chart);
    gb_preset_destroy(session->opened);
    session->runner = NULL;
    session->opened = NULL;
}

struct gb_params *gb_session_params(struct gb_session *session)
{
    return gb_preset_params(session->preset);
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

/* Keeps the curve of a run that is replaced, unless it has fewer than two points or
 * memory is short. */
static void keep(struct gb_session *session, const struct gb_params *params,
                 const struct gb_runner *runner, bool quick)
{
    const struct gb_curve *curve = gb_runner_curve(runner);
    const size_t count = gb_curve_count(curve);
    struct gb_previous_curve previous;
    if (count < 2 || !gb_previous_curve_copy(&previous, params, curve, count)) {
        return;
    }
    if (session->previous_count == GB_SESSION_PREVIOUS) {
        gb_previous_curve_finish(&session->previous[0]);
        memmove(session->previous, session->previous + 1,
                (GB_SESSION_PREVIOUS - 1) * sizeof session->previous[0]);
        session->previous_count--;
    }
    previous.marker = (char)('a' + session->previous_total++ % 26);
    previous.quick = quick;
    session->previous[session->previous_count++] = previous;
}

static bool quick_cell_matches(const struct gb_session *session,
                               const struct gb_params *params)
{
    return session->quick_cell.runner != NULL &&
           gb_params_diff_count(&session->quick_cell.full_params, params) == 0;
}

/* Whether the full run of the quick cell has been started. */
static bool full_run_started(const struct gb_session *session)
{
    return session->runner != NULL &&
           quick_cell_matches(session, gb_runner_params(session->runner));
}

/* Keeps the curve of the quick cell unless the full run of its scene has been started. */
static void keep_quick_curve(struct gb_session *session)
{
    if (session->quick_cell.runner != NULL && !full_run_started(session)) {
        keep(session, &session->quick_cell.full_params, session->quick_cell.runner, true);
    }
}

/* Updates the differences of the previous curves to these parameters. */
static void describe_all(struct gb_session *session, const struct gb_params *params)
{
    for (int i = 0; i < session->previous_count; i++) {
        struct gb_previous_curve *previous = &session->previous[i];
        char text[GB_PARAMS_DIFF_TEXT];
        gb_params_diff_describe(&previous->params, params, text, sizeof text);
        snprintf(previous->difference, sizeof previous->difference, "%s%.80s",
                 previous->quick ? "quick: " : "", text);
    }
}

/* Cost of the full run, estimated from the quick cell; NaN: no estimate.  True: it needs
 * a confirmation, whose text is in text. */
static bool estimate_cost(const struct gb_session *session, double *seconds, char *text,
                          size_t size)
{
    const struct gb_quick_cell *quick_cell = &session->quick_cell;
    const struct gb_params *params = gb_preset_params(session->preset);
    *seconds = NAN;
    return quick_cell->runner != NULL && quick_cell->state == GB_RUN_DONE &&
           quick_cell_matches(session, params) &&
           gb_cost_confirm_after_quick(
               params, gb_runner_params(quick_cell->runner),
               gb_runner_snapshot(quick_cell->runner, NULL)->seconds, seconds, text,
               size);
}

bool gb_session_cost_question(struct gb_session *session, char *text, size_t size)
{
    double seconds = NAN;
    if (estimate_cost(session, &seconds, text, size)) {
        return true;
    }
    return gb_cost_confirm_question(gb_session_params(session),
                                    session->particle_steps_per_s, text, size);
}

void gb_session_replace(struct gb_session *session, struct gb_runner *runner)
{
    if (session->runner != NULL) {
        keep(session, gb_runner_params(session->runner), session->runner, false);
        gb_runner_destroy(session->runner);
    }
    session->runner = runner;
    gb_runner_send(runner, GB_COMMAND_WATCH);
    gb_crash_set_run(gb_runner_directory(runner));
    session->runs++;
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
    describe_all(session, gb_runner_params(runner));
}

bool gb_session_start(struct gb_session *session, struct gb_error *err)
{
    const struct gb_params *params = gb_session_params(session);
    struct gb_runner *runner = NULL;
    if (!gb_run_lifecycle_start(&runner, session, params, err)) {
        return false;
    }
    if (session->quick_cell.runner != NULL && !quick_cell_matches(session, params)) {
        gb_quick_cell_drop(&session->quick_cell);
    }
    session->whatifs = 0;
    gb_session_replace(session, runner);
    gb_session_note(session, "run %d started", session->runs);
    return true;
}

bool gb_session_run_is_live(const struct gb_session *session)
{
    return session->runner != NULL && session->run_state <= GB_RUN_PAUSED;
}

static void yield_engine(struct gb_session *session, bool yielded)
{
    if (session->yielded != yielded && session->runner != NULL &&
        gb_runner_send(session->runner,
                       yielded ? GB_COMMAND_YIELD : GB_COMMAND_CONTINUE)) {
        session->yielded = yielded;
    }
}

bool gb_session_start_quick(struct gb_session *session)
{
    const struct gb_params *params = gb_session_params(session);
    struct gb_error err = {0};
    session->start_due = false;
    if (session->runner != NULL && gb_session_changes(session) == 0) {
        gb_quick_cell_drop(&session->quick_cell);
        yield_engine(session, false);
        return false;
    }
    if (!gb_params_check(params, NULL)) {
        return false;
    }
    keep_quick_curve(session);
    yield_engine(session, gb_session_run_is_live(session));
    session->pause_wanted = false;
    if (!gb_quick_cell_start(&session->quick_cell, params, &err)) {
        gb_quick_cell_drop(&session->quick_cell);
        yield_engine(session, false);
        return false;
    }
    session->frozen = false;
    describe_all(session, params);
    return true;
}

bool gb_session_take_start_due(struct gb_session *session)
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
    estimate_cost(session, &seconds, question, sizeof question);
    if (isfinite(seconds)) {
        gb_session_note(session, "full cell of %lld: about %s (estimated)",
                        (long long)gb_session_params(session)->count,
                        gb_cost_duration(seconds, duration, sizeof duration));
    }
}

/* The full run follows unless it would replace a run with much computing time. */
static void finish_quick_cell(struct gb_session *session)
{
    const struct gb_quick_cell *quick_cell = &session->quick_cell;
    const struct gb_snapshot *now = gb_runner_snapshot(quick_cell->runner, NULL);
    yield_engine(session, false);
    if (quick_cell->state != GB_RUN_DONE) {
        gb_session_note(session, "quick cell: %s", now->error.text);
        return;
    }
    gb_session_note(session, "quick cell of %lld particles: curve in %.1f s",
                    (long long)gb_runner_params(quick_cell->runner)->count, now->seconds);
    if (full_run_started(session)) {
        return;
    }
    const bool works =
        gb_session_run_is_live(session) && session->now.seconds > replaced_max_s;
    note_estimate(session);
    /* a pause requested during the quick cell also applies to the full run */
    session->start_due = session->auto_start && !works && !session->pause_wanted;
    if (!session->start_due) {
        gb_session_note(session, "%sr starts the full cell",
                        works ? "the current run continues; " : "");
    }
}

struct gb_session_shown gb_session_shown(const struct gb_session *session)
{
    const struct gb_quick_cell *quick_cell = &session->quick_cell;
    if (quick_cell->runner != NULL &&
        (gb_quick_cell_live(quick_cell) || session->runner == NULL)) {
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

bool gb_session_open(struct gb_session *session, const char *name, struct gb_error *err)
{
    struct gb_preset *preset = NULL;
    if (!gb_preset_load(&preset, name, err)) {
        return false;
    }
    gb_preset_destroy(session->opened);
    session->opened = preset;
    session->preset = preset;
    return true;
}

bool gb_session_load_data(struct gb_session *session, const char *path,
                          struct gb_error *err)
{
    struct gb_measured *measured = NULL;
    struct gb_chart_csv *chart = NULL;
    if (*path != '\0' && gb_chart_csv_read(&chart, path, NULL)) {
        gb_chart_csv_destroy(session->chart);
        session->chart = chart;
        return true;
    }
    if (*path != '\0' && !gb_measured_read(&measured, path, err)) {
        return false;
    }
    gb_measured_destroy(session->measured);
    session->measured = measured;
    return true;
}

void gb_session_misfit(const struct gb_session *session, struct gb_measured_misfit *out)
{
    const struct gb_session_shown shown = gb_session_shown(session);
    *out = (struct gb_measured_misfit){.reached = 0};
    if (session->measured != NULL && shown.curve != NULL) {
        gb_measured_compare(session->measured, shown.curve, shown.points, out);
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

/* Takes over a snapshot for display. */
static void show(struct gb_session *session, const struct gb_snapshot *snapshot)
{
    session->now = *snapshot;
    session->points = gb_curve_count(gb_runner_curve(session->runner));
    session->sample = gb_runner_view_sample(session->runner, NULL);
    take_events(session);
}

/* Measured speed, for the cost estimate of the next run. */
static void take_rate(struct gb_session *session, const struct gb_snapshot *snapshot)
{
    if (gb_loading_kind_of(gb_runner_params(session->runner))->given_rate &&
        snapshot->particle_evaluations_per_s > 0.0) {
        session->particle_steps_per_s = snapshot->particle_evaluations_per_s;
    }
}

/* Updates of the run; true if the screen changes. */
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
        show(session, snapshot);
        return true;
    }
    return other_state;
}

/* Updates of the child command and of the replicas that it computes. */
static bool refresh_child(struct gb_session *session)
{
    char text[GB_EVENT_TEXT];
    bool some = false;
    bool ended = false;
    const bool live = session->child.pid != 0;
    enum gb_child_command_event news = GB_CHILD_COMMAND_NONE;
    while ((news = gb_child_command_poll(&session->child, text, sizeof text)) !=
           GB_CHILD_COMMAND_NONE) {
        if (news != GB_CHILD_COMMAND_PROGRESS) {
            gb_session_note(session, "%s", text);
        }
        some = true;
        ended = news == GB_CHILD_COMMAND_ENDED;
    }
    return (live && gb_replica_band_refresh(&session->replica_band, ended)) || some;
}

bool gb_session_refresh(struct gb_session *session)
{
    bool ended = false;
    const int before = session->quick_cell.state;
    const bool tried =
        gb_quick_cell_refresh(&session->quick_cell, session->frozen, &ended);
    session->waiting = session->waiting && session->quick_cell.state == before;
    const bool ran = refresh_run(session);
    gb_whatif_refresh(session);
    const bool made = refresh_child(session);
    if (ended) {
        finish_quick_cell(session);
    }
    return tried || ran || ended || made;
}

void gb_session_toggle_pause(struct gb_session *session)
{
    const bool quick = gb_quick_cell_live(&session->quick_cell);
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
        show(session, gb_runner_snapshot(session->runner, NULL));
    }
}

bool gb_session_live(const struct gb_session *session)
{
    return gb_quick_cell_live(&session->quick_cell) || gb_session_run_is_live(session);
}

bool gb_session_busy(const struct gb_session *session)
{
    const int state = gb_session_shown(session).state;
    return session->child.pid != 0 ||
           ((session->runner != NULL || session->quick_cell.runner != NULL) &&
            (state <= GB_RUN_RUNNING || session->waiting));
}

bool gb_session_differs(struct gb_session *session, const struct gb_field *field)
{
    return session->runner != NULL &&
           !gb_params_diff_same(gb_session_params(session),
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
