#include "draw/figure/figure.h"

#include "draw/figure/figure_surface.h"
#include "draw/mute_stderr.h"

static void scale_to_pixels(struct gb_figure_layout *layout)
{
    for (int k = 0; k < 4; k++) {
        layout->frame[k] *= layout->unit;
        layout->legend[k] *= layout->unit;
        layout->inset[k] *= layout->unit;
        layout->below[k] *= layout->unit;
    }
    layout->x.from *= layout->unit;
    layout->x.to *= layout->unit;
    layout->y.from *= layout->unit;
    layout->y.to *= layout->unit;
}

bool gb_figure_render(struct gb_image **out, const struct gb_figure *figure, int width,
                      int height, struct gb_figure_layout *layout, struct gb_error *err)
{
    height = gb_figure_surface_height(figure, width, height);
    if (!gb_image_create(out, width, height, err)) {
        return false;
    }
    (*out)->per_inch = figure->per_inch;
    const double unit = gb_figure_surface_pixels_per_point(figure, width, height);
    const double size[2] = {width / unit, height / unit};
    cairo_surface_t *surface = cairo_image_surface_create_for_data(
        (*out)->rgba, CAIRO_FORMAT_ARGB32, width, height, 4 * width);
    const int saved = gb_mute_stderr_begin();
    const bool good = gb_figure_surface_draw(surface, figure, size, unit, layout, err);
    gb_mute_stderr_end(saved);
    cairo_surface_finish(surface);
    cairo_surface_destroy(surface);
    if (!good) {
        gb_image_destroy(*out);
        *out = NULL;
        return false;
    }
    scale_to_pixels(layout);
    gb_image_swap_red_blue(*out);
    return true;
}
