#include "draw/figure/figure_marks.h"

#include <math.h>

/* Okabe and Ito's colours without yellow, which white paper swallows; the order keeps
 * neighbours apart in lightness too. */
static const double colours[GB_FIGURE_STYLES][3] = {
    {0.000, 0.447, 0.698}, /* blue */
    {0.835, 0.369, 0.000}, /* vermilion */
    {0.000, 0.620, 0.451}, /* bluish green */
    {0.100, 0.100, 0.120}, /* black */
    {0.800, 0.475, 0.655}, /* reddish purple */
    {0.902, 0.624, 0.000}, /* orange */
    {0.337, 0.706, 0.914}, /* sky blue */
};

/* Dashes in points, ended by 0. */
static const double dashes[GB_FIGURE_STYLES][7] = {
    {0},          {6, 2.4, 0},
    {1.4, 2, 0},  {7, 2, 1.4, 2, 0},
    {11, 2.6, 0}, {7, 2, 1.4, 2, 1.4, 2, 0},
    {3, 1.8, 0},
};

static const double line_width = 1.35;
static const double faint_width = 0.45;
static const double bar_width = 0.75;
static const double mark_size = 2.6; /* radius of a disc */
static const double core_size = 1.1;
static const double bead_distance = 46.0;

void gb_figure_marks_colour(int style, double rgb[3])
{
    for (int k = 0; k < 3; k++) {
        rgb[k] = colours[style % GB_FIGURE_STYLES][k];
    }
}

/* The second round of colours has other dashes, marks with a core, and marks along its
 * lines: apart without colours too. */
static int round_of(int style)
{
    return style / GB_FIGURE_STYLES;
}

static void set_colour(cairo_t *cairo, int style, double alpha)
{
    const double *rgb = colours[style % GB_FIGURE_STYLES];
    cairo_set_source_rgba(cairo, rgb[0], rgb[1], rgb[2], alpha);
}

static void set_pen(cairo_t *cairo, const struct gb_figure_curve *curve)
{
    const double *dash =
        dashes[(curve->style + round_of(curve->style)) % GB_FIGURE_STYLES];
    const bool faint = curve->kind == GB_FIGURE_FAINT;
    int count = 0;
    while (dash[count] > 0.0) {
        count++;
    }
    cairo_set_dash(cairo, dash, faint || curve->kind == GB_FIGURE_STEPS ? 0 : count, 0.0);
    cairo_set_line_width(cairo, faint ? faint_width : line_width);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    set_colour(cairo, curve->style, faint ? 0.45 : 1.0);
}

static bool fits(const struct gb_figure_axis_scale *scale, double value)
{
    return isfinite(value) && (!scale->log || value > 0.0);
}

bool gb_figure_marks_place(const struct gb_figure_layout *layout,
                           const struct gb_figure_curve *curve, size_t k, double at[2])
{
    if (!fits(&layout->x, curve->x[k]) || !fits(&layout->y, curve->y[k])) {
        return false;
    }
    at[0] = gb_figure_axis_place(&layout->x, curve->x[k]);
    at[1] = gb_figure_axis_place(&layout->y, curve->y[k]);
    return true;
}

/* Place of y -+ error, kept on the page. */
static double edge(const struct gb_figure_layout *layout,
                   const struct gb_figure_curve *curve, size_t k, double side)
{
    const double value = curve->y[k] + side * curve->error[k];
    const double beyond = layout->frame[3] + 50.0;
    return fits(&layout->y, value) ? gb_figure_axis_place(&layout->y, value) : beyond;
}

/* Points [from, to) are a run without a gap in x, y and error. */
static void fill_band(cairo_t *cairo, const struct gb_figure_layout *layout,
                      const struct gb_figure_curve *curve, size_t from, size_t to)
{
    for (size_t k = from; k < to; k++) {
        cairo_line_to(cairo, gb_figure_axis_place(&layout->x, curve->x[k]),
                      edge(layout, curve, k, 1.0));
    }
    for (size_t k = to; k > from; k--) {
        cairo_line_to(cairo, gb_figure_axis_place(&layout->x, curve->x[k - 1]),
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
        const bool there = k < curve->count &&
                           gb_figure_marks_place(layout, curve, k, at) &&
                           isfinite(curve->error[k]);
        if (!there) {
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
    bool down = false;
    set_pen(cairo, curve);
    for (size_t k = 0; k < curve->count; k++) {
        double at[2];
        if (!gb_figure_marks_place(layout, curve, k, at)) {
            down = false;
        } else if (down) {
            cairo_line_to(cairo, at[0], at[1]);
        } else {
            cairo_move_to(cairo, at[0], at[1]);
            down = true;
        }
    }
    cairo_stroke(cairo);
    cairo_set_dash(cairo, NULL, 0, 0.0);
}

static void draw_steps(cairo_t *cairo, const struct gb_figure_layout *layout,
                       const struct gb_figure_curve *curve)
{
    const double floor_at = layout->y.from;
    bool begun = false;
    double last[2] = {0.0, 0.0};
    for (size_t k = 0; k < curve->count; k++) {
        double at[2];
        if (!gb_figure_marks_place(layout, curve, k, at)) {
            continue;
        }
        if (!begun) {
            cairo_move_to(cairo, at[0], floor_at);
        } else {
            cairo_line_to(cairo, at[0], last[1]);
        }
        cairo_line_to(cairo, at[0], at[1]);
        begun = true;
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

static void outline(cairo_t *cairo, int style, const double at[2])
{
    static const int corners[GB_FIGURE_STYLES] = {0, 4, 3, 4, 3, 5, 6};
    /* disc, square, triangle up, diamond, triangle down, pentagon, hexagon */
    static const double turn[GB_FIGURE_STYLES] = {0.0, 0.25, 0.5, 0.0, 0.0, 0.5, 0.5};
    static const double grow[GB_FIGURE_STYLES] = {1.0, 1.2, 1.3, 1.3, 1.3, 1.1, 1.1};
    const int s = style % GB_FIGURE_STYLES;
    const double r = mark_size * grow[s];
    if (corners[s] == 0) {
        cairo_new_sub_path(cairo);
        cairo_arc(cairo, at[0], at[1], r, 0.0, 2.0 * M_PI);
        return;
    }
    for (int k = 0; k < corners[s]; k++) {
        const double angle =
            2.0 * M_PI * (k + (corners[s] == 4 ? 2.0 * turn[s] : 0.0)) / corners[s] +
            (corners[s] == 4 ? 0.0 : M_PI * (2.0 * turn[s] + 0.5));
        const double x = at[0] + r * cos(angle);
        const double y = at[1] + r * sin(angle);
        (k == 0 ? cairo_move_to : cairo_line_to)(cairo, x, y);
    }
    cairo_close_path(cairo);
}

static void set_fill(cairo_t *cairo, const struct gb_figure_curve *curve, bool white)
{
    if (white) {
        cairo_set_source_rgb(cairo, 1.0, 1.0, 1.0);
    } else {
        set_colour(cairo, curve->style, 1.0);
    }
}

static void draw_mark(cairo_t *cairo, const struct gb_figure_curve *curve,
                      const double at[2])
{
    outline(cairo, curve->style, at);
    set_fill(cairo, curve, curve->open);
    cairo_fill_preserve(cairo);
    set_colour(cairo, curve->style, 1.0);
    cairo_set_line_width(cairo, 0.9);
    cairo_stroke(cairo);
    if (round_of(curve->style) > 0) {
        cairo_arc(cairo, at[0], at[1], core_size, 0.0, 2.0 * M_PI);
        set_fill(cairo, curve, !curve->open);
        cairo_fill(cairo);
    }
}

/* A line of a later round: marks at even distances along it. */
static void draw_beads(cairo_t *cairo, const struct gb_figure_layout *layout,
                       const struct gb_figure_curve *curve)
{
    double next = bead_distance *
                  (0.3 + 0.6 * (curve->style % GB_FIGURE_STYLES) / GB_FIGURE_STYLES);
    double last[2] = {NAN, NAN};
    for (size_t k = 0; k < curve->count; k++) {
        double at[2];
        if (!gb_figure_marks_place(layout, curve, k, at)) {
            last[0] = NAN;
            continue;
        }
        next -= isfinite(last[0]) ? hypot(at[0] - last[0], at[1] - last[1]) : 0.0;
        if (next <= 0.0) {
            draw_mark(cairo, curve, at);
            next = bead_distance;
        }
        last[0] = at[0];
        last[1] = at[1];
    }
}

static void bar(cairo_t *cairo, const double a[2], const double b[2])
{
    const bool upright = a[0] == b[0];
    const double cap = 0.7 * mark_size;
    cairo_move_to(cairo, a[0], a[1]);
    cairo_line_to(cairo, b[0], b[1]);
    for (int end = 0; end < 2; end++) {
        const double *p = end == 0 ? a : b;
        cairo_move_to(cairo, p[0] - (upright ? cap : 0.0), p[1] - (upright ? 0.0 : cap));
        cairo_line_to(cairo, p[0] + (upright ? cap : 0.0), p[1] + (upright ? 0.0 : cap));
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
        bar(cairo, (double[2]){gb_figure_axis_place(&layout->x, ends[0]), at[1]},
            (double[2]){gb_figure_axis_place(&layout->x, ends[1]), at[1]});
    }
}

static void draw_points(cairo_t *cairo, const struct gb_figure_layout *layout,
                        const struct gb_figure_curve *curve)
{
    for (size_t k = 0; k < curve->count; k++) {
        double at[2];
        if (gb_figure_marks_place(layout, curve, k, at)) {
            draw_bars(cairo, layout, curve, k, at);
            draw_mark(cairo, curve, at);
        }
    }
}

void gb_figure_marks_curve(cairo_t *cairo, const struct gb_figure_layout *layout,
                           const struct gb_figure_curve *curve)
{
    const bool line = curve->kind == GB_FIGURE_LINE || curve->kind == GB_FIGURE_FAINT;
    if (line && curve->error != NULL) {
        draw_band(cairo, layout, curve);
    }
    if (line || curve->kind == GB_FIGURE_BOTH) {
        draw_line(cairo, layout, curve);
    }
    if (curve->kind == GB_FIGURE_LINE && round_of(curve->style) > 0) {
        draw_beads(cairo, layout, curve);
    }
    if (curve->kind == GB_FIGURE_STEPS) {
        draw_steps(cairo, layout, curve);
    }
    if (curve->kind == GB_FIGURE_POINTS || curve->kind == GB_FIGURE_BOTH) {
        draw_points(cairo, layout, curve);
    }
}

void gb_figure_marks_sample(cairo_t *cairo, const struct gb_figure_curve *curve, double x,
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
        (curve->kind == GB_FIGURE_LINE && round_of(curve->style) > 0)) {
        draw_mark(cairo, curve, middle);
    }
}
