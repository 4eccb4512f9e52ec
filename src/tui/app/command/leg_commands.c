#include <string.h>

#include "tui/app/dialog/dialogs.h"
#include "tui/app/command/key_commands.h"

/* The legs of loading.path: keys of their editor. */

static struct gb_leg_editor *editor_of(struct gb_app *app)
{
    return &app->screen.dialog.legs;
}

void gb_leg_commands_open(struct gb_screen *screen)
{
    const struct gb_params *params = gb_session_params(&screen->session);
    gb_dialog_show_legs(&screen->dialog, &gb_dialogs_legs, params, screen->plot.glyphs);
}

void gb_leg_commands_add(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    gb_leg_editor_insert(editor_of(app), 1);
}

void gb_leg_commands_insert(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    gb_leg_editor_insert(editor_of(app), 0);
}

void gb_leg_commands_delete(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    gb_leg_editor_delete(editor_of(app));
}

void gb_leg_commands_down(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    gb_leg_editor_move(editor_of(app), 1);
}

void gb_leg_commands_up(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    gb_leg_editor_move(editor_of(app), -1);
}

void gb_leg_commands_text(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    gb_leg_editor_whole(editor_of(app));
}

/* The legs become the value of loading.path, and the quick cell follows it. */
void gb_leg_commands_take(struct gb_app *app, const struct gb_key *key)
{
    struct gb_screen *screen = &app->screen;
    char *text = gb_leg_list_join(&editor_of(app)->list);
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
