#include <glib.h>

#include "tui/app/dialog/dialogs.h"
#include "tui/app/command/key_commands.h"
#include "tui/app/panes.h"
#include "tui/session/past/session_recall.h"

/* Focus, navigation and the parameters. */

void gb_pane_commands_navigate(struct gb_app *app, const struct gb_key *key)
{
    const struct gb_pane_type *pane = gb_panes_type(app->screen.focus);
    if (pane->navigate != NULL) {
        pane->navigate(&app->screen, key->action);
    }
}

/* In the compact layout plot and state share the focus. */
static void change_focus(struct gb_screen *screen, int step)
{
    screen->focus = (enum gb_pane)(((int)screen->focus + step + GB_PANES) % GB_PANES);
    if (screen->layout.kind == GB_LAYOUT_COMPACT && screen->focus == GB_PANE_STATE) {
        screen->focus = step > 0 ? GB_PANE_EVENTS : GB_PANE_PLOT;
    }
}

void gb_pane_commands_next(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    change_focus(&app->screen, 1);
}

void gb_pane_commands_previous(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    change_focus(&app->screen, -1);
}

/* Tab goes on to the next pane, which is zoomed then. */
void gb_pane_commands_zoom(struct gb_app *app, const struct gb_key *key)
{
    struct gb_screen *screen = &app->screen;
    (void)key;
    screen->zoom = !screen->zoom;
    g_strlcpy(screen->message.text,
              screen->zoom ? "one pane: Tab goes to the next, z shows all again" : "",
              sizeof screen->message.text);
    screen->message.style = GB_STYLE_PLAIN;
}

void gb_pane_commands_find(struct gb_app *app, const struct gb_key *key)
{
    struct gb_screen *screen = &app->screen;
    (void)key;
    gb_dialog_show_finder(&screen->dialog, &gb_dialogs_find,
                          gb_session_params(&screen->session));
}

void gb_pane_commands_accept_find(struct gb_app *app)
{
    struct gb_screen *screen = &app->screen;
    const int field = gb_param_finder_selected(&screen->dialog.finder);
    if (field >= 0) {
        gb_panel_params_go(&screen->params, &screen->session, field);
        screen->focus = GB_PANE_PARAMS;
        gb_dialog_close(&screen->dialog);
    }
}

void gb_pane_commands_list_all(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    gb_panel_params_list_all(&app->screen.params, &app->screen.message);
}

void gb_pane_commands_increase(struct gb_app *app, const struct gb_key *key)
{
    struct gb_screen *screen = &app->screen;
    (void)key;
    gb_panel_params_edit_step(&screen->params, &screen->session, 1, &screen->message);
}

void gb_pane_commands_decrease(struct gb_app *app, const struct gb_key *key)
{
    struct gb_screen *screen = &app->screen;
    (void)key;
    gb_panel_params_edit_step(&screen->params, &screen->session, -1, &screen->message);
}

/* A warning of a conflict is kept. */
static void step(struct gb_screen *screen, int direction)
{
    char text[sizeof screen->message.text];
    struct gb_session *session = &screen->session;
    const bool moved = gb_session_recall_step(session, direction, text, sizeof text);
    if (moved) {
        gb_panel_params_edit_changed(session, &screen->message);
    }
    if (!moved || screen->message.text[0] == '\0') {
        g_strlcpy(screen->message.text, text, sizeof screen->message.text);
        screen->message.style = moved ? GB_STYLE_PLAIN : GB_STYLE_WARN;
    }
}

void gb_pane_commands_undo(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    if (app->screen.dialog.type == &gb_dialogs_legs) {
        gb_leg_editor_undo(&app->screen.dialog.legs);
        return;
    }
    step(&app->screen, -1);
}

void gb_pane_commands_redo(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    step(&app->screen, 1);
}

void gb_pane_commands_revert(struct gb_app *app, const struct gb_key *key)
{
    struct gb_screen *screen = &app->screen;
    (void)key;
    gb_panel_params_edit_revert(&screen->params, &screen->session, &screen->message);
}
