#include <stdio.h>
#include <string.h>

#include "scene/applies.h"
#include "scene/field.h"
#include "tui/panel/panels.h"
#include "tui/panel/param_list.h"
#include "tui/session/value_step.h"

/* Longest key of the field table, and the mark before it. */
enum { KEY_COL = 1, VALUE_COL = 18 };

static const struct gb_field *focused(const struct gb_panel_params *panel)
{
    size_t count = 0;
    return &gb_params_fields(&count)[panel->focus];
}

static struct gb_param_list listed(const struct gb_panel_params *panel,
                                   struct gb_session *session)
{
    struct gb_param_list list;
    gb_param_list_init(&list, gb_session_params(session), panel->all);
    return list;
}

/* Keeps the focus and, where there is room, its heading in sight. */
static void scroll(struct gb_panel_params *panel, const struct gb_param_list *list)
{
    const int line = list->line[gb_param_list_index(list, panel->focus)];
    const int last = list->line[list->count - 1] + 1;
    if (line - 1 < panel->top) {
        panel->top = line - 1;
    }
    if (line >= panel->top + panel->page) {
        panel->top = line - panel->page + 1;
    }
    if (panel->top > last - panel->page) {
        panel->top = last - panel->page;
    }
    panel->top = panel->top < 0 ? 0 : panel->top;
}

static void draw_value(const struct gb_panel_params *panel, const struct gb_paint *paint,
                       struct gb_session *session, const struct gb_field *field, int row,
                       enum gb_style style)
{
    const int cols = paint->rect.cols - 1 - VALUE_COL;
    char value[256];
    gb_params_format(gb_session_params(session), field, value, sizeof value);
    if (panel->editing && field == focused(panel)) {
        if (field->choices != NULL) {
            snprintf(value, sizeof value, "< %s >", field->choices[panel->choice]);
            gb_paint_cell(paint, row, VALUE_COL, cols, GB_STYLE_EDIT, value);
        } else {
            gb_prompt_draw(&panel->prompt, paint, row, VALUE_COL, cols);
        }
        return;
    }
    gb_paint_cell(paint, row, VALUE_COL, cols, style, value);
}

static void draw_field(const struct gb_panel_params *panel, const struct gb_paint *paint,
                       struct gb_session *session, int index, int row, bool focus)
{
    size_t count = 0;
    const struct gb_field *field = &gb_params_fields(&count)[index];
    const bool differs = gb_session_differs(session, field);
    const bool focused_row = index == panel->focus;
    const bool unused = !gb_applies_field(gb_session_params(session), field);
    enum gb_style style = differs  ? GB_STYLE_CHANGED
                          : unused ? GB_STYLE_DIM
                                   : GB_STYLE_PLAIN;
    if (focused_row && focus) {
        style = GB_STYLE_SELECTED;
        gb_paint_cell(paint, row, 0, paint->rect.cols - 1, style, "");
    } else if (focused_row) {
        style = GB_STYLE_BOLD;
    }
    gb_paint_text(paint, row, 0, differs ? GB_STYLE_CHANGED : style, differs ? "*" : " ");
    gb_paint_cell(paint, row, KEY_COL, VALUE_COL - KEY_COL - 1, style, field->key);
    draw_value(panel, paint, session, field, row, style);
}

static void draw_heading(const struct gb_paint *paint, int row, const char *group)
{
    if (row >= 1) {
        gb_paint_text(paint, row, 0, GB_STYLE_DIM, group);
    }
}

void gb_panel_params_draw(struct gb_panel_params *panel, const struct gb_paint *paint,
                          struct gb_session *session, bool focus)
{
    char title[64];
    const int changes = gb_session_changes(session);
    snprintf(title, sizeof title, changes > 0 ? "Parameters * %d for r" : "Parameters",
             changes);
    const struct gb_param_list list = listed(panel, session);
    size_t count = 0;
    const struct gb_field *field = gb_params_fields(&count);
    panel->page = paint->rect.rows - 1;
    if (!panel->editing) { /* a change of the scene may have hidden it */
        panel->focus = list.field[gb_param_list_index(&list, panel->focus)];
    }
    scroll(panel, &list);
    for (int i = 0; i < list.count; i++) {
        const int row = 1 + list.line[i] - panel->top;
        if (list.first[i]) {
            draw_heading(paint, row - 1, field[list.field[i]].group);
        }
        if (row >= 1 && row < paint->rect.rows) {
            draw_field(panel, paint, session, list.field[i], row, focus);
        }
    }
    gb_paint_title(paint, title, focus);
}

static void begin_edit(struct gb_panel_params *panel, struct gb_session *session)
{
    const struct gb_field *field = focused(panel);
    char value[GB_PROMPT_MAX];
    gb_params_format(gb_session_params(session), field, value, sizeof value);
    panel->editing = true;
    panel->choice = 0;
    gb_prompt_set(&panel->prompt, value);
    for (int i = 0; field->choices != NULL && field->choices[i] != NULL; i++) {
        if (strcmp(field->choices[i], value) == 0) {
            panel->choice = i;
        }
    }
}

/* The value that the run uses comes back. */
static void undo(struct gb_panel_params *panel, struct gb_session *session,
                 struct gb_message *message)
{
    const struct gb_field *field = focused(panel);
    char value[GB_PARAMS_VALUE_MAX];
    if (session->runner == NULL) {
        return;
    }
    gb_params_format(gb_runner_params(session->runner), field, value, sizeof value);
    gb_params_set(gb_session_params(session), field, value, NULL);
    snprintf(message->text, sizeof message->text, "%s.%s is %.256s again, as in the run",
             field->group, field->key, value[0] != '\0' ? value : "empty");
    message->style = GB_STYLE_PLAIN;
    gb_session_start_quick(session);
}

static bool move(struct gb_panel_params *panel, struct gb_session *session, int by)
{
    const struct gb_param_list list = listed(panel, session);
    const int to = gb_param_list_index(&list, panel->focus) + by;
    panel->focus = list.field[to < 0 ? 0 : to < list.count ? to : list.count - 1];
    return true;
}

static void toggle_all(struct gb_panel_params *panel, struct gb_message *message)
{
    panel->all = !panel->all;
    snprintf(message->text, sizeof message->text, "%s",
             panel->all ? "all parameters; those without effect on this scene are dim"
                        : "the parameters that this scene uses");
    message->style = GB_STYLE_PLAIN;
}

/* A good value is taken; one that does not fit the others is taken with a warning,
 * because the others may be changed next. */
static bool take(struct gb_session *session, const struct gb_field *field,
                 const char *text, struct gb_message *message)
{
    struct gb_error err = {0};
    if (!gb_params_set(gb_session_params(session), field, text, &err)) {
        snprintf(message->text, sizeof message->text, "%s", err.text);
        message->style = GB_STYLE_BAD;
        return false;
    }
    message->text[0] = '\0';
    if (!gb_params_check(gb_session_params(session), &err)) {
        snprintf(message->text, sizeof message->text, "does not fit the rest yet: %s",
                 err.text);
        message->style = GB_STYLE_WARN;
        return true;
    }
    gb_session_start_quick(session);
    return true;
}

/* The knob: the next value takes effect at once. */
static bool turn(struct gb_panel_params *panel, struct gb_session *session, int direction,
                 struct gb_message *message)
{
    const struct gb_field *field = focused(panel);
    char value[GB_PARAMS_VALUE_MAX];
    char text[GB_PARAMS_VALUE_MAX + 16];
    gb_params_format(gb_session_params(session), field, value, sizeof value);
    if (!gb_value_step_next(field, value, direction, text, sizeof text)) {
        snprintf(message->text, sizeof message->text,
                 "%s cannot be turned: Enter edits it", field->key);
        message->style = GB_STYLE_WARN;
        return true;
    }
    take(session, field, text, message);
    return true;
}

bool gb_panel_params_click(struct gb_panel_params *panel, struct gb_session *session,
                           int row, int col, bool *value)
{
    const struct gb_param_list list = listed(panel, session);
    *value = col >= VALUE_COL;
    for (int i = 0; i < list.count; i++) {
        if (row >= 1 && 1 + list.line[i] - panel->top == row) {
            panel->focus = list.field[i];
            return true;
        }
    }
    return false;
}

void gb_panel_params_assignment(const struct gb_panel_params *panel,
                                struct gb_session *session, char *text, size_t size)
{
    const struct gb_field *field = focused(panel);
    char value[GB_PARAMS_VALUE_MAX];
    gb_params_format(gb_session_params(session), field, value, sizeof value);
    snprintf(text, size, "%s.%s=%s", field->group, field->key, value);
}

bool gb_panel_params_find(struct gb_panel_params *panel, struct gb_session *session,
                          const char *name)
{
    size_t count = 0;
    const struct gb_field *field = gb_params_fields(&count);
    for (int exact = 1; exact >= 0; exact--) {
        for (size_t i = 1; i <= count; i++) {
            const size_t at = ((size_t)panel->focus + i) % count;
            char full[64];
            snprintf(full, sizeof full, "%s.%s", field[at].group, field[at].key);
            const bool named =
                strcmp(field[at].key, name) == 0 || strcmp(full, name) == 0;
            if (exact ? named : strstr(full, name) != NULL) {
                panel->focus = (int)at;
                panel->all |= !gb_applies_field(gb_session_params(session), &field[at]);
                return true;
            }
        }
    }
    return false;
}

bool gb_panel_params_act(struct gb_panel_params *panel, struct gb_session *session,
                         enum gb_action action, struct gb_message *message)
{
    switch (action) {
    case GB_ACTION_UP:
        return move(panel, session, -1);
    case GB_ACTION_DOWN:
        return move(panel, session, 1);
    case GB_ACTION_PAGE_UP:
        return move(panel, session, panel->page > 2 ? 2 - panel->page : -1);
    case GB_ACTION_PAGE_DOWN:
        return move(panel, session, panel->page > 2 ? panel->page - 2 : 1);
    case GB_ACTION_HOME:
        return move(panel, session, -GB_PARAM_LIST_MAX);
    case GB_ACTION_END:
        return move(panel, session, GB_PARAM_LIST_MAX);
    case GB_ACTION_ALL:
        toggle_all(panel, message);
        return true;
    case GB_ACTION_ENTER:
        begin_edit(panel, session);
        return true;
    case GB_ACTION_MORE:
        return turn(panel, session, 1, message);
    case GB_ACTION_LESS:
        return turn(panel, session, -1, message);
    case GB_ACTION_UNDO:
        undo(panel, session, message);
        return true;
    default:
        return false;
    }
}

/* What is being typed or chosen. */
static const char *typed(struct gb_panel_params *panel)
{
    const struct gb_field *field = focused(panel);
    return field->choices != NULL ? field->choices[panel->choice]
                                  : gb_prompt_text(&panel->prompt);
}

static void accept(struct gb_panel_params *panel, struct gb_session *session,
                   struct gb_message *message)
{
    if (take(session, focused(panel), typed(panel), message)) {
        panel->editing = false;
    }
}

struct gb_params gb_panel_params_edited(struct gb_panel_params *panel,
                                        struct gb_session *session)
{
    struct gb_params edited = *gb_session_params(session);
    if (panel->editing) {
        gb_params_set(&edited, focused(panel), typed(panel), NULL);
    }
    return edited;
}

static void choose(struct gb_panel_params *panel, int step)
{
    const char *const *choices = focused(panel)->choices;
    int count = 0;
    while (choices[count] != NULL) {
        count++;
    }
    panel->choice = (panel->choice + step + count) % count;
}

void gb_panel_params_edit_key(struct gb_panel_params *panel, struct gb_session *session,
                              const struct gb_term_event *event,
                              struct gb_message *message)
{
    const bool choices = focused(panel)->choices != NULL;
    if (!choices && gb_prompt_handle(&panel->prompt, event)) {
        message->text[0] = '\0';
        return;
    }
    switch (gb_keys_action(event->code)) {
    case GB_ACTION_ENTER:
        accept(panel, session, message);
        break;
    case GB_ACTION_BACK:
        panel->editing = false;
        message->text[0] = '\0';
        break;
    case GB_ACTION_UP:
    case GB_ACTION_LEFT:
        if (choices) {
            choose(panel, -1);
        }
        break;
    case GB_ACTION_DOWN:
    case GB_ACTION_RIGHT:
    case GB_ACTION_NEXT_PANE:
    case GB_ACTION_FREEZE: /* the space bar */
        if (choices) {
            choose(panel, 1);
        }
        break;
    default:
        break;
    }
}

void gb_panel_params_describe(const struct gb_panel_params *panel,
                              struct gb_session *session, struct gb_message *message)
{
    const struct gb_field *field = focused(panel);
    char accepted[256];
    char value[256];
    gb_field_accepted(field, accepted, sizeof accepted);
    if (panel->editing) {
        snprintf(message->text, sizeof message->text,
                 "%s: %s.  Enter takes it, Esc leaves it.  Accepted: %s", field->key,
                 field->meaning, accepted);
    } else if (gb_session_differs(session, field)) {
        gb_params_format(gb_runner_params(session->runner), field, value, sizeof value);
        snprintf(
            message->text, sizeof message->text,
            "%s: %s.  * the quick cell answers, the full one follows or r starts it; the "
            "run uses %s (u takes it back)",
            field->key, field->meaning, value[0] != '\0' ? value : "none");
    } else {
        snprintf(message->text, sizeof message->text, "%s: %s.  %s; default %s.  [%s]",
                 field->key, field->meaning, accepted,
                 field->fallback[0] != '\0' ? field->fallback : "none", field->source);
    }
    message->style = GB_STYLE_DIM;
}
