#include "tui/session/session_quick.h"

#include <math.h>

#include "run/cost.h"
#include "tui/session/cost_confirm.h"
#include "tui/session/overlay/previous_list.h"
#include "tui/session/past/session_recall.h"

/* A live run of more computing time, s, past and to come, is not replaced
 * automatically. */
static const double replaced_max_s = 60.0;

bool gb_session_quick_matches(const struct gb_session *session,
                              const struct gb_params *params)
{
    return session->quick_cell.runner != NULL &&
           gb_params_diff_count(&session->quick_cell.full_params, params) == 0;
}

/* Whether the full run of the quick cell has been started. */
static bool full_run_started(const struct gb_session *session)
{
    return session->runner != NULL &&
           gb_session_quick_matches(session, gb_runner_params(session->runner));
}

void gb_session_quick_keep_curve(struct gb_session *session)
{
    if (session->quick_cell.runner != NULL && !full_run_started(session)) {
        gb_previous_list_keep(session, &session->quick_cell.full_params,
                              session->quick_cell.runner, GB_SESSION_QUICK_CELL);
    }
}

bool gb_session_quick_cost(const struct gb_session *session, double *seconds, char *text,
                           size_t size)
{
    const struct gb_quick_cell *quick_cell = &session->quick_cell;
    const struct gb_params *params = gb_preset_params(session->preset);
    *seconds = NAN;
    return quick_cell->runner != NULL && quick_cell->state == GB_RUN_DONE &&
           gb_session_quick_matches(session, params) &&
           gb_cost_confirm_after_quick(
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

bool gb_session_quick_start(struct gb_session *session)
{
    const struct gb_params *params = gb_session_params(session);
    struct gb_error err = {0};
    session->start_due = false;
    if (session->runner != NULL && gb_session_changes(session) == 0) {
        gb_session_recall_keep_quick(session);
        set_engine(session, ENGINE_CONTINUES);
        return false;
    }
    if (!gb_params_check(params, NULL)) {
        return false;
    }
    gb_session_quick_keep_curve(session);
    gb_session_recall_keep_quick(session);
    set_engine(session,
               gb_session_run_is_live(session) ? ENGINE_WAITS : ENGINE_CONTINUES);
    session->pause_wanted = false;
    const enum gb_quick_cell_start outcome =
        gb_quick_cell_start(&session->quick_cell, params, &err);
    if (outcome == GB_QUICK_CELL_FAILED) {
        gb_session_note(session, "quick cell: %s", err.text);
    }
    if (outcome != GB_QUICK_CELL_STARTED) {
        gb_quick_cell_drop(&session->quick_cell);
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
    gb_session_quick_cost(session, &seconds, question, sizeof question);
    if (isfinite(seconds)) {
        gb_session_note(session, "full cell of %lld: about %s (estimated)",
                        (long long)gb_session_params(session)->count,
                        gb_cost_duration(seconds, duration, sizeof duration));
    }
}

/* What only r replaces: a live what-if, and a live run that takes long. */
static const char *irreplaceable(const struct gb_session *session)
{
    const bool what_if = session->whatifs > 0 || session->whatif_text[0] != '\0';
    if (!gb_session_run_is_live(session)) {
        return NULL;
    }
    const double whole = session->now.seconds_left >= 0.0
                             ? session->now.seconds + session->now.seconds_left
                             : gb_cost_assumed_s(gb_runner_params(session->runner));
    return what_if                                              ? "the what-if continues"
           : fmax(whole, session->now.seconds) > replaced_max_s ? "the current run continues"
                                                                : NULL;
}

/* The full run follows unless it would replace a run that has to go on. */
void gb_session_quick_finish(struct gb_session *session)
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
    session->start_due =
        session->auto_start && running == NULL && !session->pause_wanted;
    if (!session->start_due) {
        gb_session_note(session, "%s%sr starts the full cell",
                        running != NULL ? running : "", running != NULL ? "; " : "");
    }
}
