#include "tui/app/dialog/dialog.h"

#include <glib.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "tui/app/command/key_commands.h"
#include "tui/app/dialog/dialog_forms.h"

void gb_dialog_set_note(struct gb_dialog *dialog, enum gb_dialog_note kind,
                        const char *format, ...)
{
    va_list list;
    va_start(list, format);
    vsnprintf(dialog->note, sizeof dialog->note, format, list);
    va_end(list);
    dialog->kind = kind;
}

void gb_dialog_show(struct gb_dialog *dialog, const struct gb_dialog_type *type,
                    const char *text)
{
    const char *content = text != NULL ? text : "";
    gb_dialog_close(dialog);
    dialog->type = type;
    if (type->form == &gb_dialog_forms_command) {
        dialog->text = g_strdup(content);
    } else if (type->form == &gb_dialog_forms_help) {
        gb_help_list_init(&dialog->help);
    } else if (type->form == &gb_dialog_forms_question) {
        gb_dialog_set_note(dialog, GB_DIALOG_NOTE_ERROR, "%s", content);
    } else {
        gb_prompt_set(&dialog->prompt, content);
    }
}

void gb_dialog_show_presets(struct gb_dialog *dialog, const struct gb_dialog_type *type,
                            const struct gb_preset_browser_kind *kind,
                            const struct gb_params *current)
{
    gb_dialog_close(dialog);
    dialog->type = type;
    gb_preset_browser_init(&dialog->browser, kind, current);
}

void gb_dialog_show_legs(struct gb_dialog *dialog, const struct gb_dialog_type *type,
                         const struct gb_params *params, enum gb_plot_glyphs glyphs)
{
    gb_dialog_close(dialog);
    dialog->type = type;
    gb_leg_editor_init(&dialog->legs, params->path, params->dimension, glyphs);
}

void gb_dialog_show_finder(struct gb_dialog *dialog, const struct gb_dialog_type *type,
                           const struct gb_params *params)
{
    gb_dialog_close(dialog);
    dialog->type = type;
    gb_param_finder_init(&dialog->finder, params);
}

void gb_dialog_show_densities(struct gb_dialog *dialog, const struct gb_dialog_type *type,
                              struct gb_session *session, bool hide_previous)
{
    gb_dialog_close(dialog);
    dialog->type = type;
    dialog->session = session;
    dialog->hide_previous = hide_previous;
}

void gb_dialog_show_picture(struct gb_dialog *dialog, const struct gb_dialog_type *type,
                            const char *path)
{
    gb_dialog_close(dialog);
    dialog->type = type;
    gb_picture_form_init(&dialog->picture, path);
}

void gb_dialog_show_results(struct gb_dialog *dialog, const struct gb_dialog_type *type,
                            struct gb_session *session)
{
    gb_dialog_close(dialog);
    dialog->type = type;
    dialog->session = session;
}

void gb_dialog_show_pixels(struct gb_dialog *dialog, const struct gb_dialog_type *type,
                            const struct gb_png_pixels *picture, const char *path)
{
    char *text = g_strdup(path); /* of the card that is closed */
    gb_dialog_close(dialog);
    dialog->type = type;
    dialog->pixels = *picture;
    gb_dialog_set_note(dialog, GB_DIALOG_NOTE_WARNING, "%s", text);
    g_free(text);
}

void gb_dialog_show_curves(struct gb_dialog *dialog, const struct gb_dialog_type *type,
                           struct gb_session *session, double typed_pa)
{
    gb_dialog_close(dialog);
    dialog->type = type;
    dialog->session = session;
    gb_curve_list_init(&dialog->curves, session, typed_pa);
}

bool gb_dialog_takes_keys(const struct gb_dialog *dialog)
{
    return dialog->type->scope != 0 && dialog->legs.typing == GB_LEG_EDITOR_LIST &&
           !dialog->curves.naming;
}

void gb_dialog_close(struct gb_dialog *dialog)
{
    gb_png_pixels_finish(&dialog->pixels);
    gb_preset_browser_finish(&dialog->browser);
    gb_leg_editor_finish(&dialog->legs);
    g_free(dialog->text);
    memset(dialog, 0, sizeof *dialog);
}

void gb_dialog_draw(struct gb_dialog *dialog, const struct gb_paint *screen)
{
    if (dialog->type != NULL) {
        dialog->type->form->draw(dialog, screen);
    }
}

/* Esc, q, and the key that opened the dialog. */
static bool closes(const struct gb_dialog *dialog, int code)
{
    struct gb_key key;
    return gb_keys_find(code, GB_KEY_EVERYWHERE, &key) &&
           (key.action == GB_ACTION_BACK || key.command == gb_screen_commands_quit ||
            key.command == dialog->type->opened_by);
}

enum gb_dialog_result gb_dialog_handle(struct gb_dialog *dialog,
                                       const struct gb_term_event *event)
{
    const struct gb_dialog_form *form = dialog->type->form;
    if (form->edit != NULL && form->edit(dialog, event)) {
        return GB_DIALOG_OPEN;
    }
    const enum gb_dialog_result result = closes(dialog, event->code)
                                             ? GB_DIALOG_CANCELLED
                                             : form->key(dialog, event->code);
    if (result == GB_DIALOG_CANCELLED) {
        gb_dialog_close(dialog);
    }
    return result;
}

const char *gb_dialog_answer(struct gb_dialog *dialog)
{
    return dialog->type->form == &gb_dialog_forms_presets
               ? gb_preset_browser_selected(&dialog->browser)
               : gb_prompt_text(&dialog->prompt);
}
