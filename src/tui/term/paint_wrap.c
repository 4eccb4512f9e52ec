#include <stdbool.h>
#include <string.h>

#include <glib.h>

#include "base/units.h"
#include "tui/term/paint.h"

/* Draws one row of wrapped text; row -1: rows are only counted. */
static void wrap_row(const struct gb_paint *paint, int row, enum gb_style style,
                     const char *text)
{
    if (row >= 0) {
        gb_paint_cell(paint, row, 1, paint->rect.cols - 2, style, text);
    }
}

/* State of breaking a text into rows. */
struct wrapping {
    const struct gb_paint *paint;
    int row, rows, used; /* row < 0: rows are only counted */
    enum gb_style style;
    GString *line;
};

static void end_row(struct wrapping *wrapping)
{
    if (wrapping->line->len > 0 && wrapping->used < wrapping->rows) {
        wrap_row(wrapping->paint,
                 wrapping->row < 0 ? wrapping->row : wrapping->row + wrapping->used,
                 wrapping->style, wrapping->line->str);
        wrapping->used++;
    }
    g_string_truncate(wrapping->line, 0);
}

/* A word longer than a row, such as a path, continues in the next one; returns its
 * rest. */
static const char *break_word(struct wrapping *wrapping, const char *word, int room)
{
    while (gb_paint_width(word) > room && wrapping->used < wrapping->rows - 1) {
        for (int width = 0; width + gb_paint_char_width(g_utf8_get_char(word)) <= room;) {
            width += gb_paint_char_width(g_utf8_get_char(word));
            g_string_append_unichar(wrapping->line, g_utf8_get_char(word));
            word = g_utf8_next_char(word);
        }
        end_row(wrapping);
    }
    return word;
}

/* The last row takes the rest of the text and ends with an ellipsis if it does not
 * fit. */
static void add_word(struct wrapping *wrapping, const char *word, int room)
{
    GString *line = wrapping->line;
    const int width = gb_paint_width(line->str) + 1 + gb_paint_width(word);
    if (line->len > 0 && width > room && wrapping->used < wrapping->rows - 1) {
        end_row(wrapping);
    }
    if (line->len == 0) {
        word = break_word(wrapping, word, room);
    }
    g_string_append_printf(line, "%s%s", line->len > 0 ? " " : "", word);
}

/* Whether a word is a unit, maybe before a comma or the like. */
static bool is_unit(const char *word)
{
    const size_t length = strcspn(word, ".,;:)");
    char *quantity = g_strdup_printf("1 %.*s", (int)length, word);
    bool unit = false;
    for (int d = 0; d <= GB_DIM_COMPLIANCE && length > 0 && !unit; d++) {
        double value;
        unit = gb_units_parse(quantity, (enum gb_dimension)d, &value, NULL);
    }
    g_free(quantity);
    return unit;
}

/* Joins each number and the unit behind it: a row does not part them. */
static void join_units(char **words)
{
    size_t last = 0;
    if (words[0] == NULL) {
        return;
    }
    for (size_t i = 1; words[i] != NULL; i++) {
        const size_t length = strlen(words[last]);
        if (length > 0 && g_ascii_isdigit(words[last][length - 1]) && is_unit(words[i])) {
            char *both = g_strconcat(words[last], " ", words[i], NULL);
            g_free(words[last]);
            g_free(words[i]);
            words[last] = both;
        } else {
            words[++last] = words[i];
        }
    }
    words[last + 1] = NULL;
}

static int wrap(const struct gb_paint *paint, int row, int rows, enum gb_style style,
                const char *text)
{
    struct wrapping wrapping = {paint, row, rows, 0, style, g_string_new(NULL)};
    char *valid = g_utf8_make_valid(text, -1);
    char **words = g_strsplit(valid, " ", -1);
    join_units(words);
    const int room = paint->rect.cols > 4 ? paint->rect.cols - 2 : 2;
    for (int i = 0; words[i] != NULL && wrapping.used < rows; i++) {
        add_word(&wrapping, words[i], room);
    }
    end_row(&wrapping);
    g_string_free(wrapping.line, TRUE);
    g_strfreev(words);
    g_free(valid);
    return wrapping.used;
}

int gb_paint_wrap(const struct gb_paint *paint, int row, int rows, enum gb_style style,
                  const char *text)
{
    return wrap(paint, row, rows, style, text);
}

int gb_paint_wrap_rows(const struct gb_paint *paint, int rows, const char *text)
{
    return wrap(paint, -1, rows, GB_STYLE_PLAIN, text);
}
