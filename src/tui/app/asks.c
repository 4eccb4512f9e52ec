#include "tui/app/asks.h"

#include <glib.h>
#include <stdio.h>
#include <string.h>

#include "run/quick.h"
#include "scene/loading_kind.h"
#include "tui/app/complete.h"
#include "tui/session/many.h"
#include "tui/session/repeat.h"
#include "tui/session/user_presets.h"
#include "tui/session/whatif.h"

void gb_asks_tell(struct gb_app *app, enum gb_style style, const char *text)
{
    g_strlcpy(app->screen.message.text, text, sizeof app->screen.message.text);
    app->screen.message.style = style;
}

/* What a key was refused with stays until the next key, whatever comes of itself. */
static bool refuses(const struct gb_message *message)
{
    return message->text[0] != '\0' &&
           (message->style == GB_STYLE_WARN || message->style == GB_STYLE_BAD);
}

static void begin_run(struct gb_app *app)
{
    struct gb_error err = {0};
    if (gb_session_start(&app->screen.session, &err)) {
        app->screen.plot.cursor_on = false;
        if (!refuses(&app->screen.message)) {
            app->screen.message.text[0] = '\0';
        }
    } else {
        gb_asks_tell(app, GB_STYLE_BAD, err.text);
        gb_session_note(&app->screen.session, "not started: %s", err.text);
    }
}

/* What would take hours is not begun by a single key. */
void gb_asks_start_run(struct gb_app *app)
{
    char question[400];
    if (gb_session_cost_question(&app->screen.session, question, sizeof question)) {
        gb_dialog_show(&app->screen.dialog, GB_DIALOG_COSTLY, question);
    } else {
        begin_run(app);
    }
}

/* A scene that is opened answers with its quick cell first, unless it is quick itself. */
void gb_asks_start_scene(struct gb_app *app)
{
    const struct gb_params *params = gb_session_params(&app->screen.session);
    if (gb_quick_enough(params) || !gb_session_start_quick(&app->screen.session)) {
        gb_asks_start_run(app);
    }
}

/* The quick curve is there: the full cell follows.  What takes hours waits for r. */
void gb_asks_follow(struct gb_app *app)
{
    char question[400];
    if (!gb_session_take_start_due(&app->screen.session)) {
        return;
    }
    if (gb_session_cost_question(&app->screen.session, question, sizeof question)) {
        static const char text[] = "the full cell takes long: r tells how long and asks";
        gb_session_note(&app->screen.session, "%s", text);
        if (!refuses(&app->screen.message)) {
            gb_asks_tell(app, GB_STYLE_WARN, text);
        }
    } else {
        begin_run(app);
    }
}

void gb_asks_decline(struct gb_app *app)
{
    gb_session_note(&app->screen.session, "not started: declined");
    gb_asks_tell(app, GB_STYLE_WARN, "not started: change the parameters, r asks again");
}

void gb_asks_leave(struct gb_app *app, int status)
{
    app->leave = true;
    app->status = status;
}

void gb_asks_save(struct gb_app *app)
{
    char *name = gb_user_presets_suggest(app->screen.session.preset);
    gb_dialog_show(&app->screen.dialog, GB_DIALOG_SAVE, name);
    g_free(name);
}

static void save(struct gb_app *app)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    struct gb_preset *preset = app->screen.session.preset;
    struct gb_error err = {0};
    char *path = gb_user_presets_file(gb_dialog_answer(dialog), &err);
    if (path == NULL) {
        g_strlcpy(dialog->note, err.text, sizeof dialog->note);
        return;
    }
    if (!dialog->warned && g_file_test(path, G_FILE_TEST_EXISTS)) {
        dialog->warned = true;
        snprintf(dialog->note, sizeof dialog->note, "%s exists: Enter again replaces it",
                 path);
    } else if (!gb_preset_save(preset, path, true, &err)) {
        dialog->warned = false;
        g_strlcpy(dialog->note, err.text, sizeof dialog->note);
    } else {
        gb_session_note(&app->screen.session, "saved %s", path);
        char *text = g_strdup_printf("saved as %s", path);
        gb_asks_tell(app, GB_STYLE_GOOD, text);
        g_free(text);
        gb_dialog_close(dialog);
    }
    g_free(path);
}

static void open_preset(struct gb_app *app)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    struct gb_error err = {0};
    const char *name = gb_dialog_answer(dialog);
    if (!gb_session_open(&app->screen.session, name, &err)) {
        g_strlcpy(dialog->note, err.text, sizeof dialog->note);
        return;
    }
    gb_session_note(&app->screen.session, "opened %s", name);
    gb_dialog_close(dialog);
    gb_asks_start_scene(app);
}

void gb_asks_data(struct gb_app *app)
{
    const struct gb_measured *measured = app->screen.session.measured;
    gb_dialog_show(&app->screen.dialog, GB_DIALOG_DATA,
                   measured != NULL ? measured->path : "");
}

static void load_data(struct gb_app *app)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    struct gb_error err = {0};
    char *path = gb_complete_home(gb_dialog_answer(dialog));
    const struct gb_chart_csv *before = app->screen.session.choices;
    if (!gb_session_load_data(&app->screen.session, path, &err)) {
        dialog->warned = false;
        g_strlcpy(dialog->note, err.text, sizeof dialog->note);
    } else {
        const bool chart = app->screen.session.choices != before;
        gb_session_note(&app->screen.session, *path != '\0' ? "loaded %s" : "no data%s",
                        path);
        gb_dialog_close(dialog);
        app->screen.plot.view = chart ? GB_VIEW_CHART : GB_VIEW_CURVE;
        app->screen.focus = GB_PANE_PLOT;
    }
    g_free(path);
}

/* Begins with the parameter that has the focus. */
void gb_asks_fork(struct gb_app *app)
{
    struct gb_screen *screen = &app->screen;
    char text[GB_PARAMS_VALUE_MAX + 64];
    const struct gb_runner *run = screen->session.runner;
    const struct gb_params *params =
        run != NULL ? gb_runner_params(run) : gb_session_params(&screen->session);
    if (!gb_loading_kind_of(params)->changes) {
        gb_asks_tell(
            app, GB_STYLE_WARN,
            "a what-if goes on from an equilibrium, which only quasi-static runs "
            "have: change the parameter and r starts anew");
        return;
    }
    if (!gb_session_run_is_live(&screen->session)) {
        gb_asks_tell(app, GB_STYLE_WARN, "a what-if needs a run under way: r starts one");
        return;
    }
    gb_panel_params_assignment(&screen->params, &screen->session, text, sizeof text);
    gb_dialog_show(&screen->dialog, GB_DIALOG_FORK, text);
}

static void fork_run(struct gb_app *app)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    struct gb_error err = {0};
    if (!gb_whatif_ask(&app->screen.session, gb_dialog_answer(dialog), &err)) {
        g_strlcpy(dialog->note, err.text, sizeof dialog->note);
        return;
    }
    gb_dialog_close(dialog);
    gb_asks_tell(app, GB_STYLE_PLAIN,
                 "goes on with that from its next point of the loading");
}

static void find(struct gb_app *app)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    if (gb_panel_params_find(&app->screen.params, &app->screen.session,
                             gb_dialog_answer(dialog))) {
        app->screen.focus = GB_PANE_PARAMS;
        gb_dialog_close(dialog);
    } else {
        snprintf(dialog->note, sizeof dialog->note, "no parameter has that in its name");
    }
}

/* Another command of this program makes it from the run's directory, beside the screen.
 * Its path: the directory, middle, a number that is free, end. */
void gb_asks_errand(struct gb_app *app, const char *what, const char *command,
                    const char *middle, const char *end)
{
    struct gb_session *session = &app->screen.session;
    const char *directory =
        session->runner != NULL ? gb_runner_directory(session->runner) : NULL;
    struct gb_error err = {0};
    if (directory == NULL) {
        gb_asks_tell(app, GB_STYLE_WARN, "there is no stored run yet: r starts one");
        return;
    }
    char *path = NULL;
    for (int i = 1; path == NULL || g_file_test(path, G_FILE_TEST_EXISTS); i++) {
        g_free(path);
        path = g_strdup_printf("%s%s%d%s", directory, middle, i, end);
    }
    const char *const words[] = {command, directory, "-o", path, NULL};
    if (gb_child_command_start(&session->child, what, path, false, words, &err)) {
        gb_asks_tell(app, GB_STYLE_PLAIN,
                     "is being made: the events will say where it is");
    } else {
        gb_asks_tell(app, GB_STYLE_BAD, err.text);
    }
    g_free(path);
}

void gb_asks_command(struct gb_app *app)
{
    struct gb_session *session = &app->screen.session;
    int rows = 0;
    int cols = 0;
    gb_term_size(app->screen.term, &rows, &cols);
    char *text = gb_repeat_command(session->preset, gb_session_params(session), cols - 1);
    gb_dialog_show(&app->screen.dialog, GB_DIALOG_COMMAND, text);
    g_free(text);
}

void gb_asks_toggle_follow(struct gb_app *app)
{
    struct gb_session *session = &app->screen.session;
    session->follow = !session->follow;
    gb_asks_tell(app, GB_STYLE_PLAIN,
                 session->follow ? "the full cell follows the quick one by itself"
                                 : "the full cell waits for r");
}

void gb_asks_answer(struct gb_app *app)
{
    switch (app->screen.dialog.kind) {
    case GB_DIALOG_SAVE:
        save(app);
        break;
    case GB_DIALOG_OPEN:
        open_preset(app);
        break;
    case GB_DIALOG_QUIT:
        gb_asks_leave(app, 0);
        break;
    case GB_DIALOG_COSTLY:
        gb_dialog_close(&app->screen.dialog);
        app->screen.message.text[0] = '\0';
        begin_run(app);
        break;
    case GB_DIALOG_DATA:
        load_data(app);
        break;
    case GB_DIALOG_FIND:
        find(app);
        break;
    case GB_DIALOG_FORK:
        fork_run(app);
        break;
    case GB_DIALOG_CELLS:
        gb_many_cells(app);
        break;
    case GB_DIALOG_FIT:
        gb_many_fit(app);
        break;
    case GB_DIALOG_COMMAND:
    case GB_DIALOG_HELP:
    case GB_DIALOG_NONE:
        break;
    }
}

void gb_asks_leave_live(struct gb_app *app)
{
    const struct gb_session *session = &app->screen.session;
    const bool kept =
        session->runner != NULL && gb_runner_directory(session->runner) != NULL;
    const char *text = session->attached != NULL
                           ? "A run is shown that is under way elsewhere; it goes on."
                       : kept
                           ? "A run is live. It stops with a checkpoint, and `greenbody "
                             "resume` goes on with it."
                           : "A run is live; what it has found so far is not stored.";
    gb_dialog_show(&app->screen.dialog, GB_DIALOG_QUIT, text);
}

void gb_asks_quit(struct gb_app *app)
{
    const bool shown = app->screen.layout.kind != GB_LAYOUT_TOO_SMALL;
    if (gb_session_live(&app->screen.session) && shown) {
        gb_asks_leave_live(app);
    } else {
        gb_asks_leave(app, 0);
    }
}
