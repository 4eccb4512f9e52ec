#include "tui/app/dialog/dialog_forms.h"

#include <glib.h>
#include <stdio.h>

#include "tui/app/dialog/dialog_box.h"
#include "tui/panel/complete.h"
#include "tui/panel/density_table.h"

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
    FAR = 100000,    /* beyond any list */
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

/* Rows of the note in a box of PROMPT_COLS columns, at most `most`. */
static int note_rows(const struct gb_dialog *dialog, const struct gb_paint *screen,
                     int most)
{
    struct gb_paint probe = *screen;
    probe.rect.cols = MIN(PROMPT_COLS, screen->rect.cols - 2) - 4;
    return gb_paint_wrap_rows(&probe, most, dialog->note);
}

/* A note on the last answer no longer applies to an edited one. */
static bool clear_note(struct gb_dialog *dialog, bool edited)
{
    if (edited) {
        gb_dialog_set_note(dialog, GB_DIALOG_NOTE_ERROR, "%s", "");
    }
    return edited;
}

/* What was copied, in place of the title. */
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
        gb_dialog_box(screen, HELP_ROWS, HELP_COLS, dialog->type->title);
    const struct gb_paint paint = gb_dialog_box_inside(&frame);
    gb_help_list_draw(&dialog->help, &paint);
}

static bool edit_help(struct gb_dialog *dialog, const struct gb_term_event *event)
{
    return gb_help_list_handle(&dialog->help, event);
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

/* No upper limit here: drawing limits the position. */
static enum gb_dialog_result scroll(struct gb_dialog *dialog, int code)
{
    dialog->focus = MAX(dialog->focus + list_step(gb_keys_action(code), dialog->page), 0);
    return GB_DIALOG_OPEN;
}

/* The list limits the position. */
static enum gb_dialog_result scroll_help(struct gb_dialog *dialog, int code)
{
    dialog->help.top += list_step(gb_keys_action(code), dialog->help.page);
    return GB_DIALOG_OPEN;
}

const struct gb_dialog_form gb_dialog_forms_help = {draw_help, edit_help, scroll_help};

/* --- table of densities ------------------------------------------------------------ */

static void draw_densities(struct gb_dialog *dialog, const struct gb_paint *screen)
{
    const struct gb_paint frame =
        gb_dialog_box(screen, DENSITIES_ROWS, DENSITIES_COLS, told_or_title(dialog));
    const struct gb_paint paint = gb_dialog_box_inside(&frame);
    dialog->page = gb_density_table_draw(&paint, dialog->session, dialog->hide_previous,
                                         &dialog->focus);
}

const struct gb_dialog_form gb_dialog_forms_densities = {draw_densities, NULL, scroll};

/* --- list of curves --------------------------------------------------------------- */

static void draw_curves(struct gb_dialog *dialog, const struct gb_paint *screen)
{
    const int note = dialog->note[0] != '\0';
    const struct gb_paint frame =
        gb_dialog_box(screen, CURVES_ROWS, CURVES_COLS, dialog->type->title);
    struct gb_paint paint = gb_dialog_box_inside(&frame);
    draw_note(dialog, &paint, paint.rect.rows - note, note);
    paint.rect.rows -= note;
    gb_curve_list_draw(&dialog->curves, dialog->session, &paint);
}

static bool edit_curves(struct gb_dialog *dialog, const struct gb_term_event *event)
{
    return gb_curve_list_type(&dialog->curves, event);
}

static enum gb_dialog_result go_in_curves(struct gb_dialog *dialog, int code)
{
    struct gb_curve_list *list = &dialog->curves;
    const enum gb_action action = gb_keys_action(code);
    if (list->naming) {
        return action == GB_ACTION_ENTER ? GB_DIALOG_ACCEPTED : GB_DIALOG_OPEN;
    }
    if (action == GB_ACTION_ENTER) {
        gb_curve_list_rename(list, dialog->session);
        return GB_DIALOG_OPEN;
    }
    gb_curve_list_go(list, dialog->session, list_step(action, list->page));
    return GB_DIALOG_OPEN;
}

const struct gb_dialog_form gb_dialog_forms_curves = {draw_curves, edit_curves,
                                                      go_in_curves};

/* --- presets ---------------------------------------------------------------------- */

static void draw_presets(struct gb_dialog *dialog, const struct gb_paint *screen)
{
    const int note = dialog->note[0] != '\0' ? NOTE_ROWS : 0;
    const struct gb_paint frame =
        gb_dialog_box(screen, PRESETS_ROWS, PRESETS_COLS, dialog->type->title);
    struct gb_paint paint = gb_dialog_box_inside(&frame);
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

/* The message line stays: it tells of results that come while something is typed. */
static void draw_finder(struct gb_dialog *dialog, const struct gb_paint *screen)
{
    const int rows = MIN(FINDER_ROWS, screen->rect.rows - 2 * BELOW_ROWS);
    const struct gb_paint frame =
        gb_dialog_box(screen, rows, FINDER_COLS, dialog->type->title);
    const struct gb_paint paint = gb_dialog_box_inside(&frame);
    gb_param_finder_draw(&dialog->finder, &paint);
}

static bool edit_finder(struct gb_dialog *dialog, const struct gb_term_event *event)
{
    return gb_param_finder_handle(&dialog->finder, event);
}

const struct gb_dialog_form gb_dialog_forms_finder = {draw_finder, edit_finder,
                                                      accept_prompt};

/* --- legs ------------------------------------------------------------------------- */

static void draw_legs(struct gb_dialog *dialog, const struct gb_paint *screen)
{
    const int note = dialog->note[0] != '\0' ? NOTE_ROWS : 0;
    const struct gb_paint frame =
        gb_dialog_box(screen, LEGS_ROWS, LEGS_COLS, dialog->type->title);
    struct gb_paint paint = gb_dialog_box_inside(&frame);
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
        gb_dialog_box(screen, PROMPT_ROWS + rows, PROMPT_COLS, dialog->type->title);
    const struct gb_paint paint = gb_dialog_box_inside(&frame);
    gb_paint_text(&paint, 0, 1, GB_STYLE_PLAIN, dialog->type->label);
    gb_prompt_draw(&dialog->prompt, &paint, 1, 1, paint.rect.cols - 2);
    draw_note(dialog, &paint, 3, rows);
}

static void complete(struct gb_dialog *dialog)
{
    int count = 0;
    char *path = gb_complete_path(gb_prompt_text(&dialog->prompt), &count);
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
    const struct gb_paint frame = gb_dialog_box(screen, GB_PICTURE_FORM_ROWS + 2 + note,
                                                PROMPT_COLS, dialog->type->title);
    const struct gb_paint paint = gb_dialog_box_inside(&frame);
    gb_picture_form_draw(&dialog->picture, &paint);
    draw_note(dialog, &paint, GB_PICTURE_FORM_ROWS, note);
}

static bool edit_picture(struct gb_dialog *dialog, const struct gb_term_event *event)
{
    return clear_note(dialog, gb_picture_form_handle(&dialog->picture, event,
                                                     gb_keys_action(event->code)));
}

const struct gb_dialog_form gb_dialog_forms_picture = {draw_picture, edit_picture,
                                                       accept_prompt};

/* --- command ---------------------------------------------------------------------- */

/* No frame at the sides, so that the mouse can select the text: the lines end in
 * backslashes and are one shell command. */
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

/* The answers in one row. */
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

/* The height follows from the wrapped question. */
static void draw_question(struct gb_dialog *dialog, const struct gb_paint *screen)
{
    const int rows = note_rows(dialog, screen, screen->rect.rows - 5);
    const struct gb_paint frame =
        gb_dialog_box(screen, rows + 4, PROMPT_COLS, dialog->type->title);
    const struct gb_paint paint = gb_dialog_box_inside(&frame);
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
