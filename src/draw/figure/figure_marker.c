#include "draw/figure/figure_marker.h"

#include <math.h>
#include <stdint.h>

/* Radius of a disc, and of the core of markers that repeat a colour, points. */
const double gb_figure_marker_radius = 2.6;
static const double core_radius = 1.1;

/* Of a style or of a black one. */
static int number_of(int style)
{
    return style < 0 ? gb_figure_black(style) : style;
}

void gb_figure_marker_colour(int style, double rgb[3])
{
    const uint8_t *from =
        style < 0 ? gb_figure_colours_black : gb_figure_colours[style % GB_FIGURE_STYLES];
    for (int k = 0; k < 3; k++) {
        rgb[k] = from[k] / 255.0;
    }
}

int gb_figure_marker_round(int style)
{
    return number_of(style) / GB_FIGURE_STYLES;
}

int gb_figure_marker_shape(int style)
{
    return number_of(style) % GB_FIGURE_STYLES;
}

void gb_figure_marker_set_colour(cairo_t *cairo, int style, double alpha)
{
    double rgb[3];
    gb_figure_marker_colour(style, rgb);
    cairo_set_source_rgba(cairo, rgb[0], rgb[1], rgb[2], alpha);
}

static void outline(cairo_t *cairo, int style, const double at[2])
{
    static const int corners[GB_FIGURE_STYLES] = {0, 4, 3, 4, 3, 5};
    /* disc, square, triangle up, diamond, triangle down, pentagon */
    static const double rotation[GB_FIGURE_STYLES] = {0.0, 0.25, 0.5, 0.0, 0.0, 0.5};
    static const double scale[GB_FIGURE_STYLES] = {1.0, 1.2, 1.3, 1.3, 1.3, 1.1};
    const int s = gb_figure_marker_shape(style);
    const double r = gb_figure_marker_radius * scale[s];
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
        gb_figure_marker_set_colour(cairo, curve->style, 1.0);
    }
}

void gb_figure_marker_draw(cairo_t *cairo, const struct gb_figure_curve *curve,
                           const double at[2])
{
    outline(cairo, curve->style, at);
    set_fill(cairo, curve, curve->open ? WHITE : COLOURED);
    cairo_fill_preserve(cairo);
    gb_figure_marker_set_colour(cairo, curve->style, 1.0);
    cairo_set_line_width(cairo, 0.9);
    cairo_stroke(cairo);
    if (gb_figure_marker_round(curve->style) > 0) {
        cairo_arc(cairo, at[0], at[1], core_radius, 0.0, 2.0 * M_PI);
        set_fill(cairo, curve, curve->open ? COLOURED : WHITE);
        cairo_fill(cairo);
    }
}
