#include "tui/app/help_list.h"

#include <glib.h>
#include <string.h>

#include "tui/app/keys.h"

enum { KEY_COLS = 10, INDENT = 2, HEAD_ROWS = 2 };

static const struct gb_help_word glossary[] = {
#include "tui/glossary_rows.inc"
};

const struct gb_help_word *gb_help_list_words(size_t *count)
{
    *count = G_N_ELEMENTS(glossary);
    return glossary;
}

/* A line of the list, with a name before the text or above it. */
struct line {
    char *name, *text; /* owned; NULL: none */
    enum gb_style style;
    int col; /* of the text */
};

struct lines {
    GPtrArray *line;
    const struct gb_paint *paint;
    char **wanted;       /* words of the filter, lower case */
    const char *heading; /* that comes before the next line; NULL: none */
};

static void free_line(void *data)
{
    struct line *line = data;
    g_free(line->name);
    g_free(line->text);
    g_free(line);
}

static void add(struct lines *lines, const char *name, const char *text,
                enum gb_style style, int col)
{
    struct line *line = g_new0(struct line, 1);
    *line = (struct line){g_strdup(name), g_strdup(text), style, col};
    g_ptr_array_add(lines->line, line);
}

/* A heading is added when something stands below it. */
static void add_heading(struct lines *lines)
{
    if (lines->heading != NULL) {
        if (lines->line->len > 0) {
            add(lines, NULL, "", GB_STYLE_PLAIN, 0);
        }
        add(lines, NULL, lines->heading, GB_STYLE_TITLE, 0);
        lines->heading = NULL;
    }
}

/* The text broken at blanks from column `col` on; the name stands in the first line. */
static void add_wrapped(struct lines *lines, const char *name, const char *text, int col)
{
    const int room = MAX(lines->paint->rect.cols - col, 8);
    char **word = g_strsplit(text, " ", -1);
    GString *line = g_string_new(NULL);
    add_heading(lines);
    for (size_t i = 0; word[i] != NULL; i++) {
        if (line->len > 0 &&
            gb_paint_width(line->str) + 1 + gb_paint_width(word[i]) > room) {
            add(lines, name, line->str, GB_STYLE_PLAIN, col);
            name = NULL;
            g_string_truncate(line, 0);
        }
        g_string_append_printf(line, "%s%s", line->len > 0 ? " " : "", word[i]);
    }
    add(lines, name, line->str, GB_STYLE_PLAIN, col);
    g_string_free(line, TRUE);
    g_strfreev(word);
}

/* All words of the filter stand in the texts. */
static bool wanted(const struct lines *lines, const char *name, const char *text,
                   const char *heading)
{
    char *joined = g_strdup_printf("%s %s %s", name, text, heading);
    char *all = g_utf8_strdown(joined, -1);
    bool found = true;
    for (size_t i = 0; lines->wanted[i] != NULL; i++) {
        found = found && strstr(all, lines->wanted[i]) != NULL;
    }
    g_free(all);
    g_free(joined);
    return found;
}

static void add_keys(struct lines *lines)
{
    const char *group = "";
    for (size_t i = 0; i < gb_keys_count(); i++) {
        const struct gb_key key = gb_keys_at(i);
        const char *heading = gb_keys_heading(i);
        if (heading != NULL) {
            group = lines->heading = heading;
        }
        if (wanted(lines, key.name, key.help, group)) {
            add_wrapped(lines, key.name, key.help, KEY_COLS);
        }
    }
}

static void add_glossary(struct lines *lines)
{
    for (size_t i = 0; i < G_N_ELEMENTS(glossary); i++) {
        const struct gb_help_word *entry = &glossary[i];
        if (entry->word == NULL) {
            lines->heading = entry->meaning;
        } else if (wanted(lines, entry->word, entry->meaning, "glossary")) {
            add_heading(lines);
            add(lines, NULL, entry->word, GB_STYLE_BOLD, 0);
            add_wrapped(lines, NULL, entry->meaning, INDENT);
        }
    }
}

void gb_help_list_init(struct gb_help_list *list)
{
    memset(list, 0, sizeof *list);
    gb_prompt_set(&list->filter, "");
}

bool gb_help_list_handle(struct gb_help_list *list, const struct gb_term_event *event)
{
    if ((event->kind == GB_TERM_TEXT && event->code == '?') ||
        !gb_prompt_handle(&list->filter, event)) {
        return false;
    }
    list->top = 0;
    return true;
}

static void draw_line(const struct gb_paint *paint, int row, const struct line *line)
{
    if (line->name != NULL) {
        gb_paint_text(paint, row, 0, GB_STYLE_BOLD, line->name);
    }
    gb_paint_text(paint, row, line->col, line->style, line->text);
}

void gb_help_list_draw(struct gb_help_list *list, const struct gb_paint *paint)
{
    char *typed = g_utf8_strdown(gb_prompt_text(&list->filter), -1);
    struct lines lines = {.line = g_ptr_array_new_with_free_func(free_line),
                          .paint = paint,
                          .wanted = g_strsplit(typed, " ", -1)};
    add_keys(&lines);
    add_glossary(&lines);
    const int count = (int)lines.line->len;
    list->page = MAX(paint->rect.rows - HEAD_ROWS, 1);
    list->top = CLAMP(list->top, 0, MAX(count - list->page, 0));
    const int col = gb_paint_text(paint, 0, 0, GB_STYLE_DIM, "Filter: ");
    gb_prompt_draw(&list->filter, paint, 0, col, paint->rect.cols - col);
    for (int i = 0; i < list->page && list->top + i < count; i++) {
        draw_line(paint, HEAD_ROWS + i,
                  g_ptr_array_index(lines.line, (guint)(list->top + i)));
    }
    if (count == 0) {
        gb_paint_text(paint, HEAD_ROWS, 0, GB_STYLE_WARN,
                      "no key and no word of the glossary has this");
    }
    g_strfreev(lines.wanted);
    g_free(typed);
    g_ptr_array_free(lines.line, TRUE);
}
