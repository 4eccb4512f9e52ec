#include "tui/term/paint.h"

#include <glib.h>
#include <math.h>
#include <ncurses.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "base/units.h"

/* Drawing into a rectangle of cells: texts cut to the room, wrapped texts, plots,
 * boxes. */

/* Cutting texts to the available width.  A cut text ends with an ellipsis and never
 * with a part of a number ("mu 0.15" gives "mu ..." and not "mu 0.1...") or of its
 * unit.  Only a text that consists of one number is cut within its decimals. */

#define ELLIPSIS "\u2026"

/* Decimals that remain of a number at least, if nothing else of a text fits. */
enum { DECIMALS_MIN = 2 };

static bool is_exponent_mark(const char *text, const char *at)
{
    return (*at == 'e' || *at == 'E') && at > text && g_ascii_isdigit(at[-1]);
}

/* Is the character part of a number: a digit, a decimal point between digits, an
 * exponent with its sign? */
static bool is_of_number(const char *text, const char *at)
{
    return g_ascii_isdigit(*at) || *at == '.' || is_exponent_mark(text, at) ||
           ((*at == '-' || *at == '+') && at > text && is_exponent_mark(text, at - 1));
}

static bool has_digit(const char *from, const char *end)
{
    while (from < end && !g_ascii_isdigit(*from)) {
        from++;
    }
    return from < end;
}

/* Is a number at the beginning of a text cut after some of its decimals? */
static bool is_cut_decimal(const char *text, const char *end)
{
    const char *point = memchr(text, '.', (size_t)(end - text));
    for (const char *at = text; is_of_number(text, at); at++) {
        if (is_exponent_mark(text, at)) {
            return false;
        }
    }
    return point != NULL && end - point > DECIMALS_MIN;
}

/* Does a cut at this place remove the end of a word? */
static bool is_in_word(const char *text, const char *end)
{
    return end > text && end[-1] != ' ' && g_ascii_isalpha(*end);
}

/* Moves the end of a cut text before an incomplete unit: "2.9 s" would mean seconds if
 * the text has standard errors. */
static const char *leave_unit(const char *text, const char *end)
{
    const char *from = end;
    if (!is_in_word(text, end)) {
        return end;
    }
    while (from > text && from[-1] != ' ') {
        from--;
    }
    return from - text >= 2 && g_ascii_isdigit(from[-2]) ? from - 1 : end;
}

/* Moves the end of a cut text before the number there. */
static const char *leave_number(const char *text, const char *end)
{
    const char *from = end = leave_unit(text, end);
    while (from > text && is_of_number(text, from - 1)) {
        from--;
    }
    if (!has_digit(from, end) || (from == text && is_cut_decimal(text, end))) {
        return end;
    }
    return from;
}

/* Width of a character in cells: 0, 1 or 2. */
static int paint_char_width(uint32_t ch)
{
    return g_unichar_iszerowidth(ch) ? 0 : g_unichar_iswide(ch) ? 2 : 1;
}

char *gb_paint_fit(const char *text, int cols)
{
    const char *end = text;
    if (gb_paint_width(text) <= cols) {
        return g_strdup(text);
    }
    for (int left = cols - 1; *end != '\0'; end = g_utf8_next_char(end)) {
        left -= paint_char_width(g_utf8_get_char(end));
        if (left < 0) {
            break;
        }
    }
    end = leave_number(text, end);
    return cols > 0 ? g_strdup_printf("%.*s" ELLIPSIS, (int)(end - text), text)
                    : g_strdup("");
}

char *gb_paint_fit_copy(char *to, size_t size, const char *text)
{
    const char *end = text;
    if (strlen(text) < size) {
        g_strlcpy(to, text, size);
        return to;
    }
    while ((size_t)(g_utf8_next_char(end) - text) + sizeof ELLIPSIS <= size) {
        end = g_utf8_next_char(end);
    }
    end = leave_number(text, end);
    g_snprintf(to, (gulong)size, "%.*s" ELLIPSIS, (int)(end - text), text);
    return to;
}

/* Draws one row of wrapped text; row -1: only counts rows. */
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
    int row, rows, used; /* row < 0: only count rows */
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

/* Continues a word longer than a row, such as a path, in the next row; returns the rest
 * of the word. */
static const char *break_word(struct wrapping *wrapping, const char *word, int room)
{
    while (gb_paint_width(word) > room && wrapping->used < wrapping->rows - 1) {
        for (int width = 0; width + paint_char_width(g_utf8_get_char(word)) <= room;) {
            width += paint_char_width(g_utf8_get_char(word));
            g_string_append_unichar(wrapping->line, g_utf8_get_char(word));
            word = g_utf8_next_char(word);
        }
        end_row(wrapping);
    }
    return word;
}

/* Adds a word.  The last row takes the rest of the text and ends with an ellipsis if it
 * does not fit. */
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

/* Is a word a unit, possibly followed by a comma or similar? */
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

/* Joins each number with the unit after it, so that they stay in one row. */
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

/* ASCII replacements for symbols, for terminals without UTF-8. */
static const struct {
    gunichar sign;
    char ascii;
} replacement[] = {
    {0x2500, '-'}, {0x2502, '|'}, {0x250c, '+'}, {0x2510, '+'}, {0x2514, '+'},
    {0x2518, '+'}, {0x252c, '+'}, {0x251c, '+'}, {0x2524, '+'}, {0x2534, '+'},
    {0x2026, '~'}, {0x00b7, '-'}, {0x25b6, '>'}, {0x2016, '='}, {0x2713, '*'},
    {0x25a0, '#'}, {0x2717, '!'}, {0x25cc, 'o'}, {0x2588, '#'}, {0x2591, '.'},
    {0x2022, '*'}, {0x2192, '>'}, {0x00d7, 'x'}, {0x25cf, '*'}, {0x25cb, 'o'},
    {0x2592, ':'}, {0x2593, '*'},
};

static gunichar shown(const struct gb_paint *paint, gunichar ch)
{
    if (ch < 32 || (ch >= 127 && ch < 160)) {
        return '?';
    }
    if (ch < 127 || gb_term_utf8(paint->term)) {
        return ch;
    }
    for (size_t i = 0; i < G_N_ELEMENTS(replacement); i++) {
        if (replacement[i].sign == ch) {
            return (gunichar)replacement[i].ascii;
        }
    }
    return '?';
}

int gb_paint_width(const char *text)
{
    int width = 0;
    for (const char *at = text; *at != '\0'; at = g_utf8_next_char(at)) {
        width += paint_char_width(g_utf8_get_char(at));
    }
    return width;
}

struct gb_paint gb_paint_at(const struct gb_term *term, struct gb_rect rect)
{
    return (struct gb_paint){term, rect};
}

static void put(const struct gb_paint *paint, int row, int col, gunichar ch)
{
    char utf8[8] = {0};
    g_unichar_to_utf8(shown(paint, ch), utf8);
    mvaddstr(paint->rect.row + row, paint->rect.col + col, utf8);
}

static void pen(const struct gb_paint *paint, enum gb_style style)
{
    attrset((int)gb_term_attributes(paint->term, style));
}

static bool inside(const struct gb_paint *paint, int row)
{
    return row >= 0 && row < paint->rect.rows;
}

int gb_paint_text(const struct gb_paint *paint, int row, int col, enum gb_style style,
                  const char *text)
{
    char *valid = g_utf8_make_valid(text, -1);
    if (col >= 0 && gb_paint_width(valid) > paint->rect.cols - col) {
        char *whole = valid;
        valid = gb_paint_fit(whole, paint->rect.cols - col);
        g_free(whole);
    }
    pen(paint, style);
    for (const char *at = valid; *at != '\0'; at = g_utf8_next_char(at)) {
        const gunichar ch = g_utf8_get_char(at);
        const int width = paint_char_width(ch);
        if (inside(paint, row) && col >= 0 && width > 0 &&
            col + width <= paint->rect.cols) {
            put(paint, row, col, ch);
        }
        col += width;
    }
    attrset(A_NORMAL);
    g_free(valid);
    return col;
}

int gb_paint_format(const struct gb_paint *paint, int row, int col, enum gb_style style,
                    const char *format, ...)
{
    char text[512];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    return gb_paint_text(paint, row, col, style, text);
}

int gb_paint_cell(const struct gb_paint *paint, int row, int col, int cols,
                  enum gb_style style, const char *text)
{
    char *valid = g_utf8_make_valid(text, -1);
    char *fitted = gb_paint_fit(valid, cols);
    char *padded =
        g_strdup_printf("%s%*s", fitted, MAX(cols - gb_paint_width(fitted), 0), "");
    col = gb_paint_text(paint, row, col, style, padded);
    g_free(padded);
    g_free(fitted);
    g_free(valid);
    return col;
}

static void line_row(const struct gb_paint *paint, int row)
{
    pen(paint, GB_STYLE_DIM);
    for (int col = 0; inside(paint, row) && col < paint->rect.cols; col++) {
        put(paint, row, col, 0x2500);
    }
    attrset(A_NORMAL);
}

void gb_paint_title(const struct gb_paint *paint, const char *title,
                    enum gb_paint_focus focus)
{
    char text[256];
    snprintf(text, sizeof text, " %s ", title);
    line_row(paint, 0);
    const int max = paint->rect.cols - 3;
    const int width = gb_paint_width(text);
    gb_paint_cell(paint, 0, 2, width < max ? width : max,
                  focus == GB_PAINT_FOCUSED ? GB_STYLE_FOCUS : GB_STYLE_TITLE, text);
}

void gb_paint_bar(const struct gb_paint *paint, int row, int col, int cols, double share)
{
    const double clean = share > 0.0 ? fmin(share, 1.0) : 0.0;
    const int full = (int)floor(clean * cols + 0.5);
    for (int i = 0; i < cols && inside(paint, row); i++) {
        if (col + i < paint->rect.cols) {
            pen(paint, i < full ? GB_STYLE_SERIES : GB_STYLE_DIM);
            put(paint, row, col + i, i < full ? 0x2588 : 0x2591);
        }
    }
    attrset(A_NORMAL);
}

void gb_paint_column(const struct gb_paint *paint, int col, int from, int to)
{
    pen(paint, GB_STYLE_DIM);
    for (int row = from; row <= to; row++) {
        if (inside(paint, row) && col >= 0 && col < paint->rect.cols) {
            put(paint, row, col, 0x2502);
        }
    }
    attrset(A_NORMAL);
}

void gb_paint_box(const struct gb_paint *paint, const char *title)
{
    const int rows = paint->rect.rows;
    const int cols = paint->rect.cols;
    for (int row = 1; row < rows - 1; row++) {
        gb_paint_cell(paint, row, 0, cols, GB_STYLE_PLAIN, "");
    }
    line_row(paint, rows - 1);
    gb_paint_title(paint, title, GB_PAINT_FOCUSED);
    gb_paint_column(paint, 0, 1, rows - 2);
    gb_paint_column(paint, cols - 1, 1, rows - 2);
    pen(paint, GB_STYLE_DIM);
    put(paint, 0, 0, 0x250c);
    put(paint, 0, cols - 1, 0x2510);
    put(paint, rows - 1, 0, 0x2514);
    put(paint, rows - 1, cols - 1, 0x2518);
    attrset(A_NORMAL);
}

static enum gb_style ink_style(int ink)
{
    switch (ink) {
    case GB_PLOT_INK_NONE:
    case GB_PLOT_INK_TEXT:
        return GB_STYLE_PLAIN;
    case GB_PLOT_INK_AXIS:
    case GB_PLOT_INK_DIM:
        return GB_STYLE_DIM;
    case GB_PLOT_INK_CURSOR:
        return GB_STYLE_WARN;
    default:
        return (enum gb_style)(GB_STYLE_SERIES +
                               (ink - GB_PLOT_INK_SERIES) % GB_PLOT_COLOURS);
    }
}

static void cell_pen(const struct gb_paint *paint, const struct gb_plot_cell *cell)
{
    if (cell->ink >= GB_PLOT_INK_SHADE) {
        attrset((int)gb_term_shade(paint->term, cell->ink - GB_PLOT_INK_SHADE,
                                   cell->back - 1));
    } else {
        pen(paint, ink_style(cell->ink));
    }
}

void gb_paint_plot(const struct gb_paint *paint, int row, int col,
                   const struct gb_plot *plot)
{
    for (int r = 0; r < plot->rows; r++) {
        for (int c = 0; c < plot->cols; c++) {
            const struct gb_plot_cell *cell = &plot->cell[r * plot->cols + c];
            if (cell->ch != ' ' && inside(paint, row + r) && col + c < paint->rect.cols) {
                cell_pen(paint, cell);
                put(paint, row + r, col + c, cell->ch);
            }
        }
    }
    attrset(A_NORMAL);
}

char *gb_paint_time(double seconds, char *buffer, size_t size)
{
    if (!(seconds >= 0.0 && seconds < 3.6e9)) {
        snprintf(buffer, size, "--:--");
        return buffer;
    }
    const long all = (long)seconds;
    if (all >= 3600) {
        snprintf(buffer, size, "%ld:%02ld:%02ld", all / 3600, all / 60 % 60, all % 60);
    } else {
        snprintf(buffer, size, "%ld:%02ld", all / 60, all % 60);
    }
    return buffer;
}
