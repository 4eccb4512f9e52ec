#include <glib.h>
#include <math.h>

#include "tui/plot/plot.h"
#include "tui/plot/plot_raster.h"

/* A corner of the band in dots of the field, from its top left corner. */
struct corner {
    double x, y;
};

/* On which side of the line a-b a point lies: the sign. */
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

static bool find_corner(const struct gb_plot *plot, double x, double y,
                        struct corner *corner)
{
    const double px = gb_plot_axis_position(&plot->x, x);
    const double py = gb_plot_axis_position(&plot->y, y);
    corner->x = px * (plot->field_cols * gb_plot_raster_dots_x(plot->glyphs) - 1);
    corner->y = (1.0 - py) * (plot->field_rows * gb_plot_raster_dots_y(plot->glyphs) - 1);
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

/* The part of the band between two of its points. */
static void fill(struct gb_plot *plot, const struct corner corner[4], int ink)
{
    const int last_x = plot->field_cols * gb_plot_raster_dots_x(plot->glyphs) - 1;
    const int last_y = plot->field_rows * gb_plot_raster_dots_y(plot->glyphs) - 1;
    int low[2], high[2];
    find_range(corner, last_x, last_y, low, high);
    for (int y = low[1]; y <= high[1]; y++) {
        for (int x = low[0]; x <= high[0]; x++) {
            if (in_triangle(&corner[0], &corner[1], &corner[2], x, y) ||
                in_triangle(&corner[1], &corner[2], &corner[3], x, y)) {
                gb_plot_raster_tone(plot, x, y, ink);
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
