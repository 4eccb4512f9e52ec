#include "tui/app/help_list.h"

#include <glib.h>

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
    const bool found = gb_list_box_matches(lines->wanted, joined);
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
    *list = (struct gb_help_list){.box = {.unfocused = true}};
}

bool gb_help_list_handle(struct gb_help_list *list, const struct gb_term_event *event)
{
    if ((event->kind == GB_TERM_TEXT && event->code == '?') ||
        !gb_prompt_handle(&list->box.filter, event)) {
        return false;
    }
    list->box.top = 0;
    return true;
}

static void write_line(void *data, int item, struct gb_list_box_line *out)
{
    const struct lines *lines = data;
    const struct line *line = g_ptr_array_index(lines->line, (guint)item);
    out->style = line->style;
    if (line->col < KEY_COLS) { /* from the left edge, or indented */
        out->whole = g_strdup_printf("%*s%s", line->col, "", line->text);
    } else {
        out->cell[0] = g_strdup(line->name);
        out->ink[0] = GB_STYLE_BOLD;
        out->cell[1] = g_strdup(line->text);
    }
}

void gb_help_list_draw(struct gb_help_list *list, const struct gb_paint *paint)
{
    static const struct gb_list_box_look look = {
        .columns = 2,
        .column = {{.cols = KEY_COLS}, {.cols = 0}},
        .empty = "no key and no word of the glossary has this",
        .empty_style = GB_STYLE_WARN,
        .write = write_line};
    char *typed = g_utf8_casefold(gb_prompt_text(&list->box.filter), -1);
    struct lines lines = {.line = g_ptr_array_new_with_free_func(free_line),
                          .paint = paint,
                          .wanted = g_strsplit(typed, " ", -1)};
    struct gb_rect rect = paint->rect;
    rect.row += HEAD_ROWS;
    rect.rows -= HEAD_ROWS;
    const struct gb_paint rows = gb_paint_at(paint->term, rect);
    add_keys(&lines);
    add_glossary(&lines);
    gb_list_box_set_count(&list->box, (int)lines.line->len);
    gb_list_box_draw_filter(&list->box, paint, 0, 0, "Filter:");
    gb_list_box_draw(&list->box, &rows, &look, &lines);
    g_strfreev(lines.wanted);
    g_free(typed);
    g_ptr_array_free(lines.line, TRUE);
}
