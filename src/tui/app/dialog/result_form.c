#include <glib.h>
#include <stdio.h>

#include "tui/app/dialog/dialog_box.h"
#include "tui/app/dialog/dialog_forms.h"
#include "tui/session/session.h"

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

/* Draws the lines from the first one shown on, warnings behind a "!"; returns the rows
 * that all lines need. */
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

/* What stands below the lines: path, note of the last key, keys. */
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
        gb_dialog_box(screen, lines + 1 + below + BORDER, CARD_COLS, title);
    const struct gb_paint paint = gb_dialog_box_inside(&frame);
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

const struct gb_dialog_form gb_result_form_cards = {draw_card, NULL, go};

/* --- picture ------------------------------------------------------------------------ */

/* The cells of the picture stay empty: its pixels are sent behind the frame. */
static void draw_picture(struct gb_dialog *dialog, const struct gb_paint *screen)
{
    const struct gb_paint frame =
        gb_dialog_box(screen, screen->rect.rows, screen->rect.cols, dialog->type->title);
    const struct gb_paint paint = gb_dialog_box_inside(&frame);
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

const struct gb_dialog_form gb_result_form_picture = {draw_picture, NULL, stay};
