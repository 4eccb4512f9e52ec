/* Commands of the panes: the clipboard, mouse, theme, help and quitting, the editor of
 * a loading path, focus and navigation, and the value of the focused parameter. */
#include <glib.h>
#include <string.h>

#include "tui/app/dialogs.h"
#include "tui/app/key_commands.h"
#include "tui/app/screen.h"
#include "tui/session/run_lifecycle.h"
#include "tui/session/session.h"
#include "tui/term/term.h"

/* The clipboard: what the dialog shows, or what is under the cursor of the pane. */

/* The folder of the run on display; NULL: none. */
static char *folder(const struct gb_session *session)
{
    return session->runner != NULL ? g_strdup(gb_runner_directory(session->runner))
                                   : NULL;
}

static char *chosen(struct gb_app *app)
{
    struct gb_screen *screen = &app->screen;
    if (screen->dialog.type != NULL) {
        return screen->dialog.type->copied(app);
    }
    const struct gb_pane_type *pane = gb_screen_pane(screen->focus);
    char *text = pane->copied != NULL ? pane->copied(screen) : NULL;
    return text != NULL ? text : folder(&screen->session);
}

/* Reports "copied: contact.mu=0.15"; a dialog shows it above its contents. */
static void tell(struct gb_app *app, enum gb_style style, const char *text)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    if (dialog->type != NULL) {
        gb_dialog_set_note(dialog, GB_DIALOG_NOTE_WARNING, "%s", text);
    } else {
        gb_pane_commands_message(app, style, text);
    }
}

void gb_pane_commands_copy(struct gb_app *app, const struct gb_key *key)
{
    struct gb_error err = {0};
    char *text = chosen(app);
    (void)key;
    if (text == NULL) {
        tell(app, GB_STYLE_WARN, "nothing to copy yet: r starts a run");
    } else if (!gb_term_clipboard_copy(app->screen.term, text, &err)) {
        tell(app, GB_STYLE_WARN, err.text);
    } else {
        char *told = g_strdup_printf("copied: %s", text);
        tell(app, GB_STYLE_PLAIN, g_strdelimit(told, "\n\t", ' '));
        g_free(told);
    }
    g_free(text);
}

/* Mouse, theme, help and quitting. */

void gb_pane_commands_message(struct gb_app *app, enum gb_style style, const char *text)
{
    g_strlcpy(app->screen.message.text, text, sizeof app->screen.message.text);
    app->screen.message.style = style;
}

void gb_pane_commands_mouse(struct gb_app *app, const struct gb_key *key)
{
    struct gb_term *term = app->screen.term;
    const bool on = !gb_term_has_mouse(term);
    (void)key;
    gb_term_mouse(term, on);
    gb_pane_commands_message(app, GB_STYLE_PLAIN,
                             gb_term_has_mouse(term)
                                 ? "mouse on: clicks and wheel; Shift-drag selects text"
                             : on ? "this terminal reports no mouse"
                                  : "mouse off: the terminal selects text");
}

/* Selects the next theme; after the last one the first, which asks the terminal. */
void gb_pane_commands_theme(struct gb_app *app, const struct gb_key *key)
{
    static const char *const told[] = {
        "auto: for a light and a dark background of the terminal",
        "light: for a light background of the terminal",
        "dark: for a dark background of the terminal",
        "contrast: white on a black background"};
    struct gb_screen *screen = &app->screen;
    struct gb_settings settings = {.theme = (gb_term_present_theme(screen->term) + 1) %
                                            (int)G_N_ELEMENTS(told)};
    struct gb_error err = {0};
    char *path = gb_settings_path();
    char text[sizeof screen->message.text];
    (void)key;
    gb_term_set_theme(screen->term, settings.theme);
    gb_term_repaint(screen->term);
    if (gb_settings_remember(path, "theme", gb_settings_word(&settings, "theme"), &err)) {
        g_snprintf(text, sizeof text, "theme %s; kept in %s", told[settings.theme], path);
    } else {
        g_snprintf(text, sizeof text, "theme %s; not kept: %s", told[settings.theme],
                   err.text);
    }
    gb_pane_commands_message(app, GB_STYLE_PLAIN, text);
    g_free(path);
}

void gb_pane_commands_repaint(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    gb_term_repaint(app->screen.term);
}

void gb_pane_commands_help(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    gb_dialog_show(&app->screen.dialog, &gb_dialogs_help, NULL);
}

void gb_pane_commands_leave(struct gb_app *app, int status)
{
    app->leave = true;
    app->status = status;
}

void gb_pane_commands_ask_quit(struct gb_app *app)
{
    char text[sizeof app->screen.dialog.note];
    gb_run_lifecycle_quit_text(&app->screen.session, text, sizeof text);
    gb_dialog_show(&app->screen.dialog, &gb_dialogs_quit, text);
    static const char *const answers[] = {[GB_DETACH_NOTHING] = NULL,
                                          [GB_DETACH_RUN] = "d leave it running",
                                          [GB_DETACH_START] = "d run the full cell"};
    app->screen.dialog.other = answers[gb_run_lifecycle_detaching(&app->screen.session)];
}

/* Key d in the question before quitting: the run continues in a process of its own. */
bool gb_pane_commands_press_quit(struct gb_app *app, const struct gb_term_event *event)
{
    struct gb_session *session = &app->screen.session;
    struct gb_dialog *dialog = &app->screen.dialog;
    struct gb_error err = {0};
    if (event->code != 'd' || dialog->other == NULL) {
        return false;
    }
    switch (gb_run_lifecycle_detaching(session)) {
    case GB_DETACH_NOTHING: /* it has ended in the meantime */
        return false;
    case GB_DETACH_START:
        if (!gb_session_start(session, &err)) {
            gb_dialog_set_note(dialog, GB_DIALOG_NOTE_ERROR, "%s", err.text);
            return true;
        }
        break;
    case GB_DETACH_RUN:
        break;
    }
    app->detach = true;
    gb_pane_commands_leave(app, 0);
    return true;
}

void gb_pane_commands_quit(struct gb_app *app, const struct gb_key *key)
{
    const bool visible = app->screen.layout.kind != GB_LAYOUT_TOO_SMALL;
    (void)key;
    if (gb_session_live(&app->screen.session) && visible) {
        gb_pane_commands_ask_quit(app);
    } else {
        gb_pane_commands_leave(app, 0);
    }
}

void gb_pane_commands_accept_quit(struct gb_app *app)
{
    gb_pane_commands_leave(app, 0);
}

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

/* Sets loading.path from the legs and starts the quick cell. */
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

/* Changes the focused value by a step.  A warning about a conflict stays visible. */
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

/* Moves the focus.  In the compact layout plot and state share it. */
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

/* Zooms the focused pane.  Tab then zooms the next pane. */
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
    const int field = gb_dialog_found(&screen->dialog.finder);
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
