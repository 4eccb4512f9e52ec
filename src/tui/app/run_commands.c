#include <glib.h>
#include <stdio.h>
#include <string.h>

#include "run/quick.h"
#include "scene/loading_kind.h"
#include "scene/path/path.h"
#include "tui/app/dialogs.h"
#include "tui/app/key_commands.h"
#include "tui/session/run_lifecycle.h"
#include "tui/session/session.h"

/* The current run, its quick cell, and what-ifs. */

enum { QUESTION = 400 };

/* A refusal stays on the message line until the next key, even if a run starts. */
static bool is_refusal(const struct gb_message *message)
{
    return message->text[0] != '\0' &&
           (message->style == GB_STYLE_WARN || message->style == GB_STYLE_BAD);
}

/* Changes that a what-if or a preset has left are those of the next run, too. */
static void tell_changes(struct gb_app *app)
{
    const char *changes = gb_session_params(&app->screen.session)->changes;
    if (changes[0] != '\0') {
        char *text = g_strdup_printf(
            "this run has the changes after step %s; D drops them", changes);
        gb_session_note(&app->screen.session, "%s", text);
        gb_screen_commands_message(app, GB_STYLE_WARN, text);
        g_free(text);
    }
}

void gb_run_commands_drop_changes(struct gb_app *app, const struct gb_key *key)
{
    struct gb_screen *screen = &app->screen;
    struct gb_params *params = gb_session_params(&screen->session);
    (void)key;
    if (params->changes[0] == '\0') {
        gb_screen_commands_message(app, GB_STYLE_WARN,
                                   "there are no changes during the run to drop");
        return;
    }
    gb_session_note(&screen->session, "dropped: the changes after step %s",
                    params->changes);
    params->changes[0] = '\0';
    gb_panel_params_edit_changed(&screen->session, &screen->message);
}

static void start_run(struct gb_app *app)
{
    struct gb_error err = {0};
    if (gb_session_start(&app->screen.session, &err)) {
        app->screen.plot.cursor_on = false;
        if (!is_refusal(&app->screen.message)) {
            app->screen.message.text[0] = '\0';
        }
        tell_changes(app);
    } else {
        gb_screen_commands_message(app, GB_STYLE_BAD, err.text);
        gb_session_note(&app->screen.session, "not started: %s", err.text);
    }
}

/* An expensive run is started after a confirmation only. */
static void start_or_ask(struct gb_app *app)
{
    char question[QUESTION];
    if (gb_session_cost_question(&app->screen.session, question, sizeof question)) {
        gb_dialog_show(&app->screen.dialog, &gb_dialogs_cost, question);
    } else {
        start_run(app);
    }
}

void gb_run_commands_start(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    start_or_ask(app);
}

void gb_run_commands_accept_cost(struct gb_app *app)
{
    gb_dialog_close(&app->screen.dialog);
    app->screen.message.text[0] = '\0';
    start_run(app);
}

void gb_run_commands_decline_cost(struct gb_app *app)
{
    gb_session_note(&app->screen.session, "not started: declined");
    gb_screen_commands_message(app, GB_STYLE_WARN,
                               "not started: change the parameters, r asks again");
}

void gb_run_commands_start_scene(struct gb_app *app)
{
    const struct gb_params *params = gb_session_params(&app->screen.session);
    if (gb_quick_enough(params) || !gb_session_quick_start(&app->screen.session)) {
        start_or_ask(app);
    }
}

void gb_run_commands_follow_quick(struct gb_app *app)
{
    char question[QUESTION];
    struct gb_session *session = &app->screen.session;
    if (!gb_session_quick_take_due(session)) {
        return;
    }
    if (gb_session_cost_question(session, question, sizeof question)) {
        static const char text[] = "the full cell takes long: r shows how long and asks";
        gb_session_note(session, "%s", text);
        if (!is_refusal(&app->screen.message)) {
            gb_screen_commands_message(app, GB_STYLE_WARN, text);
        }
    } else {
        start_run(app);
    }
}

void gb_run_commands_pause(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    gb_session_toggle_pause(&app->screen.session);
}

void gb_run_commands_freeze(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    gb_session_toggle_freeze(&app->screen.session);
}

void gb_run_commands_take_over(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    gb_run_lifecycle_take_over(&app->screen.session, &app->screen.message);
}

void gb_run_commands_auto_start(struct gb_app *app, const struct gb_key *key)
{
    struct gb_session *session = &app->screen.session;
    (void)key;
    session->auto_start = !session->auto_start;
    gb_screen_commands_message(app, GB_STYLE_PLAIN,
                               session->auto_start
                                   ? "the full cell follows the quick one automatically"
                                   : "the full cell waits for r");
}

/* Prefills the dialog with the focused parameter. */
/* Semicolons separate assignments here: legs of a path are separated by `then`. */
static void separate_legs(char *text, size_t size)
{
    char **legs = gb_path_parse_split(text);
    if (strncmp(text, "loading.path=", strlen("loading.path=")) == 0) {
        char *joined = g_strjoinv(" then ", legs);
        g_strlcpy(text, joined, size);
        g_free(joined);
    }
    g_strfreev(legs);
}

void gb_run_commands_what_if(struct gb_app *app, const struct gb_key *key)
{
    struct gb_screen *screen = &app->screen;
    char text[GB_PARAMS_VALUE_MAX + 64];
    const struct gb_runner *run = screen->session.runner;
    const struct gb_params *params =
        run != NULL ? gb_runner_params(run) : gb_session_params(&screen->session);
    (void)key;
    if (!gb_loading_kind_of(params)->changes) {
        gb_screen_commands_message(
            app, GB_STYLE_WARN,
            "a what-if continues from an equilibrium, which only quasi-static runs have: "
            "change the parameter and start again with r");
        return;
    }
    if (!gb_session_run_is_live(&screen->session)) {
        gb_screen_commands_message(app, GB_STYLE_WARN,
                                   "a what-if needs a live run: r starts one");
        return;
    }
    gb_panel_params_assignment(&screen->params, &screen->session, text, sizeof text);
    separate_legs(text, sizeof text);
    gb_dialog_show(&screen->dialog, &gb_dialogs_what_if, text);
}

void gb_run_commands_accept_what_if(struct gb_app *app)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    struct gb_error err = {0};
    if (!gb_session_whatif_request(&app->screen.session, gb_dialog_answer(dialog),
                                   &err)) {
        gb_dialog_set_note(dialog, GB_DIALOG_NOTE_ERROR, "%s", err.text);
        return;
    }
    gb_dialog_close(dialog);
    gb_screen_commands_message(app, GB_STYLE_PLAIN,
                               "continues with these values from the next loading point");
}
