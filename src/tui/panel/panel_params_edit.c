#include <stdio.h>
#include <string.h>

#include "tui/app/keys.h"
#include "tui/panel/panels.h"
#include "tui/session/past/session_recall.h"
#include "tui/session/value_step.h"

/* Editing of the focused parameter: typed, chosen, stepped, reverted. */

void gb_panel_params_edit_begin(struct gb_panel_params *panel, struct gb_session *session)
{
    const struct gb_field *field = gb_panel_params_field(panel);
    char value[GB_PROMPT_MAX];
    gb_params_format(gb_session_params(session), field, value, sizeof value);
    panel->editing = true;
    panel->choice = 0;
    gb_prompt_offer(&panel->prompt, value);
    for (int i = 0; field->choices != NULL && field->choices[i] != NULL; i++) {
        if (strcmp(field->choices[i], value) == 0) {
            panel->choice = i;
        }
    }
}

void gb_panel_params_edit_revert(struct gb_panel_params *panel,
                                 struct gb_session *session, struct gb_message *message)
{
    const struct gb_field *field = gb_panel_params_field(panel);
    char value[GB_PARAMS_VALUE_MAX];
    if (session->runner == NULL) {
        return;
    }
    gb_params_format(gb_runner_params(session->runner), field, value, sizeof value);
    gb_params_set(gb_session_params(session), field, value, NULL);
    snprintf(message->text, sizeof message->text, "%s.%s is %.256s again, as in the run",
             field->group, field->key, value[0] != '\0' ? value : "empty");
    message->style = GB_STYLE_PLAIN;
    gb_session_recall_answer(session);
}

void gb_panel_params_edit_changed(struct gb_session *session, struct gb_message *message)
{
    struct gb_error err = {0};
    message->text[0] = '\0';
    if (gb_params_check(gb_session_params(session), &err)) {
        gb_session_recall_answer(session);
    } else {
        snprintf(message->text, sizeof message->text, "conflicts with %s", err.text);
        message->style = GB_STYLE_WARN;
    }
}

bool gb_panel_params_edit_set(struct gb_session *session, const struct gb_field *field,
                              const char *text, struct gb_message *message)
{
    struct gb_error err = {0};
    if (!gb_params_set(gb_session_params(session), field, text, &err)) {
        snprintf(message->text, sizeof message->text, "%s", err.text);
        message->style = GB_STYLE_BAD;
        return false;
    }
    gb_panel_params_edit_changed(session, message);
    return true;
}

void gb_panel_params_edit_step(struct gb_panel_params *panel, struct gb_session *session,
                               int direction, struct gb_message *message)
{
    const struct gb_field *field = gb_panel_params_field(panel);
    char value[GB_PARAMS_VALUE_MAX];
    char text[GB_PARAMS_VALUE_MAX + 16];
    gb_params_format(gb_session_params(session), field, value, sizeof value);
    if (gb_value_step_next(field, value, direction, text, sizeof text)) {
        gb_panel_params_edit_set(session, field, text, message);
    } else {
        snprintf(message->text, sizeof message->text,
                 "%s has no next value: Enter edits it", field->key);
        message->style = GB_STYLE_WARN;
    }
}

/* The text typed, or the choice shown. */
static const char *edited_text(struct gb_panel_params *panel)
{
    const struct gb_field *field = gb_panel_params_field(panel);
    return field->choices != NULL ? field->choices[panel->choice]
                                  : gb_prompt_text(&panel->prompt);
}

struct gb_params gb_panel_params_edit_params(struct gb_panel_params *panel,
                                             struct gb_session *session)
{
    struct gb_params edited = *gb_session_params(session);
    if (panel->editing) {
        gb_params_set(&edited, gb_panel_params_field(panel), edited_text(panel), NULL);
    }
    return edited;
}

static void step_choice(struct gb_panel_params *panel, int step)
{
    const char *const *choices = gb_panel_params_field(panel)->choices;
    int count = 0;
    while (choices[count] != NULL) {
        count++;
    }
    panel->choice = (panel->choice + step + count) % count;
}

/* Direction in which a key moves through the choices; 0: none. */
static int choice_step(int code, enum gb_action action)
{
    if (action == GB_ACTION_UP || action == GB_ACTION_LEFT) {
        return -1;
    }
    return action == GB_ACTION_DOWN || action == GB_ACTION_RIGHT || code == '\t' ||
           code == 'n' || code == ' ';
}

void gb_panel_params_edit_key(struct gb_panel_params *panel, struct gb_session *session,
                              const struct gb_term_event *event,
                              struct gb_message *message)
{
    const struct gb_field *field = gb_panel_params_field(panel);
    if (field->choices == NULL && gb_prompt_handle(&panel->prompt, event)) {
        message->text[0] = '\0';
        return;
    }
    const enum gb_action action = gb_keys_action(event->code);
    if (action == GB_ACTION_ENTER) {
        panel->editing =
            !gb_panel_params_edit_set(session, field, edited_text(panel), message);
    } else if (action == GB_ACTION_BACK) {
        panel->editing = false;
        message->text[0] = '\0';
    } else if (field->choices != NULL) {
        step_choice(panel, choice_step(event->code, action));
    }
}
