#include "tui/session/whatif.h"

#include <glib.h>
#include <string.h>

#include "run/change.h"
#include "scene/field/changes.h"
#include "tui/session/run_lifecycle.h"

/* The changes are checked with a step that is never reached, so that an error is reported
 * now and not at the next point. */
static const int64_t some_step = INT64_C(1000000000);

bool gb_whatif_request(struct gb_session *session, const char *text, struct gb_error *err)
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

void gb_whatif_refresh(struct gb_session *session)
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
