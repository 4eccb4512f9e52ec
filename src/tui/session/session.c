#include "tui/session/session.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "tui/session/cost_confirm.h"
#include "tui/session/overlay/previous_list.h"
#include "tui/session/past/session_recall.h"
#include "tui/session/run_lifecycle.h"
#include "tui/session/session_quick.h"
#include "tui/session/session_refresh.h"
#include "tui/term/crash.h"

void gb_session_init(struct gb_session *session, struct gb_preset *preset)
{
    memset(session, 0, sizeof *session);
    session->preset = preset;
    session->now.seconds_left = -1.0;
    session->auto_start = true;
    gb_param_steps_note(&session->steps, preset);
}

void gb_session_finish(struct gb_session *session)
{
    gb_quick_cell_drop(&session->quick_cell);
    gb_runner_destroy(session->runner);
    for (int i = 0; i < session->previous_count; i++) {
        gb_previous_curve_finish(&session->previous[i]);
    }
    gb_replica_band_finish(&session->replica_band);
    gb_moduli_job_finish(&session->moduli);
    gb_results_finish(&session->results);
    gb_measured_destroy(session->measured);
    g_free(session->reading);
    gb_chart_csv_destroy(session->chart);
    gb_stability_csv_destroy(session->stability);
    gb_chart_job_finish(&session->chart_job);
    gb_kept_runs_finish(&session->kept);
    gb_param_steps_finish(&session->steps);
    if (session->opened != NULL) {
        g_ptr_array_unref(session->opened);
    }
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

bool gb_session_cost_question(struct gb_session *session, char *text, size_t size)
{
    double seconds = NAN;
    if (gb_session_quick_cost(session, &seconds, text, size)) {
        return true;
    }
    return gb_cost_confirm_question(gb_session_params(session),
                                    session->particle_steps_per_s, text, size);
}

void gb_session_adopt(struct gb_session *session, struct gb_runner *runner)
{
    if (session->runner != NULL) {
        gb_previous_list_keep(session, gb_runner_params(session->runner), session->runner,
                              GB_SESSION_FULL_CELL);
        gb_session_recall_keep_run(session);
    }
    session->runner = runner;
    gb_runner_send(runner, GB_COMMAND_WATCH);
    gb_crash_set_run(gb_runner_directory(runner));
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

void gb_session_replace(struct gb_session *session, struct gb_runner *runner)
{
    gb_session_adopt(session, runner);
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
    if (session->quick_cell.runner != NULL &&
        !gb_session_quick_matches(session, params)) {
        gb_session_recall_keep_quick(session);
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

static void destroy_preset(void *preset)
{
    gb_preset_destroy(preset);
}

/* Earlier presets stay: an undo goes back to them. */
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
    if (gb_chart_csv_read(&chart, path, NULL)) {
        gb_chart_csv_destroy(session->chart);
        gb_chart_job_finish(&session->chart_job);
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
               ? gb_replica_band_group(&session->replica_band)
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
        gb_session_refresh_show(session, gb_runner_snapshot(session->runner, NULL));
    }
}

bool gb_session_live(const struct gb_session *session)
{
    return gb_quick_cell_live(&session->quick_cell) || gb_session_run_is_live(session);
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
