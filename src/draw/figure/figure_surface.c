#include "draw/figure/figure_surface.h"

#include <math.h>
#include <string.h>

#include "draw/figure/figure_draw.h"
#include "draw/figure/figure_labels.h"
#include "draw/image/print_size.h"
#include "draw/mute_stderr.h"

/* Minimum size of a page in points; a page has the shape of the image. */
static const double min_width = 420.0;
static const double min_height = 300.0;

/* Labels of a page are larger than they shall be in print. */
double gb_figure_surface_pixels_per_point(const struct gb_figure *figure, int width,
                                          int height)
{
    if (figure->per_inch > 0) {
        return gb_print_size_pixels(figure->per_inch,
                                    GB_PRINT_SIZE_TEXT / GB_FIGURE_LABELS_SIZE);
    }
    return fmin(width / min_width, height / min_height);
}

/* The least height with which a page is high enough: a legend may find room in a higher
 * frame. */
static double grow(struct gb_figure_page *page)
{
    const double most = 2.0 * page->width;
    for (;;) {
        gb_figure_page_arrange(page);
        const double missing = gb_figure_page_wanted_height(page) - page->height;
        gb_figure_labels_finish(&page->labels);
        if (missing <= 0.1 || page->height >= most) {
            return page->height;
        }
        page->height += fmax(0.25 * missing, 2.0);
        page->legend_height = 0.0;
        memset(&page->layout, 0, sizeof page->layout);
    }
}

int gb_figure_surface_height(const struct gb_figure *figure, int width, int height)
{
    const double unit = gb_figure_surface_pixels_per_point(figure, width, height);
    struct gb_figure_page page = {.figure = figure,
                                  .width = width / unit,
                                  .height = height / unit,
                                  .tick_size = gb_figure_page_tick_size};
    struct gb_error err = {0};
    if (figure->per_inch == 0) {
        return height;
    }
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, 1, 1);
    cairo_t *cairo = cairo_create(surface);
    const int saved = gb_mute_stderr_begin();
    const bool good = gb_text_init(&page.text, cairo, &err); /* told when it is drawn */
    const double grown = good ? ceil(grow(&page) * unit - 1e-6) : height;
    gb_mute_stderr_end(saved);
    gb_text_finish(&page.text);
    cairo_destroy(cairo);
    cairo_surface_destroy(surface);
    return (int)fmin(grown, GB_IMAGE_MAX);
}

bool gb_figure_surface_draw(cairo_surface_t *surface, const struct gb_figure *figure,
                            const double size[2], double unit,
                            struct gb_figure_layout *layout, struct gb_error *err)
{
    cairo_t *cairo = cairo_create(surface);
    struct gb_figure_page page = {.figure = figure,
                                  .width = size[0],
                                  .height = size[1],
                                  .tick_size = gb_figure_page_tick_size};
    bool good = gb_text_init(&page.text, cairo, err);
    if (good) {
        cairo_scale(cairo, unit, unit);
        cairo_set_source_rgb(cairo, 1.0, 1.0, 1.0);
        cairo_paint(cairo);
        gb_figure_page_arrange(&page);
        gb_figure_draw_page(&page);
        page.layout.unit = unit;
        memcpy(page.layout.legend, page.labels.legend, sizeof page.layout.legend);
        page.layout.direct = page.labels.at[0][2] > 0.0;
        *layout = page.layout;
    }
    const cairo_status_t status = cairo_status(cairo);
    gb_figure_labels_finish(&page.labels);
    gb_text_finish(&page.text);
    cairo_destroy(cairo);
    if (good && status != CAIRO_STATUS_SUCCESS) {
        good = gb_error_set(
            err, status == CAIRO_STATUS_NO_MEMORY ? GB_ERR_MEMORY : GB_ERR_MACHINE,
            "the figure cannot be drawn: %s", cairo_status_to_string(status));
    }
    return good;
}
