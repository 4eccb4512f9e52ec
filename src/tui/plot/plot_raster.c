#include "tui/plot/plot_raster.h"

#include <math.h>

int gb_plot_raster_dots_x(enum gb_plot_glyphs glyphs)
{
    return glyphs == GB_PLOT_BRAILLE ? 2 : 1;
}

int gb_plot_raster_dots_y(enum gb_plot_glyphs glyphs)
{
    return glyphs == GB_PLOT_BRAILLE ? 4 : 2;
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

/* Sets a dot of the field, counted from its top left corner. */
static void dot(struct gb_plot *plot, int x, int y, int ink)
{
    const int nx = gb_plot_raster_dots_x(plot->glyphs);
    const int ny = gb_plot_raster_dots_y(plot->glyphs);
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

/* Whether a dot is one of the tone. */
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

void gb_plot_raster_tone(struct gb_plot *plot, int x, int y, int ink)
{
    static const uint32_t light_shade = 0x2591;
    const int nx = gb_plot_raster_dots_x(plot->glyphs);
    const int ny = gb_plot_raster_dots_y(plot->glyphs);
    const int at = (plot->top + y / ny) * plot->cols + plot->left + x / nx;
    struct gb_plot_cell *cell = &plot->cell[at];
    if (!is_of_tone(plot->glyphs, x, y) || cell->fixed ||
        (plot->dots[at] != 0 && !cell->tone)) {
        return;
    }
    plot->dots[at] = (uint8_t)(plot->dots[at] | 1u << (y % ny * nx + x % nx));
    cell->ch = plot->glyphs == GB_PLOT_BLOCK ? light_shade
                                             : glyph(plot->glyphs, plot->dots[at]);
    cell->ink = ink;
    cell->tone = true;
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

static int limit(double value, int max)
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
    const int last_x = plot->field_cols * gb_plot_raster_dots_x(plot->glyphs) - 1;
    const int last_y = plot->field_rows * gb_plot_raster_dots_y(plot->glyphs) - 1;
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
        dot(plot, limit(floor(x + t * dx + 0.5), last_x),
            limit(floor(y + t * dy + 0.5), last_y), ink);
    }
}

void gb_plot_raster_line(struct gb_plot *plot, const struct gb_plot_series *series)
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

void gb_plot_raster_column(struct gb_plot *plot, int col, double share, int ink)
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
