#include "tui/session/past/session_recall.h"

#include <stdio.h>
#include <string.h>

#include "tui/session/overlay/previous_list.h"
#include "tui/session/session_quick.h"
#include "tui/session/session_refresh.h"

/* Parameters that an undo names; more are counted. */
enum { NAMED_MAX = 3 };

void gb_session_recall_keep_run(struct gb_session *session)
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
    if (followed) { /* its engine is elsewhere */
        gb_runner_destroy(run.runner);
    } else {
        gb_kept_runs_add(&session->kept, &run);
    }
}

void gb_session_recall_keep_quick(struct gb_session *session)
{
    struct gb_quick_cell *cell = &session->quick_cell;
    if (cell->runner != NULL && cell->state == GB_RUN_DONE) {
        const struct gb_kept_run run = {
            .params = cell->full_params, .runner = cell->runner, .quick = true};
        cell->runner = NULL;
        gb_kept_runs_add(&session->kept, &run);
    }
    gb_quick_cell_drop(cell);
}

static void show(struct gb_session *session, struct gb_kept_run *run)
{
    const struct gb_snapshot *now = gb_runner_snapshot(run->runner, NULL);
    gb_session_adopt(session, run->runner);
    session->run_state = now->state;
    session->events_seen = now->events;
    gb_session_refresh_show(session, now);
}

static bool recall_run(struct gb_session *session, const struct gb_params *params)
{
    struct gb_kept_run run;
    struct gb_runner *resumed = NULL;
    struct gb_error err = {0};
    if (!gb_kept_runs_take(&session->kept, params, false, &run)) {
        return false;
    }
    if (!gb_session_quick_matches(session, params)) {
        gb_session_quick_keep_curve(session);
        gb_session_recall_keep_quick(session);
    }
    const char *directory = gb_runner_directory(run.runner);
    if (run.stopped && directory != NULL && gb_runner_resume(&resumed, directory, &err)) {
        gb_session_adopt(session, resumed);
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
    if (!gb_kept_runs_take(&session->kept, params, true, &run)) {
        return false;
    }
    gb_session_quick_keep_curve(session);
    gb_session_recall_keep_quick(session);
    gb_quick_cell_adopt(&session->quick_cell, &run.params, run.runner);
    gb_previous_list_forget(session, params, true);
    gb_previous_list_describe(session, params);
    gb_session_quick_finish(session);
    return true;
}

void gb_session_recall_answer(struct gb_session *session)
{
    const struct gb_params params = *gb_session_params(session);
    session->start_due = false;
    const bool on_display = session->runner != NULL && gb_session_changes(session) == 0;
    if (on_display ||
        (!recall_run(session, &params) && !recall_quick(session, &params))) {
        gb_previous_list_forget(session, &params, true); /* it is computed anew */
        gb_session_quick_start(session);
    }
}

bool gb_session_recall_step(struct gb_session *session, int direction, char *text,
                            size_t size)
{
    const char *verb = direction < 0 ? "undo" : "redo";
    const struct gb_params before = *gb_session_params(session);
    char difference[GB_PARAMS_DIFF_TEXT];
    struct gb_preset *preset = gb_param_steps_move(&session->steps, direction);
    if (preset == NULL) {
        snprintf(text, size, "nothing to %s", verb);
        return false;
    }
    session->preset = preset;
    const int count = gb_params_diff_count(gb_session_params(session), &before);
    if (count > NAMED_MAX) {
        snprintf(difference, sizeof difference, "%d parameters", count);
    } else {
        gb_params_diff_describe(gb_session_params(session), &before, difference,
                                sizeof difference);
    }
    snprintf(text, size, "%s: %s; %d more", verb, difference,
             gb_param_steps_left(&session->steps, direction));
    return true;
}
