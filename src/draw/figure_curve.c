/* Draws one curve: its markers, its line with band, bars, steps or arrows; and a thinned copy
 * of a curve with more points than a page can show. */
#include "draw/figure_curve.h"

#include <cairo.h>
#include <glib.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "draw/figure.h"

/* Colours and markers of the styles; lengths in points. */

/* Radius of a disc, and of the core of markers that repeat a colour, points. */
static const double marker_radius = 2.6;
static const double core_radius = 1.1;

/* Of a style or of a black one. */
static int number_of(int style)
{
    return style < 0 ? gb_figure_black(style) : style;
}

void gb_figure_curve_colour(int style, double rgb[3])
{
    const uint8_t *from =
        style < 0 ? gb_figure_colours_black : gb_figure_colours[style % GB_FIGURE_STYLES];
    for (int k = 0; k < 3; k++) {
        rgb[k] = from[k] / 255.0;
    }
}

int gb_figure_curve_round(int style)
{
    return number_of(style) / GB_FIGURE_STYLES;
}

int gb_figure_curve_shape(int style)
{
    return number_of(style) % GB_FIGURE_STYLES;
}

static void set_colour(cairo_t *cairo, int style, double alpha)
{
    double rgb[3];
    gb_figure_curve_colour(style, rgb);
    cairo_set_source_rgba(cairo, rgb[0], rgb[1], rgb[2], alpha);
}

static void outline(cairo_t *cairo, int style, const double at[2])
{
    static const int corners[GB_FIGURE_STYLES] = {0, 4, 3, 4, 3, 5};
    /* disc, square, triangle up, diamond, triangle down, pentagon */
    static const double rotation[GB_FIGURE_STYLES] = {0.0, 0.25, 0.5, 0.0, 0.0, 0.5};
    static const double scale[GB_FIGURE_STYLES] = {1.0, 1.2, 1.3, 1.3, 1.3, 1.1};
    const int s = gb_figure_curve_shape(style);
    const double r = marker_radius * scale[s];
    if (corners[s] == 0) {
        cairo_new_sub_path(cairo);
        cairo_arc(cairo, at[0], at[1], r, 0.0, 2.0 * M_PI);
        return;
    }
    for (int k = 0; k < corners[s]; k++) {
        const double angle =
            2.0 * M_PI * (k + (corners[s] == 4 ? 2.0 * rotation[s] : 0.0)) / corners[s] +
            (corners[s] == 4 ? 0.0 : M_PI * (2.0 * rotation[s] + 0.5));
        const double x = at[0] + r * cos(angle);
        const double y = at[1] + r * sin(angle);
        (k == 0 ? cairo_move_to : cairo_line_to)(cairo, x, y);
    }
    cairo_close_path(cairo);
}

enum fill { COLOURED, WHITE };

static void set_fill(cairo_t *cairo, const struct gb_figure_curve *curve, enum fill fill)
{
    if (fill == WHITE) {
        cairo_set_source_rgb(cairo, 1.0, 1.0, 1.0);
    } else {
        set_colour(cairo, curve->style, 1.0);
    }
}

static void draw_marker(cairo_t *cairo, const struct gb_figure_curve *curve,
                        const double at[2])
{
    outline(cairo, curve->style, at);
    set_fill(cairo, curve, curve->open ? WHITE : COLOURED);
    cairo_fill_preserve(cairo);
    set_colour(cairo, curve->style, 1.0);
    cairo_set_line_width(cairo, 0.9);
    cairo_stroke(cairo);
    if (gb_figure_curve_round(curve->style) > 0) {
        cairo_arc(cairo, at[0], at[1], core_radius, 0.0, 2.0 * M_PI);
        set_fill(cairo, curve, curve->open ? COLOURED : WHITE);
        cairo_fill(cairo);
    }
}

/* Dashes in points, ended by 0. */
static const double dashes[GB_FIGURE_STYLES][7] = {
    {0},          {6, 2.4, 0},
    {1.4, 2, 0},  {7, 2, 1.4, 2, 0},
    {11, 2.6, 0}, {7, 2, 1.4, 2, 1.4, 2, 0},
};

static const double line_width = 1.35;
static const double faint_width = 0.45;
static const double bar_width = 0.75;
static const double arrow_width = 1.0;
static const double arrow_head[2] = {6.0, 2.1}; /* length and half width */
static const double marker_distance = 46.0;

static void set_pen(cairo_t *cairo, const struct gb_figure_curve *curve)
{
    const double *dash = dashes[(gb_figure_curve_shape(curve->style) +
                                 gb_figure_curve_round(curve->style)) %
                                GB_FIGURE_STYLES];
    const bool faint = curve->kind == GB_FIGURE_FAINT;
    const bool dashed = curve->kind == GB_FIGURE_LINE || curve->kind == GB_FIGURE_BOTH;
    int count = 0;
    while (dash[count] > 0.0) {
        count++;
    }
    cairo_set_dash(cairo, dash, dashed ? count : 0, 0.0);
    cairo_set_line_width(cairo, faint ? faint_width : line_width);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    set_colour(cairo, curve->style, faint ? 0.45 : 1.0);
}

static bool fits(const struct gb_figure_axis_scale *scale, double value)
{
    return isfinite(value) && (!scale->log || value > 0.0);
}

bool gb_figure_curve_position(const struct gb_figure_layout *layout,
                              const struct gb_figure_curve *curve, size_t k, double at[2])
{
    if (!fits(&layout->x, curve->x[k]) || !fits(&layout->y, curve->y[k])) {
        return false;
    }
    at[0] = gb_figure_axis_position(&layout->x, curve->x[k]);
    at[1] = gb_figure_axis_position(&layout->y, curve->y[k]);
    return true;
}

/* Position of y + side * error, limited to the page. */
static double edge(const struct gb_figure_layout *layout,
                   const struct gb_figure_curve *curve, size_t k, double side)
{
    const double value = curve->y[k] + side * curve->error[k];
    const double outside = layout->frame[3] + 50.0;
    return fits(&layout->y, value) ? gb_figure_axis_position(&layout->y, value) : outside;
}

/* Fills the band of the points [from, to), which have no gap. */
static void fill_band(cairo_t *cairo, const struct gb_figure_layout *layout,
                      const struct gb_figure_curve *curve, size_t from, size_t to)
{
    for (size_t k = from; k < to; k++) {
        cairo_line_to(cairo, gb_figure_axis_position(&layout->x, curve->x[k]),
                      edge(layout, curve, k, 1.0));
    }
    for (size_t k = to; k > from; k--) {
        cairo_line_to(cairo, gb_figure_axis_position(&layout->x, curve->x[k - 1]),
                      edge(layout, curve, k - 1, -1.0));
    }
    cairo_close_path(cairo);
    cairo_fill(cairo);
}

static void draw_band(cairo_t *cairo, const struct gb_figure_layout *layout,
                      const struct gb_figure_curve *curve)
{
    size_t from = 0;
    set_colour(cairo, curve->style, 0.2);
    for (size_t k = 0; k <= curve->count; k++) {
        double at[2];
        const bool valid = k < curve->count &&
                           gb_figure_curve_position(layout, curve, k, at) &&
                           isfinite(curve->error[k]);
        if (!valid) {
            if (k > from + 1) {
                fill_band(cairo, layout, curve, from, k);
            }
            from = k + 1;
        }
    }
}

static void draw_line(cairo_t *cairo, const struct gb_figure_layout *layout,
                      const struct gb_figure_curve *curve)
{
    bool pen_down = false;
    set_pen(cairo, curve);
    for (size_t k = 0; k < curve->count; k++) {
        double at[2];
        if (!gb_figure_curve_position(layout, curve, k, at)) {
            pen_down = false;
        } else if (pen_down) {
            cairo_line_to(cairo, at[0], at[1]);
        } else {
            cairo_move_to(cairo, at[0], at[1]);
            pen_down = true;
        }
    }
    cairo_stroke(cairo);
    cairo_set_dash(cairo, NULL, 0, 0.0);
}

static void draw_steps(cairo_t *cairo, const struct gb_figure_layout *layout,
                       const struct gb_figure_curve *curve)
{
    const double floor_at = layout->y.from;
    bool started = false;
    double last[2] = {0.0, 0.0};
    for (size_t k = 0; k < curve->count; k++) {
        double at[2];
        if (!gb_figure_curve_position(layout, curve, k, at)) {
            continue;
        }
        if (!started) {
            cairo_move_to(cairo, at[0], floor_at);
        } else {
            cairo_line_to(cairo, at[0], last[1]);
        }
        cairo_line_to(cairo, at[0], at[1]);
        started = true;
        last[0] = at[0];
        last[1] = at[1];
    }
    cairo_line_to(cairo, last[0], floor_at);
    set_colour(cairo, curve->style, 0.16);
    cairo_fill_preserve(cairo);
    set_pen(cairo, curve);
    cairo_set_line_width(cairo, 0.6 * line_width);
    cairo_stroke(cairo);
}

/* Curves that repeat a colour have markers at equal distances. */
static void draw_line_markers(cairo_t *cairo, const struct gb_figure_layout *layout,
                              const struct gb_figure_curve *curve)
{
    double next = marker_distance *
                  (0.3 + 0.6 * gb_figure_curve_shape(curve->style) / GB_FIGURE_STYLES);
    double last[2] = {NAN, NAN};
    for (size_t k = 0; k < curve->count; k++) {
        double at[2];
        if (!gb_figure_curve_position(layout, curve, k, at)) {
            last[0] = NAN;
            continue;
        }
        next -= isfinite(last[0]) ? hypot(at[0] - last[0], at[1] - last[1]) : 0.0;
        if (next <= 0.0) {
            draw_marker(cairo, curve, at);
            next = marker_distance;
        }
        last[0] = at[0];
        last[1] = at[1];
    }
}

static void bar(cairo_t *cairo, const double a[2], const double b[2])
{
    const bool vertical = a[0] == b[0];
    const double cap = 0.7 * marker_radius;
    cairo_move_to(cairo, a[0], a[1]);
    cairo_line_to(cairo, b[0], b[1]);
    for (int end = 0; end < 2; end++) {
        const double *p = end == 0 ? a : b;
        cairo_move_to(cairo, p[0] - (vertical ? cap : 0.0),
                      p[1] - (vertical ? 0.0 : cap));
        cairo_line_to(cairo, p[0] + (vertical ? cap : 0.0),
                      p[1] + (vertical ? 0.0 : cap));
    }
    cairo_stroke(cairo);
}

static void draw_bars(cairo_t *cairo, const struct gb_figure_layout *layout,
                      const struct gb_figure_curve *curve, size_t k, const double at[2])
{
    set_colour(cairo, curve->style, 1.0);
    cairo_set_line_width(cairo, bar_width);
    if (curve->error != NULL && curve->error[k] > 0.0) {
        bar(cairo, (double[2]){at[0], edge(layout, curve, k, -1.0)},
            (double[2]){at[0], edge(layout, curve, k, 1.0)});
    }
    if (curve->x_error != NULL && curve->x_error[k] > 0.0) {
        double ends[2] = {curve->x[k] - curve->x_error[k],
                          curve->x[k] + curve->x_error[k]};
        ends[0] = fits(&layout->x, ends[0]) ? ends[0] : layout->x.low;
        bar(cairo, (double[2]){gb_figure_axis_position(&layout->x, ends[0]), at[1]},
            (double[2]){gb_figure_axis_position(&layout->x, ends[1]), at[1]});
    }
}

static void draw_points(cairo_t *cairo, const struct gb_figure_layout *layout,
                        const struct gb_figure_curve *curve)
{
    for (size_t k = 0; k < curve->count; k++) {
        double at[2];
        if (gb_figure_curve_position(layout, curve, k, at)) {
            draw_bars(cairo, layout, curve, k, at);
            draw_marker(cairo, curve, at);
        }
    }
}

/* An arrow shorter than its head is the head alone. */
static void draw_arrow(cairo_t *cairo, const double from[2], const double to[2])
{
    const double length = hypot(to[0] - from[0], to[1] - from[1]);
    if (!(length > 0.0)) {
        return;
    }
    const double along[2] = {(to[0] - from[0]) / length, (to[1] - from[1]) / length};
    const double neck[2] = {to[0] - arrow_head[0] * along[0],
                            to[1] - arrow_head[0] * along[1]};
    const double side[2] = {-arrow_head[1] * along[1], arrow_head[1] * along[0]};
    if (length > arrow_head[0]) {
        cairo_move_to(cairo, from[0], from[1]);
        cairo_line_to(cairo, neck[0], neck[1]);
        cairo_stroke(cairo);
    }
    cairo_move_to(cairo, to[0], to[1]);
    cairo_line_to(cairo, neck[0] + side[0], neck[1] + side[1]);
    cairo_line_to(cairo, neck[0] - side[0], neck[1] - side[1]);
    cairo_close_path(cairo);
    cairo_fill(cairo);
}

static void draw_arrows(cairo_t *cairo, const struct gb_figure_layout *layout,
                        const struct gb_figure_curve *curve)
{
    set_pen(cairo, curve);
    cairo_set_line_width(cairo, arrow_width);
    for (size_t k = 0; k + 1 < curve->count; k++) {
        double from[2], to[2];
        if (gb_figure_curve_position(layout, curve, k, from) &&
            gb_figure_curve_position(layout, curve, k + 1, to)) {
            draw_arrow(cairo, from, to);
        }
    }
}

/* Curves of more points than print can show are thinned.  Of all points of a line that follow
 * each other in one column of the page, the first and the last stay and those that reach
 * highest and lowest, errors included: the line covers the same dots.  Of points in one cell
 * of the page the one with the longest bars stays. */
enum { POINTS_FULL = 20000, CELLS_MOST = 10000 };

/* Width of columns and least width of cells, points: a dot at 360 per inch. */
static const double column_width = 0.2, cell_least = 0.4, cell_most = 3.2;
static const double arrow_cell = 0.8;

/* The points that stay, in a copy of a curve. */
struct thinned {
    GArray *x, *y, *error, *x_error;
};

static void keep(struct thinned *kept, const struct gb_figure_curve *curve, size_t k)
{
    g_array_append_val(kept->x, curve->x[k]);
    g_array_append_val(kept->y, curve->y[k]);
    if (curve->error != NULL) {
        g_array_append_val(kept->error, curve->error[k]);
    }
    if (curve->x_error != NULL) {
        g_array_append_val(kept->x_error, curve->x_error[k]);
    }
}

/* Half the bar of a point; 0: none. */
static double reach_of(const double *error, size_t k)
{
    return error != NULL && error[k] > 0.0 ? error[k] : 0.0;
}

static int compare_sizes(const void *a, const void *b)
{
    const size_t one = *(const size_t *)a, other = *(const size_t *)b;
    return (one > other) - (one < other);
}

/* The points [from, to) lie in one column. */
static void keep_column(struct thinned *kept, const struct gb_figure_curve *curve,
                        size_t from, size_t to)
{
    size_t of[6] = {from, from, from, from, from, to - 1};
    for (size_t k = from; k < to; k++) {
        const double reach = reach_of(curve->error, k);
        of[1] = curve->y[k] > curve->y[of[1]] ? k : of[1];
        of[2] = curve->y[k] < curve->y[of[2]] ? k : of[2];
        of[3] = curve->y[k] + reach > curve->y[of[3]] + reach_of(curve->error, of[3])
                    ? k
                    : of[3];
        of[4] = curve->y[k] - reach < curve->y[of[4]] - reach_of(curve->error, of[4])
                    ? k
                    : of[4];
    }
    qsort(of, G_N_ELEMENTS(of), sizeof of[0], compare_sizes);
    for (size_t i = 0; i < G_N_ELEMENTS(of); i++) {
        if (i == 0 || of[i] != of[i - 1]) {
            keep(kept, curve, of[i]);
        }
    }
}

static void thin_line(struct thinned *kept, const struct gb_figure_layout *layout,
                      const struct gb_figure_curve *curve)
{
    bool gap = false;
    for (size_t k = 0; k < curve->count;) {
        double at[2];
        if (!gb_figure_curve_position(layout, curve, k, at)) {
            if (!gap) { /* one of them is as wide as many */
                keep(kept, curve, k);
            }
            gap = true;
            k++;
            continue;
        }
        const double column = floor(at[0] / column_width);
        const size_t from = k;
        while (k < curve->count && gb_figure_curve_position(layout, curve, k, at) &&
               floor(at[0] / column_width) == column) {
            k++;
        }
        keep_column(kept, curve, from, k);
        gap = false;
    }
}

/* Cell along an axis of the page; positions outside of the frame, whose markers and bars may
 * reach into it, are one. */
static gsize cell_of(double at, double low, double high, double width)
{
    const double margin = 2.0 * marker_radius;
    return (gsize)((fmin(fmax(at, low - margin), high + margin) - low + margin) / width);
}

/* The point of each cell with the longest bars, by cell. */
static GHashTable *fill_cells(const struct gb_figure_layout *layout,
                              const struct gb_figure_curve *curve, double width,
                              size_t most)
{
    GHashTable *cells = g_hash_table_new(NULL, NULL);
    for (size_t k = 0; k < curve->count && g_hash_table_size(cells) <= most; k++) {
        double at[2];
        if (!gb_figure_curve_position(layout, curve, k, at)) {
            continue;
        }
        const gsize column = cell_of(at[0], layout->frame[0], layout->frame[2], width);
        const gsize row = cell_of(at[1], layout->frame[1], layout->frame[3], width);
        const gpointer cell = GSIZE_TO_POINTER((column << 20 | row) + 1);
        const size_t there = GPOINTER_TO_SIZE(g_hash_table_lookup(cells, cell));
        if (there == 0 ||
            reach_of(curve->error, k) + reach_of(curve->x_error, k) >
                reach_of(curve->error, there - 1) + reach_of(curve->x_error, there - 1)) {
            g_hash_table_insert(cells, cell, GSIZE_TO_POINTER(k + 1));
        }
    }
    return cells;
}

static void thin_points(struct thinned *kept, const struct gb_figure_layout *layout,
                        const struct gb_figure_curve *curve)
{
    double width = cell_least;
    GHashTable *cells = fill_cells(layout, curve, width, CELLS_MOST);
    while (g_hash_table_size(cells) > CELLS_MOST && width < cell_most) {
        g_hash_table_unref(cells);
        width *= 2.0;
        cells =
            fill_cells(layout, curve, width, width < cell_most ? CELLS_MOST : SIZE_MAX);
    }
    bool *stays = g_new0(bool, curve->count);
    GHashTableIter at_cell;
    gpointer cell = NULL, point = NULL;
    g_hash_table_iter_init(&at_cell, cells);
    while (g_hash_table_iter_next(&at_cell, &cell, &point)) {
        stays[GPOINTER_TO_SIZE(point) - 1] = true;
    }
    for (size_t k = 0; k < curve->count; k++) {
        if (stays[k]) {
            keep(kept, curve, k);
        }
    }
    g_free(stays);
    g_hash_table_unref(cells);
}

/* Pairs that begin and end in the same cells are one arrow. */
static void thin_arrows(struct thinned *kept, const struct gb_figure_layout *layout,
                        const struct gb_figure_curve *curve)
{
    GHashTable *seen = g_hash_table_new(NULL, NULL);
    for (size_t k = 0; k + 1 < curve->count; k++) {
        double a[2], b[2];
        if (gb_figure_curve_position(layout, curve, k, a) &&
            gb_figure_curve_position(layout, curve, k + 1, b)) {
            gsize cell = 0;
            for (int c = 0; c < 2; c++) {
                const double low = layout->frame[c], high = layout->frame[c + 2];
                cell = cell << 16 | cell_of(a[c], low, high, arrow_cell);
                cell = cell << 16 | cell_of(b[c], low, high, arrow_cell);
            }
            if (g_hash_table_add(seen, GSIZE_TO_POINTER(cell))) {
                const double none = NAN;
                keep(kept, curve, k);
                keep(kept, curve, k + 1);
                g_array_append_val(kept->x, none);
                g_array_append_val(kept->y, none);
            }
        }
    }
    g_hash_table_unref(seen);
}

static void draw(cairo_t *cairo, const struct gb_figure_layout *layout,
                 const struct gb_figure_curve *curve);

static void draw_thinned(cairo_t *cairo, const struct gb_figure_layout *layout,
                         const struct gb_figure_curve *curve,
                         void (*thin)(struct thinned *kept,
                                      const struct gb_figure_layout *layout,
                                      const struct gb_figure_curve *curve))
{
    GArray *column[4];
    for (int c = 0; c < 4; c++) {
        column[c] = g_array_new(FALSE, FALSE, sizeof(double));
    }
    struct thinned kept = {column[0], column[1], column[2], column[3]};
    struct gb_figure_curve less = *curve;
    thin(&kept, layout, curve);
    less.count = kept.x->len;
    less.x = (const double *)(const void *)kept.x->data;
    less.y = (const double *)(const void *)kept.y->data;
    less.error =
        kept.error->len > 0 ? (const double *)(const void *)kept.error->data : NULL;
    less.x_error =
        kept.x_error->len > 0 ? (const double *)(const void *)kept.x_error->data : NULL;
    draw(cairo, layout, &less);
    for (int c = 0; c < 4; c++) {
        g_array_unref(column[c]);
    }
}

void gb_figure_curve_draw(cairo_t *cairo, const struct gb_figure_layout *layout,
                          const struct gb_figure_curve *curve)
{
    if (curve->count <= POINTS_FULL) {
        draw(cairo, layout, curve);
        return;
    }
    switch (curve->kind) {
    case GB_FIGURE_POINTS:
        draw_thinned(cairo, layout, curve, thin_points);
        break;
    case GB_FIGURE_ARROWS:
        draw_thinned(cairo, layout, curve, thin_arrows);
        break;
    case GB_FIGURE_BOTH: { /* markers of points over a line of all */
        struct gb_figure_curve line = *curve, points = *curve;
        line.kind = GB_FIGURE_LINE;
        line.error = line.x_error = NULL;
        points.kind = GB_FIGURE_POINTS;
        draw_thinned(cairo, layout, &line, thin_line);
        draw_thinned(cairo, layout, &points, thin_points);
        break;
    }
    default:
        draw_thinned(cairo, layout, curve, thin_line);
    }
}

static void draw(cairo_t *cairo, const struct gb_figure_layout *layout,
                 const struct gb_figure_curve *curve)
{
    const bool line = curve->kind == GB_FIGURE_LINE || curve->kind == GB_FIGURE_FAINT;
    if (line && curve->error != NULL) {
        draw_band(cairo, layout, curve);
    }
    if (line || curve->kind == GB_FIGURE_BOTH) {
        draw_line(cairo, layout, curve);
    }
    if (curve->kind == GB_FIGURE_LINE && gb_figure_curve_round(curve->style) > 0) {
        draw_line_markers(cairo, layout, curve);
    }
    if (curve->kind == GB_FIGURE_STEPS) {
        draw_steps(cairo, layout, curve);
    }
    if (curve->kind == GB_FIGURE_ARROWS) {
        draw_arrows(cairo, layout, curve);
    }
    if (curve->kind == GB_FIGURE_POINTS || curve->kind == GB_FIGURE_BOTH) {
        draw_points(cairo, layout, curve);
    }
}

void gb_figure_curve_sample(cairo_t *cairo, const struct gb_figure_curve *curve, double x,
                            double y, double width)
{
    const double middle[2] = {x + 0.5 * width, y};
    if (curve->kind == GB_FIGURE_STEPS) {
        cairo_rectangle(cairo, x, y - 3.0, width, 6.0);
        set_colour(cairo, curve->style, 0.16);
        cairo_fill_preserve(cairo);
        set_colour(cairo, curve->style, 1.0);
        cairo_set_line_width(cairo, 0.6 * line_width);
        cairo_stroke(cairo);
        return;
    }
    if (curve->kind != GB_FIGURE_POINTS) {
        set_pen(cairo, curve);
        cairo_move_to(cairo, x, y);
        cairo_line_to(cairo, x + width, y);
        cairo_stroke(cairo);
        cairo_set_dash(cairo, NULL, 0, 0.0);
    }
    if (curve->kind == GB_FIGURE_POINTS || curve->kind == GB_FIGURE_BOTH ||
        (curve->kind == GB_FIGURE_LINE && gb_figure_curve_round(curve->style) > 0)) {
        draw_marker(cairo, curve, middle);
    }
}
