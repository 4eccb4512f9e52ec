#include "tui/term/paint.h"

#include <glib.h>
#include <math.h>
#include <ncurses.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "tui/term/text_fit.h"

/* ASCII replacements of the symbols of the screen, for terminals without UTF-8. */
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

int gb_paint_char_width(uint32_t ch)
{
    return g_unichar_iszerowidth(ch) ? 0 : g_unichar_iswide(ch) ? 2 : 1;
}

int gb_paint_width(const char *text)
{
    int width = 0;
    for (const char *at = text; *at != '\0'; at = g_utf8_next_char(at)) {
        width += gb_paint_char_width(g_utf8_get_char(at));
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
        valid = gb_text_fit(whole, paint->rect.cols - col);
        g_free(whole);
    }
    pen(paint, style);
    for (const char *at = valid; *at != '\0'; at = g_utf8_next_char(at)) {
        const gunichar ch = g_utf8_get_char(at);
        const int width = gb_paint_char_width(ch);
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
    char *fitted = gb_text_fit(valid, cols);
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
