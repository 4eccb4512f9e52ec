/* The dialogs of the workbench: lists with a filter, input lines, questions, result
 * cards and pictures.  A dialog is a row of struct gb_dialog_type (dialogs.c) with a
 * form, which draws it and handles its keys.  This file has the forms, the data that
 * they show (parameters found, curves, choices of a picture), and the functions that
 * open, answer and close the one dialog that can be open. */
#include "tui/app/dialog.h"

#include <glib.h>
#include <math.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "base/units.h"
#include "greenbody/params.h"
#include "run/cost.h"
#include "scene/field/field.h"
#include "scene/field/field_words.h"
#include "tui/app/key_commands.h"
#include "tui/app/keys.h"
#include "tui/panel/density_table.h"
#include "tui/panel/list_box.h"
#include "tui/panel/prompt.h"
#include "tui/session/pressure_rows.h"
#include "tui/session/previous.h"
#include "tui/session/session.h"
#include "tui/term/paint.h"
#include "tui/view/views.h"

/* The list of parameters that match the typed text, best match first (field_words.h). */

/* Columns of a wide list.  A narrow list omits the meaning. */
enum { FOUND_COLS = 25, VALUE_COLS = 14, WORDS_ROWS = 2, HEAD_ROWS = 2 };

/* Rank of a field; fields of equal rank stay in the order of the field table. */
static int rank_field(void *data, int item, char **words)
{
    struct gb_param_finder *finder = data;
    size_t count = 0;
    (void)words;
    return gb_field_words_rank(&gb_params_fields(&count)[item],
                               gb_prompt_text(&finder->list.filter));
}

static void search(struct gb_param_finder *finder)
{
    size_t count = 0;
    (void)gb_params_fields(&count);
    gb_list_box_search(&finder->list, (int)count, rank_field, finder);
}

static void param_finder_finish(struct gb_param_finder *finder)
{
    gb_list_box_finish(&finder->list);
}

static void param_finder_init(struct gb_param_finder *finder,
                              const struct gb_params *params)
{
    param_finder_finish(finder);
    finder->params = *params;
    search(finder);
}

/* Typing, arrows and pages; false: another key. */
static bool param_finder_handle(struct gb_param_finder *finder,
                                const struct gb_term_event *event)
{
    if (event->kind == GB_TERM_KEY && event->code == '\t') {
        gb_list_box_go(&finder->list, 1);
        return true;
    }
    const enum gb_list_box_event news = gb_list_box_handle(&finder->list, event);
    if (news == GB_LIST_BOX_TYPED) {
        search(finder);
    }
    return news != GB_LIST_BOX_OTHER;
}

/* "contact.mu   0.1   friction coefficient of sliding" */
static void write_field(void *data, int item, struct gb_list_box_line *line)
{
    const struct gb_param_finder *finder = data;
    size_t count = 0;
    const struct gb_field *field = &gb_params_fields(&count)[item];
    char value[GB_PARAMS_VALUE_MAX];
    gb_params_format(&finder->params, field, value, sizeof value);
    line->style =
        gb_field_applies(field, &finder->params) ? GB_STYLE_PLAIN : GB_STYLE_DIM;
    line->cell[0] = g_strdup_printf("%s.%s", field->group, field->key);
    line->cell[1] = g_strdup(value);
    line->cell[2] = g_strdup(field->meaning);
}

/* Meaning and synonyms of the selected parameter. */
static void draw_words(const struct gb_param_finder *finder, const struct gb_paint *paint,
                       int row)
{
    const int selected = gb_dialog_found(finder);
    size_t count = 0;
    if (selected < 0) {
        gb_paint_wrap(
            paint, row, WORDS_ROWS, GB_STYLE_WARN,
            "no parameter has this name, symbol or meaning; ? has the glossary");
        return;
    }
    const struct gb_field *field = &gb_params_fields(&count)[selected];
    const char *words = field->words != NULL ? field->words : "";
    char *text = g_strdup_printf(
        "%s%s%s%s", field->meaning, *words != '\0' ? "; also: " : "", words,
        gb_field_applies(field, &finder->params) ? "" : " (no effect on this scene)");
    gb_paint_wrap(paint, row, WORDS_ROWS, GB_STYLE_DIM, text);
    g_free(text);
}

static void param_finder_draw(struct gb_param_finder *finder,
                              const struct gb_paint *paint)
{
    static const struct gb_list_box_look look = {
        .columns = 3,
        .column = {{.cols = FOUND_COLS}, {.cols = VALUE_COLS}, {.cols = 0}},
        .write = write_field};
    struct gb_rect rows = paint->rect;
    rows.row += HEAD_ROWS;
    rows.rows -= HEAD_ROWS + WORDS_ROWS;
    const struct gb_paint inside = gb_paint_at(paint->term, rows);
    gb_list_box_draw_filter(&finder->list, paint, 0, 0, "Name, symbol or meaning:");
    gb_list_box_draw(&finder->list, &inside, &look, finder);
    draw_words(finder, paint, paint->rect.rows - WORDS_ROWS);
}

int gb_dialog_found(const struct gb_param_finder *finder)
{
    return gb_list_box_focused(&finder->list);
}

enum { SIGNS, SHAPE, NAME, CELL, DENSITY, DIFFERENCE, COLUMNS };
enum { FOOT_ROWS = 2 }; /* explanation of the signs */

static const char curve_signs[] =
    "* pinned: stays, also with m; - hidden. ~ within, ! beyond two standard deviations. "
    "D takes a curve off the plot, its files stay.";

/* pressure_pa: typed by the user; 0: use the usual one. */
static void curve_list_init(struct gb_curve_list *list, const struct gb_session *session,
                            double pressure_pa)
{
    *list = (struct gb_curve_list){.pressure_pa =
                                       gb_pressure_rows_usual(session, pressure_pa)};
}

/* Number of lines: the run, then the previous curves from the newest. */
static int count_lines(const struct gb_session *session)
{
    return session->previous_count + (session->runner != NULL);
}

static int index_of(const struct gb_session *session, int line)
{
    return session->previous_count - 1 - line + (session->runner != NULL);
}

static void curve_list_navigate(struct gb_curve_list *list,
                                const struct gb_session *session, enum gb_action action)
{
    gb_list_box_set_count(&list->box, count_lines(session));
    (void)gb_list_box_navigate(&list->box, action);
}

int gb_dialog_curve(struct gb_curve_list *list, const struct gb_session *session)
{
    gb_list_box_set_count(&list->box, count_lines(session));
    if (list->box.count == 0) {
        return GB_CURVE_LIST_NONE;
    }
    const int index = index_of(session, list->box.focus);
    return index < session->previous_count ? index : GB_CURVE_LIST_RUN;
}

/* Starts editing the name of the focused curve. */
static void curve_list_rename(struct gb_curve_list *list, struct gb_session *session)
{
    const int index = gb_dialog_curve(list, session);
    if (index != GB_CURVE_LIST_NONE) {
        gb_prompt_set(&list->prompt, gb_previous_list_label(session, index)->name);
        list->naming = true;
    }
}

/* Handles an event while a name is typed.  False: nothing is typed, or editing ends. */
static bool curve_list_type(struct gb_curve_list *list, const struct gb_term_event *event)
{
    if (list->naming && event->kind == GB_TERM_KEY && event->code == GB_KEY_ESCAPE) {
        list->naming = false;
        return true;
    }
    return list->naming && gb_prompt_handle(&list->prompt, event);
}

/* A line of the list. */
struct line {
    struct gb_pressure_row row;
    struct gb_curve_label label;
    const char *name;
    enum gb_style ink;
};

static struct line curve_list_line_of(const struct gb_session *session, int number)
{
    const int index = index_of(session, number);
    if (index == session->previous_count) {
        const struct gb_curve_label *label = &session->run_label;
        return (struct line){gb_pressure_rows_run(session), *label,
                             label->name[0] != '\0' ? label->name : "run on display",
                             GB_STYLE_SERIES};
    }
    const struct gb_previous_curve *previous = &session->previous[index];
    const int colour = previous->label.colour;
    return (struct line){gb_pressure_rows_previous(session, index), previous->label,
                         gb_previous_list_name(previous),
                         colour > 0 ? (enum gb_style)(GB_STYLE_SERIES + colour)
                                    : GB_STYLE_DIM};
}

/* "N 8000", "quick 1000". */
static void write_cell(const struct gb_pressure_row *row, char *text, size_t size)
{
    struct gb_params small;
    const bool quick = row->quick && gb_cost_quick(row->params, &small);
    snprintf(text, size, "%s %lld", row->quick ? "quick" : "N",
             (long long)(quick ? small.count : row->params->count));
}

/* Data from which a row is written. */
struct source {
    const struct gb_curve_list *list;
    const struct gb_session *session;
};

static void write_values(const struct source *source, const struct line *curve,
                         struct gb_list_box_line *line)
{
    const struct gb_session *session = source->session;
    const double pressure_pa = source->list->pressure_pa;
    char text[24];
    const struct gb_pressure_value value =
        gb_pressure_rows_at(session, &curve->row, pressure_pa);
    write_cell(&curve->row, text, sizeof text);
    line->cell[CELL] = g_strdup(text);
    gb_pressure_rows_write(value, text, sizeof text);
    line->cell[DENSITY] = g_strdup(text);
    if (curve->row.kind == GB_PRESSURE_ROW_PREVIOUS && session->runner != NULL) {
        const struct gb_pressure_row run = gb_pressure_rows_run(session);
        gb_pressure_rows_write_difference(&curve->row, value, &run,
                                          gb_pressure_rows_at(session, &run, pressure_pa),
                                          text, sizeof text);
        line->cell[DIFFERENCE] = g_strdup(text);
    }
}

static void write_curve(void *data, int item, struct gb_list_box_line *line)
{
    const struct source *source = data;
    const struct line curve = curve_list_line_of(source->session, item);
    const bool run = curve.row.kind == GB_PRESSURE_ROW_RUN;
    const char marker = curve.label.marker;
    line->style = curve.label.hidden ? GB_STYLE_DIM : GB_STYLE_PLAIN;
    line->cell[SIGNS] = g_strdup_printf("%s%s", curve.label.pinned ? "*" : " ",
                                        curve.label.hidden ? "-" : "");
    line->cell[SHAPE] = g_strdup_printf("%c", run || marker == '\0' ? '>' : marker);
    line->ink[SHAPE] = run ? GB_STYLE_SERIES : (int)curve.ink;
    line->cell[NAME] = g_strdup(curve.name);
    write_values(source, &curve, line);
}

static void curve_list_draw(struct gb_curve_list *list, const struct gb_session *session,
                            const struct gb_paint *paint)
{
    char pressure[24];
    struct source source = {list, session};
    gb_units_format_short(list->pressure_pa, GB_DIM_PRESSURE, 4, pressure,
                          sizeof pressure);
    const struct gb_list_box_look look = {
        .columns = COLUMNS,
        .column = {[SIGNS] = {.cols = 2, .tight = true},
                   [SHAPE] = {.cols = 2},
                   [NAME] = {.title = "curve", .cols = 0},
                   [CELL] = {.title = "cell", .cols = 12, .right = true},
                   [DENSITY] = {.title = pressure, .cols = 9, .right = true},
                   [DIFFERENCE] = {.title = "- run ", .cols = 9, .right = true}},
        .head = GB_STYLE_BOLD,
        .titled = true,
        .empty = "no curve yet: r starts a run",
        .empty_style = GB_STYLE_DIM,
        .write = write_curve};
    struct gb_rect rect = paint->rect;
    rect.rows -= FOOT_ROWS;
    const struct gb_paint rows = gb_paint_at(paint->term, rect);
    gb_list_box_set_count(&list->box, count_lines(session));
    gb_list_box_draw(&list->box, &rows, &look, &source);
    if (list->naming) {
        const struct gb_rect name = gb_list_box_cell(&list->box, &rows, &look, NAME);
        gb_prompt_draw(&list->prompt, &rows, name.row, name.col, name.cols);
    }
    gb_paint_wrap(paint, paint->rect.rows - FOOT_ROWS, FOOT_ROWS, GB_STYLE_DIM,
                  curve_signs);
}

/* The form of each kind of dialog (list, line, question, cards, picture), and the
 * dialog that is open. */

enum { NAME_COLS = 9, CHOICES_MOST = 6 };

/* A choice: its text on the screen and the option of the command; NULL: none. */
struct choice {
    const char *text, *word;
};

struct row {
    const char *name;
    struct choice choice[CHOICES_MOST]; /* the first one is the default of the command */
};

static const struct row choice_rows[GB_PICTURE_FORM_CHOICES] = {
    [GB_PICTURE_FORM_SHOW] = {"show",
                              {{"particles", NULL},
                               {"forces", "--show=forces"},
                               {"particles and forces", "--show=both"},
                               {"particles and force rose", "--rose"}}},
    [GB_PICTURE_FORM_COLOUR] = {"colour",
                                {{"coordination number", NULL},
                                 {"pressure", "--color=pressure"},
                                 {"bridges", "--color=bridges"},
                                 {"size", "--color=size"}}},
    [GB_PICTURE_FORM_CUT] = {"cut",
                             {{"none", NULL},
                              {"the nearest corner", "--cut=corner"},
                              {"the front half", "--cut=y=0.5"},
                              {"a slice in the middle", "--slice=y=0.5"}}},
    [GB_PICTURE_FORM_VIEW] = {"view",
                              {{"corner", NULL},
                               {"front", "--view=front"},
                               {"side", "--view=side"},
                               {"top", "--view=top"}}},
};

/* Colours that apply to forces only. */
static const struct row force_colours = {
    "colour", {{"compressive or tensile", NULL}, {"bridged or not", "--color=bridged"}}};

static const struct row *row_at(const struct gb_picture_form *form, int row)
{
    const bool forces = form->choice[GB_PICTURE_FORM_SHOW] == 1;
    return row == GB_PICTURE_FORM_COLOUR && forces ? &force_colours : &choice_rows[row];
}

static int count_of(const struct row *row)
{
    int count = 0;
    while (count < CHOICES_MOST && row->choice[count].text != NULL) {
        count++;
    }
    return count;
}

static const struct choice *chosen(const struct gb_picture_form *form, int row)
{
    return &row_at(form, row)->choice[form->choice[row]];
}

static void picture_form_init(struct gb_picture_form *form, const char *path)
{
    *form = (struct gb_picture_form){.row = 0};
    gb_prompt_set(&form->file, path);
}

/* The input line of a row; NULL for a row of choices. */
static struct gb_prompt *line_of(struct gb_picture_form *form, int row)
{
    return row == GB_PICTURE_FORM_WIDTH  ? &form->width
           : row == GB_PICTURE_FORM_FILE ? &form->file
                                         : NULL;
}

static void draw_width(struct gb_prompt *width, const struct gb_paint *paint, int room)
{
    const char *text = gb_prompt_text(width);
    const bool empty = *text == '\0';
    gb_paint_cell(paint, GB_PICTURE_FORM_WIDTH, NAME_COLS + 2, room,
                  empty ? GB_STYLE_DIM : GB_STYLE_PLAIN,
                  empty ? "for a screen; 8cm, elsevier: in print" : text);
}

/* Draws the end of a long path, which is more informative than its beginning. */
static void draw_file(struct gb_prompt *file, const struct gb_paint *paint, int room)
{
    char text[64];
    const char *path = gb_prompt_text(file);
    if (gb_paint_width(path) > room && strrchr(path, '/') != NULL) {
        snprintf(text, sizeof text, "\u2026%s", strrchr(path, '/'));
        path = text;
    }
    gb_paint_cell(paint, GB_PICTURE_FORM_FILE, NAME_COLS + 2, room, GB_STYLE_PLAIN, path);
}

static void picture_form_draw(const struct gb_picture_form *form,
                              const struct gb_paint *paint)
{
    char text[64];
    struct gb_picture_form shown = *form;
    const int room = paint->rect.cols - NAME_COLS - 1;
    for (int i = 0; i < GB_PICTURE_FORM_CHOICES; i++) {
        const bool here = i == form->row;
        snprintf(text, sizeof text, here ? "< %s >" : "  %s", chosen(form, i)->text);
        gb_paint_cell(paint, i, 1, NAME_COLS, GB_STYLE_DIM, row_at(form, i)->name);
        gb_paint_cell(paint, i, NAME_COLS, room, here ? GB_STYLE_BOLD : GB_STYLE_PLAIN,
                      text);
    }
    gb_paint_cell(paint, GB_PICTURE_FORM_WIDTH, 1, NAME_COLS, GB_STYLE_DIM, "width");
    gb_paint_cell(paint, GB_PICTURE_FORM_FILE, 1, NAME_COLS, GB_STYLE_DIM, "file");
    draw_width(&shown.width, paint, room - 2);
    draw_file(&shown.file, paint, room - 2);
    const struct gb_prompt *line = line_of(&shown, form->row);
    if (line != NULL) {
        gb_prompt_draw(line, paint, form->row, NAME_COLS + 2, room - 2);
    }
}

static void change(struct gb_picture_form *form, int by)
{
    const int row = form->row;
    const int count = count_of(row_at(form, row));
    form->choice[row] = (form->choice[row] + count + by) % count;
    if (row == GB_PICTURE_FORM_SHOW) { /* other colours apply */
        form->choice[GB_PICTURE_FORM_COLOUR] = 0;
    }
}

/* Handles a key.  Up and down move to a row, left and right change its choice, and the
 * rows of the width and the file take text.  False: another key, such as Enter or Esc. */
static bool picture_form_handle(struct gb_picture_form *form,
                                const struct gb_term_event *event, enum gb_action action)
{
    struct gb_prompt *line = line_of(form, form->row);
    if (line != NULL && gb_prompt_handle(line, event)) {
        return true;
    }
    if (line != NULL && event->kind == GB_TERM_TEXT) {
        return false;
    }
    switch (action) {
    case GB_ACTION_UP:
        form->row = (form->row + GB_PICTURE_FORM_ROWS - 1) % GB_PICTURE_FORM_ROWS;
        return true;
    case GB_ACTION_DOWN:
        form->row = (form->row + 1) % GB_PICTURE_FORM_ROWS;
        return true;
    case GB_ACTION_LEFT:
    case GB_ACTION_RIGHT:
        if (line == NULL) {
            change(form, action == GB_ACTION_LEFT ? -1 : 1);
        }
        return true;
    default:
        return false;
    }
}

void gb_dialog_words(struct gb_picture_form *form,
                     const char *words[GB_PICTURE_FORM_WORDS + 1])
{
    int count = 0;
    for (int i = 0; i < GB_PICTURE_FORM_CHOICES; i++) {
        if (chosen(form, i)->word != NULL) {
            words[count++] = chosen(form, i)->word;
        }
    }
    if (*gb_prompt_text(&form->width) != '\0') {
        words[count++] = "--width";
        words[count++] = gb_prompt_text(&form->width);
    }
    words[count] = NULL;
}

/* The frames of dialogs. */

/* A centred box with a border, at most as large as the screen. */
static struct gb_paint dialog_box(const struct gb_paint *screen, int rows, int cols,
                                  const char *title)
{
    rows = MIN(rows, screen->rect.rows - 2);
    cols = MIN(cols, screen->rect.cols - 2);
    const struct gb_rect rect = {(screen->rect.rows - rows) / 2,
                                 (screen->rect.cols - cols) / 2, rows, cols};
    const struct gb_paint paint = gb_paint_at(screen->term, rect);
    gb_paint_box(&paint, title);
    return paint;
}

/* The area inside the border of a box. */
static struct gb_paint dialog_box_inside(const struct gb_paint *paint)
{
    const struct gb_rect rect = {paint->rect.row + 1, paint->rect.col + 2,
                                 paint->rect.rows - 2, paint->rect.cols - 4};
    return gb_paint_at(paint->term, rect);
}

/* Results of jobs, one card at a time, and pictures. */

enum {
    CARD_COLS = 66,
    FRAME = 4 /* columns of border and margin */,
    BORDER = 2,
    MARK = 2
};

static const struct gb_result_card *shown_card(const struct gb_dialog *dialog)
{
    return gb_results_at(&dialog->session->results, dialog->focus);
}

/* "Enter use the values  o open  ..."; g_free. */
static char *describe_keys(const struct gb_dialog *dialog,
                           const struct gb_result_card *card)
{
    const int count = dialog->session->results.count;
    GString *text = g_string_new(NULL);
    if (card->values->len > 0) {
        g_string_append_printf(text, "Enter: %s   ", card->kind->use);
    }
    if (card->path != NULL) {
        g_string_append(text, "o: open   ");
    }
    g_string_append(text, "y: copy   ");
    if (dialog->focus + 1 < count) {
        g_string_append(text, "Left: older   ");
    }
    if (dialog->focus > 0) {
        g_string_append(text, "Right: newer   ");
    }
    g_string_append(text, "Esc: close");
    return g_string_free(text, FALSE);
}

static enum gb_style style_of(enum gb_result_role role)
{
    return role == GB_RESULT_WARNING ? GB_STYLE_WARN
           : role == GB_RESULT_VALUE ? GB_STYLE_BOLD
                                     : GB_STYLE_PLAIN;
}

/* Draws the lines from the first visible one, with "!" before warnings.  Returns the
 * number of rows that all lines need. */
static int draw_lines(const struct gb_paint *paint, const struct gb_result_card *card,
                      int first, int rows)
{
    struct gb_paint text = *paint;
    text.rect.col += MARK;
    text.rect.cols -= MARK;
    int row = -first;
    for (guint i = 0; i < card->lines->len; i++) {
        const struct gb_result_line *line =
            &g_array_index(card->lines, struct gb_result_line, i);
        const int used = gb_paint_wrap_rows(&text, paint->rect.rows, line->text);
        if (row >= 0 && row + used <= rows) {
            gb_paint_text(paint, row, 0, style_of(line->role),
                          line->role == GB_RESULT_WARNING ? "!" : "");
            gb_paint_wrap(&text, row, used, style_of(line->role), line->text);
        }
        row += used;
    }
    return row + first;
}

/* Text below the lines: path, note about the last key, keys. */
struct foot {
    const char *text[3];
    enum gb_style style[3];
};

static int foot_rows(const struct foot *foot, const struct gb_paint *paint)
{
    int rows = 0;
    for (int i = 0; i < 3; i++) {
        rows += foot->text[i][0] != '\0'
                    ? gb_paint_wrap_rows(paint, paint->rect.rows, foot->text[i])
                    : 0;
    }
    return rows;
}

static void draw_foot(const struct foot *foot, const struct gb_paint *paint, int row)
{
    for (int i = 0; i < 3; i++) {
        if (foot->text[i][0] != '\0') {
            row += gb_paint_wrap(paint, row, paint->rect.rows - row, foot->style[i],
                                 foot->text[i]);
        }
    }
}

static void draw_card(struct gb_dialog *dialog, const struct gb_paint *screen)
{
    const struct gb_result_card *card = shown_card(dialog);
    char title[96];
    if (card == NULL) {
        return;
    }
    char *keys = describe_keys(dialog, card);
    const struct foot foot = {{card->path != NULL ? card->path : "", dialog->note, keys},
                              {GB_STYLE_DIM, GB_STYLE_WARN, GB_STYLE_PLAIN}};
    struct gb_paint probe = *screen;
    probe.rect.cols = MIN(CARD_COLS, screen->rect.cols - 2) - FRAME;
    const int below = foot_rows(&foot, &probe);
    const int lines = draw_lines(&probe, card, 0, 0);
    snprintf(title, sizeof title, "Result: %s (%d of %d)", card->kind->title,
             dialog->focus + 1, dialog->session->results.count);
    const struct gb_paint frame =
        dialog_box(screen, lines + 1 + below + BORDER, CARD_COLS, title);
    const struct gb_paint paint = dialog_box_inside(&frame);
    const int room = paint.rect.rows - below - 1;
    dialog->top = CLAMP(dialog->top, 0, MAX(lines - room, 0));
    draw_lines(&paint, card, dialog->top, room);
    draw_foot(&foot, &paint, paint.rect.rows - below);
    g_free(keys);
}

static enum gb_dialog_result go(struct gb_dialog *dialog, int code)
{
    const int count = dialog->session->results.count;
    switch (gb_keys_action(code)) {
    case GB_ACTION_ENTER:
        return GB_DIALOG_ACCEPTED;
    case GB_ACTION_LEFT:
        dialog->focus = MIN(dialog->focus + 1, count - 1);
        dialog->note[0] = '\0';
        break;
    case GB_ACTION_RIGHT:
        dialog->focus = MAX(dialog->focus - 1, 0);
        dialog->note[0] = '\0';
        break;
    case GB_ACTION_UP:
        dialog->top--;
        break;
    case GB_ACTION_DOWN:
        dialog->top++;
        break;
    default:
        break;
    }
    return GB_DIALOG_OPEN;
}

const struct gb_dialog_form gb_dialog_forms_cards = {draw_card, NULL, go};

/* --- picture ------------------------------------------------------------------------ */

/* Leaves the cells of the picture empty: its pixels are sent after the frame. */
static void result_form_draw_picture(struct gb_dialog *dialog,
                                     const struct gb_paint *screen)
{
    const struct gb_paint frame =
        dialog_box(screen, screen->rect.rows, screen->rect.cols, dialog->type->title);
    const struct gb_paint paint = dialog_box_inside(&frame);
    const int below = gb_paint_wrap_rows(&paint, 2, dialog->note);
    gb_paint_wrap(&paint, paint.rect.rows - below, below, GB_STYLE_DIM, dialog->note);
    dialog->field = paint.rect;
    dialog->field.rows -= below;
}

static enum gb_dialog_result stay(struct gb_dialog *dialog, int code)
{
    (void)dialog;
    (void)code;
    return GB_DIALOG_OPEN;
}

const struct gb_dialog_form gb_dialog_forms_pixels = {result_form_draw_picture, NULL,
                                                      stay};

enum {
    HELP_ROWS = 48,
    HELP_COLS = 72,
    DENSITIES_ROWS = 36,
    DENSITIES_COLS = 80,
    CURVES_ROWS = 14,
    CURVES_COLS = 80,
    FINDER_ROWS = 24,
    BELOW_ROWS = 3, /* message and footer */
    FINDER_COLS = 100,
    PRESETS_ROWS = 34,
    PRESETS_COLS = 84,
    LEGS_ROWS = 40,
    LEGS_COLS = 110,
    LEGS_PAGE = 5,
    FAR = 100000,    /* more than any list */
    PROMPT_ROWS = 5, /* without the note */
    PROMPT_COLS = 64,
    NOTE_ROWS = 3
};

static void draw_note(const struct gb_dialog *dialog, const struct gb_paint *paint,
                      int row, int rows)
{
    if (dialog->note[0] != '\0') {
        gb_paint_wrap(paint, row, rows,
                      dialog->kind == GB_DIALOG_NOTE_WARNING ? GB_STYLE_WARN
                                                             : GB_STYLE_BAD,
                      dialog->note);
    }
}

/* Rows of the note in a box of PROMPT_COLS columns, limited to `most`. */
static int note_rows(const struct gb_dialog *dialog, const struct gb_paint *screen,
                     int most)
{
    struct gb_paint probe = *screen;
    probe.rect.cols = MIN(PROMPT_COLS, screen->rect.cols - 2) - 4;
    return gb_paint_wrap_rows(&probe, most, dialog->note);
}

/* Clears the note about the last answer when the answer is edited. */
static bool clear_note(struct gb_dialog *dialog, bool edited)
{
    if (edited) {
        gb_dialog_set_note(dialog, GB_DIALOG_NOTE_ERROR, "%s", "");
    }
    return edited;
}

/* The note about a copy, or else the title. */
static const char *told_or_title(const struct gb_dialog *dialog)
{
    return dialog->note[0] != '\0' ? dialog->note : dialog->type->title;
}

static enum gb_dialog_result accept_prompt(struct gb_dialog *dialog, int code)
{
    (void)dialog;
    return gb_keys_action(code) == GB_ACTION_ENTER ? GB_DIALOG_ACCEPTED : GB_DIALOG_OPEN;
}

/* --- help ------------------------------------------------------------------------- */

static void draw_help(struct gb_dialog *dialog, const struct gb_paint *screen)
{
    const struct gb_paint frame =
        dialog_box(screen, HELP_ROWS, HELP_COLS, dialog->type->title);
    const struct gb_paint paint = dialog_box_inside(&frame);
    gb_keys_help_draw(&dialog->help, &paint);
}

static bool edit_help(struct gb_dialog *dialog, const struct gb_term_event *event)
{
    return gb_keys_help_handle(&dialog->help, event);
}

/* Lines by which a key moves in a list with this many lines per page. */
static int list_step(enum gb_action action, int page)
{
    switch (action) {
    case GB_ACTION_UP:
        return -1;
    case GB_ACTION_DOWN:
        return 1;
    case GB_ACTION_PAGE_UP:
        return -page;
    case GB_ACTION_PAGE_DOWN:
        return page;
    case GB_ACTION_HOME:
        return -FAR;
    case GB_ACTION_END:
        return FAR;
    default:
        return 0;
    }
}

/* Scrolls without an upper limit; drawing limits the position. */
static enum gb_dialog_result scroll(struct gb_dialog *dialog, int code)
{
    dialog->focus = MAX(dialog->focus + list_step(gb_keys_action(code), dialog->page), 0);
    return GB_DIALOG_OPEN;
}

static enum gb_dialog_result scroll_help(struct gb_dialog *dialog, int code)
{
    (void)gb_list_box_navigate(&dialog->help.box, gb_keys_action(code));
    return GB_DIALOG_OPEN;
}

const struct gb_dialog_form gb_dialog_forms_help = {draw_help, edit_help, scroll_help};

/* --- table of densities ------------------------------------------------------------ */

static void draw_densities(struct gb_dialog *dialog, const struct gb_paint *screen)
{
    const struct gb_paint frame =
        dialog_box(screen, DENSITIES_ROWS, DENSITIES_COLS, told_or_title(dialog));
    const struct gb_paint paint = dialog_box_inside(&frame);
    dialog->page = gb_density_table_draw(&paint, dialog->session, dialog->hide_previous,
                                         &dialog->focus);
}

const struct gb_dialog_form gb_dialog_forms_densities = {draw_densities, NULL, scroll};

/* --- list of curves --------------------------------------------------------------- */

static void draw_curves(struct gb_dialog *dialog, const struct gb_paint *screen)
{
    const int note = dialog->note[0] != '\0';
    const struct gb_paint frame =
        dialog_box(screen, CURVES_ROWS, CURVES_COLS, dialog->type->title);
    struct gb_paint paint = dialog_box_inside(&frame);
    draw_note(dialog, &paint, paint.rect.rows - note, note);
    paint.rect.rows -= note;
    curve_list_draw(&dialog->curves, dialog->session, &paint);
}

static bool edit_curves(struct gb_dialog *dialog, const struct gb_term_event *event)
{
    return curve_list_type(&dialog->curves, event);
}

static enum gb_dialog_result go_in_curves(struct gb_dialog *dialog, int code)
{
    struct gb_curve_list *list = &dialog->curves;
    const enum gb_action action = gb_keys_action(code);
    if (list->naming) {
        return action == GB_ACTION_ENTER ? GB_DIALOG_ACCEPTED : GB_DIALOG_OPEN;
    }
    if (action == GB_ACTION_ENTER) {
        curve_list_rename(list, dialog->session);
        return GB_DIALOG_OPEN;
    }
    curve_list_navigate(list, dialog->session, action);
    return GB_DIALOG_OPEN;
}

const struct gb_dialog_form gb_dialog_forms_curves = {draw_curves, edit_curves,
                                                      go_in_curves};

/* --- presets ---------------------------------------------------------------------- */

static void draw_presets(struct gb_dialog *dialog, const struct gb_paint *screen)
{
    const int note = dialog->note[0] != '\0' ? NOTE_ROWS : 0;
    const struct gb_paint frame =
        dialog_box(screen, PRESETS_ROWS, PRESETS_COLS, dialog->type->title);
    struct gb_paint paint = dialog_box_inside(&frame);
    draw_note(dialog, &paint, paint.rect.rows - note, note);
    paint.rect.rows -= note;
    gb_preset_browser_draw(&dialog->browser, &paint);
}

static bool edit_presets(struct gb_dialog *dialog, const struct gb_term_event *event)
{
    return clear_note(dialog, gb_preset_browser_handle(&dialog->browser, event));
}

static enum gb_dialog_result accept_preset(struct gb_dialog *dialog, int code)
{
    return gb_keys_action(code) == GB_ACTION_ENTER &&
                   gb_preset_browser_selected(&dialog->browser) != NULL
               ? GB_DIALOG_ACCEPTED
               : GB_DIALOG_OPEN;
}

const struct gb_dialog_form gb_dialog_forms_presets = {draw_presets, edit_presets,
                                                       accept_preset};

/* --- search of a parameter --------------------------------------------------------- */

/* Leaves the message line visible, for results that arrive while the user types. */
static void draw_finder(struct gb_dialog *dialog, const struct gb_paint *screen)
{
    const int rows = MIN(FINDER_ROWS, screen->rect.rows - 2 * BELOW_ROWS);
    const struct gb_paint frame =
        dialog_box(screen, rows, FINDER_COLS, dialog->type->title);
    const struct gb_paint paint = dialog_box_inside(&frame);
    param_finder_draw(&dialog->finder, &paint);
}

static bool edit_finder(struct gb_dialog *dialog, const struct gb_term_event *event)
{
    return param_finder_handle(&dialog->finder, event);
}

const struct gb_dialog_form gb_dialog_forms_finder = {draw_finder, edit_finder,
                                                      accept_prompt};

/* --- legs ------------------------------------------------------------------------- */

static void draw_legs(struct gb_dialog *dialog, const struct gb_paint *screen)
{
    const int note = dialog->note[0] != '\0' ? NOTE_ROWS : 0;
    const struct gb_paint frame =
        dialog_box(screen, LEGS_ROWS, LEGS_COLS, dialog->type->title);
    struct gb_paint paint = dialog_box_inside(&frame);
    draw_note(dialog, &paint, paint.rect.rows - note, note);
    paint.rect.rows -= note;
    gb_leg_editor_draw(&dialog->legs, &paint);
}

static bool edit_legs(struct gb_dialog *dialog, const struct gb_term_event *event)
{
    gb_dialog_set_note(dialog, GB_DIALOG_NOTE_ERROR, "%s", "");
    return gb_leg_editor_type(&dialog->legs, event);
}

static enum gb_dialog_result go_in_legs(struct gb_dialog *dialog, int code)
{
    struct gb_leg_editor *legs = &dialog->legs;
    const enum gb_action action = gb_keys_action(code);
    if (action == GB_ACTION_ENTER) {
        gb_leg_editor_change(legs);
        return GB_DIALOG_OPEN;
    }
    gb_leg_editor_go(legs, list_step(action, LEGS_PAGE));
    return GB_DIALOG_OPEN;
}

const struct gb_dialog_form gb_dialog_forms_legs = {draw_legs, edit_legs, go_in_legs};

/* --- input line -------------------------------------------------------------------- */

static void draw_prompt(struct gb_dialog *dialog, const struct gb_paint *screen)
{
    const int rows = MAX(note_rows(dialog, screen, screen->rect.rows - 7), NOTE_ROWS);
    const struct gb_paint frame =
        dialog_box(screen, PROMPT_ROWS + rows, PROMPT_COLS, dialog->type->title);
    const struct gb_paint paint = dialog_box_inside(&frame);
    gb_paint_text(&paint, 0, 1, GB_STYLE_PLAIN, dialog->type->label);
    gb_prompt_draw(&dialog->prompt, &paint, 1, 1, paint.rect.cols - 2);
    draw_note(dialog, &paint, 3, rows);
}

static void complete(struct gb_dialog *dialog)
{
    int count = 0;
    char *path = gb_prompt_complete_path(gb_prompt_text(&dialog->prompt), &count);
    gb_prompt_set(&dialog->prompt, path);
    if (count != 1) {
        gb_dialog_set_note(dialog, GB_DIALOG_NOTE_WARNING, "%d files match", count);
    }
    g_free(path);
}

static bool edit_prompt(struct gb_dialog *dialog, const struct gb_term_event *event)
{
    const bool edited = clear_note(dialog, gb_prompt_handle(&dialog->prompt, event));
    if (dialog->type->completes_path && event->kind == GB_TERM_KEY &&
        event->code == '\t') {
        complete(dialog);
        return true;
    }
    return edited;
}

const struct gb_dialog_form gb_dialog_forms_prompt = {draw_prompt, edit_prompt,
                                                      accept_prompt};

/* --- picture ------------------------------------------------------------------------ */

static void draw_picture(struct gb_dialog *dialog, const struct gb_paint *screen)
{
    const int note = dialog->note[0] != '\0' ? NOTE_ROWS : 0;
    const struct gb_paint frame = dialog_box(screen, GB_PICTURE_FORM_ROWS + 2 + note,
                                             PROMPT_COLS, dialog->type->title);
    const struct gb_paint paint = dialog_box_inside(&frame);
    picture_form_draw(&dialog->picture, &paint);
    draw_note(dialog, &paint, GB_PICTURE_FORM_ROWS, note);
}

static bool edit_picture(struct gb_dialog *dialog, const struct gb_term_event *event)
{
    return clear_note(dialog, picture_form_handle(&dialog->picture, event,
                                                  gb_keys_action(event->code)));
}

const struct gb_dialog_form gb_dialog_forms_picture = {draw_picture, edit_picture,
                                                       accept_prompt};

/* --- command ---------------------------------------------------------------------- */

/* Draws the command without side borders, so that the mouse can select it.  The lines
 * end in backslashes and form one shell command. */
static void draw_command(struct gb_dialog *dialog, const struct gb_paint *screen)
{
    char **lines = g_strsplit(dialog->text, "\n", -1);
    const int count = (int)g_strv_length(lines);
    const int rows = MIN(count + 2, screen->rect.rows - 2);
    const struct gb_rect rect = {(screen->rect.rows - rows) / 2, 0, rows,
                                 screen->rect.cols};
    const struct gb_paint paint = gb_paint_at(screen->term, rect);
    for (int row = 1; row < rows; row++) {
        gb_paint_cell(&paint, row, 0, rect.cols, GB_STYLE_PLAIN,
                      row <= count ? lines[row - 1] : "");
    }
    gb_paint_title(&paint, told_or_title(dialog), GB_PAINT_FOCUSED);
    const struct gb_rect end = {rect.row + rows - 1, 0, 1, rect.cols};
    const struct gb_paint last = gb_paint_at(screen->term, end);
    gb_paint_title(&last, dialog->type->label, GB_PAINT_UNFOCUSED);
    g_strfreev(lines);
}

static enum gb_dialog_result stay_open(struct gb_dialog *dialog, int code)
{
    (void)dialog;
    (void)code;
    return GB_DIALOG_OPEN;
}

const struct gb_dialog_form gb_dialog_forms_command = {draw_command, NULL, stay_open};

/* --- question --------------------------------------------------------------------- */

/* Draws the answers in one row. */
static void draw_answers(const struct gb_dialog *dialog, const struct gb_paint *paint,
                         int row)
{
    gb_paint_text(paint, row, 1, GB_STYLE_BOLD, "y");
    const int col = gb_paint_text(paint, row, 3, GB_STYLE_PLAIN, dialog->type->yes) + 4;
    gb_paint_text(paint, row, col, GB_STYLE_BOLD, "n");
    const int end = gb_paint_text(paint, row, col + 2, GB_STYLE_PLAIN, dialog->type->no);
    if (dialog->other != NULL) {
        const char key[] = {dialog->other[0], '\0'};
        gb_paint_text(paint, row, end + 4, GB_STYLE_BOLD, key);
        gb_paint_text(paint, row, end + 5, GB_STYLE_PLAIN, dialog->other + 1);
    }
}

/* Draws the question; the height depends on the wrapped text. */
static void draw_question(struct gb_dialog *dialog, const struct gb_paint *screen)
{
    const int rows = note_rows(dialog, screen, screen->rect.rows - 5);
    const struct gb_paint frame =
        dialog_box(screen, rows + 4, PROMPT_COLS, dialog->type->title);
    const struct gb_paint paint = dialog_box_inside(&frame);
    gb_paint_wrap(&paint, 0, paint.rect.rows - 2, GB_STYLE_PLAIN, dialog->note);
    draw_answers(dialog, &paint, paint.rect.rows - 1);
}

static enum gb_dialog_result decide(struct gb_dialog *dialog, int code)
{
    (void)dialog;
    return code == 'y' || code == 'Y'   ? GB_DIALOG_ACCEPTED
           : code == 'n' || code == 'N' ? GB_DIALOG_CANCELLED
                                        : GB_DIALOG_OPEN;
}

const struct gb_dialog_form gb_dialog_forms_question = {draw_question, NULL, decide};

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
        gb_keys_help_init(&dialog->help);
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
    param_finder_init(&dialog->finder, params);
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
    picture_form_init(&dialog->picture, path);
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
    char *text = g_strdup(path); /* the card owns it and is closed */
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
    curve_list_init(&dialog->curves, session, typed_pa);
}

bool gb_dialog_takes_keys(const struct gb_dialog *dialog)
{
    return dialog->type->scope != 0 && dialog->legs.typing == GB_LEG_EDITOR_LIST &&
           !dialog->curves.naming;
}

void gb_dialog_close(struct gb_dialog *dialog)
{
    gb_pixels_png_finish(&dialog->pixels);
    gb_preset_browser_finish(&dialog->browser);
    param_finder_finish(&dialog->finder);
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

/* Does the key close the dialog: Esc, q, or the key that opened it? */
static bool closes(const struct gb_dialog *dialog, int code)
{
    struct gb_key key;
    return gb_keys_find(code, GB_KEY_EVERYWHERE, &key) &&
           (key.action == GB_ACTION_BACK || key.command == gb_pane_commands_quit ||
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
