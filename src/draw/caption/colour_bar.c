#include "draw/caption/colour_bar.h"

#include <math.h>
#include <stdio.h>

#include "draw/figure/figure_axis.h"
#include "draw/style/picture_scale.h"

static void frame_bar(const struct gb_caption_pen *pen, const struct gb_frame *bar,
                      const char *title)
{
    gb_caption_pen_set_foreground(pen);
    cairo_set_line_width(pen->cairo, fmax(0.05 * pen->unit, 1.0));
    cairo_rectangle(pen->cairo, bar->left, bar->top, bar->width, bar->height);
    cairo_stroke(pen->cairo);
    gb_caption_pen_line_upwards(pen, title, bar->left - 0.95 * pen->unit,
                                bar->top + 0.5 * bar->height);
}

static void set_colour(const struct gb_caption_pen *pen, const uint8_t rgb[3])
{
    cairo_set_source_rgb(pen->cairo, rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0);
}

/* Whole numbers: one cell each, the lowest at the bottom; every n-th has a label where they
 * are low. */
static void draw_cells(const struct gb_caption_pen *pen, const struct gb_frame *bar,
                       const struct gb_picture_style_scale *scale)
{
    const int first = (int)scale->low;
    const int last = (int)scale->high;
    const double step = bar->height / (last - first + 1);
    const int every = (int)fmax(ceil(0.95 * pen->unit / step), 1.0);
    for (int k = first; k <= last; k++) {
        uint8_t rgb[3];
        char label[16];
        const double top = bar->top + bar->height - (k - first + 1) * step;
        gb_picture_scale_colour(scale, k, rgb);
        set_colour(pen, rgb);
        cairo_rectangle(pen->cairo, bar->left, top, bar->width, step + 0.5);
        cairo_fill(pen->cairo);
        if ((last - k) % every != 0) {
            continue;
        }
        snprintf(label, sizeof label, "%s%d",
                 k == last && scale->above    ? "\xe2\x89\xa5"
                 : k == first && scale->below ? "\xe2\x89\xa4"
                                              : "",
                 k);
        gb_caption_pen_line(pen, label, bar->left + bar->width + 0.5 * pen->unit,
                            top + 0.5 * step, 0.0, 0.85, 0.0);
    }
}

enum bar_end { AT_LOW_END, AT_HIGH_END };

/* Triangle at an end of the bar: values exist beyond it. */
static void draw_arrow(const struct gb_caption_pen *pen, const struct gb_frame *bar,
                       const struct gb_picture_style_scale *scale, enum bar_end end)
{
    const bool above = end == AT_HIGH_END;
    const double base = above ? bar->top : bar->top + bar->height;
    const double tip = base + (above ? -1.0 : 1.0) * 0.8 * pen->unit;
    uint8_t rgb[3];
    gb_palette_value(scale->map, above ? 1.0 : 0.0, rgb);
    set_colour(pen, rgb);
    cairo_move_to(pen->cairo, bar->left, base);
    cairo_line_to(pen->cairo, bar->left + 0.5 * bar->width, tip);
    cairo_line_to(pen->cairo, bar->left + bar->width, base);
    cairo_close_path(pen->cairo);
    cairo_fill_preserve(pen->cairo);
    gb_caption_pen_set_foreground(pen);
    cairo_set_line_width(pen->cairo, fmax(0.05 * pen->unit, 1.0));
    cairo_stroke(pen->cairo);
}

static void draw_tick(const struct gb_caption_pen *pen, const struct gb_frame *bar,
                      double y, const char *label)
{
    gb_caption_pen_set_foreground(pen);
    cairo_set_line_width(pen->cairo, fmax(0.05 * pen->unit, 1.0));
    cairo_move_to(pen->cairo, bar->left + bar->width, y);
    cairo_line_to(pen->cairo, bar->left + bar->width + 0.3 * pen->unit, y);
    cairo_stroke(pen->cairo);
    gb_text_write(&pen->text, label, 0.85 * pen->unit, 0.0,
                  (double[2]){bar->left + bar->width + 0.5 * pen->unit, y},
                  (double[2]){0.0, 0.5}, 0);
}

/* The ends, and the ticks between them that leave room for those. */
static void draw_ticks(const struct gb_caption_pen *pen, const struct gb_frame *bar,
                       const struct gb_picture_style_scale *scale)
{
    static const bool exact[2] = {true, true};
    const double room = 1.1 * pen->unit;
    const int wanted = (int)fmin(fmax(bar->height / (2.0 * pen->unit), 2.0), 6.0);
    struct gb_figure_axis_scale axis;
    gb_figure_axis_fit(&axis, scale->log ? GB_FIGURE_AXIS_LOG : GB_FIGURE_AXIS_LINEAR,
                       scale->low, scale->high, wanted, exact);
    axis.from = bar->top + bar->height;
    axis.to = bar->top;
    for (int k = 0; k < axis.ticks; k++) {
        char plain[48]; /* no space for a power of ten */
        const double y = gb_figure_axis_position(&axis, axis.tick[k]);
        if (y > axis.from - room || y < axis.to + room) {
            continue;
        }
        snprintf(plain, sizeof plain, "%.4g", axis.tick[k]);
        draw_tick(pen, bar, y, axis.power == 0 ? axis.label[k] : plain);
    }
    for (int end = 0; end < 2; end++) {
        char label[48];
        const double value = end == 0 ? scale->low : scale->high;
        const double magnitude = fabs(value);
        snprintf(label, sizeof label, "%s%.4g", value < 0.0 ? "\xe2\x88\x92" : "",
                 magnitude);
        draw_tick(pen, bar, end == 0 ? axis.from : axis.to, label);
    }
}

/* One colour, one tick. */
static void draw_one_value(const struct gb_caption_pen *pen, const struct gb_frame *bar,
                           const struct gb_picture_style_scale *scale)
{
    uint8_t rgb[3];
    char label[48];
    gb_palette_value(scale->map, 0.5, rgb);
    set_colour(pen, rgb);
    cairo_rectangle(pen->cairo, bar->left, bar->top, bar->width, bar->height);
    cairo_fill(pen->cairo);
    snprintf(label, sizeof label, "%.4g", scale->low);
    draw_tick(pen, bar, bar->top + 0.5 * bar->height, label);
}

static void draw_gradient(const struct gb_caption_pen *pen, const struct gb_frame *bar,
                          const struct gb_picture_style_scale *scale)
{
    const int steps = 256;
    for (int k = 0; k < steps; k++) {
        uint8_t rgb[3];
        gb_palette_value(scale->map, (k + 0.5) / steps, rgb);
        const double top = bar->top + bar->height * (1.0 - (k + 1.0) / steps);
        set_colour(pen, rgb);
        cairo_rectangle(pen->cairo, bar->left, top, bar->width,
                        bar->height / steps + 0.6);
        cairo_fill(pen->cairo);
    }
    if (scale->below) {
        draw_arrow(pen, bar, scale, AT_LOW_END);
    }
    if (scale->above) {
        draw_arrow(pen, bar, scale, AT_HIGH_END);
    }
    draw_ticks(pen, bar, scale);
}

void gb_colour_bar_draw(const struct gb_caption_pen *pen, const struct gb_frame *bar,
                        const struct gb_picture_style_scale *scale)
{
    if (scale->title == NULL) {
        return;
    }
    if (scale->whole) {
        draw_cells(pen, bar, scale);
    } else if (!(scale->high > scale->low)) {
        draw_one_value(pen, bar, scale);
    } else {
        draw_gradient(pen, bar, scale);
    }
    frame_bar(pen, bar, scale->title);
}
