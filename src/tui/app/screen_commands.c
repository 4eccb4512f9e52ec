#include <glib.h>

#include "tui/app/dialogs.h"
#include "tui/app/key_commands.h"
#include "tui/app/screen.h"
#include "tui/session/run_lifecycle.h"
#include "tui/term/term.h"

/* The clipboard: what the dialog shows, or what is under the cursor of the pane. */

/* The folder of the run shown; NULL: none. */
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

/* "copied: contact.mu=0.15"; a dialog tells it above its content. */
static void tell(struct gb_app *app, enum gb_style style, const char *text)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    if (dialog->type != NULL) {
        gb_dialog_set_note(dialog, GB_DIALOG_NOTE_WARNING, "%s", text);
    } else {
        gb_screen_commands_message(app, style, text);
    }
}

void gb_screen_commands_copy(struct gb_app *app, const struct gb_key *key)
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

void gb_screen_commands_message(struct gb_app *app, enum gb_style style, const char *text)
{
    g_strlcpy(app->screen.message.text, text, sizeof app->screen.message.text);
    app->screen.message.style = style;
}

void gb_screen_commands_mouse(struct gb_app *app, const struct gb_key *key)
{
    struct gb_term *term = app->screen.term;
    const bool on = !gb_term_has_mouse(term);
    (void)key;
    gb_term_mouse(term, on);
    gb_screen_commands_message(app, GB_STYLE_PLAIN,
                               gb_term_has_mouse(term)
                                   ? "mouse on: clicks and wheel; Shift-drag selects text"
                               : on ? "this terminal reports no mouse"
                                    : "mouse off: the terminal selects text");
}

/* After the last theme the first one, which asks the terminal. */
void gb_screen_commands_theme(struct gb_app *app, const struct gb_key *key)
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
    gb_screen_commands_message(app, GB_STYLE_PLAIN, text);
    g_free(path);
}

void gb_screen_commands_repaint(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    gb_term_repaint(app->screen.term);
}

void gb_screen_commands_help(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    gb_dialog_show(&app->screen.dialog, &gb_dialogs_help, NULL);
}

void gb_screen_commands_leave(struct gb_app *app, int status)
{
    app->leave = true;
    app->status = status;
}

void gb_screen_commands_ask_quit(struct gb_app *app)
{
    char text[sizeof app->screen.dialog.note];
    gb_run_lifecycle_quit_text(&app->screen.session, text, sizeof text);
    gb_dialog_show(&app->screen.dialog, &gb_dialogs_quit, text);
    static const char *const answers[] = {[GB_DETACH_NOTHING] = NULL,
                                          [GB_DETACH_RUN] = "d leave it running",
                                          [GB_DETACH_START] = "d run the full cell"};
    app->screen.dialog.other = answers[gb_run_lifecycle_detaching(&app->screen.session)];
}

/* d: the run goes on in a process of its own. */
bool gb_screen_commands_press_quit(struct gb_app *app, const struct gb_term_event *event)
{
    struct gb_session *session = &app->screen.session;
    struct gb_dialog *dialog = &app->screen.dialog;
    struct gb_error err = {0};
    if (event->code != 'd' || dialog->other == NULL) {
        return false;
    }
    switch (gb_run_lifecycle_detaching(session)) {
    case GB_DETACH_NOTHING: /* it has ended meanwhile */
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
    gb_screen_commands_leave(app, 0);
    return true;
}

void gb_screen_commands_quit(struct gb_app *app, const struct gb_key *key)
{
    const bool visible = app->screen.layout.kind != GB_LAYOUT_TOO_SMALL;
    (void)key;
    if (gb_session_live(&app->screen.session) && visible) {
        gb_screen_commands_ask_quit(app);
    } else {
        gb_screen_commands_leave(app, 0);
    }
}

void gb_screen_commands_accept_quit(struct gb_app *app)
{
    gb_screen_commands_leave(app, 0);
}
