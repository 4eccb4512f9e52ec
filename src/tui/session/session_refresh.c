#include "tui/session/session_refresh.h"

#include "scene/loading_kind.h"
#include "tui/session/session_quick.h"
#include "tui/session/whatif.h"

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

void gb_session_refresh_show(struct gb_session *session,
                             const struct gb_snapshot *snapshot)
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
        gb_session_refresh_show(session, snapshot);
        return true;
    }
    return other_state;
}

/* Updates of the child command and of the replicas that it computes.  *succeeded: it has
 * ended well. */
static bool refresh_child(struct gb_session *session, bool *succeeded)
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
    *succeeded = ended && session->child.succeeded;
    return (live && gb_replica_band_refresh(&session->replica_band, ended)) || some;
}

bool gb_session_refresh(struct gb_session *session)
{
    const enum gb_run_state before = session->quick_cell.state;
    gb_param_steps_note(&session->steps, session->preset);
    const enum gb_quick_cell_news news =
        gb_quick_cell_refresh(&session->quick_cell, session->frozen);
    session->waiting = session->waiting && session->quick_cell.state == before;
    const bool ran = refresh_run(session);
    gb_whatif_refresh(session);
    bool succeeded = false;
    const bool made = refresh_child(session, &succeeded);
    const bool measured =
        gb_moduli_job_refresh(&session->moduli, session->runner, &session->child, made);
    if (session->moduli.failed.code != GB_OK) {
        gb_session_note(session, "moduli: %s", session->moduli.failed.text);
        session->moduli.failed = (struct gb_error){0};
    }
    const bool charted = gb_chart_job_refresh(&session->chart_job, &session->chart,
                                              &session->stability);
    if (succeeded) {
        gb_results_take(&session->results, session, session->child.name,
                        session->child.path);
    }
    if (news == GB_QUICK_CELL_ENDED) {
        gb_session_quick_finish(session);
    }
    return news != GB_QUICK_CELL_SAME || ran || made || measured || charted;
}
