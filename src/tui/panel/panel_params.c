#include <stdio.h>
#include <string.h>

#include "scene/field/applies.h"
#include "scene/field/field.h"
#include "tui/panel/panels.h"
#include "tui/panel/param_list.h"

/* Columns; the longest key of the field table has 16 characters. */
enum { KEY_COL = 1, VALUE_COL = 18 };
/* Width of the pane from which on the title explains r. */
enum { WIDE_COLS = 45 };

const struct gb_field *gb_panel_params_field(const struct gb_panel_params *panel)
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

/* Keeps the focused line visible, and its heading where there is room. */
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
    if (panel->editing && field == gb_panel_params_field(panel)) {
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
                       struct gb_session *session, int index, int row,
                       enum gb_paint_focus focus)
{
    size_t count = 0;
    const struct gb_field *field = &gb_params_fields(&count)[index];
    const bool differs = gb_session_differs(session, field);
    const bool focused_row = index == panel->focus;
    const bool unused = !gb_applies_field(gb_session_params(session), field);
    enum gb_style style = differs  ? GB_STYLE_CHANGED
                          : unused ? GB_STYLE_DIM
                                   : GB_STYLE_PLAIN;
    if (focused_row && focus == GB_PAINT_FOCUSED) {
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
                          struct gb_session *session, enum gb_paint_focus focus)
{
    char title[64];
    const int changes = gb_session_changes(session);
    if (changes > 0) {
        snprintf(title, sizeof title, "%d change%s not run yet%s", changes,
                 changes == 1 ? "" : "s",
                 paint->rect.cols >= WIDE_COLS ? " (r runs them)" : " (r)");
    } else {
        snprintf(title, sizeof title, "Parameters");
    }
    const struct gb_param_list list = listed(panel, session);
    size_t count = 0;
    const struct gb_field *field = gb_params_fields(&count);
    panel->page = paint->rect.rows - 1;
    if (!panel->editing) { /* a change of the scene may have removed its line */
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

static void move(struct gb_panel_params *panel, struct gb_session *session, int by)
{
    const struct gb_param_list list = listed(panel, session);
    const int to = gb_param_list_index(&list, panel->focus) + by;
    panel->focus = list.field[to < 0 ? 0 : to < list.count ? to : list.count - 1];
}

void gb_panel_params_list_all(struct gb_panel_params *panel, struct gb_message *message)
{
    panel->all = !panel->all;
    snprintf(message->text, sizeof message->text, "%s",
             panel->all ? "all parameters; those without effect on this scene are dim"
                        : "parameters used by this scene");
    message->style = GB_STYLE_PLAIN;
}

enum gb_panel_params_hit gb_panel_params_click(struct gb_panel_params *panel,
                                               struct gb_session *session, int row,
                                               int col)
{
    const struct gb_param_list list = listed(panel, session);
    for (int i = 0; i < list.count; i++) {
        if (row >= 1 && 1 + list.line[i] - panel->top == row) {
            panel->focus = list.field[i];
            return col >= VALUE_COL ? GB_PANEL_PARAMS_VALUE : GB_PANEL_PARAMS_KEY;
        }
    }
    return GB_PANEL_PARAMS_MISS;
}

void gb_panel_params_assignment(const struct gb_panel_params *panel,
                                struct gb_session *session, char *text, size_t size)
{
    const struct gb_field *field = gb_panel_params_field(panel);
    char value[GB_PARAMS_VALUE_MAX];
    gb_params_format(gb_session_params(session), field, value, sizeof value);
    snprintf(text, size, "%s.%s=%s", field->group, field->key, value);
}

void gb_panel_params_go(struct gb_panel_params *panel, struct gb_session *session,
                        int field)
{
    size_t count = 0;
    panel->focus = field;
    panel->all |=
        !gb_applies_field(gb_session_params(session), &gb_params_fields(&count)[field]);
}

void gb_panel_params_navigate(struct gb_panel_params *panel, struct gb_session *session,
                              enum gb_action action)
{
    const int page = panel->page > 2 ? panel->page - 2 : 1;
    switch (action) {
    case GB_ACTION_UP:
        move(panel, session, -1);
        break;
    case GB_ACTION_DOWN:
        move(panel, session, 1);
        break;
    case GB_ACTION_PAGE_UP:
        move(panel, session, -page);
        break;
    case GB_ACTION_PAGE_DOWN:
        move(panel, session, page);
        break;
    case GB_ACTION_HOME:
        move(panel, session, -GB_PARAM_LIST_MAX);
        break;
    case GB_ACTION_END:
        move(panel, session, GB_PARAM_LIST_MAX);
        break;
    case GB_ACTION_ENTER:
        gb_panel_params_edit_begin(panel, session);
        break;
    case GB_ACTION_LEFT:
    case GB_ACTION_RIGHT:
    case GB_ACTION_BACK:
    case GB_ACTION_NONE:
        break;
    }
}

void gb_panel_params_describe(const struct gb_panel_params *panel,
                              struct gb_session *session, struct gb_message *message)
{
    const struct gb_field *field = gb_panel_params_field(panel);
    char accepted[256];
    char value[256];
    gb_field_accepted(field, accepted, sizeof accepted);
    if (panel->editing) {
        snprintf(message->text, sizeof message->text,
                 "%s: %s.  %sEnter accepts, Esc cancels.  Accepted: %s", field->key,
                 field->meaning,
                 panel->prompt.fresh && field->choices == NULL
                     ? "Typing replaces, Left and End edit.  "
                     : "",
                 accepted);
    } else if (gb_session_differs(session, field)) {
        gb_params_format(gb_runner_params(session->runner), field, value, sizeof value);
        snprintf(message->text, sizeof message->text,
                 "%s: %s.  * changed: the quick cell runs first, the full one follows or "
                 "waits for r; the run uses %s (B goes back)",
                 field->key, field->meaning, value[0] != '\0' ? value : "none");
    } else {
        snprintf(message->text, sizeof message->text, "%s: %s.  %s; default %s.  [%s]",
                 field->key, field->meaning, accepted,
                 field->fallback[0] != '\0' ? field->fallback : "none", field->source);
    }
    message->style = GB_STYLE_DIM;
}
