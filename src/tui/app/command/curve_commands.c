#include <glib.h>

#include "tui/app/command/key_commands.h"
#include "tui/app/dialog/dialogs.h"
#include "tui/session/overlay/previous_list.h"
#include "tui/term/text_fit.h"

/* The list of curves: pin, name, hide, delete. */

void gb_curve_commands_open(struct gb_app *app, const struct gb_key *key)
{
    struct gb_screen *screen = &app->screen;
    (void)key;
    gb_dialog_show_curves(&screen->dialog, &gb_dialogs_curves, &screen->session,
                          screen->plot.at_pa);
}

/* The curve in focus; a note of the last command is removed. */
static int focused(struct gb_app *app)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    gb_dialog_set_note(dialog, GB_DIALOG_NOTE_ERROR, "%s", "");
    return gb_curve_list_focused(&dialog->curves, &app->screen.session);
}

static void refuse(struct gb_app *app, const char *text)
{
    gb_dialog_set_note(&app->screen.dialog, GB_DIALOG_NOTE_WARNING, "%s", text);
}

void gb_curve_commands_pin(struct gb_app *app, const struct gb_key *key)
{
    struct gb_session *session = &app->screen.session;
    const int index = focused(app);
    (void)key;
    if (index != GB_CURVE_LIST_NONE &&
        !gb_previous_list_pin(session, index,
                              !gb_previous_list_label(session, index)->pinned)) {
        gb_dialog_set_note(&app->screen.dialog, GB_DIALOG_NOTE_WARNING,
                           "%d curves are pinned, more cannot be: unpin one",
                           GB_PREVIOUS_PINNED);
    }
}

void gb_curve_commands_hide(struct gb_app *app, const struct gb_key *key)
{
    struct gb_session *session = &app->screen.session;
    const int index = focused(app);
    (void)key;
    if (index >= 0) {
        gb_previous_list_hide(session, index, !session->previous[index].label.hidden);
    } else if (index == GB_CURVE_LIST_RUN) {
        refuse(app, "the run on display is always shown");
    }
}

void gb_curve_commands_delete(struct gb_app *app, const struct gb_key *key)
{
    struct gb_session *session = &app->screen.session;
    const int index = focused(app);
    (void)key;
    if (index >= 0) {
        gb_previous_list_delete(session, index);
    } else if (index == GB_CURVE_LIST_RUN) {
        refuse(app, "the run on display stays: another run replaces it");
    }
}

void gb_curve_commands_accept_name(struct gb_app *app)
{
    struct gb_session *session = &app->screen.session;
    struct gb_curve_list *list = &app->screen.dialog.curves;
    const int index = focused(app);
    if (index != GB_CURVE_LIST_NONE) {
        char *name = g_strstrip(g_strdup(gb_prompt_text(&list->prompt)));
        struct gb_curve_label *label = gb_previous_list_label(session, index);
        gb_text_fit_copy(label->name, sizeof label->name, name);
        g_free(name);
    }
    list->naming = false;
}
