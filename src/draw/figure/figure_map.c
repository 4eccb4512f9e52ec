#include "draw/figure/figure_map.h"

#include <math.h>

#include "draw/figure/figure_names.h"
#include "draw/image/palette.h"

/* Lengths in points. */
static const double bar_gap = 12.0;
static const double bar_width = 12.0;
static const double bar_total = 62.0;

enum { BAR_STEPS = 128, BAR_TICKS = 6 };

double gb_figure_map_bar_width(const struct gb_figure *figure)
{
    return figure->map != NULL ? bar_total : 0.0;
}

static void set_colour(cairo_t *cairo, const struct gb_figure_map *map, double value)
{
    uint8_t rgb[3];
    gb_palette_scale((value - map->low) / (map->high - map->low), rgb);
    cairo_set_source_rgb(cairo, rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0);
}

/* Cells overlap by a little: no seams between them in any format. */
static void draw_cells(const struct gb_figure_page *page)
{
    const struct gb_figure_map *map = page->figure->map;
    cairo_t *cairo = page->text.cairo;
    for (int i = 0; i < map->columns; i++) {
        for (int k = 0; k < map->rows; k++) {
            const double value = map->value[i * map->rows + k];
            const double left = gb_figure_axis_position(&page->layout.x, map->x[i]);
            const double right = gb_figure_axis_position(&page->layout.x, map->x[i + 1]);
            const double low = gb_figure_axis_position(&page->layout.y, map->y[k]);
            const double high = gb_figure_axis_position(&page->layout.y, map->y[k + 1]);
            if (isfinite(value)) {
                set_colour(cairo, map, value);
                cairo_rectangle(cairo, left, high, right - left + 0.3, low - high + 0.3);
                cairo_fill(cairo);
            }
        }
    }
}

static void draw_bar(const struct gb_figure_page *page)
{
    const struct gb_figure_map *map = page->figure->map;
    cairo_t *cairo = page->text.cairo;
    const double *f = page->layout.frame;
    const double left = f[2] + bar_gap, height = (f[3] - f[1]) / BAR_STEPS;
    struct gb_figure_axis_scale scale;
    gb_figure_axis_fit(&scale, GB_FIGURE_AXIS_LINEAR, map->low, map->high, BAR_TICKS,
                       (const bool[2]){true, true});
    scale.from = f[3];
    scale.to = f[1];
    for (int k = 0; k < BAR_STEPS; k++) {
        set_colour(cairo, map, map->low + (map->high - map->low) * (k + 0.5) / BAR_STEPS);
        cairo_rectangle(cairo, left, f[3] - (k + 1) * height, bar_width, height + 0.3);
        cairo_fill(cairo);
    }
    cairo_set_source_rgb(cairo, 0.1, 0.1, 0.12);
    cairo_set_line_width(cairo, 0.6);
    cairo_rectangle(cairo, left, f[1], bar_width, f[3] - f[1]);
    cairo_stroke(cairo);
    for (int k = 0; k < scale.ticks; k++) {
        const double at[2] = {left + bar_width + gb_figure_page_gap,
                              gb_figure_axis_position(&scale, scale.tick[k])};
        gb_text_write(&page->text, scale.label[k], gb_figure_page_tick_size, 0.0, at,
                      (double[2]){0.0, 0.5}, 0);
    }
    gb_figure_names_draw(page, map->label, GB_FIGURE_NAMES_ALONG_Y, 0.5 * (f[1] + f[3]),
                         page->width - 5.0, 1.0);
}

void gb_figure_map_draw(const struct gb_figure_page *page)
{
    if (page->figure->map != NULL) {
        draw_cells(page);
        draw_bar(page);
    }
}
