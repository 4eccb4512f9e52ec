#include "draw/caption/force_legend.h"

#include <stdio.h>

#include "draw/caption/caption_layout.h"
#include "draw/caption/caption_number.h"
#include "draw/style/force_rods.h"
#include "draw/style/round_number.h"

enum { RODS = 3 };

/* Each further rod has at most this share of the force before. */
static const double next_share = 0.5;
/* Thickest rod of the legend, heights of a line. */
static const double max_thickness = 1.2;

int gb_force_legend_lines(const struct gb_picture_style *style)
{
    return style->legend_count > 0 ? style->legend_count + 1 + RODS : 0;
}

static void draw_rod(const struct gb_caption_pen *pen, double x, double y, double width)
{
    cairo_set_line_width(pen->cairo, width);
    cairo_set_line_cap(pen->cairo, CAIRO_LINE_CAP_ROUND);
    cairo_move_to(pen->cairo, x + 0.3 * pen->unit, y);
    cairo_line_to(pen->cairo, x + 1.6 * pen->unit, y);
    cairo_stroke(pen->cairo);
    cairo_set_line_cap(pen->cairo, CAIRO_LINE_CAP_BUTT);
}

static void draw_line(const struct gb_caption_pen *pen, const struct gb_frame *frame,
                      const char *text, double y)
{
    gb_caption_pen_line(pen, text, frame->left + 2.5 * pen->unit, y, 0.0, 0.9,
                        frame->width - 2.5 * pen->unit);
}

/* Largest force of the legend, N: its rod fits a line. */
static double largest(const struct gb_caption_pen *pen,
                      const struct gb_picture_style *style, double scale)
{
    const double thickest = 2.0 * scale * gb_force_rods_radius(1.0);
    const double limit = max_thickness * pen->unit;
    return thickest <= limit
               ? style->max_force_n
               : gb_round_number_below(style->max_force_n * limit / thickest);
}

void gb_force_legend_draw(const struct gb_caption_pen *pen, const struct gb_frame *frame,
                          const struct gb_picture_style *style, double scale)
{
    const double step = GB_CAPTION_LAYOUT_LEGEND_LINE * pen->unit;
    double y = frame->top + 0.5 * step;
    for (int k = 0; k < style->legend_count; k++, y += step) {
        const uint8_t *rgb = style->legend[k].rgb;
        cairo_set_source_rgb(pen->cairo, rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0);
        draw_rod(pen, frame->left, y, 0.45 * pen->unit);
        draw_line(pen, frame, style->legend[k].name, y);
    }
    gb_caption_pen_line(pen, "normal force", frame->left, y, 0.0, 0.9, frame->width);
    double force_n = largest(pen, style, scale);
    for (int k = 0; k < RODS; k++) {
        char force[48], line[64];
        const double ratio = force_n / style->max_force_n;
        const bool above = ratio >= 1.0 && style->forces_above;
        y += step;
        gb_caption_number_format(force_n, GB_DIM_FORCE, 2, force, sizeof force);
        snprintf(line, sizeof line, "%s%s", above ? "\xe2\x89\xa5 " : "", force);
        gb_caption_pen_set_foreground(pen);
        draw_rod(pen, frame->left, y, 2.0 * scale * gb_force_rods_radius(ratio));
        draw_line(pen, frame, line, y);
        force_n = gb_round_number_below(next_share * force_n);
    }
}
