#include <glib.h>
#include <string.h>

#include "tui/app/dialogs.h"
#include "tui/app/key_commands.h"
#include "tui/app/screen.h"
#include "tui/session/session.h"

/* The legs of loading.path: keys of their editor. */

static struct gb_leg_editor *editor_of(struct gb_app *app)
{
    return &app->screen.dialog.legs;
}

void gb_pane_commands_leg_open(struct gb_screen *screen)
{
    const struct gb_params *params = gb_session_params(&screen->session);
    gb_dialog_show_legs(&screen->dialog, &gb_dialogs_legs, params, screen->plot.glyphs);
}

void gb_pane_commands_leg_add(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    gb_leg_editor_insert(editor_of(app), 1);
}

void gb_pane_commands_leg_insert(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    gb_leg_editor_insert(editor_of(app), 0);
}

void gb_pane_commands_leg_delete(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    gb_leg_editor_delete(editor_of(app));
}

void gb_pane_commands_leg_down(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    gb_leg_editor_move(editor_of(app), 1);
}

void gb_pane_commands_leg_up(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    gb_leg_editor_move(editor_of(app), -1);
}

void gb_pane_commands_leg_text(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    gb_leg_editor_whole(editor_of(app));
}

/* The legs become the value of loading.path, and the quick cell follows it. */
void gb_pane_commands_leg_take(struct gb_app *app, const struct gb_key *key)
{
    struct gb_screen *screen = &app->screen;
    char *text = gb_leg_editor_list_join(&editor_of(app)->list);
    const struct gb_field *field = gb_params_find("loading", "path");
    (void)key;
    if (gb_panel_params_edit_set(&screen->session, field, text, &screen->message)) {
        gb_dialog_close(&screen->dialog);
    } else {
        gb_dialog_set_note(&screen->dialog, GB_DIALOG_NOTE_ERROR, "%s",
                           screen->message.text);
        screen->message.text[0] = '\0';
    }
    g_free(text);
}

/* Focus, navigation and the parameters. */

void gb_pane_commands_navigate(struct gb_app *app, const struct gb_key *key)
{
    const struct gb_pane_type *pane = gb_screen_pane(app->screen.focus);
    if (pane->navigate != NULL) {
        pane->navigate(&app->screen, key->action);
    }
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
