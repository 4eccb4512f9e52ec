/* Plots in character cells.  A plot is an array of cells with a character and an ink;
 * lines are drawn as dots of a raster with several dots per cell.  The file has the
 * legend, bands, the raster with clipped lines, axes with ticks, and the drawing
 * functions of plot.h. */
#include "tui/panel/plot.h"

#include <glib.h>
#include <limits.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "tui/term/paint.h"

/* A candidate position of the legend. */
struct box {
    int rows, columns; /* of the entries */
    int width;         /* width of an entry */
    int row, col;
    int taken; /* occupied cells below it */
};

static int box_cols(const struct box *box)
{
    return box->columns * box->width + (box->columns - 1) * 2;
}

/* Occupied cells below a box; the count ends at `enough`. */
static int taken(const struct gb_plot *plot, const struct box *box, int enough)
{
    const int cols = box_cols(box);
    int sum = 0;
    for (int r = box->row; r < box->row + box->rows; r++) {
        for (int c = box->col; c < box->col + cols && sum < enough; c++) {
            sum += plot->cell[r * plot->cols + c].ch != ' ';
        }
    }
    return sum;
}

/* Moves the box to a position if it covers fewer cells there. */
static void try_position(const struct gb_plot *plot, struct box *box, int row, int col)
{
    struct box there = *box;
    there.row = row;
    there.col = col;
    there.taken = taken(plot, &there, box->taken);
    if (there.taken < box->taken) {
        *box = there;
    }
}

/* Finds a position: first the corners top left and bottom right, which curves mostly
 * leave free, then all positions. */
static void find_position(const struct gb_plot *plot, struct box *box)
{
    const int bottom = plot->top + plot->field_rows - 1 - box->rows;
    const int right = plot->left + plot->field_cols - box_cols(box);
    box->taken = INT_MAX;
    try_position(plot, box, plot->top + 1, plot->left + 1);
    try_position(plot, box, bottom, right);
    for (int row = plot->top + 1; row <= bottom; row++) {
        for (int col = plot->left + 1; col <= right && box->taken > 0; col++) {
            try_position(plot, box, row, col);
        }
    }
}

/* Finds a box in one to three columns that covers nothing; false: none. */
static bool find_free(const struct gb_plot *plot, struct box *box, int entries)
{
    for (box->columns = 1; box->columns <= 3; box->columns++) {
        box->rows = (entries + box->columns - 1) / box->columns;
        if (box->rows > plot->field_rows - 2 || box_cols(box) > plot->field_cols - 1) {
            continue;
        }
        find_position(plot, box);
        if (box->taken == 0) {
            return true;
        }
    }
    return false;
}

/* Number of columns of entries in the foot. */
static int foot_columns(const struct gb_plot *plot, int width)
{
    return MAX(1, (plot->cols + 2) / (width + 2));
}

/* Places the entries: in the foot if there is one, in a free area, or in the box that
 * covers least.  Returns the number of entries that fit. */
static int arrange(const struct gb_plot *plot, struct box *box, int count)
{
    if (plot->foot > 0) {
        box->rows = plot->foot;
        box->row = plot->rows - plot->foot;
        box->columns = foot_columns(plot, box->width);
        return MIN(count, box->rows * box->columns);
    }
    if (!find_free(plot, box, count)) {
        box->columns = 1;
        box->rows = MIN(count, plot->field_rows - 2);
        find_position(plot, box);
    }
    return MIN(count, box->rows * box->columns);
}

static void write_entry(struct gb_plot *plot, int row, int col, int width,
                        const struct gb_plot_entry *entry)
{
    char *name = gb_paint_fit(entry->name, width - 2);
    gb_plot_put(plot, row, col,
                entry->marker ? gb_plot_mark_char(plot, entry->marker) : ' ', entry->ink);
    gb_plot_put(plot, row, col + 1, ' ', GB_PLOT_INK_NONE);
    gb_plot_text(plot, row, col + 2, entry->ink, name);
    g_free(name);
}

static int entry_width(const struct gb_plot *plot, const struct gb_plot_entry *entry,
                       int count)
{
    int width = 0;
    for (int i = 0; i < count; i++) {
        width = MAX(width, 2 + (int)g_utf8_strlen(entry[i].name, -1));
    }
    return MIN(width, plot->field_cols - 2);
}

int gb_plot_legend_foot(const struct gb_plot *plot, const struct gb_plot_entry *entry,
                        int count)
{
    const int columns = foot_columns(plot, entry_width(plot, entry, count));
    return MIN((count + columns - 1) / columns, plot->rows / 3);
}

bool gb_plot_legend(struct gb_plot *plot, const struct gb_plot_entry *entry, int count)
{
    struct box box = {.width = entry_width(plot, entry, count)};
    if (count <= 0 || plot->field_rows < 5 || box.width < 4) {
        return count <= 0;
    }
    const int shown = arrange(plot, &box, count);
    for (int i = 0; i < shown; i++) {
        struct gb_plot_entry more = {.ink = GB_PLOT_INK_DIM};
        snprintf(more.name, sizeof more.name, "and %d more", count - shown + 1);
        const bool whole = i + 1 < shown || shown == count;
        write_entry(plot, box.row + i % box.rows,
                    box.col + i / box.rows * (box.width + 2), box.width,
                    whole ? &entry[i] : &more);
    }
    return shown == count && box.taken == 0;
}

/* A corner of the band, in dots from the top left corner of the field. */
struct corner {
    double x, y;
};

/* Sign of the side of the line a-b on which a point lies. */
static double side_of(const struct corner *a, const struct corner *b, double x, double y)
{
    return (b->x - a->x) * (y - a->y) - (b->y - a->y) * (x - a->x);
}

static bool in_triangle(const struct corner *a, const struct corner *b,
                        const struct corner *c, double x, double y)
{
    const double s[3] = {side_of(a, b, x, y), side_of(b, c, x, y), side_of(c, a, x, y)};
    return (s[0] >= 0.0 && s[1] >= 0.0 && s[2] >= 0.0) ||
           (s[0] <= 0.0 && s[1] <= 0.0 && s[2] <= 0.0);
}

/* Number of dots per cell. */
static int plot_raster_dots_x(enum gb_plot_glyphs glyphs)
{
    return glyphs == GB_PLOT_BRAILLE ? 2 : 1;
}

static int plot_raster_dots_y(enum gb_plot_glyphs glyphs)
{
    return glyphs == GB_PLOT_BRAILLE ? 4 : 2;
}

static bool find_corner(const struct gb_plot *plot, double x, double y,
                        struct corner *corner)
{
    const double px = gb_plot_axis_position(&plot->x, x);
    const double py = gb_plot_axis_position(&plot->y, y);
    corner->x = px * (plot->field_cols * plot_raster_dots_x(plot->glyphs) - 1);
    corner->y = (1.0 - py) * (plot->field_rows * plot_raster_dots_y(plot->glyphs) - 1);
    return isfinite(corner->x) && isfinite(corner->y);
}

/* Bounds of four corners within 0..last. */
static void find_range(const struct corner corner[4], double last_x, double last_y,
                       int low[2], int high[2])
{
    double least[2] = {last_x, last_y}, most[2] = {0.0, 0.0};
    for (int k = 0; k < 4; k++) {
        least[0] = fmin(least[0], corner[k].x);
        least[1] = fmin(least[1], corner[k].y);
        most[0] = fmax(most[0], corner[k].x);
        most[1] = fmax(most[1], corner[k].y);
    }
    for (int k = 0; k < 2; k++) {
        low[k] = (int)ceil(fmax(least[k], 0.0));
        high[k] = (int)floor(fmin(most[k], k == 0 ? last_x : last_y));
    }
}

/* Character of the dots of a cell.  Bit y * 2 + x in braille, bit y otherwise. */
static uint32_t glyph(enum gb_plot_glyphs glyphs, unsigned bits)
{
    static const uint32_t block[] = {' ', 0x2580, 0x2584, 0x2588};
    static const uint32_t ascii[] = {' ', '\'', '.', ':'};
    /* Unicode numbers the dots of the left column, then of the right one, then the last
     * row */
    static const unsigned braille[8] = {0x01, 0x08, 0x02, 0x10, 0x04, 0x20, 0x40, 0x80};
    if (glyphs != GB_PLOT_BRAILLE) {
        return glyphs == GB_PLOT_BLOCK ? block[bits & 3] : ascii[bits & 3];
    }
    unsigned code = 0;
    for (unsigned i = 0; i < 8; i++) {
        code |= (bits >> i & 1) ? braille[i] : 0;
    }
    return 0x2800 + code;
}

/* Does a dot belong to the tone of a band? */
static bool is_of_tone(enum gb_plot_glyphs glyphs, int x, int y)
{
    switch (glyphs) {
    case GB_PLOT_BRAILLE:
        return y % 2 == 0 && x % 2 == y / 2 % 2;
    case GB_PLOT_BLOCK:
        return y % 2 == 0;
    default:
        return y % 2 == 1 && (x + y / 2) % 2 == 0;
    }
}

/* Sets a dot, counted from the top left corner of the field, if it belongs to the even
 * tone of a band: one dot of four in braille, a light shade per cell in blocks, and a
 * dot in every second cell in ASCII.  Cells with a line or a text do not change. */
static void plot_raster_tone(struct gb_plot *plot, int x, int y, int ink)
{
    static const uint32_t light_shade = 0x2591;
    const int nx = plot_raster_dots_x(plot->glyphs);
    const int ny = plot_raster_dots_y(plot->glyphs);
    const int at = (plot->top + y / ny) * plot->cols + plot->left + x / nx;
    struct gb_plot_cell *cell = &plot->cell[at];
    if (!is_of_tone(plot->glyphs, x, y) || cell->fixed ||
        (plot->dots[at] != 0 && !cell->tone)) {
        return;
    }
    plot->dots[at] = (uint8_t)(plot->dots[at] | 1u << (y % ny * nx + x % nx));
    cell->ch =
        plot->glyphs == GB_PLOT_BLOCK ? light_shade : glyph(plot->glyphs, plot->dots[at]);
    cell->ink = ink;
    cell->tone = true;
}

/* Fills the band between two of its points. */
static void fill(struct gb_plot *plot, const struct corner corner[4], int ink)
{
    const int last_x = plot->field_cols * plot_raster_dots_x(plot->glyphs) - 1;
    const int last_y = plot->field_rows * plot_raster_dots_y(plot->glyphs) - 1;
    int low[2], high[2];
    find_range(corner, last_x, last_y, low, high);
    for (int y = low[1]; y <= high[1]; y++) {
        for (int x = low[0]; x <= high[0]; x++) {
            if (in_triangle(&corner[0], &corner[1], &corner[2], x, y) ||
                in_triangle(&corner[1], &corner[2], &corner[3], x, y)) {
                plot_raster_tone(plot, x, y, ink);
            }
        }
    }
}

void gb_plot_band(struct gb_plot *plot, const struct gb_plot_band *band)
{
    struct corner corner[4] = {{0.0, 0.0}};
    bool before = false;
    if (plot->field_rows <= 0 || plot->field_cols <= 0) {
        return;
    }
    for (size_t i = 0; i < band->count; i++) {
        const bool good = find_corner(plot, band->x[0][i], band->y[0][i], &corner[2]) &&
                          find_corner(plot, band->x[1][i], band->y[1][i], &corner[3]);
        if (before && good) {
            fill(plot, corner, band->ink);
        }
        corner[0] = corner[2];
        corner[1] = corner[3];
        before = good;
    }
}

/* The raster: dots of the field and their characters. */

/* Sets a dot of the field, counted from its top left corner. */
static void dot(struct gb_plot *plot, int x, int y, int ink)
{
    const int nx = plot_raster_dots_x(plot->glyphs);
    const int ny = plot_raster_dots_y(plot->glyphs);
    const int at = (plot->top + y / ny) * plot->cols + plot->left + x / nx;
    struct gb_plot_cell *cell = &plot->cell[at];
    if (cell->tone) {
        cell->tone = false;
        plot->dots[at] = 0;
    }
    plot->dots[at] = (uint8_t)(plot->dots[at] | 1u << (y % ny * nx + x % nx));
    if (!cell->fixed) {
        cell->ch = glyph(plot->glyphs, plot->dots[at]);
        cell->ink = ink;
    }
}

/* One side of Liang and Barsky's clipping: keeps t in [*from, *to] where p t <= q. */
static bool clip_side(double p, double q, double *from, double *to)
{
    if (p == 0.0) {
        return q >= 0.0;
    }
    const double t = q / p;
    if (p < 0.0) {
        *from = t > *from ? t : *from;
    } else {
        *to = t < *to ? t : *to;
    }
    return *from <= *to;
}

/* Cuts the segment a-b to the unit square; false when nothing is left. */
static bool clip(double a[2], double b[2])
{
    double from = 0.0;
    double to = 1.0;
    const double d[2] = {b[0] - a[0], b[1] - a[1]};
    for (int k = 0; k < 2; k++) {
        if (!clip_side(-d[k], a[k], &from, &to) ||
            !clip_side(d[k], 1.0 - a[k], &from, &to)) {
            return false;
        }
    }
    for (int k = 0; k < 2; k++) {
        b[k] = a[k] + to * d[k];
        a[k] = a[k] + from * d[k];
    }
    return true;
}

static int plot_raster_limit(double value, int max)
{
    return value < 0.0 ? 0 : value > max ? max : (int)value;
}

static void segment(struct gb_plot *plot, const double from[2], const double end[2],
                    int ink)
{
    double a[2] = {from[0], from[1]};
    double b[2] = {end[0], end[1]};
    if (!clip(a, b)) {
        return;
    }
    const int last_x = plot->field_cols * plot_raster_dots_x(plot->glyphs) - 1;
    const int last_y = plot->field_rows * plot_raster_dots_y(plot->glyphs) - 1;
    const double x = a[0] * last_x;
    const double y = (1.0 - a[1]) * last_y;
    const double dx = b[0] * last_x - x;
    const double dy = (1.0 - b[1]) * last_y - y;
    if (!isfinite(x + y + dx + dy)) {
        return; /* the length of the segment overflows */
    }
    const int steps = (int)ceil(fmax(fabs(dx), fabs(dy)));
    for (int i = 0; i <= steps; i++) {
        const double t = steps > 0 ? (double)i / steps : 0.0;
        dot(plot, plot_raster_limit(floor(x + t * dx + 0.5), last_x),
            plot_raster_limit(floor(y + t * dy + 0.5), last_y), ink);
    }
}

/* Line of a series, clipped to the field; NaN interrupts it. */
static void plot_raster_line(struct gb_plot *plot, const struct gb_plot_series *series)
{
    if (plot->field_rows <= 0 || plot->field_cols <= 0) {
        return;
    }
    double before[2] = {NAN, NAN};
    for (size_t i = 0; i < series->count; i++) {
        const double now[2] = {gb_plot_axis_position(&plot->x, series->x[i]),
                               gb_plot_axis_position(&plot->y, series->y[i])};
        if (!isfinite(now[0]) || !isfinite(now[1])) {
            before[0] = NAN;
            continue;
        }
        segment(plot, isnan(before[0]) ? now : before, now, series->ink);
        before[0] = now[0];
        before[1] = now[1];
    }
}

/* Fills a column of the field from the bottom to a fraction of the height. */
static void plot_raster_column(struct gb_plot *plot, int col, double share, int ink)
{
    const double cells = share * plot->field_rows;
    for (int i = 0; i < plot->field_rows; i++) {
        const double part = cells - i;
        const int eighths = part >= 1.0 ? 8 : (int)floor(part * 8.0 + 0.5);
        uint32_t ch = 0x2580 + (uint32_t)eighths;
        if (plot->glyphs == GB_PLOT_ASCII) {
            ch = eighths >= 4 ? '#' : '.';
        } else if (plot->glyphs == GB_PLOT_BLOCK) {
            ch = eighths >= 6 ? 0x2588 : 0x2584;
        }
        if (eighths < 1) {
            return;
        }
        struct gb_plot_cell *cell =
            &plot->cell[(plot->top + plot->field_rows - 1 - i) * plot->cols + col];
        *cell = (struct gb_plot_cell){.ch = ch, .ink = ink, .fixed = true};
    }
}

/* Decades below the largest value on a logarithmic axis if the smallest value is not
 * positive. */
static const double log_decades = 3.0;

/* The smallest number 1, 2 or 5 x 10^k that is at least the step. */
static double nice_step(double step)
{
    const double decade = pow(10.0, floor(log10(step)));
    static const double nice[] = {1.0, 2.0, 5.0, 10.0};
    for (size_t i = 0; i < 4; i++) {
        /* the tolerance accepts 0.2 if 2 x 0.1 is rounded up */
        if (nice[i] * decade >= step * (1.0 - 1e-9)) {
            return nice[i] * decade;
        }
    }
    return 10.0 * decade;
}

/* Writes decimal digits if they are short, otherwise a power of ten. */
static void write_tick(char *text, double value, double step)
{
    const double size = fabs(value);
    int decimals = (int)ceil(-log10(step) - 1e-9);
    decimals = decimals < 0 ? 0 : decimals;
    if (size < 1e-12 * step) {
        snprintf(text, GB_PLOT_TICK_TEXT, "0");
    } else if (size >= 1e5 || decimals > 4) {
        snprintf(text, GB_PLOT_TICK_TEXT, "%.3g", value);
    } else {
        snprintf(text, GB_PLOT_TICK_TEXT, "%.*f", decimals, value);
    }
}

static void add_tick(struct gb_plot_axis *axis, double value, double step)
{
    if (axis->ticks < GB_PLOT_TICKS) {
        axis->tick[axis->ticks] = value;
        write_tick(axis->text[axis->ticks], value, step);
        axis->ticks++;
    }
}

/* Number of multiples of the step between two values. */
static double steps_inside(const struct gb_plot_axis *axis, double step, double *first)
{
    *first = ceil(axis->low / step - 1e-6);
    return floor(axis->high / step + 1e-6) - *first;
}

/* Fits a linear axis.  Its ends are multiples of a fifth of a tick, because whole ticks
 * would leave up to half of a small plot empty.  There are at least two ticks, so that
 * the scale is defined. */
static void fit_linear(struct gb_plot_axis *axis, double low, double high, int max)
{
    double step = nice_step((high - low) / (max > 2 ? max - 1 : 1));
    const double fine = step / 5.0;
    double first = 0.0;
    axis->low = floor(low / fine + 1e-9) * fine;
    axis->high = ceil(high / fine - 1e-9) * fine;
    double count = steps_inside(axis, step, &first);
    if (count < 1.0) {
        step = nice_step(step * 0.4);
        count = steps_inside(axis, step, &first);
    }
    for (double i = 0.0; i <= count; i += 1.0) {
        add_tick(axis, (first + i) * step, step);
    }
}

/* The largest number 1, 2 or 5 x 10^k that is at most the value. */
static double nice_floor(double value)
{
    const double decade = pow(10.0, floor(log10(value) + 1e-9));
    const double mantissa = value / decade * (1.0 + 1e-9);
    return decade * (mantissa >= 5.0 ? 5.0 : mantissa >= 2.0 ? 2.0 : 1.0);
}

static void add_log_tick(struct gb_plot_axis *axis, double value, double decade)
{
    if (value >= axis->low * (1.0 - 1e-9) && value <= axis->high * (1.0 + 1e-9)) {
        add_tick(axis, value, decade);
    }
}

/* Ticks at the decades: every second, third, ... decade if space is short; also at 2
 * and 5 if there are few decades or enough space. */
static void fit_log(struct gb_plot_axis *axis, double low, double high, int max)
{
    axis->low = nice_floor(low);
    axis->high = nice_step(high);
    if (axis->high <= axis->low * (1.0 + 1e-9)) {
        axis->high = nice_step(axis->low * 1.5);
    }
    const double first = floor(log10(axis->low) + 1e-9);
    const double last = ceil(log10(axis->high) - 1e-9);
    const double decades = log10(axis->high / axis->low);
    const bool between = decades < 1.2 || 3.0 * decades + 1.0 <= max;
    const double stride = fmax(ceil((decades + 1.0) / max), 1.0);
    for (double e = first; e <= last + 0.5; e += stride) {
        const double decade = pow(10.0, e);
        add_log_tick(axis, decade, decade);
        if (between) {
            add_log_tick(axis, 2.0 * decade, decade);
            add_log_tick(axis, 5.0 * decade, decade);
        }
    }
}

void gb_plot_axis_fit(struct gb_plot_axis *axis, double low, double high, bool log,
                      int max)
{
    memset(axis, 0, sizeof *axis);
    if (!isfinite(low) || !isfinite(high)) {
        low = 0.0;
        high = 1.0;
    }
    if (low > high) {
        const double swap = low;
        low = high;
        high = swap;
    }
    axis->log = log && high > 0.0;
    if (axis->log) {
        if (low <= 0.0) {
            low = high * pow(10.0, -log_decades);
        }
        fit_log(axis, low, high, max);
        return;
    }
    if (!(high - low > 1e-9 * fmax(fabs(low), fabs(high)))) {
        const double half = high != 0.0 ? 0.1 * fabs(high) : 0.5;
        low -= half;
        high += half;
    }
    fit_linear(axis, low, high, max);
}

/* Ends a fitted axis exactly at these values; a low end without a logarithm is ignored.
 * At least two ticks remain, at the ends if necessary. */
static void plot_axis_end(struct gb_plot_axis *axis, double low, double high)
{
    const struct gb_plot_axis fitted = *axis;
    axis->low = axis->log && low <= 0.0 ? fitted.low : low;
    axis->high = high;
    const double rest = 1e-9 * (axis->high - axis->low);
    axis->ticks = 0;
    for (int i = 0; i < fitted.ticks; i++) {
        if (fitted.tick[i] >= axis->low - rest && fitted.tick[i] <= axis->high + rest) {
            axis->tick[axis->ticks] = fitted.tick[i];
            memcpy(axis->text[axis->ticks++], fitted.text[i], GB_PLOT_TICK_TEXT);
        }
    }
    if (axis->ticks < 2) {
        axis->ticks = 0;
        add_tick(axis, axis->low, (axis->high - axis->low) / 10.0);
        add_tick(axis, axis->high, (axis->high - axis->low) / 10.0);
    }
}

double gb_plot_axis_position(const struct gb_plot_axis *axis, double value)
{
    if (!axis->log) {
        return (value - axis->low) / (axis->high - axis->low);
    }
    if (!(value > 0.0)) {
        return NAN;
    }
    return log10(value / axis->low) / log10(axis->high / axis->low);
}

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
    char *fitted = gb_paint_fit(text, MAX(plot->cols - col, 0));
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
    const int dots = plot->field_rows * plot_raster_dots_y(plot->glyphs);
    return plot->top + (int)floor((1.0 - position) * (dots - 1) + 0.5) /
                           plot_raster_dots_y(plot->glyphs);
}

static int field_col(const struct gb_plot *plot, double position)
{
    const int dots = plot->field_cols * plot_raster_dots_x(plot->glyphs);
    return plot->left +
           (int)floor(position * (dots - 1) + 0.5) / plot_raster_dots_x(plot->glyphs);
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
        plot_axis_end(&plot->y, y_ends[0], y_ends[1]);
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
        plot_axis_end(&plot->x, x_ends[0], x_ends[1]);
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

/* Draws a marker unless it would cover a label of the axes; the line shows the curve
 * there. */
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

/* Draws markers at least `spacing` cells apart, and one at the last point. */
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
        plot_raster_line(plot, series);
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
    /* equal widths in x have equal widths in cells, with a gap of one column */
    const int width = MAX((int)floor((to - from) * plot->field_cols) - 1, 1);
    const int col = field_col(plot, from);
    const int end = MIN(col + width, plot->left + plot->field_cols);
    for (int c = col; c < end; c++) {
        plot_raster_column(plot, c, top > 1.0 ? 1.0 : top, ink);
    }
}

/* Is a cell free?  Blanks within a text are not. */
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
