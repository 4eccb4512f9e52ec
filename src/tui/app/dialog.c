#include "tui/app/dialog.h"

#include <glib.h>
#include <stdio.h>
#include <string.h>

#include "tui/app/complete.h"

enum {
    HELP_COLS = 60,
    OPEN_ROWS = 34,
    OPEN_COLS = 84,
    ASK_COLS = 64,
    NAME_COLS = 10,
    OPEN_NOTE = 3
};

/* Dialogs in which a line is typed. */
static const struct ask {
    enum gb_dialog_kind kind;
    const char *title, *label;
    bool path; /* Tab completes it */
} asks[] = {
    {GB_DIALOG_SAVE, "Save the parameters as a preset (Esc back)",
     "Name, or a path with a slash:", false},
    {GB_DIALOG_DATA, "Experiment over the plot (Esc back)",
     "CSV file, Tab completes; nothing takes it away:", true},
    {GB_DIALOG_FORK, "What if the run went on with ... (Esc back)",
     "key=value; several with semicolons between:", false},
    {GB_DIALOG_FIND, "Find a parameter (Esc back)", "Its name, or a part of it:", false},
    {GB_DIALOG_CELLS, "More cells of this scene (Esc back)",
     "How many; and until which error at a pressure:", false},
    {GB_DIALOG_FIT, "Fit to the experiment (Esc back)",
     "Up to 4 keys with commas, each may have =LOW:HIGH:", false},
};

static const struct ask *ask_of(const struct gb_dialog *dialog)
{
    for (size_t i = 0; i < G_N_ELEMENTS(asks); i++) {
        if (asks[i].kind == dialog->kind) {
            return &asks[i];
        }
    }
    return NULL;
}

void gb_dialog_show(struct gb_dialog *dialog, enum gb_dialog_kind kind, const char *text)
{
    gb_dialog_close(dialog);
    dialog->kind = kind;
    if (kind == GB_DIALOG_COMMAND) {
        dialog->text = g_strdup(text != NULL ? text : "");
    } else if (kind == GB_DIALOG_COSTLY || kind == GB_DIALOG_QUIT) {
        g_strlcpy(dialog->note, text != NULL ? text : "", sizeof dialog->note);
    } else {
        gb_prompt_set(&dialog->prompt, text != NULL ? text : "");
    }
}

void gb_dialog_browse(struct gb_dialog *dialog, const struct gb_params *current)
{
    gb_dialog_close(dialog);
    dialog->kind = GB_DIALOG_OPEN;
    gb_preset_browser_init(&dialog->browser, current);
}

void gb_dialog_close(struct gb_dialog *dialog)
{
    gb_preset_browser_finish(&dialog->browser);
    g_free(dialog->text);
    memset(dialog, 0, sizeof *dialog);
}

/* A box in the middle of the screen, as large as fits. */
static struct gb_paint box(const struct gb_paint *screen, int rows, int cols,
                           const char *title)
{
    const int max_rows = screen->rect.rows - 2;
    const int max_cols = screen->rect.cols - 2;
    rows = rows < max_rows ? rows : max_rows;
    cols = cols < max_cols ? cols : max_cols;
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

static void draw_help(struct gb_dialog *dialog, const struct gb_paint *screen)
{
    size_t count = 0;
    const struct gb_key *key = gb_keys_table(&count);
    const struct gb_paint frame =
        box(screen, (int)count + 2, HELP_COLS, "Keys (Up and Down scroll, Esc back)");
    const struct gb_paint paint = inside(&frame);
    dialog->page = paint.rect.rows;
    const int max = (int)count - dialog->page;
    dialog->top = dialog->focus < max ? dialog->focus : max;
    dialog->top = dialog->top < 0 ? 0 : dialog->top;
    dialog->focus = dialog->top;
    for (int i = 0; i < dialog->page && dialog->top + i < (int)count; i++) {
        const struct gb_key *row = &key[dialog->top + i];
        gb_paint_cell(&paint, i, 0, NAME_COLS, GB_STYLE_BOLD, row->name);
        gb_paint_cell(&paint, i, NAME_COLS, paint.rect.cols - NAME_COLS, GB_STYLE_PLAIN,
                      row->help);
    }
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
    const int note = dialog->note[0] != '\0' ? OPEN_NOTE : 0;
    const struct gb_paint frame = box(screen, OPEN_ROWS, OPEN_COLS,
                                      "Open a preset (Enter opens, Tab compares, Esc)");
    struct gb_paint paint = inside(&frame);
    draw_note(dialog, &paint, paint.rect.rows - note, note);
    paint.rect.rows -= note;
    gb_preset_browser_draw(&dialog->browser, &paint);
}

static void draw_ask(const struct gb_dialog *dialog, const struct gb_paint *screen)
{
    const struct ask *ask = ask_of(dialog);
    const struct gb_paint frame = box(screen, 8, ASK_COLS, ask->title);
    const struct gb_paint paint = inside(&frame);
    gb_paint_text(&paint, 0, 1, GB_STYLE_PLAIN, ask->label);
    gb_prompt_draw(&dialog->prompt, &paint, 1, 1, paint.rect.cols - 2);
    draw_note(dialog, &paint, 3, 3);
}

/* Without a frame at its sides, so that it can be copied with the mouse: the lines end in
 * backslashes and are one command for a shell. */
static void draw_command(const struct gb_dialog *dialog, const struct gb_paint *screen)
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
    gb_paint_title(&paint, "The command that repeats this (Esc back)", true);
    const struct gb_rect end = {rect.row + rows - 1, 0, 1, rect.cols};
    const struct gb_paint last = gb_paint_at(screen->term, end);
    gb_paint_title(&last, "c again closes", false);
    g_strfreev(lines);
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

static void draw_quit(const struct gb_dialog *dialog, const struct gb_paint *screen)
{
    const struct gb_paint frame = box(screen, 6, ASK_COLS, "Quit?");
    const struct gb_paint paint = inside(&frame);
    gb_paint_wrap(&paint, 0, 2, GB_STYLE_PLAIN, dialog->note);
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
    case GB_DIALOG_DATA:
    case GB_DIALOG_FORK:
    case GB_DIALOG_FIND:
    case GB_DIALOG_CELLS:
    case GB_DIALOG_FIT:
        draw_ask(dialog, screen);
        break;
    case GB_DIALOG_COMMAND:
        draw_command(dialog, screen);
        break;
    case GB_DIALOG_QUIT:
        draw_quit(dialog, screen);
        break;
    case GB_DIALOG_COSTLY:
        draw_costly(dialog, screen);
        break;
    }
}

static void go_to(struct gb_dialog *dialog, int to)
{
    dialog->focus = to < 0 ? 0 : to;
}

/* Moves the help page; how far it goes the drawing knows. */
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

static void complete(struct gb_dialog *dialog)
{
    int count = 0;
    char *path = gb_complete_path(gb_prompt_text(&dialog->prompt), &count);
    gb_prompt_set(&dialog->prompt, path);
    dialog->warned = count != 1;
    if (count != 1) {
        snprintf(dialog->note, sizeof dialog->note, "%d files fit", count);
    }
    g_free(path);
}

/* Events that change what is typed; Enter and Esc do not. */
static bool edit(struct gb_dialog *dialog, const struct gb_term_event *event)
{
    const struct ask *ask = ask_of(dialog);
    bool taken = false;
    if (dialog->kind == GB_DIALOG_OPEN) {
        taken = gb_preset_browser_handle(&dialog->browser, event);
    } else if (ask != NULL) {
        taken = gb_prompt_handle(&dialog->prompt, event);
    }
    if (taken) {
        dialog->note[0] = '\0';
        dialog->warned = false;
    }
    if (ask != NULL && ask->path && event->kind == GB_TERM_KEY && event->code == '\t') {
        complete(dialog);
        return true;
    }
    return taken;
}

static bool is_question(const struct gb_dialog *dialog)
{
    return dialog->kind == GB_DIALOG_QUIT || dialog->kind == GB_DIALOG_COSTLY;
}

/* y answers, n and Esc go back. */
static bool decide(struct gb_dialog *dialog, const struct gb_term_event *event,
                   enum gb_action action)
{
    const bool yes = event->code == 'y' || event->code == 'Y';
    if (!yes && (event->code == 'n' || event->code == 'N' || action == GB_ACTION_BACK ||
                 action == GB_ACTION_QUIT)) {
        gb_dialog_close(dialog);
    }
    return yes;
}

bool gb_dialog_type(struct gb_dialog *dialog, const struct gb_term_event *event)
{
    if (edit(dialog, event)) {
        return false;
    }
    const enum gb_action action = gb_keys_action(event->code);
    if (is_question(dialog)) {
        return decide(dialog, event, action);
    }
    if (action == GB_ACTION_BACK || action == GB_ACTION_QUIT ||
        (action == GB_ACTION_HELP && dialog->kind == GB_DIALOG_HELP) ||
        (action == GB_ACTION_COMMAND && dialog->kind == GB_DIALOG_COMMAND)) {
        gb_dialog_close(dialog);
        return false;
    }
    scroll_by_action(dialog, action);
    return action == GB_ACTION_ENTER && dialog->kind != GB_DIALOG_HELP &&
           dialog->kind != GB_DIALOG_COMMAND &&
           (dialog->kind != GB_DIALOG_OPEN ||
            gb_preset_browser_selected(&dialog->browser) != NULL);
}

const char *gb_dialog_answer(struct gb_dialog *dialog)
{
    if (dialog->kind == GB_DIALOG_OPEN) {
        return gb_preset_browser_selected(&dialog->browser);
    }
    return gb_prompt_text(&dialog->prompt);
}
