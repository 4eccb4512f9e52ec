#include <stdio.h>
#include <string.h>

#include "phys/field.h"
#include "tui/panels.h"

/* Longest key of the field table, and the mark before it. */
enum { KEY_COL = 1, VALUE_COL = 18 };

static const struct gb_field *focused(const struct gb_panel_params *panel)
{
    size_t count = 0;
    return &gb_params_fields(&count)[panel->focus];
}

static int field_count(void)
{
    size_t count = 0;
    gb_params_fields(&count);
    return (int)count;
}

/* Line of a field: every group has a heading, and a blank line before all but the first.
 */
static int line_of(int index)
{
    size_t count = 0;
    const struct gb_field *field = gb_params_fields(&count);
    int line = 1;
    for (int i = 1; i <= index; i++) {
        line += strcmp(field[i].group, field[i - 1].group) != 0 ? 3 : 1;
    }
    return line;
}

/* Keeps the focus and, where there is room, its heading in sight. */
static void scroll(struct gb_panel_params *panel)
{
    const int line = line_of(panel->focus);
    const int last = line_of(field_count() - 1) + 1;
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
    const bool here = index == panel->focus;
    enum gb_style style = differs ? GB_STYLE_CHANGED : GB_STYLE_PLAIN;
    if (here && focus) {
        style = GB_STYLE_SELECTED;
        gb_paint_cell(paint, row, 0, paint->rect.cols - 1, style, "");
    } else if (here) {
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
    panel->page = paint->rect.rows - 1;
    scroll(panel);
    size_t count = 0;
    const struct gb_field *field = gb_params_fields(&count);
    int line = 0;
    for (int i = 0; i < (int)count; i++) {
        line = line_of(i);
        const int row = 1 + line - panel->top;
        if (i == 0 || strcmp(field[i].group, field[i - 1].group) != 0) {
            draw_heading(paint, row - 1, field[i].group);
        }
        if (row >= 1 && row < paint->rect.rows) {
            draw_field(panel, paint, session, i, row, focus);
        }
    }
    gb_paint_title(paint, title, focus);
}

static void begin_edit(struct gb_panel_params *panel, struct gb_session *session)
{
    const struct gb_field *field = focused(panel);
    char value[GB_PROMPT_MOST];
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
    char value[256];
    if (session->runner == NULL) {
        return;
    }
    gb_params_format(gb_runner_params(session->runner), field, value, sizeof value);
    gb_params_set(gb_session_params(session), field, value, NULL);
    snprintf(message->text, sizeof message->text, "%s.%s is %s again, as in the run",
             field->group, field->key, value[0] != '\0' ? value : "empty");
    message->style = GB_STYLE_PLAIN;
}

static bool move(struct gb_panel_params *panel, int to)
{
    const int last = field_count() - 1;
    panel->focus = to < 0 ? 0 : to > last ? last : to;
    return true;
}

bool gb_panel_params_act(struct gb_panel_params *panel, struct gb_session *session,
                         enum gb_action action, struct gb_message *message)
{
    switch (action) {
    case GB_ACTION_UP:
        return move(panel, panel->focus - 1);
    case GB_ACTION_DOWN:
        return move(panel, panel->focus + 1);
    case GB_ACTION_PAGE_UP:
        return move(panel, panel->focus - (panel->page > 2 ? panel->page - 2 : 1));
    case GB_ACTION_PAGE_DOWN:
        return move(panel, panel->focus + (panel->page > 2 ? panel->page - 2 : 1));
    case GB_ACTION_HOME:
        return move(panel, 0);
    case GB_ACTION_END:
        return move(panel, field_count() - 1);
    case GB_ACTION_ENTER:
        begin_edit(panel, session);
        return true;
    case GB_ACTION_UNDO:
        undo(panel, session, message);
        return true;
    default:
        return false;
    }
}

/* A good value is taken; one that does not fit the others is taken with a warning,
 * because the others may be changed next. */
static void accept(struct gb_panel_params *panel, struct gb_session *session,
                   struct gb_message *message)
{
    const struct gb_field *field = focused(panel);
    struct gb_error err = {0};
    const char *text = field->choices != NULL ? field->choices[panel->choice]
                                              : gb_prompt_text(&panel->prompt);
    if (!gb_params_set(gb_session_params(session), field, text, &err)) {
        snprintf(message->text, sizeof message->text, "%s", err.text);
        message->style = GB_STYLE_BAD;
        return;
    }
    panel->editing = false;
    if (!gb_params_check(gb_session_params(session), &err)) {
        snprintf(message->text, sizeof message->text, "does not fit the rest yet: %s",
                 err.text);
        message->style = GB_STYLE_WARN;
        return;
    }
    message->text[0] = '\0';
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

void gb_panel_params_type(struct gb_panel_params *panel, struct gb_session *session,
                          const struct gb_term_event *event, struct gb_message *message)
{
    const bool choices = focused(panel)->choices != NULL;
    if (!choices && gb_prompt_take(&panel->prompt, event)) {
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

void gb_panel_params_explain(const struct gb_panel_params *panel,
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
        snprintf(message->text, sizeof message->text,
                 "%s: %s.  * applies at restart (r); the run uses %s (u takes it back)",
                 field->key, field->meaning, value[0] != '\0' ? value : "none");
    } else {
        snprintf(message->text, sizeof message->text, "%s: %s.  %s; default %s.  [%s]",
                 field->key, field->meaning, accepted,
                 field->fallback[0] != '\0' ? field->fallback : "none", field->source);
    }
    message->style = GB_STYLE_DIM;
}
