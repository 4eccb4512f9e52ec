#include <glib.h>

#include "tui/app/dialog/dialogs.h"
#include "tui/app/command/key_commands.h"
#include "tui/app/panes.h"
#include "tui/term/clipboard.h"

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
    const struct gb_pane_type *pane = gb_panes_type(screen->focus);
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

void gb_copy_commands_copy(struct gb_app *app, const struct gb_key *key)
{
    struct gb_error err = {0};
    char *text = chosen(app);
    (void)key;
    if (text == NULL) {
        tell(app, GB_STYLE_WARN, "nothing to copy yet: r starts a run");
    } else if (!gb_clipboard_copy(app->screen.term, text, &err)) {
        tell(app, GB_STYLE_WARN, err.text);
    } else {
        char *told = g_strdup_printf("copied: %s", text);
        tell(app, GB_STYLE_PLAIN, g_strdelimit(told, "\n\t", ' '));
        g_free(told);
    }
    g_free(text);
}
