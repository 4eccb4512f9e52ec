#include "tui/dialog.h"

#include <glib.h>
#include <stdio.h>
#include <string.h>

#include "run/preset.h"

enum { HELP_COLS = 60, LIST_COLS = 52, ASK_COLS = 64, NAME_COLS = 10 };

void gb_dialog_show(struct gb_dialog *dialog, enum gb_dialog_kind kind, const char *text)
{
    gb_dialog_close(dialog);
    dialog->kind = kind;
    if (kind == GB_DIALOG_OPEN) {
        dialog->names = gb_preset_list();
    }
    if (kind == GB_DIALOG_COSTLY) {
        g_strlcpy(dialog->note, text != NULL ? text : "", sizeof dialog->note);
        return;
    }
    gb_prompt_set(&dialog->prompt, text != NULL ? text : "");
}

void gb_dialog_close(struct gb_dialog *dialog)
{
    g_strfreev(dialog->names);
    memset(dialog, 0, sizeof *dialog);
}

/* A box in the middle of the screen, as large as fits. */
static struct gb_paint box(const struct gb_paint *screen, int rows, int cols,
                           const char *title)
{
    const int most_rows = screen->rect.rows - 2;
    const int most_cols = screen->rect.cols - 2;
    rows = rows < most_rows ? rows : most_rows;
    cols = cols < most_cols ? cols : most_cols;
    const struct gb_rect rect = {(screen->rect.rows - rows) / 2,
                                 (screen->rect.cols - cols) / 2, rows, cols};
    const struct gb_paint paint = gb_paint_at(screen->term, rect);
    gb_paint_box(&paint, title);
    return paint;
}

static struct gb_paint inside(const struct gb_paint *paint)
{
    const struct gb_rect rect = {paint->rect.row + 1, paint->rect.col + 2,
                                 paint->rect.rows - 2, paint->rect.cols - 4};
    return gb_paint_at(paint->term, rect);
}

static void keep_in_sight(struct gb_dialog *dialog, int lines)
{
    if (dialog->focus >= dialog->top + dialog->page) {
        dialog->top = dialog->focus - dialog->page + 1;
    }
    if (dialog->focus < dialog->top) {
        dialog->top = dialog->focus;
    }
    if (dialog->top > lines - dialog->page) {
        dialog->top = lines - dialog->page;
    }
    dialog->top = dialog->top < 0 ? 0 : dialog->top;
}

static void draw_help(struct gb_dialog *dialog, const struct gb_paint *screen)
{
    size_t count = 0;
    const struct gb_key *key = gb_keys_table(&count);
    const struct gb_paint frame =
        box(screen, (int)count + 2, HELP_COLS, "Keys (Up and Down scroll, Esc back)");
    const struct gb_paint paint = inside(&frame);
    dialog->page = paint.rect.rows;
    const int most = (int)count - dialog->page;
    dialog->top = dialog->focus < most ? dialog->focus : most;
    dialog->top = dialog->top < 0 ? 0 : dialog->top;
    dialog->focus = dialog->top;
    for (int i = 0; i < dialog->page && dialog->top + i < (int)count; i++) {
        const struct gb_key *row = &key[dialog->top + i];
        gb_paint_cell(&paint, i, 0, NAME_COLS, GB_STYLE_BOLD, row->name);
        gb_paint_cell(&paint, i, NAME_COLS, paint.rect.cols - NAME_COLS, GB_STYLE_PLAIN,
                      row->help);
    }
}

static int name_count(const struct gb_dialog *dialog)
{
    return dialog->names == NULL ? 0 : (int)g_strv_length(dialog->names);
}

static void draw_note(const struct gb_dialog *dialog, const struct gb_paint *paint,
                      int row, int rows)
{
    if (dialog->note[0] != '\0') {
        gb_paint_wrap(paint, row, rows, dialog->warned ? GB_STYLE_WARN : GB_STYLE_BAD,
                      dialog->note);
    }
}

static void draw_open(struct gb_dialog *dialog, const struct gb_paint *screen)
{
    const int count = name_count(dialog);
    const int note = dialog->note[0] != '\0' ? 3 : 0;
    const struct gb_paint frame =
        box(screen, (count > 0 ? count : 1) + 2 + note, LIST_COLS,
            "Open a preset (Enter runs it, Esc back)");
    const struct gb_paint paint = inside(&frame);
    dialog->page = paint.rect.rows - note;
    keep_in_sight(dialog, count);
    if (count == 0) {
        gb_paint_text(&paint, 0, 0, GB_STYLE_DIM, "no preset was found");
    }
    for (int i = 0; i < dialog->page && dialog->top + i < count; i++) {
        const int at = dialog->top + i;
        gb_paint_cell(&paint, i, 0, paint.rect.cols,
                      at == dialog->focus ? GB_STYLE_SELECTED : GB_STYLE_PLAIN,
                      dialog->names[at]);
    }
    draw_note(dialog, &paint, dialog->page, note);
}

static void draw_save(const struct gb_dialog *dialog, const struct gb_paint *screen)
{
    const struct gb_paint frame =
        box(screen, 8, ASK_COLS, "Save the parameters as a preset (Esc back)");
    const struct gb_paint paint = inside(&frame);
    gb_paint_text(&paint, 0, 1, GB_STYLE_PLAIN, "Name, or a path with a slash:");
    gb_prompt_draw(&dialog->prompt, &paint, 1, 1, paint.rect.cols - 2);
    draw_note(dialog, &paint, 3, 3);
}

/* The two answers of a question, in one row. */
static void draw_answers(const struct gb_paint *paint, int row, const char *yes,
                         const char *no)
{
    gb_paint_text(paint, row, 1, GB_STYLE_BOLD, "y");
    const int col = gb_paint_text(paint, row, 3, GB_STYLE_PLAIN, yes) + 4;
    gb_paint_text(paint, row, col, GB_STYLE_BOLD, "n");
    gb_paint_text(paint, row, col + 2, GB_STYLE_PLAIN, no);
}

/* As high as the question needs. */
static void draw_costly(const struct gb_dialog *dialog, const struct gb_paint *screen)
{
    struct gb_paint probe = *screen;
    probe.rect.cols = MIN(ASK_COLS, screen->rect.cols - 2) - 4;
    const int rows = gb_paint_wrapped(&probe, screen->rect.rows - 5, dialog->note);
    const struct gb_paint frame =
        box(screen, rows + 4, ASK_COLS, "A long run: start it?");
    const struct gb_paint paint = inside(&frame);
    gb_paint_wrap(&paint, 0, paint.rect.rows - 2, GB_STYLE_PLAIN, dialog->note);
    draw_answers(&paint, paint.rect.rows - 1, "starts it", "leaves it");
}

static void draw_quit(const struct gb_paint *screen)
{
    const struct gb_paint frame = box(screen, 6, ASK_COLS, "Quit?");
    const struct gb_paint paint = inside(&frame);
    gb_paint_wrap(&paint, 0, 2, GB_STYLE_PLAIN,
                  "A run is live; what it has found so far is not stored.");
    draw_answers(&paint, 3, "ends it and quits", "goes back");
}

void gb_dialog_draw(struct gb_dialog *dialog, const struct gb_paint *screen)
{
    switch (dialog->kind) {
    case GB_DIALOG_NONE:
        break;
    case GB_DIALOG_HELP:
        draw_help(dialog, screen);
        break;
    case GB_DIALOG_OPEN:
        draw_open(dialog, screen);
        break;
    case GB_DIALOG_SAVE:
        draw_save(dialog, screen);
        break;
    case GB_DIALOG_QUIT:
        draw_quit(screen);
        break;
    case GB_DIALOG_COSTLY:
        draw_costly(dialog, screen);
        break;
    }
}

static void go_to(struct gb_dialog *dialog, int to)
{
    const int last = dialog->kind == GB_DIALOG_OPEN ? name_count(dialog) - 1 : G_MAXINT;
    dialog->focus = to < 0 ? 0 : to > last ? last : to;
    dialog->note[0] = '\0';
}

/* Moves a list or the help page. */
static void scroll_by_action(struct gb_dialog *dialog, enum gb_action action)
{
    switch (action) {
    case GB_ACTION_UP:
        go_to(dialog, dialog->focus - 1);
        break;
    case GB_ACTION_DOWN:
        go_to(dialog, dialog->focus + 1);
        break;
    case GB_ACTION_PAGE_UP:
        go_to(dialog, dialog->focus - dialog->page);
        break;
    case GB_ACTION_PAGE_DOWN:
        go_to(dialog, dialog->focus + dialog->page);
        break;
    case GB_ACTION_HOME:
        go_to(dialog, 0);
        break;
    case GB_ACTION_END:
        go_to(dialog, 1000000);
        break;
    default:
        break;
    }
}

bool gb_dialog_type(struct gb_dialog *dialog, const struct gb_term_event *event)
{
    if (dialog->kind == GB_DIALOG_SAVE && gb_prompt_take(&dialog->prompt, event)) {
        dialog->note[0] = '\0';
        dialog->warned = false;
        return false;
    }
    const enum gb_action action = gb_keys_action(event->code);
    if (dialog->kind == GB_DIALOG_QUIT || dialog->kind == GB_DIALOG_COSTLY) {
        const bool yes = event->code == 'y' || event->code == 'Y';
        if (!yes && (event->code == 'n' || event->code == 'N' ||
                     action == GB_ACTION_BACK || action == GB_ACTION_QUIT)) {
            gb_dialog_close(dialog);
        }
        return yes;
    }
    if (action == GB_ACTION_BACK || action == GB_ACTION_QUIT ||
        (action == GB_ACTION_HELP && dialog->kind == GB_DIALOG_HELP)) {
        gb_dialog_close(dialog);
        return false;
    }
    scroll_by_action(dialog, action);
    return action == GB_ACTION_ENTER && dialog->kind != GB_DIALOG_HELP &&
           (dialog->kind != GB_DIALOG_OPEN || name_count(dialog) > 0);
}

const char *gb_dialog_answer(struct gb_dialog *dialog)
{
    if (dialog->kind == GB_DIALOG_OPEN) {
        return dialog->names[dialog->focus];
    }
    return gb_prompt_text(&dialog->prompt);
}
