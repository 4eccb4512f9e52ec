#include <stdio.h>
#include <string.h>

#include "tui/app/keys.h"
#include "tui/legs/leg_editor.h"
#include "tui/legs/leg_sketch.h"
#include "tui/legs/leg_words.h"

/* The legs above, below them what the focused one does and the sketch, or the shorthands
 * while it is typed; the keys in the last rows. */

enum {
    TEXT_COL = 3,   /* of a leg, behind its number */
    WORD_COLS = 7,  /* "leads  " */
    ERROR_ROWS = 3, /* of the focused leg */
    KEY_ROWS = 2,
    LINES = 2 * GB_LEG_LIST_MAX + 3,
    SKETCH_ROWS = 9
};

/* A line of the list: a leg, what is wrong with it, or the one that is typed. */
struct line {
    int leg; /* from 0 */
    int rows;
    enum gb_style style;
    bool typed;
    const char *text;
};

struct lines {
    struct line line[LINES];
    int count;
    int focus; /* line */
    struct gb_error typed_error;
    struct gb_leg typed_leg;
    bool typed_good;
};

static void add(struct lines *lines, struct line line)
{
    if (lines->count < LINES) {
        lines->line[lines->count++] = line;
    }
}

static void add_error(struct lines *lines, const struct gb_paint *paint, int leg,
                      bool focused, const struct gb_error *err)
{
    struct gb_paint text = *paint;
    text.rect.cols -= TEXT_COL;
    const int rows = focused ? gb_paint_wrap_rows(&text, ERROR_ROWS, err->text) : 1;
    add(lines, (struct line){leg, rows, GB_STYLE_BAD, false, err->text});
}

static void add_typed(struct lines *lines, struct gb_leg_editor *editor,
                      const struct gb_paint *paint)
{
    const char *text = gb_prompt_text(&editor->prompt);
    const bool whole = editor->typing == GB_LEG_EDITOR_WHOLE;
    const int before = whole ? 0 : editor->focus;
    struct gb_path path;
    lines->typed_leg = (struct gb_leg){.leading = -1};
    if (whole) {
        gb_path_parse(&path, text, editor->list.dimension, &lines->typed_error);
    } else {
        lines->typed_good =
            text[0] != '\0' && gb_leg_list_try(&editor->list, before, text,
                                               &lines->typed_leg, &lines->typed_error);
    }
    lines->focus = lines->count;
    add(lines, (struct line){before, 1, GB_STYLE_EDIT, true, ""});
    if (lines->typed_error.text[0] != '\0') {
        add_error(lines, paint, before, true, &lines->typed_error);
    }
}

static void list_lines(struct lines *lines, struct gb_leg_editor *editor,
                       const struct gb_paint *paint)
{
    const struct gb_leg_list *list = &editor->list;
    const int count = gb_leg_list_count(list);
    const enum gb_leg_editor_typing typing = editor->typing;
    if (typing == GB_LEG_EDITOR_WHOLE) {
        add_typed(lines, editor, paint);
        return;
    }
    for (int i = 0; i < count; i++) {
        const bool focused = i == editor->focus;
        if (focused && typing != GB_LEG_EDITOR_LIST) {
            add_typed(lines, editor, paint);
        }
        if (typing == GB_LEG_EDITOR_CHANGE && focused) {
            continue;
        }
        const bool bad = list->index[i] < 0;
        lines->focus =
            focused && typing == GB_LEG_EDITOR_LIST ? lines->count : lines->focus;
        add(lines,
            (struct line){i, 1,
                          focused && typing == GB_LEG_EDITOR_LIST ? GB_STYLE_SELECTED
                          : bad                                   ? GB_STYLE_WARN
                                                                  : GB_STYLE_PLAIN,
                          false, gb_leg_list_at(list, i)});
        if (bad) {
            add_error(lines, paint, i, focused, &list->error[i]);
        }
    }
    if (editor->focus == count && typing != GB_LEG_EDITOR_LIST) {
        add_typed(lines, editor, paint);
    } else if (typing == GB_LEG_EDITOR_LIST) {
        lines->focus = editor->focus == count ? lines->count : lines->focus;
        add(lines,
            (struct line){
                count, 1, editor->focus == count ? GB_STYLE_SELECTED : GB_STYLE_DIM,
                false, count > 0 ? "Enter adds a leg" : "no legs: Enter adds one"});
    }
}

/* Rows from line `from` to the end of the focused leg. */
static int rows_to_focus(const struct lines *lines, int from)
{
    const int leg = lines->line[lines->focus].leg;
    int rows = 0;
    for (int i = from; i < lines->count; i++) {
        if (i <= lines->focus || lines->line[i].leg == leg) {
            rows += lines->line[i].rows;
        }
    }
    return rows;
}

/* Legs behind one that is put in count from it. */
static int number_of(const struct gb_leg_editor *editor, const struct line *line)
{
    const bool behind = editor->typing == GB_LEG_EDITOR_INSERT && !line->typed &&
                        line->leg >= editor->focus;
    return line->leg + 1 + behind;
}

static void draw_line(struct gb_leg_editor *editor, const struct gb_paint *paint, int row,
                      const struct line *line, bool first)
{
    const int cols = paint->rect.cols - TEXT_COL;
    char number[16];
    snprintf(number, sizeof number, "%2d", number_of(editor, line));
    if (first) {
        gb_paint_text(paint, row, 0, GB_STYLE_DIM, number);
    }
    if (line->typed) {
        gb_prompt_draw(&editor->prompt, paint, row, TEXT_COL, cols);
    } else if (line->rows > 1) {
        struct gb_paint text = *paint;
        text.rect.col += TEXT_COL;
        text.rect.cols -= TEXT_COL;
        gb_paint_wrap(&text, row, line->rows, line->style, line->text);
    } else {
        gb_paint_cell(paint, row, TEXT_COL, cols, line->style, line->text);
    }
}

/* Returns the rows used, at most `most`. */
static int draw_list(struct gb_leg_editor *editor, const struct gb_paint *paint, int most,
                     const struct lines *lines)
{
    int from = 0;
    int row = 0;
    while (from < lines->focus && rows_to_focus(lines, from) > most) {
        from++;
    }
    for (int i = from; i < lines->count && row + lines->line[i].rows <= most; i++) {
        const bool first = i == 0 || lines->line[i].leg != lines->line[i - 1].leg ||
                           lines->line[i].style != GB_STYLE_BAD;
        draw_line(editor, paint, row, &lines->line[i], first);
        row += lines->line[i].rows;
    }
    return row;
}

static int draw_word(const struct gb_paint *paint, int row, const char *name,
                     const char *text)
{
    struct gb_paint right = *paint;
    if (text[0] == '\0' || row >= paint->rect.rows) {
        return row;
    }
    gb_paint_text(paint, row, 0, GB_STYLE_DIM, name);
    right.rect.col += WORD_COLS;
    right.rect.cols -= WORD_COLS;
    return row + gb_paint_wrap(&right, row, paint->rect.rows - row, GB_STYLE_PLAIN, text);
}

static void draw_words(const struct gb_paint *paint, const struct gb_leg *leg,
                       int dimension)
{
    struct gb_leg_words words;
    gb_leg_words_write(leg, dimension, &words);
    int row = draw_word(paint, 0, "leads", words.leads);
    row = draw_word(paint, row, "held", words.held);
    row = draw_word(paint, row, "fixed", words.fixed);
    draw_word(paint, row, "ends", words.ends);
}

static void draw_sketch(struct gb_leg_editor *editor, const struct gb_paint *paint)
{
    const struct gb_leg_list *list = &editor->list;
    const struct gb_leg *leg = gb_leg_list_leg(list, editor->focus);
    const int focus = leg != NULL ? list->index[editor->focus] + 1 : 0;
    if (gb_plot_resize(&editor->plot, paint->rect.rows, paint->rect.cols, editor->glyphs,
                       NULL)) {
        gb_leg_sketch_draw(&list->path, list->dimension, focus, &editor->plot);
        gb_paint_plot(paint, 0, 0, &editor->plot);
    }
}

/* What the focused leg does, left; the whole path, right. */
static void draw_preview(struct gb_leg_editor *editor, const struct gb_paint *paint)
{
    const struct gb_leg *leg = gb_leg_list_leg(&editor->list, editor->focus);
    struct gb_paint left = *paint, right = *paint;
    left.rect.cols = paint->rect.cols / 2 - 1;
    right.rect.col += paint->rect.cols / 2;
    right.rect.cols -= paint->rect.cols / 2;
    if (leg != NULL) {
        draw_words(&left, leg, editor->list.dimension);
    }
    if (editor->list.path.count > 0) {
        draw_sketch(editor, &right);
    }
}

/* The shorthands that fit, and what the focused one does. */
static void draw_offers(struct gb_leg_editor *editor, const struct gb_paint *paint)
{
    const char *usage, *doc, *focused = "";
    const int rows = paint->rect.rows - 2;
    const int from = MAX(0, editor->offer - rows + 1);
    int row = 0;
    for (int i = from; row < rows && gb_leg_editor_offer(editor, i, &usage, &doc); i++) {
        const bool here = i == editor->offer;
        focused = here ? doc : focused;
        gb_paint_cell(paint, row++, TEXT_COL, paint->rect.cols - TEXT_COL,
                      here ? GB_STYLE_BOLD : GB_STYLE_DIM, usage);
        if (here) {
            gb_paint_text(paint, row - 1, 1, GB_STYLE_BOLD, ">");
        }
    }
    gb_paint_wrap(paint, row, 2, GB_STYLE_DIM, focused);
}

static void draw_typing(struct gb_leg_editor *editor, const struct gb_paint *paint,
                        const struct lines *lines)
{
    struct gb_paint lower = *paint;
    if (lines->typed_good && editor->typing != GB_LEG_EDITOR_WHOLE) {
        draw_words(&lower, &lines->typed_leg, editor->list.dimension);
    } else if (editor->typing != GB_LEG_EDITOR_WHOLE) {
        draw_offers(editor, &lower);
    }
}

/* "Enter edit  O add  ...  Esc restore", from the table of keys. */
static void write_keys(const struct gb_leg_editor *editor, GString *text)
{
    if (editor->typing != GB_LEG_EDITOR_LIST) {
        g_string_assign(text, "Enter takes the leg  Tab completes  Up Down choose  "
                              "Esc leaves it");
        return;
    }
    g_string_assign(text, "Enter edit  ");
    for (size_t i = 0; i < gb_keys_count(); i++) {
        const struct gb_key key = gb_keys_at(i);
        if ((key.scope & GB_KEY_LEGS) && key.brief != NULL) {
            g_string_append_printf(text, "%.*s %s  ", (int)strcspn(key.name, " "),
                                   key.name, key.brief);
        }
    }
    g_string_append(text, "Esc restore");
}

void gb_leg_editor_draw(struct gb_leg_editor *editor, const struct gb_paint *inside)
{
    struct lines lines = {.count = 0};
    struct gb_paint lower = *inside;
    GString *keys = g_string_new(NULL);
    write_keys(editor, keys);
    const int key_rows = gb_paint_wrap_rows(inside, KEY_ROWS, keys->str);
    const int rows = inside->rect.rows - key_rows;
    const bool typing = editor->typing != GB_LEG_EDITOR_LIST;
    list_lines(&lines, editor, inside);
    const int used = draw_list(
        editor, inside, MAX(4, typing ? rows / 3 + 1 : rows - SKETCH_ROWS), &lines);
    lower.rect.row += used + (rows > 15);
    lower.rect.rows = rows - used - (rows > 15);
    if (typing) {
        draw_typing(editor, &lower, &lines);
    } else {
        draw_preview(editor, &lower);
    }
    gb_paint_wrap(inside, rows, key_rows, GB_STYLE_DIM, keys->str);
    g_string_free(keys, TRUE);
}
