#include "tui/panel/prompt.h"

#include <glib.h>
#include <ncurses.h>
#include <string.h>

enum { CTRL_A = 1, CTRL_E = 5, CTRL_H = 8, CTRL_K = 11, CTRL_U = 21, DELETE = 127 };

void gb_prompt_set(struct gb_prompt *prompt, const char *text)
{
    char *valid = g_utf8_make_valid(text, -1);
    prompt->length = 0;
    for (const char *at = valid; *at != '\0' && prompt->length < GB_PROMPT_MAX;
         at = g_utf8_next_char(at)) {
        prompt->text[prompt->length++] = g_utf8_get_char(at);
    }
    prompt->cursor = prompt->length;
    prompt->fresh = false;
    g_free(valid);
}

void gb_prompt_offer(struct gb_prompt *prompt, const char *text)
{
    gb_prompt_set(prompt, text);
    prompt->fresh = prompt->length > 0;
}

/* Removes `count` characters before index `end`. */
static void cut(struct gb_prompt *prompt, int end, int count)
{
    memmove(prompt->text + end - count, prompt->text + end,
            (size_t)(prompt->length - end) * sizeof prompt->text[0]);
    prompt->length -= count;
    prompt->cursor = end - count;
}

static bool insert(struct gb_prompt *prompt, uint32_t ch)
{
    if (prompt->length == GB_PROMPT_MAX) {
        return true;
    }
    memmove(prompt->text + prompt->cursor + 1, prompt->text + prompt->cursor,
            (size_t)(prompt->length - prompt->cursor) * sizeof prompt->text[0]);
    prompt->text[prompt->cursor++] = ch;
    prompt->length++;
    return true;
}

static void go_to(struct gb_prompt *prompt, int to)
{
    prompt->cursor = CLAMP(to, 0, prompt->length);
}

static void delete_forward(struct gb_prompt *prompt)
{
    if (prompt->cursor < prompt->length) {
        cut(prompt, prompt->cursor + 1, 1);
    }
}

bool gb_prompt_handle(struct gb_prompt *prompt, const struct gb_term_event *event)
{
    const bool replaces = prompt->fresh && event->kind == GB_TERM_TEXT;
    prompt->fresh = false;
    if (replaces) {
        prompt->length = prompt->cursor = 0;
    }
    if (event->kind == GB_TERM_TEXT) {
        return insert(prompt, (uint32_t)event->code);
    }
    switch (event->code) {
    case KEY_LEFT:
        go_to(prompt, prompt->cursor - 1);
        return true;
    case KEY_RIGHT:
        go_to(prompt, prompt->cursor + 1);
        return true;
    case KEY_HOME:
    case CTRL_A:
        go_to(prompt, 0);
        return true;
    case KEY_END:
    case CTRL_E:
        go_to(prompt, prompt->length);
        return true;
    case KEY_BACKSPACE:
    case CTRL_H:
    case DELETE:
        if (prompt->cursor > 0) {
            cut(prompt, prompt->cursor, 1);
        }
        return true;
    case KEY_DC:
        delete_forward(prompt);
        return true;
    case CTRL_U:
        cut(prompt, prompt->cursor, prompt->cursor);
        return true;
    case CTRL_K:
        prompt->length = prompt->cursor;
        return true;
    default:
        return false;
    }
}

const char *gb_prompt_text(struct gb_prompt *prompt)
{
    int at = 0;
    for (int i = 0; i < prompt->length; i++) {
        at += g_unichar_to_utf8(prompt->text[i], prompt->utf8 + at);
    }
    prompt->utf8[at] = '\0';
    return prompt->utf8;
}

void gb_prompt_draw(const struct gb_prompt *prompt, const struct gb_paint *paint, int row,
                    int col, int cols)
{
    const int from = prompt->cursor >= cols ? prompt->cursor - cols + 1 : 0;
    for (int i = 0; i < cols; i++) {
        const int at = from + i;
        char utf8[8] = " ";
        if (at < prompt->length) {
            utf8[g_unichar_to_utf8(prompt->text[at], utf8)] = '\0';
        }
        const bool marked =
            at == prompt->cursor || (prompt->fresh && at < prompt->length);
        gb_paint_text(paint, row, col + i, marked ? GB_STYLE_SELECTED : GB_STYLE_EDIT,
                      utf8);
    }
}
