#include "draw/figure/figure_marker.h"

#include <math.h>

/* Radius of a disc, and of the core of markers that repeat a colour, points. */
const double gb_figure_marker_radius = 2.6;
static const double core_radius = 1.1;

/* Colours of Okabe and Ito without yellow, which has no contrast on white; neighbours
 * also differ in lightness. */
static const double colours[GB_FIGURE_STYLES][3] = {
    {0.000, 0.447, 0.698}, /* blue */
    {0.835, 0.369, 0.000}, /* vermilion */
    {0.000, 0.620, 0.451}, /* bluish green */
    {0.100, 0.100, 0.120}, /* black */
    {0.800, 0.475, 0.655}, /* reddish purple */
    {0.902, 0.624, 0.000}, /* orange */
    {0.337, 0.706, 0.914}, /* sky blue */
};

void gb_figure_marker_colour(int style, double rgb[3])
{
    for (int k = 0; k < 3; k++) {
        rgb[k] = colours[style % GB_FIGURE_STYLES][k];
    }
}

int gb_figure_marker_round(int style)
{
    return style / GB_FIGURE_STYLES;
}

void gb_figure_marker_set_colour(cairo_t *cairo, int style, double alpha)
{
    const double *rgb = colours[style % GB_FIGURE_STYLES];
    cairo_set_source_rgba(cairo, rgb[0], rgb[1], rgb[2], alpha);
}

static void outline(cairo_t *cairo, int style, const double at[2])
{
    static const int corners[GB_FIGURE_STYLES] = {0, 4, 3, 4, 3, 5, 6};
    /* disc, square, triangle up, diamond, triangle down, pentagon, hexagon */
    static const double rotation[GB_FIGURE_STYLES] = {0.0, 0.25, 0.5, 0.0, 0.0, 0.5, 0.5};
    static const double scale[GB_FIGURE_STYLES] = {1.0, 1.2, 1.3, 1.3, 1.3, 1.1, 1.1};
    const int s = style % GB_FIGURE_STYLES;
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
