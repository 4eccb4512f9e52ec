#include "tui/plot/plot.h"

#include <glib.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "tui/plot/plot_raster.h"
#include "tui/term/text_fit.h"

enum { TICK_COLS = 9, TICKS_MAX = 12 };

static const uint32_t wide_marks[] = {' ',    0x25cf, 0x25cb, 0x25c6, 0x25c7,
                                      0x25b2, 0x25b3, 0x25a0, 0x25a1};
static const uint32_t ascii_marks[] = {' ', '*', 'o', '#', '+', '^', 'v', '@', 'x'};

enum { MARKS = sizeof wide_marks / sizeof wide_marks[0] };

void gb_plot_init(struct gb_plot *plot)
{
    memset(plot, 0, sizeof *plot);
}

void gb_plot_finish(struct gb_plot *plot)
{
    gb_alloc_free(plot->cell);
    gb_alloc_free(plot->dots);
    gb_plot_init(plot);
}

static bool reserve(struct gb_plot *plot, size_t cells, struct gb_error *err)
{
    if (cells <= plot->capacity) {
        return true;
    }
    struct gb_plot_cell *cell = gb_alloc_array(cells, sizeof *cell, err);
    uint8_t *dots = cell == NULL ? NULL : gb_alloc_array(cells, 1, err);
    if (dots == NULL) {
        gb_alloc_free(cell);
        return false;
    }
    gb_plot_finish(plot);
    plot->cell = cell;
    plot->dots = dots;
    plot->capacity = cells;
    return true;
}

bool gb_plot_resize(struct gb_plot *plot, int rows, int cols, enum gb_plot_glyphs glyphs,
                    struct gb_error *err)
{
    const size_t cells = rows > 0 && cols > 0 ? (size_t)rows * (size_t)cols : 0;
    if (!reserve(plot, cells, err)) {
        return false;
    }
    plot->rows = cells > 0 ? rows : 0;
    plot->cols = cells > 0 ? cols : 0;
    plot->glyphs = glyphs;
    plot->log_x = false;
    plot->exact_x = plot->exact_y = false;
    plot->foot = 0;
    for (size_t i = 0; i < cells; i++) {
        plot->cell[i] = (struct gb_plot_cell){.ch = ' ', .ink = GB_PLOT_INK_NONE};
        plot->dots[i] = 0;
    }
    plot->top = 0;
    plot->left = 0;
    plot->field_rows = plot->rows;
    plot->field_cols = plot->cols;
    return true;
}

void gb_plot_put(struct gb_plot *plot, int row, int col, uint32_t ch, int ink)
{
    if (row >= 0 && row < plot->rows && col >= 0 && col < plot->cols) {
        plot->cell[row * plot->cols + col] =
            (struct gb_plot_cell){.ch = ch, .ink = ink, .fixed = true};
    }
}

void gb_plot_text(struct gb_plot *plot, int row, int col, int ink, const char *text)
{
    char *fitted = gb_text_fit(text, MAX(plot->cols - col, 0));
    for (const char *at = fitted; *at != '\0'; at = g_utf8_next_char(at)) {
        gb_plot_put(plot, row, col++, g_utf8_get_char(at), ink);
    }
    g_free(fitted);
}

static uint32_t line_char(const struct gb_plot *plot, uint32_t wide, uint32_t ascii)
{
    return plot->glyphs == GB_PLOT_ASCII ? ascii : wide;
}

/* Row and column of a position in the field, 0..1 along each axis. */
static int field_row(const struct gb_plot *plot, double position)
{
    const int dots = plot->field_rows * gb_plot_raster_dots_y(plot->glyphs);
    return plot->top + (int)floor((1.0 - position) * (dots - 1) + 0.5) /
                           gb_plot_raster_dots_y(plot->glyphs);
}

static int field_col(const struct gb_plot *plot, double position)
{
    const int dots = plot->field_cols * gb_plot_raster_dots_x(plot->glyphs);
    return plot->left +
           (int)floor(position * (dots - 1) + 0.5) / gb_plot_raster_dots_x(plot->glyphs);
}

static void draw_y_axis(struct gb_plot *plot)
{
    const int col = plot->left - 1;
    for (int row = 0; row < plot->field_rows; row++) {
        gb_plot_put(plot, plot->top + row, col, line_char(plot, 0x2502, '|'),
                    GB_PLOT_INK_AXIS);
    }
    int last = plot->rows;
    for (int i = 0; i < plot->y.ticks; i++) {
        const int row = field_row(plot, gb_plot_axis_position(&plot->y, plot->y.tick[i]));
        if (row >= last) {
            continue;
        }
        last = row;
        const int width = (int)strlen(plot->y.text[i]);
        gb_plot_text(plot, row, col - width, GB_PLOT_INK_TEXT, plot->y.text[i]);
        gb_plot_put(plot, row, col, line_char(plot, 0x2524, '+'), GB_PLOT_INK_AXIS);
    }
}

static void draw_x_axis(struct gb_plot *plot)
{
    const int row = plot->top + plot->field_rows;
    gb_plot_put(plot, row, plot->left - 1, line_char(plot, 0x2514, '+'),
                GB_PLOT_INK_AXIS);
    for (int col = 0; col < plot->field_cols; col++) {
        gb_plot_put(plot, row, plot->left + col, line_char(plot, 0x2500, '-'),
                    GB_PLOT_INK_AXIS);
    }
    int free_from = 0;
    for (int i = 0; i < plot->x.ticks; i++) {
        const int col = field_col(plot, gb_plot_axis_position(&plot->x, plot->x.tick[i]));
        const int width = (int)strlen(plot->x.text[i]);
        int from = col - width / 2;
        from = from + width > plot->cols ? plot->cols - width : from;
        if (from < free_from) {
            continue;
        }
        free_from = from + width + 1;
        gb_plot_put(plot, row, col, line_char(plot, 0x252c, '+'), GB_PLOT_INK_AXIS);
        gb_plot_text(plot, row + 1, from, GB_PLOT_INK_TEXT, plot->x.text[i]);
    }
}

static int widest_tick(const struct gb_plot_axis *axis)
{
    int width = 1;
    for (int i = 0; i < axis->ticks; i++) {
        const int length = (int)strlen(axis->text[i]);
        width = length > width ? length : width;
    }
    return width;
}

static int limit(int value, int min, int max)
{
    return value < min ? min : value > max ? max : value;
}

void gb_plot_axes(struct gb_plot *plot, const double x_ends[2], const double y_ends[2],
                  enum gb_plot_scale y_scale, const char *x_label, const char *y_label)
{
    const int rows = plot->rows - 2 - plot->foot;
    gb_plot_axis_fit(&plot->y, y_ends[0], y_ends[1], y_scale == GB_PLOT_LOG,
                     limit(rows / 2 + 1, 2, 10));
    if (plot->exact_y) {
        gb_plot_axis_end(&plot->y, y_ends[0], y_ends[1]);
    }
    const int left = widest_tick(&plot->y) + 1;
    const int cols = plot->cols - left;
    if (rows < 2 || cols < 8) {
        gb_plot_bare(plot, x_ends, y_ends);
        return;
    }
    plot->left = left;
    plot->field_rows = rows;
    plot->field_cols = cols;
    gb_plot_axis_fit(&plot->x, x_ends[0], x_ends[1], plot->log_x,
                     limit(cols / TICK_COLS + 1, 2, TICKS_MAX));
    if (plot->exact_x) {
        gb_plot_axis_end(&plot->x, x_ends[0], x_ends[1]);
    }
    draw_y_axis(plot);
    draw_x_axis(plot);
    gb_plot_text(plot, 0, left + 1, GB_PLOT_INK_TEXT, y_label);
    const int width = (int)g_utf8_strlen(x_label, -1);
    gb_plot_text(plot, rows - 1, plot->cols - width, GB_PLOT_INK_TEXT, x_label);
}

void gb_plot_bare(struct gb_plot *plot, const double x_ends[2], const double y_ends[2])
{
    plot->top = 0;
    plot->left = 0;
    plot->field_rows = plot->rows;
    plot->field_cols = plot->cols;
    plot->x = (struct gb_plot_axis){.low = x_ends[0], .high = x_ends[1]};
    plot->y = (struct gb_plot_axis){.low = y_ends[0], .high = y_ends[1]};
}

uint32_t gb_plot_mark_char(const struct gb_plot *plot, int marker)
{
    if (marker >= MARKS) {
        return (uint32_t)marker; /* a letter */
    }
    return plot->glyphs == GB_PLOT_ASCII ? ascii_marks[marker] : wide_marks[marker];
}

/* Markers do not cover labels of the axes; the line shows the curve there. */
static void put_marker(struct gb_plot *plot, int row, int col, uint32_t ch, int ink)
{
    if (row < 0 || row >= plot->rows || col < 0 || col >= plot->cols) {
        return;
    }
    const struct gb_plot_cell *cell = &plot->cell[row * plot->cols + col];
    const bool text = cell->ink == GB_PLOT_INK_TEXT || cell->ink == GB_PLOT_INK_AXIS;
    if (!cell->fixed || !text) {
        gb_plot_put(plot, row, col, ch, ink);
    }
}

/* Markers at least `spacing` cells apart, and one at the last point. */
static void draw_markers(struct gb_plot *plot, const struct gb_plot_series *series)
{
    const uint32_t ch = gb_plot_mark_char(plot, series->marker);
    int last_row = INT16_MIN;
    int last_col = INT16_MIN;
    int end_row = -1;
    int end_col = -1;
    for (size_t i = 0; i < series->count; i++) {
        const double x = gb_plot_axis_position(&plot->x, series->x[i]);
        const double y = gb_plot_axis_position(&plot->y, series->y[i]);
        if (!(x >= 0.0 && x <= 1.0 && y >= 0.0 && y <= 1.0)) {
            continue;
        }
        end_row = field_row(plot, y);
        end_col = field_col(plot, x);
        const int distance_to = MAX(2 * abs(end_row - last_row), abs(end_col - last_col));
        if (series->points || (series->spacing > 0 && distance_to >= series->spacing)) {
            put_marker(plot, end_row, end_col, ch, series->ink);
            last_row = end_row;
            last_col = end_col;
        }
    }
    if (series->spacing == 0 && end_row >= 0) {
        put_marker(plot, end_row, end_col, ch, series->ink);
    }
}

void gb_plot_line(struct gb_plot *plot, const struct gb_plot_series *series)
{
    if (!series->points) {
        gb_plot_raster_line(plot, series);
    }
    if (series->marker > 0) {
        draw_markers(plot, series);
    }
}

void gb_plot_bar(struct gb_plot *plot, double x_from, double x_to, double y, int ink)
{
    const double from = gb_plot_axis_position(&plot->x, x_from);
    const double to = gb_plot_axis_position(&plot->x, x_to);
    const double top = gb_plot_axis_position(&plot->y, y);
    if (!(from >= 0.0 && to <= 1.0 && from <= to && top > 0.0)) {
        return;
    }
    /* equal widths in cells for equal widths in x, with a gap of one column */
    const int width = MAX((int)floor((to - from) * plot->field_cols) - 1, 1);
    const int col = field_col(plot, from);
    const int end = MIN(col + width, plot->left + plot->field_cols);
    for (int c = col; c < end; c++) {
        gb_plot_raster_column(plot, c, top > 1.0 ? 1.0 : top, ink);
    }
}

/* Blanks of a text are not free. */
static bool is_free(const struct gb_plot *plot, int row, int col)
{
    const struct gb_plot_cell *cell = &plot->cell[row * plot->cols + col];
    return cell->ch == ' ' && !cell->fixed;
}

static bool takes_cursor(const struct gb_plot *plot, int row, int col)
{
    return is_free(plot, row, col) || plot->cell[row * plot->cols + col].tone;
}

void gb_plot_cursor(struct gb_plot *plot, double x, double y)
{
    const double px = gb_plot_axis_position(&plot->x, x);
    const double py = gb_plot_axis_position(&plot->y, y);
    if (!(px >= 0.0 && px <= 1.0 && py >= 0.0 && py <= 1.0)) {
        return;
    }
    const int row = field_row(plot, py);
    const int col = field_col(plot, px);
    for (int r = plot->top; r < plot->top + plot->field_rows; r++) {
        if (takes_cursor(plot, r, col)) {
            gb_plot_put(plot, r, col, line_char(plot, 0x2502, '|'), GB_PLOT_INK_CURSOR);
        }
    }
    for (int c = plot->left; c < plot->left + plot->field_cols; c++) {
        if (takes_cursor(plot, row, c)) {
            gb_plot_put(plot, row, c, line_char(plot, 0x2500, '-'), GB_PLOT_INK_CURSOR);
        }
    }
    gb_plot_put(plot, row, col, line_char(plot, 0x253c, '+'), GB_PLOT_INK_CURSOR);
}

char *gb_plot_dump(const struct gb_plot *plot)
{
    GString *text = g_string_new(NULL);
    for (int row = 0; row < plot->rows; row++) {
        const gsize from = text->len;
        gsize end = from;
        for (int col = 0; col < plot->cols; col++) {
            g_string_append_unichar(text, plot->cell[row * plot->cols + col].ch);
            if (plot->cell[row * plot->cols + col].ch != ' ') {
                end = text->len;
            }
        }
        g_string_truncate(text, end);
        g_string_append_c(text, '\n');
    }
    return g_string_free(text, FALSE);
}
