#include <glib.h>
#include <stdio.h>
#include <string.h>

#include "tui/app/command/key_commands.h"
#include "tui/app/dialog/dialogs.h"
#include "tui/app/dispatch.h"
#include "tui/view/views.h"

/* Results of the jobs in the background, as cards. */

/* The equations fitted to what is shown, with the intervals that the view has. */
static void make_fit(struct gb_session *session)
{
    const struct gb_session_shown shown = gb_session_shown(session);
    if (shown.curve != NULL && shown.points > 1) {
        gb_compaction_cache_update(&session->results.fits, shown.curve, shown.points,
                                   shown.state >= GB_RUN_DONE ? GB_COMPACTION_PROFILE
                                                              : GB_COMPACTION_LINEAR);
        gb_results_make(&session->results, session, GB_RESULTS_FIT);
    }
}

/* The card of the view that is shown becomes the newest one. */
void gb_result_commands_show(struct gb_app *app, const struct gb_key *key)
{
    struct gb_session *session = &app->screen.session;
    (void)key;
    if (app->screen.plot.view->draw == gb_view_fit_draw) {
        make_fit(session);
    } else if (app->screen.plot.view->draw == gb_view_moduli_draw) {
        gb_results_make(&session->results, session, GB_RESULTS_MODULI);
    }
    if (session->results.count == 0) {
        gb_screen_commands_message(
            app, GB_STYLE_WARN,
            "no result yet: C, R, Y, s and x make one, and view E with a curve");
        return;
    }
    gb_dialog_show_results(&app->screen.dialog, &gb_dialogs_results, session);
}

/* Nothing that is typed is interrupted. */
void gb_result_commands_follow(struct gb_app *app)
{
    struct gb_screen *screen = &app->screen;
    struct gb_results *results = &screen->session.results;
    if (!gb_results_take_news(results)) {
        return;
    }
    app->redraw = true;
    const struct gb_dialog_type *open = screen->dialog.type;
    if ((open == NULL || open == &gb_dialogs_results) && !screen->params.editing &&
        screen->layout.kind != GB_LAYOUT_TOO_SMALL) {
        gb_dialog_show_results(&screen->dialog, &gb_dialogs_results, &screen->session);
    } else {
        char text[96];
        snprintf(text, sizeof text, "%s: the result is there, W shows it",
                 gb_results_at(results, 0)->kind->title);
        gb_screen_commands_message(app, GB_STYLE_GOOD, text);
    }
}

char *gb_result_commands_text(struct gb_app *app)
{
    return gb_result_card_text(
        gb_results_at(&app->screen.session.results, app->screen.dialog.focus));
}

void gb_result_commands_accept(struct gb_app *app)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    struct gb_session *session = &app->screen.session;
    const struct gb_result_card *card = gb_results_at(&session->results, dialog->focus);
    struct gb_error err = {0};
    char *told = NULL;
    if (card->values->len == 0) {
        gb_dialog_set_note(dialog, GB_DIALOG_NOTE_WARNING, "%s",
                           "there is nothing to use in this result");
        return;
    }
    if (!gb_result_card_use(card, gb_session_params(session), &told, &err)) {
        gb_dialog_set_note(dialog, GB_DIALOG_NOTE_ERROR, "%s", err.text);
        return;
    }
    gb_session_note(session, "%s used: %s", card->kind->title, told);
    gb_dialog_close(dialog);
    gb_panel_params_edit_changed(session, &app->screen.message);
    if (app->screen.message.text[0] == '\0') {
        char text[400];
        snprintf(text, sizeof text, "used: %.300s; u undoes", told);
        gb_screen_commands_message(app, GB_STYLE_GOOD, text);
    }
    g_free(told);
}

/* In the terminal where it has pixels; nothing else is started for it. */
static void open_result(struct gb_app *app)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    const struct gb_result_card *card =
        gb_results_at(&app->screen.session.results, dialog->focus);
    const char *page = card->page != NULL ? card->page : card->path;
    struct gb_png_pixels picture = {0};
    struct gb_error err = {0};
    if (page == NULL) {
        return;
    }
    if (card->picture == NULL || gb_term_images(app->screen.term) == GB_IMAGES_NONE) {
        gb_dialog_set_note(dialog, GB_DIALOG_NOTE_WARNING, "%s%s",
                           card->page != NULL ? "in a browser: "
                           : card->picture != NULL
                               ? "this terminal shows no pixels: open "
                               : "in an editor: ",
                           page);
    } else if (gb_png_pixels_read(&picture, card->picture, &err)) {
        gb_dialog_show_pixels(dialog, &gb_dialogs_pixels, &picture, page);
    } else {
        gb_dialog_set_note(dialog, GB_DIALOG_NOTE_ERROR, "%s", err.text);
    }
}

static bool is_own(int code)
{
    struct gb_key key;
    switch (gb_keys_action(code)) {
    case GB_ACTION_ENTER:
    case GB_ACTION_LEFT:
    case GB_ACTION_RIGHT:
    case GB_ACTION_UP:
    case GB_ACTION_DOWN:
    case GB_ACTION_BACK:
        return true;
    default:
        return gb_keys_find(code, GB_KEY_EVERYWHERE, &key) &&
               (key.command == gb_screen_commands_quit ||
                key.command == gb_result_commands_show);
    }
}

/* A card comes by itself: keys that it does not have act as without it. */
bool gb_result_commands_press(struct gb_app *app, const struct gb_term_event *event)
{
    if (event->kind == GB_TERM_TEXT && event->code == 'o') {
        open_result(app);
        return true;
    }
    if (is_own(event->code)) {
        return false;
    }
    gb_dialog_close(&app->screen.dialog);
    gb_dispatch_event(app, event);
    return true;
}
