#include "tui/app/dispatch.h"

#include "tui/app/command/key_commands.h"

enum { LAST_ASCII = 126 };

void gb_dispatch_key(struct gb_app *app, const struct gb_key *key)
{
    const struct gb_screen *screen = &app->screen;
    const int here = screen->layout.kind == GB_LAYOUT_TOO_SMALL ? GB_KEY_TOO_SMALL
                                                                : 1 << screen->focus;
    if (key->scope & here) {
        key->command(app, key);
    }
}

static void handle_dialog(struct gb_app *app, const struct gb_term_event *event)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    const struct gb_dialog_type *type = dialog->type;
    struct gb_key key;
    if (gb_dialog_takes_keys(dialog) && gb_keys_find(event->code, type->scope, &key)) {
        key.command(app, &key);
        return;
    }
    if (type->press != NULL && type->press(app, event)) {
        return;
    }
    switch (gb_dialog_handle(dialog, event)) {
    case GB_DIALOG_OPEN:
        break;
    case GB_DIALOG_ACCEPTED:
        type->accept(app);
        break;
    case GB_DIALOG_CANCELLED:
        if (type->decline != NULL) {
            type->decline(app);
        }
        break;
    }
}

void gb_dispatch_event(struct gb_app *app, const struct gb_term_event *event)
{
    struct gb_screen *screen = &app->screen;
    struct gb_key key;
    if (screen->layout.kind != GB_LAYOUT_TOO_SMALL) {
        if (screen->dialog.type != NULL) {
            handle_dialog(app, event);
            return;
        }
        if (screen->params.editing) {
            gb_panel_params_edit_key(&screen->params, &screen->session, event,
                                     &screen->message);
            return;
        }
    }
    /* code points beyond ASCII overlap with the key codes of curses */
    if (event->kind == GB_TERM_TEXT && event->code > LAST_ASCII) {
        return;
    }
    screen->message.text[0] = '\0';
    if (gb_keys_find(event->code, GB_KEY_ALWAYS, &key)) {
        gb_dispatch_key(app, &key);
    }
}
