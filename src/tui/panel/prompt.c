#include "tui/panel/prompt.h"

#include <glib.h>
#include <ncurses.h>
#include <string.h>

char *gb_prompt_complete_home(const char *path)
{
    return g_str_has_prefix(path, "~/")
               ? g_build_filename(g_get_home_dir(), path + 2, NULL)
               : g_strdup(path);
}

/* Truncates a to the common prefix with b, at a whole character. */
static void cut_to_common(GString *a, const char *b)
{
    gsize n = 0;
    while (n < a->len && a->str[n] == b[n]) {
        n++;
    }
    while (n > 0 && (a->str[n] & 0xc0) == 0x80) {
        n--;
    }
    g_string_truncate(a, n);
}

/* Common prefix of the names in a folder that begin with `begun`; NULL: none. */
static GString *common_name(const char *folder, const char *begun, int *count)
{
    GString *common = NULL;
    GDir *dir = g_dir_open(folder, 0, NULL);
    const char *name = NULL;
    *count = 0;
    while (dir != NULL && (name = g_dir_read_name(dir)) != NULL) {
        if (!g_str_has_prefix(name, begun) || (*begun == '\0' && *name == '.')) {
            continue;
        }
        (*count)++;
        if (common == NULL) {
            common = g_string_new(name);
        } else {
            cut_to_common(common, name);
        }
    }
    if (dir != NULL) {
        g_dir_close(dir);
    }
    return common;
}

char *gb_prompt_complete_path(const char *path, int *count)
{
    int found = 0;
    char *real = gb_prompt_complete_home(path);
    const char *slash = strrchr(real, '/');
    char *folder = slash == NULL   ? g_strdup(".")
                   : slash == real ? g_strdup("/")
                                   : g_strndup(real, (gsize)(slash - real));
    GString *name = common_name(folder, slash == NULL ? real : slash + 1, &found);
    char *done = NULL;
    if (name == NULL) {
        done = g_strdup(path);
    } else {
        char *head = g_strndup(real, slash == NULL ? 0 : (gsize)(slash - real + 1));
        done = g_strconcat(head, name->str, NULL);
        if (found == 1 && g_file_test(done, G_FILE_TEST_IS_DIR)) {
            char *with_slash = g_strconcat(done, "/", NULL);
            g_free(done);
            done = with_slash;
        }
        g_free(head);
        g_string_free(name, TRUE);
    }
    if (count != NULL) {
        *count = found;
    }
    g_free(folder);
    g_free(real);
    return done;
}

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
