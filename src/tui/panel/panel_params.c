#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/field/field.h"
#include "tui/app/keys.h"
#include "tui/panel/panels.h"
#include "tui/session/session.h"

/* The pane of the parameters: which parameters are listed, the next value of a
 * parameter, editing (typed, chosen, stepped, reverted), and drawing. */

void gb_panel_params_list_init(struct gb_param_list *list, const struct gb_params *params,
                               bool all)
{
    size_t count = 0;
    const struct gb_field *field = gb_params_fields(&count);
    const char *group = "";
    int line = -1;
    list->count = 0;
    for (size_t i = 0; i < count && list->count < GB_PARAM_LIST_MAX; i++) {
        if (!all && !gb_field_applies(&field[i], params)) {
            continue;
        }
        const bool first = strcmp(field[i].group, group) != 0;
        line += !first ? 1 : list->count > 0 ? 3 : 2;
        group = field[i].group;
        list->field[list->count] = (int)i;
        list->first[list->count] = first;
        list->line[list->count++] = line;
    }
}

int gb_panel_params_list_index(const struct gb_param_list *list, int field)
{
    int position = 0;
    while (position + 1 < list->count && list->field[position + 1] <= field) {
        position++;
    }
    return position;
}

/* A step of 4 to 10 % of the value, so that the number stays short. */
static double increment_of(double value)
{
    const double decade = pow(10.0, floor(log10(fabs(value)) + 1e-9));
    const double mantissa = fabs(value) / decade;
    return decade * (mantissa < 2.0 - 1e-9 ? 0.1 : mantissa < 5.0 - 1e-9 ? 0.2 : 0.5);
}

static void value_step_step_choice(const struct gb_field *field, const char *value,
                                   int direction, char *text, size_t size)
{
    int count = 0;
    int at = 0;
    for (; field->choices[count] != NULL; count++) {
        at = strcmp(field->choices[count], value) == 0 ? count : at;
    }
    snprintf(text, size, "%s", field->choices[(at + direction + count) % count]);
}

/* "9.7 nm" becomes "10.2 nm": the text after the number is kept. */
static bool step_number(const struct gb_field *field, const char *value, int direction,
                        char *text, size_t size)
{
    char *rest = NULL;
    const double number = strtod(value, &rest);
    if (rest == value) {
        return false; /* "auto", or empty */
    }
    if (field->type == GB_FIELD_SEED) {
        snprintf(text, size, "%.0f%s", fmax(number + direction, 0.0), rest);
        return true;
    }
    const double step = number != 0.0 ? increment_of(number) : 0.01;
    /* below 1 the steps are smaller, so use the step just below the value */
    const double down = number != 0.0 ? increment_of(number * (1.0 - 1e-6)) : step;
    const double next = direction > 0 ? number + step : number - down;
    snprintf(text, size, "%.6g%s",
             field->type == GB_FIELD_INTEGER ? floor(next + 0.5) : next, rest);
    return true;
}

bool gb_panel_params_next_value(const struct gb_field *field, const char *value,
                                int direction, char *text, size_t size)
{
    if (field->choices != NULL) {
        value_step_step_choice(field, value, direction, text, size);
        return true;
    }
    return field->type != GB_FIELD_TEXT && field->type != GB_FIELD_PRESSURES &&
           step_number(field, value, direction, text, size);
}

/* Editing of the focused parameter: typed, chosen, stepped, reverted. */

static void panel_params_edit_begin(struct gb_panel_params *panel,
                                    struct gb_session *session)
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
    gb_session_show_edited(session);
}

void gb_panel_params_edit_changed(struct gb_session *session, struct gb_message *message)
{
    struct gb_error err = {0};
    message->text[0] = '\0';
    if (gb_params_check(gb_session_params(session), &err)) {
        gb_session_show_edited(session);
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
    if (gb_panel_params_next_value(field, value, direction, text, sizeof text)) {
        gb_panel_params_edit_set(session, field, text, message);
    } else {
        snprintf(message->text, sizeof message->text,
                 "%s has no next value: Enter edits it", field->key);
        message->style = GB_STYLE_WARN;
    }
}

/* The typed text, or the chosen value. */
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

/* Direction in which a key moves through the choices; 0: it does not. */
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

/* Columns; the longest key of the field table has 16 characters. */
enum { KEY_COL = 1, VALUE_COL = 18 };
/* Width of the pane from which the title explains r. */
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
    gb_panel_params_list_init(&list, gb_session_params(session), panel->all);
    return list;
}

/* Keeps the focused line visible, and its heading if there is room. */
static void scroll(struct gb_panel_params *panel, const struct gb_param_list *list)
{
    const int line = list->line[gb_panel_params_list_index(list, panel->focus)];
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
    const bool unused = !gb_field_applies(field, gb_session_params(session));
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
        panel->focus = list.field[gb_panel_params_list_index(&list, panel->focus)];
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
    const int to = gb_panel_params_list_index(&list, panel->focus) + by;
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
        !gb_field_applies(&gb_params_fields(&count)[field], gb_session_params(session));
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
        panel_params_edit_begin(panel, session);
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
                 "%s: %s.  %sEnter accepts, Esc cancels.  Expected: %s", field->key,
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
