#include "draw/caption/colour_bar.h"

#include <math.h>
#include <stdio.h>

#include "draw/figure/figure_axis.h"
#include "draw/image/palette.h"

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

/* Whole numbers: one cell each, 0 at the bottom. */
static void draw_cells(const struct gb_caption_pen *pen, const struct gb_frame *bar,
                       const struct gb_picture_style_scale *scale)
{
    const int last = (int)scale->high;
    const double step = bar->height / (last + 1);
    for (int k = 0; k <= last; k++) {
        uint8_t rgb[3];
        char label[16];
        const double top = bar->top + bar->height - (k + 1) * step;
        gb_palette_contacts(k, rgb);
        cairo_set_source_rgb(pen->cairo, rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0);
        cairo_rectangle(pen->cairo, bar->left, top, bar->width, step + 0.5);
        cairo_fill(pen->cairo);
        snprintf(label, sizeof label, "%s%d",
                 k == last && scale->above ? "\xe2\x89\xa5" : "", k);
        gb_caption_pen_line(pen, label, bar->left + bar->width + 0.5 * pen->unit,
                            top + 0.5 * step, 0.0, 0.85, 0.0);
    }
}

enum bar_end { AT_LOW_END, AT_HIGH_END };

/* Triangle at an end of the bar: values exist beyond it. */
static void draw_arrow(const struct gb_caption_pen *pen, const struct gb_frame *bar,
                       enum bar_end end)
{
    const bool above = end == AT_HIGH_END;
    const double base = above ? bar->top : bar->top + bar->height;
    const double tip = base + (above ? -1.0 : 1.0) * 0.8 * pen->unit;
    uint8_t rgb[3];
    gb_palette_field(above ? 1.0 : 0.0, rgb);
    cairo_set_source_rgb(pen->cairo, rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0);
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

static void draw_ticks(const struct gb_caption_pen *pen, const struct gb_frame *bar,
                       const struct gb_picture_style_scale *scale)
{
    static const bool exact[2] = {true, true};
    struct gb_figure_axis_scale axis;
    gb_figure_axis_fit(&axis, GB_FIGURE_AXIS_LINEAR, scale->low, scale->high, 6, exact);
    axis.from = bar->top + bar->height;
    axis.to = bar->top;
    for (int k = 0; k < axis.ticks; k++) {
        char plain[48]; /* no space for a power of ten */
        snprintf(plain, sizeof plain, "%.4g", axis.tick[k]);
        draw_tick(pen, bar, gb_figure_axis_position(&axis, axis.tick[k]),
                  axis.power == 0 ? axis.label[k] : plain);
    }
}

/* One colour, one tick. */
static void draw_one_value(const struct gb_caption_pen *pen, const struct gb_frame *bar,
                           double value)
{
    uint8_t rgb[3];
    char label[48];
    gb_palette_field(0.5, rgb);
    cairo_set_source_rgb(pen->cairo, rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0);
    cairo_rectangle(pen->cairo, bar->left, bar->top, bar->width, bar->height);
    cairo_fill(pen->cairo);
    snprintf(label, sizeof label, "%.4g", value);
    draw_tick(pen, bar, bar->top + 0.5 * bar->height, label);
}

static void draw_gradient(const struct gb_caption_pen *pen, const struct gb_frame *bar,
                          const struct gb_picture_style_scale *scale)
{
    const int steps = 256;
    for (int k = 0; k < steps; k++) {
        uint8_t rgb[3];
        gb_palette_field((k + 0.5) / steps, rgb);
        const double top = bar->top + bar->height * (1.0 - (k + 1.0) / steps);
        cairo_set_source_rgb(pen->cairo, rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0);
        cairo_rectangle(pen->cairo, bar->left, top, bar->width,
                        bar->height / steps + 0.6);
        cairo_fill(pen->cairo);
    }
    if (scale->below) {
        draw_arrow(pen, bar, AT_LOW_END);
    }
    if (scale->above) {
        draw_arrow(pen, bar, AT_HIGH_END);
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
        draw_one_value(pen, bar, scale->low);
    } else {
        draw_gradient(pen, bar, scale);
    }
    frame_bar(pen, bar, scale->title);
}
